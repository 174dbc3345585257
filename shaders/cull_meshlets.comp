// Which placed meshlets may be seen: inside the frustum and not facing away as a whole; of a mesh
// with coarser levels, those of the level that the frame takes. Never leaves out anything visible.
// One invocation a meshlet; its rank among those of its workgroup keeps order. Where ids are
// rastered in compute, which needs no order, a list is made at once.
#version 460
#extension GL_EXT_scalar_block_layout : require
#ifdef FROXEL_LIST
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#endif
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#define FROXEL_CAMERA_ALONE
#include "lib/frame.glsl"
#include "lib/visibility_set.glsl"
#include "lib/visibility_draws.glsl"
#ifdef FROXEL_LIST
#include "lib/raster_set.glsl"
#endif
#ifdef FROXEL_DETAIL
#include "lib/detail_choice.glsl"
#endif

layout(local_size_x = kCullGroup) in;

// Spheres are tested with this share of slack, and the rounding of the planes on top.
const float kSlack = 1e-4;
const float kRounding = 1e-6;

// Whether a sphere lies outside x * normal.x + y * normal.y + z * normal.z + offset >= 0, a plane
// in view space, taken to object space: no transform of the radius is needed.
bool beyond(InstanceView view, vec3 normal, float offset, vec3 center, float radius) {
    vec4 plane = view.row0 * normal.x + view.row1 * normal.y + view.row2 * normal.z;
    plane.w += offset;
    float reach = length(plane.xyz) * (radius * (1.0 + kSlack) + kSlack * 1e-2);
    float rounding = kRounding * (dot(abs(plane.xyz), abs(center)) + abs(plane.w));
    return dot(plane.xyz, center) + plane.w < -reach - rounding;
}

// w + x, w - x, w + y, w - y and w - z of clip space, all linear in view space.
bool outside(InstanceView view, vec3 center, float radius) {
    vec2 s = frame.camera.clip_scale;
    vec2 more = 1.0 + frame.camera.clip_offset;
    vec2 less = 1.0 - frame.camera.clip_offset;
    vec2 w = frame.camera.clip_w;
    return beyond(view, vec3(s.x, 0.0, w.y * more.x), w.x * more.x, center, radius) ||
           beyond(view, vec3(-s.x, 0.0, w.y * less.x), w.x * less.x, center, radius) ||
           beyond(view, vec3(0.0, s.y, w.y * more.y), w.x * more.y, center, radius) ||
           beyond(view, vec3(0.0, -s.y, w.y * less.y), w.x * less.y, center, radius) ||
           beyond(view, vec3(0.0, 0.0, w.y - frame.camera.clip_z.y), w.x - frame.camera.clip_z.x,
                  center, radius);
}

bool facesAway(InstanceView view, Meshlet m, uint flags) {
    // An eye too far away for its object space (a singular or tiny scale) says nothing.
    bool known = frame.camera.orthographic == 0.0 && all(lessThan(abs(view.eye_object), vec3(1e6)));
    if (!known || (flags & kMaterialDoubleSided) != 0 || m.cone_cutoff >= 1.0) {
        return false;
    }
    vec3 toward = m.center - view.eye_object;
    float rounding = kRounding * length(view.eye_object);
    return dot(toward, m.cone_axis) >=
           m.cone_cutoff * length(toward) + m.radius * (1.0 + kSlack) + kSlack + rounding;
}

bool isVisible(PlacedMeshlet placed) {
    if (placed.meshlet == kNoMeshlet) {
        return false;
    }
    VisibleItem item = items[placed.item];
    InstanceView view = instances[item.instance];
#ifdef FROXEL_DETAIL
    if (!drawsDetail(view, details[placed.meshlet])) {
        return false;
    }
#endif
    if ((cull_flags & kKeepAll) != 0u || item.bends != 0u) {
        return true;
    }
    Meshlet m = meshlets[placed.meshlet];
    return !outside(view, m.center, m.radius) && !facesAway(view, m, item.flags);
}

shared uint scan[kCullGroup];
#ifdef FROXEL_LIST
shared uint group_first;

// Makes room for so many in the list, of which each batch has its part; where it begins.
uint appendVisible(uint count) {
    uint first = atomicAdd(batches[0].listed_of_all, count);
    uint most = batches[0].most;
    for (uint at = first; at < first + count;) {
        uint batch = at / most;
        uint end = min((batch + 1u) * most, first + count);
        atomicAdd(batches[batch].listed.x, end - at);
        batches[batch].others.x = kRasterBlockGroups; // whoever is first or last
        at = end;
    }
    return first;
}
#endif

void main() {
    uint i = gl_GlobalInvocationID.x;
    uint lane = gl_LocalInvocationIndex;
    uint placed = placedAt(i);
    bool visible = isVisible(placed_meshlets[placed]);
    scan[lane] = visible ? 1u : 0u;
    barrier();
    for (uint step = 1; step < kCullGroup; step *= 2) {
        uint before = lane >= step ? scan[lane - step] : 0u;
        barrier();
        scan[lane] += before;
        barrier();
    }
#ifdef FROXEL_LIST
    if (lane == kCullGroup - 1) {
        group_first = appendVisible(scan[lane]);
    }
    barrier();
    if (visible) {
        visible_meshlets[group_first + scan[lane] - 1u] = placed;
    }
#else
    ranks[i] = visible ? scan[lane] - 1u : kCulled;
    if (lane == kCullGroup - 1) {
        counts[group_count + gl_WorkGroupID.x] = scan[lane];
    }
#endif
}
