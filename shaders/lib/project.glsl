// From object space to clip space by the rows of an instance; the same bits in every pass.
#include "lib/clip.glsl"

vec3 toView(vec3 position_object) {
    vec4 p = vec4(position_object, 1.0);
    precise vec3 position_view =
        vec3(dot(view_from_object_0, p), dot(view_from_object_1, p), dot(view_from_object_2, p));
    return position_view;
}
