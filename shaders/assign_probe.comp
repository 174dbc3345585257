// Divides and takes roots, for the host to see whether this device rounds them as it does.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "lib/assign_round.glsl"

layout(local_size_x = 64) in;

layout(set = 0, binding = 0, scalar) readonly buffer OperandBlock { double operands[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer ResultBlock { double results[]; };

void main() {
    uint i = 2u * gl_GlobalInvocationID.x;
    results[i] = assignDivide(operands[i], operands[i + 1u]);
    results[i + 1u] = assignSqrt(operands[i]);
}
