// Vertices of a primitive that bends as a frame has them: moved by morph targets, then by a skin,
// as motion::deform() has it. Positions are the same bits as its, other vectors off by some
// roundings, since it takes them in double. One invocation a vertex.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "lib/pose_set.glsl"

layout(local_size_x = kPoseGroup) in;

struct Vertex {
    vec3 position;
    vec3 normal;
    vec3 tangent;
};

Vertex morphed(Vertex v, uint first, uint end) {
    precise vec3 position = v.position;
    precise vec3 normal = v.normal;
    precise vec3 tangent = v.tangent;
    for (uint i = first; i < end; ++i) {
        PoseDelta delta = deltas[i];
        float weight = weights[job.first_weight + delta.target];
        position = position + weight * delta.position;
        normal = normal + weight * delta.normal;
        tangent = tangent + weight * delta.tangent;
    }
    return Vertex(position, unitOr(normal, v.normal), unitOr(tangent, v.tangent));
}

PoseJoint sumOf(uint first, uint end) {
    precise vec4 row0 = vec4(0.0);
    precise vec4 row1 = vec4(0.0);
    precise vec4 row2 = vec4(0.0);
    for (uint i = first; i < end; ++i) {
        PoseInfluence influence = influences[i];
        PoseJoint joint = joints[job.first_joint + influence.joint];
        row0 = row0 + influence.weight * joint.row0;
        row1 = row1 + influence.weight * joint.row1;
        row2 = row2 + influence.weight * joint.row2;
    }
    return PoseJoint(row0, row1, row2);
}

// In glm's order.
float along(vec4 row, vec4 point) {
    precise vec4 terms = row * point;
    precise float sum = (terms.x + terms.y) + (terms.z + terms.w);
    return sum;
}

// `side`: -1 where the sum of the joints mirrors the vertex, else 1.
Vertex skinned(Vertex v, PoseJoint m, out float side) {
    vec4 point = vec4(v.position, 1.0);
    Vertex moved;
    moved.position = vec3(along(m.row0, point), along(m.row1, point), along(m.row2, point));
    vec3 sizes = max(max(abs(m.row0.xyz), abs(m.row1.xyz)), abs(m.row2.xyz));
    float size = max(max(sizes.x, sizes.y), sizes.z);
    // Products of three stay in range.
    float scale = size > 1e-6 && size < 1e6 ? 1.0 : size;
    if (!(scale > 0.0)) {
        side = 1.0;
        moved.normal = v.normal;
        moved.tangent = v.tangent;
        return moved;
    }
    vec3 x = m.row0.xyz / scale;
    vec3 y = m.row1.xyz / scale;
    vec3 z = m.row2.xyz / scale;
    // Cofactors are there for flattened joints too, where the inverse is not.
    vec3 by_x = cross(y, z);
    vec3 by_y = cross(z, x);
    vec3 by_z = cross(x, y);
    side = dot(x, by_x) < 0.0 ? -1.0 : 1.0;
    vec3 n = v.normal;
    vec3 t = v.tangent;
    moved.normal = unitOr(side * vec3(dot(by_x, n), dot(by_y, n), dot(by_z, n)), n);
    moved.tangent = unitOr(vec3(dot(x, t), dot(y, t), dot(z, t)), t);
    return moved;
}

void main() {
    uint own = ownIndex();
    if (own >= job.vertex_count) {
        return;
    }
    uint at = job.first_vertex + own;
    PoseRange first = ranges[job.first_range + own];
    PoseRange end = ranges[job.first_range + own + 1u];
    vec3 rest = rest_positions[at];
    Vertex v = Vertex(rest, rest_surfaces[at].normal, vec3(1.0, 0.0, 0.0));
    if (job.tangents != 0u) {
        v.tangent = rest_extended[at].tangent.xyz;
    }
    if (first.delta < end.delta) {
        v = morphed(v, first.delta, end.delta);
    }
    float side = 1.0;
    if (job.first_joint != kNoSkin) {
        v = skinned(v, sumOf(first.influence, end.influence), side);
    }
    posed_positions[at] = isNumber(v.position.x + v.position.y + v.position.z) ? v.position : rest;
    posed_surfaces[at].normal = v.normal;
    if (job.tangents != 0u) {
        posed_extended[at].tangent = vec4(v.tangent, rest_extended[at].tangent.w * side);
    }
}
