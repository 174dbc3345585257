// From view space to clip space; the same bits in every pass.
vec4 project(vec3 position_view) {
    precise float w = frame.camera.clip_w.x + frame.camera.clip_w.y * position_view.z;
    precise vec4 clip =
        vec4(position_view.xy * frame.camera.clip_scale + frame.camera.clip_offset * w,
             frame.camera.clip_z.x + frame.camera.clip_z.y * position_view.z, w);
    return clip;
}
