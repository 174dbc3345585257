// Of an instance whose view_from_object has these rows, without its place: a direction of the view
// to object space. Of a flat instance nothing has a thickness.
mat3 objectFromView(vec3 r0, vec3 r1, vec3 r2) {
    vec3 c0 = cross(r1, r2);
    float volume = dot(r0, c0);
    return volume != 0.0 ? mat3(c0, cross(r2, r0), cross(r0, r1)) / volume : mat3(0.0);
}
