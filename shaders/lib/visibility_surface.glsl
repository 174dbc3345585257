// From a pixel's id to its triangle, and from there to what the rasteriser would have interpolated:
// `precise`, so that it has the same bits in every variant of a shader.

struct VisibleTriangle {
    uvec3 vertices;
    uint item;
    // In view space: its corners, and the edges from the first.
    vec3 corner;
    vec3 corner1;
    vec3 corner2;
    vec3 edge1;
    vec3 edge2;
};

vec3 viewPoint(InstanceView view, vec3 position_object) {
    vec4 p = vec4(position_object, 1.0);
    precise vec3 position_view = vec3(dot(view.row0, p), dot(view.row1, p), dot(view.row2, p));
    return position_view;
}

VisibleTriangle fetchTriangle(uint id) {
    PlacedMeshlet placed = placed_meshlets[id >> kTriangleBits];
    uint first = placed.first_index + 3u * (id & ((1u << kTriangleBits) - 1u));
    VisibleTriangle t;
    t.item = placed.item;
    t.vertices = uvec3(indices[first], indices[first + 1u], indices[first + 2u]) +
                 items[placed.item].vertex_offset;
    InstanceView view = instances[items[placed.item].instance];
    t.corner = viewPoint(view, positions[t.vertices.x]);
    t.corner1 = viewPoint(view, positions[t.vertices.y]);
    t.corner2 = viewPoint(view, positions[t.vertices.z]);
    t.edge1 = t.corner1 - t.corner;
    t.edge2 = t.corner2 - t.corner;
    return t;
}

// The ray of a pixel meets the triangle's plane at corner + x * edge1 + y * edge2 (Moeller and
// Trumbore 1997): perspective-correct weights of the second and third corner.
vec2 planeCoordinates(VisibleTriangle t, vec2 pixel) {
    precise vec2 ray = (pixel + 0.5) * frame.camera.ray_scale + frame.camera.ray_offset;
    precise vec3 direction = vec3(ray * frame.camera.ray_spread.y, -1.0);
    precise vec3 from_corner = vec3(ray * frame.camera.ray_spread.x, 0.0) - t.corner;
    precise vec3 across = cross(direction, t.edge2);
    precise float area = dot(t.edge1, across);
    precise vec2 weights =
        vec2(dot(from_corner, across), dot(direction, cross(from_corner, t.edge1))) / area;
    return area != 0.0 ? weights : vec2(0.0); // edge-on
}

// A vertex attribute as an affine function of the plane's coordinates.
#define attributeOf(type)                                                                          \
    type interpolate(type a, type b, type c, vec2 w) {                                             \
        precise type value = a + (b - a) * w.x + (c - a) * w.y;                                    \
        return value;                                                                              \
    }                                                                                              \
    type change(type a, type b, type c, vec2 w) {                                                  \
        precise type value = (b - a) * w.x + (c - a) * w.y;                                        \
        return value;                                                                              \
    }
attributeOf(vec2);
attributeOf(vec3);
attributeOf(vec4);
#undef attributeOf

// As surface.vert.
vec3 viewNormal(InstanceView view, vec3 normal_object) {
    precise vec3 c0 = cross(view.row1.xyz, view.row2.xyz);
    precise vec3 c1 = cross(view.row2.xyz, view.row0.xyz);
    precise vec3 c2 = cross(view.row0.xyz, view.row1.xyz);
    float side = view.mirrored != 0u ? -1.0 : 1.0;
    precise vec3 normal =
        side * vec3(dot(c0, normal_object), dot(c1, normal_object), dot(c2, normal_object));
    return normal;
}

vec4 viewTangent(InstanceView view, vec4 tangent_object) {
    precise vec3 t =
        vec3(dot(view.row0.xyz, tangent_object.xyz), dot(view.row1.xyz, tangent_object.xyz),
             dot(view.row2.xyz, tangent_object.xyz));
    float side = view.mirrored != 0u ? -1.0 : 1.0;
    precise vec4 tangent = vec4(dot(t, t) > 0.0 ? normalize(t) : t, tangent_object.w * side);
    return tangent;
}

// Whether the pixel looks at the triangle's front.
bool showsFront(VisibleTriangle t, InstanceView view, uvec2 pixel) {
    vec2 ray = (vec2(pixel) + 0.5) * frame.camera.ray_scale + frame.camera.ray_offset;
    vec3 direction = vec3(ray * frame.camera.ray_spread.y, -1.0);
    bool counter_clockwise = dot(cross(t.edge1, t.edge2), direction) < 0.0;
    return counter_clockwise != (view.mirrored != 0u);
}

// Fills visible_flags, visible_textures, visible_material and gradients; returns what the vertex
// stage would have handed on. Gradients are differences inside the pixel's quad, as a rasteriser
// takes them.
VertexData fetchSurface(VisibleTriangle t, uvec2 pixel, out bool front) {
    VisibleItem item = items[t.item];
    InstanceView view = instances[item.instance];
    visible_flags = item.flags;
    visible_textures = item.textures;
    visible_material = item.material_index;
    front = showsFront(t, view, pixel);

    vec2 step = 1.0 - 2.0 * vec2(pixel & 1u);
    precise vec2 w = planeCoordinates(t, vec2(pixel));
    precise vec2 w_dx = (planeCoordinates(t, vec2(pixel) + vec2(step.x, 0.0)) - w) * step.x;
    precise vec2 w_dy = (planeCoordinates(t, vec2(pixel) + vec2(0.0, step.y)) - w) * step.y;
    // The pixel's centre lies in the triangle; of slivers the arithmetic may say otherwise.
    w = clamp(w, vec2(0.0), vec2(1.0, 1.0 - clamp(w.x, 0.0, 1.0)));
    const vec3 corner = vec3(0.0);
    gradients.position_dx = change(corner, t.edge1, t.edge2, w_dx);
    gradients.position_dy = change(corner, t.edge1, t.edge2, w_dy);

    SurfaceVertex a = surfaces[t.vertices.x];
    SurfaceVertex b = surfaces[t.vertices.y];
    SurfaceVertex c = surfaces[t.vertices.z];
    VertexData v = VertexData(viewNormal(view, interpolate(a.normal, b.normal, c.normal, w)),
                              interpolate(a.uv0, b.uv0, c.uv0, w), vec2(0.0), vec4(1.0), vec4(0.0));
    gradients.uv0_dx = change(a.uv0, b.uv0, c.uv0, w_dx);
    gradients.uv0_dy = change(a.uv0, b.uv0, c.uv0, w_dy);
    gradients.uv1_dx = vec2(0.0);
    gradients.uv1_dy = vec2(0.0);
    if (hasMaterial(kMaterialExtended)) {
        ExtendedVertex d = extended[t.vertices.x];
        ExtendedVertex e = extended[t.vertices.y];
        ExtendedVertex f = extended[t.vertices.z];
        v.uv1 = interpolate(d.uv1, e.uv1, f.uv1, w);
        v.color = interpolate(d.color, e.color, f.color, w);
        v.tangent_view = interpolate(viewTangent(view, d.tangent), viewTangent(view, e.tangent),
                                     viewTangent(view, f.tangent), w);
        gradients.uv1_dx = change(d.uv1, e.uv1, f.uv1, w_dx);
        gradients.uv1_dy = change(d.uv1, e.uv1, f.uv1, w_dy);
    }
    return v;
}
