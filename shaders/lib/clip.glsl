// From view space to clip space; the same bits in every pass.
vec4 project(vec3 position_view) {
    precise float w = frame.clip_w.x + frame.clip_w.y * position_view.z;
    precise vec4 clip = vec4(position_view.xy * frame.clip_scale + frame.clip_offset * w,
                             frame.clip_z.x + frame.clip_z.y * position_view.z, w);
    return clip;
}
