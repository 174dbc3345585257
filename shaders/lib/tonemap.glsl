// From linear radiance to eight bits.

// Khronos PBR Neutral tone mapper (Khronos 2024): base colours keep their hue, highlights roll off.
vec3 pbrNeutral(vec3 color) {
    const float kStart = 0.8 - 0.04;
    const float kDesaturation = 0.15;
    float low = min(color.r, min(color.g, color.b));
    float offset = low < 0.08 ? low - 6.25 * low * low : 0.04;
    color -= offset;
    float peak = max(color.r, max(color.g, color.b));
    if (peak < kStart) {
        return color;
    }
    float d = 1.0 - kStart;
    float new_peak = 1.0 - d * d / (peak + d - kStart);
    color *= new_peak / peak;
    float g = 1.0 - 1.0 / (kDesaturation * (peak - new_peak) + 1.0);
    return mix(color, vec3(new_peak), g);
}

// IEC 61966-2-1.
vec3 srgbEncode(vec3 c) {
    vec3 low = c * 12.92;
    vec3 high = 1.055 * pow(max(c, vec3(0.0031308)), vec3(1.0 / 2.4)) - 0.055;
    return mix(high, low, lessThan(c, vec3(0.0031308)));
}

vec3 srgbDecode(vec3 c) {
    vec3 high = pow((c + 0.055) / 1.055, vec3(2.4));
    return mix(high, c / 12.92, lessThanEqual(c, vec3(0.04045)));
}

// What pbrNeutral() takes to this. White would be infinite: at most 0.95 is.
vec3 inverseNeutral(vec3 color) {
    const float kStart = 0.8 - 0.04;
    const float kDesaturation = 0.15;
    float new_peak = max(color.r, max(color.g, color.b));
    if (new_peak > 0.95) {
        color *= 0.95 / new_peak;
        new_peak = 0.95;
    }
    if (new_peak > kStart) {
        float d = 1.0 - kStart;
        float peak = d * d / (1.0 - new_peak) - d + kStart;
        float g = 1.0 - 1.0 / (kDesaturation * (peak - new_peak) + 1.0);
        color = max((color - g * new_peak) / (1.0 - g), vec3(0.0)) * (peak / new_peak);
    }
    float low = min(color.r, min(color.g, color.b));
    return color + (low < 0.04 ? sqrt(low / 6.25) - low : 0.04);
}

// Radiance that displayColor() shows as this colour: of what is blended and unlit.
vec3 shownAs(vec3 color) {
    return (hasOutput(kOutputClamp) ? color : inverseNeutral(clamp(color, vec3(0.0), vec3(1.0)))) /
           frame.exposure;
}

// What the display emits, linear, 0 to 1. Exposed and tone-mapped is what is lit: the background
// and unlit surfaces (KHR_materials_unlit) have their own colours whatever the exposure. Alpha
// tells how much of the background is covered or, above 1, how much of an unlit surface is seen.
// Radiance beyond fp32's comfort becomes white, not infinity.
vec3 displayColor(vec4 radiance, vec3 background) {
    vec3 c = min(radiance.rgb * frame.exposure, vec3(1e6));
    if (!hasOutput(kOutputClamp)) {
        c = pbrNeutral(c);
    }
    if (radiance.a < 1.0) {
        c += (1.0 - radiance.a) * background;
    } else if (radiance.a > 1.0) {
        c = mix(c, radiance.rgb, radiance.a - 1.0);
    }
    return clamp(c, vec3(0.0), vec3(1.0));
}

// Of a row of so many.
vec3 backgroundAt(uint row, uint rows) {
    float up = 1.0 - 2.0 * (float(row) + 0.5) / float(rows);
    return frame.background * (1.0 + frame.background_gradient * up);
}

// RGBA8, alpha 255.
uint packDisplay(vec3 color) { return packUnorm4x8(vec4(srgbEncode(color), 1.0)); }
