// The scene's vertex streams besides positions, as buffers.

struct SurfaceVertex {
    vec3 normal;
    vec2 uv0;
};

struct ExtendedVertex {
    vec2 uv1;
    vec4 color;
    vec4 tangent;
};
