// Adds one for each fragment that passes the depth test.
#version 460

layout(location = 0) out vec4 count;

void main() { count = vec4(1.0); }
