// Highlights that are longer in one direction of the surface (KHR_materials_anisotropy): the
// distribution of Trowbridge and Reitz with two roughnesses, and Smith's height-correlated
// shadowing (Heitz 2014). What is around is seen by a round lobe about a normal that is bent as a
// cylinder's along the bitangent would be; rectangles by a round lobe of as much area. Blinn's
// stays round.
#ifndef FROXEL_ANISOTROPY
#define FROXEL_ANISOTROPY

struct Anisotropy {
    float strength;
    vec3 tangent_view; // along which highlights are longer; any length but 0 where strength is not
};

// What is lit of it.
struct AnisotropySurface {
    vec3 tangent_view; // unit, as its bitangent; on the surface
    vec3 bitangent_view;
    float alpha_t;
    float alpha_b;
    float strength;
};

bool hasAnisotropy() { return hasMaterial(kMaterialAnisotropy) && !hasLight(kLightBlinnPhong); }

Anisotropy noAnisotropy() { return Anisotropy(0.0, vec3(1.0, 0.0, 0.0)); }

AnisotropySurface anisotropySurface(Anisotropy a, vec3 normal_view, float alpha) {
    precise AnisotropySurface s;
    vec3 along = a.tangent_view - normal_view * dot(normal_view, a.tangent_view);
    float length2 = dot(along, along);
    bool known = length2 > 1e-12;
    // Any direction will do where highlights are round.
    vec3 other = abs(normal_view.x) < 0.6 ? vec3(0.0, normal_view.z, -normal_view.y)
                                          : vec3(-normal_view.z, 0.0, normal_view.x);
    s.tangent_view = normalize(known ? along : other);
    s.bitangent_view = cross(normal_view, s.tangent_view);
    s.strength = known ? a.strength : 0.0;
    s.alpha_t = mix(alpha, 1.0, s.strength * s.strength);
    s.alpha_b = alpha;
    return s;
}

#endif
