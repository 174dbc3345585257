// No less than the largest scale of the instance, and that where axes stay orthogonal.
float largestScale(InstanceView view) {
    vec3 x = vec3(view.row0.x, view.row1.x, view.row2.x);
    vec3 y = vec3(view.row0.y, view.row1.y, view.row2.y);
    vec3 z = vec3(view.row0.z, view.row1.z, view.row2.z);
    float xy = abs(dot(x, y));
    float yz = abs(dot(y, z));
    float zx = abs(dot(z, x));
    return sqrt(max(max(dot(x, x) + xy + zx, dot(y, y) + xy + yz), dot(z, z) + yz + zx));
}
