// Samples a texture at given places by given gradients, as the visibility passes do.
#version 460
#extension GL_EXT_scalar_block_layout : require

struct TextureSample {
    vec2 uv;
    vec2 dx;
    vec2 dy;
    vec4 value;
};

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) buffer SampleBlock {
    TextureSample samples[];
};
layout(set = 0, binding = 1) uniform sampler2D sampled_texture;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < samples.length()) {
        TextureSample s = samples[i];
        samples[i].value = textureGrad(sampled_texture, s.uv, s.dx, s.dy);
    }
}
