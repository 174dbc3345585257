// Light that passes a surface as through glass (KHR_materials_transmission, _volume, _dispersion):
// what the picture behind it shows. A thin wall does not bend it; in a body it is bent once, as it
// enters, and goes the body's thickness before it is looked up where it then is on screen.
layout(set = FROXEL_BEHIND_SET, binding = 0) uniform texture2D solid_depth;
// The picture behind this layer, whose alpha is how much of the background is covered. Each level
// has half the sides of the one before.
layout(set = FROXEL_BEHIND_SET, binding = 2) uniform sampler2D behind_image;

// Cubic B-spline by four bilinear samples (Sigg and Hadwiger 2005, "Fast Third-Order Texture
// Filtering"): a level by itself shows its texels.
vec3 smoothLevel(vec2 uv, float level) {
    vec2 size = vec2(textureSize(behind_image, int(level)));
    vec2 at = uv * size - 0.5;
    vec2 f = fract(at);
    vec2 left = 1.0 - f;
    vec2 w0 = left * left * left / 6.0;
    vec2 w1 = 2.0 / 3.0 - f * f + f * f * f / 2.0;
    vec2 w3 = f * f * f / 6.0;
    vec2 low = w0 + w1;
    vec2 first = (at - f - 0.5 + w1 / low) / size;
    vec2 second = (at - f + 1.5 + w3 / (1.0 - low)) / size;
    vec3 top = mix(textureLod(behind_image, vec2(second.x, first.y), level).rgb,
                   textureLod(behind_image, first, level).rgb, low.x);
    vec3 bottom = mix(textureLod(behind_image, second, level).rgb,
                      textureLod(behind_image, vec2(first.x, second.y), level).rgb, low.x);
    return mix(bottom, top, low.y);
}

// at: in pixels, whose centres are at halves.
vec3 behindAt(vec2 at, float level) {
    vec2 uv = at / vec2(frame.camera.width_px, frame.camera.height_px);
    if (!isFrosted() || level <= 0.0) {
        return textureLod(behind_image, uv, 0.0).rgb;
    }
    float most = float(textureQueryLevels(behind_image) - 1);
    float lower = min(floor(level), most);
    return mix(smoothLevel(uv, lower), smoothLevel(uv, min(lower + 1.0, most)),
               clamp(level - lower, 0.0, 1.0));
}

// Where the ray that enters at a point is seen to leave the body.
vec2 exitAt(vec3 position_view, vec3 way) {
    vec3 left_view = position_view + way;
    vec2 ray = left_view.xy / (frame.camera.ray_spread.x - frame.camera.ray_spread.y * left_view.z);
    return (ray - frame.camera.ray_offset) / frame.camera.ray_scale;
}

// Along the ray that enters, as far as the body is thick, in metres. object_from_view: of the
// instance, of directions.
vec3 wayThrough(Surface s, mat3 object_from_view, float ior, float thickness) {
    vec3 normal = s.n_dot_eye < 0.0 ? -s.normal_view : s.normal_view;
    vec3 direction = refract(-s.to_eye_view, normal, 1.0 / ior);
    float turned = length(object_from_view * direction);
    return direction * (turned > 0.0 ? thickness / turned : 0.0);
}

vec3 seenAlong(vec3 way, Surface s, vec2 own, float depth, float level) {
    vec2 at = exitAt(s.position_view, way);
    // What stands before the surface is not behind it.
    ivec2 texel = ivec2(clamp(at, vec2(0.0), vec2(textureSize(behind_image, 0)) - 1.0));
    bool before = texelFetch(solid_depth, texel, 0).r > depth;
    return behindAt(before ? own : at, level);
}

vec3 seenBent(Surface s, Transmission t, mat3 object_from_view, vec3 way, vec2 own, float depth,
              float level) {
    vec3 seen = seenAlong(way, s, own, depth, level);
    if (hasDispersion() && t.dispersion != 0.0) {
        float spread = (t.ior - 1.0) * 0.025 * t.dispersion;
        vec3 red = wayThrough(s, object_from_view, max(t.ior - spread, 1.0), t.thickness);
        vec3 blue = wayThrough(s, object_from_view, t.ior + spread, t.thickness);
        seen.r = seenAlong(red, s, own, depth, level).r;
        seen.b = seenAlong(blue, s, own, depth, level).b;
    }
    return seen;
}

// What arrives at the surface from behind; left: the share of white light that is left after the
// body. depth: of the fragment.
vec3 seenBehind(Surface s, Transmission t, uvec2 pixel, float depth, mat3 object_from_view,
                out vec3 left) {
    left = vec3(1.0);
    float level = isFrosted() ? log2(float(frame.camera.width_px)) * t.roughness : 0.0;
    vec2 own = vec2(pixel) + 0.5;
    if (hasBody() && t.thickness > 0.0) {
        vec3 way = wayThrough(s, object_from_view, t.ior, t.thickness);
        if (t.attenuation_m > 0.0) {
            left = attenuated(t.attenuation_color, length(way) / t.attenuation_m);
        }
        return seenBent(s, t, object_from_view, way, own, depth, level);
    }
    return isFrosted() && level > 0.0 ? behindAt(own, level)
                                      : texelFetch(behind_image, ivec2(pixel), 0).rgb;
}

// What arrives at the surface from behind and is left after the body, without the fog before the
// surface: what is behind was seen through all of the fog. Of lights behind the surface `sum` keeps
// what the body leaves.
vec3 broughtBehind(Surface s, Transmission t, uvec2 pixel, float depth, float distance,
                   mat3 object_from_view, inout LightSum sum) {
    vec3 left;
    vec3 seen = seenBehind(s, t, pixel, depth, object_from_view, left);
    sum.layers.through = min(sum.layers.through, kMostSum) * left;
    sum.layers.through_grazing = min(sum.layers.through_grazing, kMostSum) * left;
    return withoutFog(seen, pixel, distance) * left;
}
