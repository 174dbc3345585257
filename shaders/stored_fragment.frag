// A debug view's value of each fragment that passes the depth test.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "lib/stored_fragment.glsl"

void main() { stored = fragmentValue(); }
