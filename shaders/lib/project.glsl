// From object space to clip space by the rows of an instance; the same bits in every pass.

vec3 toView(vec3 position_object) {
    vec4 p = vec4(position_object, 1.0);
    precise vec3 position_view = vec3(dot(view_from_object_0, p), dot(view_from_object_1, p),
                                      dot(view_from_object_2, p));
    return position_view;
}

vec4 project(vec3 position_view) {
    precise float w = frame.clip_w.x + frame.clip_w.y * position_view.z;
    precise vec4 clip = vec4(position_view.xy * frame.clip_scale + frame.clip_offset * w,
                             frame.clip_z.x + frame.clip_z.y * position_view.z, w);
    return clip;
}
