// What a material looks like at a point of a surface.
#ifdef FROXEL_VISIBILITY
#include "lib/visibility_material.glsl"
#else
#include "lib/fragment_material.glsl"
#endif

// What the vertex stage hands on.
struct VertexData {
    vec3 normal_view;
    vec2 uv0;
    vec2 uv1;
    vec4 color;
    vec4 tangent_view;
};

vec2 slotUv(VertexData v, UvTransform t) {
    if (!hasMaterial(kMaterialUvTransform)) {
        return v.uv0;
    }
    vec2 uv = t.texcoord == 0u ? v.uv0 : v.uv1;
    return vec2(dot(t.row0.xy, uv) + t.row0.z, dot(t.row1.xy, uv) + t.row1.z);
}

vec4 baseColor(VertexData v) {
    vec4 color = material.base_color;
    if (hasTexture(base_color_slot)) {
        color *= sampleMaterial(base_color, v);
    }
    if (hasMaterial(kMaterialExtended)) {
        color *= v.color;
    }
    return color;
}

bool maskedOut(vec4 base) { return hasMaterial(kMaterialMask) && base.a < material.alpha_cutoff; }

// A surface's directions along which u grows and v falls: glTF's green channel points up in the
// image. The longer of the two is about unit.
struct TangentFrame {
    vec3 tangent_view;
    vec3 bitangent_view;
    bool known; // false: no texture coordinates to speak of
};

// From the file's tangents; else from screen-space derivatives (Mikkelsen 2020, "Surface Gradient
// Based Bump Mapping Framework"): constant over a triangle, right for mirrored texture coordinates,
// and nothing to store. Derivatives are taken of the same values in every renderer.
TangentFrame tangentFrame(VertexData v, vec3 n, vec3 position_view, UvTransform transform) {
    TangentFrame frame;
    frame.known = true;
    if (hasMaterial(kMaterialTangents)) {
        frame.tangent_view = v.tangent_view.xyz;
        frame.bitangent_view = cross(n, v.tangent_view.xyz) * v.tangent_view.w;
        return frame;
    }
    vec3 dpx = positionDx(position_view);
    vec3 dpy = positionDy(position_view);
    vec2 dux = uvDx(v, transform);
    vec2 duy = uvDy(v, transform);
    vec3 across_x = cross(n, dpx);
    vec3 across_y = cross(dpy, n);
    // Gradients of u and v over the surface, up to a common factor.
    vec3 t = across_y * dux.x + across_x * duy.x;
    vec3 b = across_y * dux.y + across_x * duy.y;
    float longest = max(dot(t, t), dot(b, b));
    frame.known = longest > 0.0;
    // Keeps handedness: the area's sign in screen space turns both.
    float handed = dot(across_y, dpx) < 0.0 ? -1.0 : 1.0;
    float scale = handed * inversesqrt(longest);
    frame.tangent_view = t * scale;
    frame.bitangent_view = b * -scale;
    return frame;
}

// `sampled`: of a map that `transform` places.
vec3 perturbNormal(VertexData v, vec3 n, vec3 position_view, vec3 sampled, UvTransform transform) {
    TangentFrame frame = tangentFrame(v, n, position_view, transform);
    if (!frame.known) {
        return n;
    }
    precise vec3 bent =
        frame.tangent_view * sampled.x + frame.bitangent_view * sampled.y + n * sampled.z;
    return normalize(bent);
}

// What the dielectric reflects, clamped before the strength; or, with it, how glossy it is.
void shadeSpecular(VertexData v, inout GbufferSample g) {
    vec3 f0 = material.specular_f0;
    float strength = material.specular;
    if (hasTexture(specular_color_slot)) {
        vec4 color = sampleMaterial(specular_color, v);
        f0 *= color.rgb;
        if (hasMaterial(kMaterialGlossiness)) {
            g.roughness = 1.0 - (1.0 - material.roughness) * color.a;
        }
    }
    if (hasTexture(specular_slot)) {
        strength *= sampleMaterial(specular, v).a;
    }
    g.dielectric = Dielectric(false, min(f0, vec3(1.0)) * strength, strength);
}

vec3 unpackNormalMap(vec4 texel, float scale) {
    vec3 sampled = texel.xyz * 2.0 - 1.0;
    sampled.xy *= scale;
    return sampled;
}

float metalness(VertexData v) {
    return hasTexture(metallic_roughness_slot)
               ? material.metallic * sampleMaterial(metallic_roughness, v).b
               : material.metallic;
}

#ifdef FROXEL_LAYERED
// Of white light, straight through the body.
vec3 leftOfBody(VertexData v) {
    float thickness_m = material.volume.thickness_m;
    if (hasTexture(thickness_slot)) {
        thickness_m *= sampleMaterial(thickness, v).g;
    }
    return material.volume.attenuation_m > 0.0
               ? attenuated(material.volume.attenuation_color,
                            thickness_m / material.volume.attenuation_m)
               : vec3(1.0);
}
// Bumps of what it covers are not the coat's.
Coat shadeCoat(VertexData v, vec3 position_view, bool front) {
    Coat coat = Coat(material.coat.strength, material.coat.roughness, normalize(v.normal_view));
    if (hasTexture(coat_slot)) {
        coat.strength *= sampleMaterial(coat, v).r;
    }
    if (hasTexture(coat_roughness_slot)) {
        coat.roughness *= sampleMaterial(coat_roughness, v).g;
    }
    if (hasTexture(coat_normal_slot)) {
        vec4 texel = sampleMaterial(coat_normal, v);
        coat.normal_view = perturbNormal(v, coat.normal_view, position_view,
                                         unpackNormalMap(texel, material.coat.normal_scale),
                                         material.uv[coat_normal_slot]);
    }
    if (hasMaterial(kMaterialDoubleSided)) {
        coat.normal_view = front ? coat.normal_view : -coat.normal_view;
    }
    return coat;
}

Sheen shadeSheen(VertexData v) {
    Sheen sheen = Sheen(material.sheen.color, material.sheen.roughness);
    if (hasTexture(sheen_color_slot)) {
        sheen.color *= sampleMaterial(sheen_color, v).rgb;
    }
    if (hasTexture(sheen_roughness_slot)) {
        sheen.roughness *= sampleMaterial(sheen_roughness, v).a;
    }
    return sheen;
}

// n: the shape's normal.
Anisotropy shadeAnisotropy(VertexData v, vec3 n, vec3 position_view) {
    Anisotropy a = Anisotropy(material.anisotropy.strength, vec3(0.0));
    vec2 direction = vec2(1.0, 0.0);
    if (hasTexture(anisotropy_slot)) {
        vec3 texel = sampleMaterial(anisotropy, v).xyz;
        direction = texel.xy * 2.0 - 1.0;
        a.strength *= texel.z;
    }
    float c = cos(material.anisotropy.rotation_rad);
    float s = sin(material.anisotropy.rotation_rad);
    direction = vec2(c * direction.x - s * direction.y, s * direction.x + c * direction.y);
    TangentFrame frame = tangentFrame(v, n, position_view, material.uv[anisotropy_slot]);
    if (frame.known) {
        vec3 t = frame.tangent_view;
        vec3 b = frame.bitangent_view;
        float t2 = dot(t, t);
        t = t2 > 0.0 ? t * inversesqrt(t2) : cross(b, n);
        vec3 turned = cross(n, t);
        b = dot(turned, b) < 0.0 ? -turned : turned;
        a.tangent_view = t * direction.x + b * direction.y;
    }
    return a;
}

Film shadeFilm(VertexData v) {
    Film film = Film(material.film.strength, material.film.ior, material.film.most_nm);
    if (hasTexture(film_slot)) {
        film.strength *= sampleMaterial(film, v).r;
    }
    if (hasTexture(film_thickness_slot)) {
        film.thickness_nm =
            mix(material.film.least_nm, material.film.most_nm, sampleMaterial(film_thickness, v).g);
    }
    return film;
}

DiffuseTransmission shadeDiffuseTransmission(VertexData v) {
    DiffuseTransmission through = DiffuseTransmission(material.diffuse_transmission.color,
                                                      material.diffuse_transmission.strength);
    if (hasTexture(diffuse_transmission_slot)) {
        through.strength *= sampleMaterial(diffuse_transmission, v).a;
    }
    if (hasTexture(diffuse_transmission_color_slot)) {
        through.color *= sampleMaterial(diffuse_transmission_color, v).rgb;
    }
    if (material.volume.thickness_m > 0.0) {
        through.color *= leftOfBody(v);
    }
    return through;
}

// roughness: of the surface.
Transmission shadeTransmission(VertexData v, float roughness) {
    Transmission t =
        Transmission(material.transmission.strength, transmittedRoughness(roughness, material.ior),
                     material.ior, material.transmission.dispersion, material.volume.thickness_m,
                     material.volume.attenuation_color, material.volume.attenuation_m);
    if (hasTexture(transmission_slot)) {
        t.strength *= sampleMaterial(transmission, v).r;
    }
    if (hasTexture(thickness_slot)) {
        t.thickness *= sampleMaterial(thickness, v).g;
    }
    return t;
}
#endif

GbufferSample shadeMaterial(VertexData v, vec4 base, vec3 position_view, bool front) {
    precise GbufferSample g;
    g.base_color = clamp(base.rgb, vec3(0.0), vec3(1.0));
    vec3 n = normalize(v.normal_view);
    if (hasTexture(normal_slot)) {
        vec4 texel = sampleMaterial(normal, v);
        n = perturbNormal(v, n, position_view, unpackNormalMap(texel, material.normal_scale),
                          material.uv[normal_slot]);
    }
    if (hasMaterial(kMaterialDoubleSided)) {
        n = front ? n : -n; // bumps and all: seen from behind they are dents
    }
    g.normal_view = n;
    g.roughness = material.roughness;
    g.metallic = material.metallic;
    if (hasTexture(metallic_roughness_slot)) {
        vec4 mr = sampleMaterial(metallic_roughness, v);
        g.roughness *= mr.g;
        g.metallic *= mr.b;
    }
    g.occlusion = 1.0;
    if (hasTexture(occlusion_slot)) {
        float r = sampleMaterial(occlusion, v).r;
        g.occlusion = 1.0 + material.occlusion_strength * (r - 1.0);
    }
    g.emissive = material.emissive;
    if (hasTexture(emissive_slot)) {
        g.emissive *= sampleMaterial(emissive, v).rgb;
    }
    g.unlit = hasMaterial(kMaterialUnlit);
    g.dielectric = usualDielectric();
    if (hasMaterial(kMaterialSpecular)) {
        shadeSpecular(v, g);
    }
#ifdef FROXEL_LAYERED
    g.layers = noLayers(n);
    if (hasCoat()) {
        g.layers.coat = shadeCoat(v, position_view, front);
    }
    if (hasSheen()) {
        g.layers.sheen = shadeSheen(v);
    }
    if (hasAnisotropy()) {
        g.layers.anisotropy = shadeAnisotropy(v, normalize(v.normal_view), position_view);
    }
    if (hasFilm()) {
        g.layers.film = shadeFilm(v);
    }
    if (hasDiffuseTransmission()) {
        g.layers.diffuse_transmission = shadeDiffuseTransmission(v);
    }
    if (hasTransmission()) {
        g.layers.transmission = shadeTransmission(v, g.roughness);
    }
#endif
    return g;
}
