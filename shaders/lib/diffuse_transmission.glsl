// Light from behind that a surface scatters towards the eye (KHR_materials_diffuse_transmission),
// in place of as much of what its base colour scatters. It is lit as a matt surface on the other
// side, and Fresnel's term is that of an eye mirrored there.
#ifndef FROXEL_DIFFUSE_TRANSMISSION
#define FROXEL_DIFFUSE_TRANSMISSION

struct DiffuseTransmission {
    vec3 color;
    float strength;
};

bool hasDiffuseTransmission() { return hasMaterial(kMaterialDiffuseTransmission); }

DiffuseTransmission noDiffuseTransmission() { return DiffuseTransmission(vec3(0.0), 0.0); }

// What is left of white light after `ways` times the way whose color is known (Beer's law).
vec3 attenuated(vec3 color, float ways) {
    precise vec3 left = exp2(log2(max(color, vec3(1e-30))) * ways);
    left = mix(left, vec3(ways > 0.0 ? 0.0 : 1.0), lessThan(color, vec3(1e-30)));
    return mix(left, vec3(1.0), equal(color, vec3(1.0)));
}

#endif
