// The fragment stage's side of surface.vert.
layout(location = 0) in vec3 normal_view_in;
layout(location = 1) in vec2 uv0_in;
#ifdef FROXEL_EXTENDED
layout(location = 2) in vec2 uv1_in;
layout(location = 3) in vec4 color_in;
layout(location = 4) in vec4 tangent_view_in;
#endif

VertexData vertexData() {
#ifdef FROXEL_EXTENDED
    return VertexData(normal_view_in, uv0_in, uv1_in, color_in, tangent_view_in);
#else
    return VertexData(normal_view_in, uv0_in, vec2(0.0), vec4(1.0), vec4(0.0));
#endif
}
