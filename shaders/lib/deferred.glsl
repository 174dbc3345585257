// Lights the surface that the geometry pass left in a pixel.

// Every invocation of a subgroup calls this together; `inside` is false beyond the picture's edge.
vec3 lightPixel(uvec2 pixel, bool inside) {
    float depth = inside ? texelFetch(depth_image, ivec2(pixel), 0).x : 0.0;
    bool covered = depth > 0.0;
    float distance = distanceFromDepth(covered ? depth : 1.0);
    GbufferSample g = unpackGbuffer(texelFetch(gbuffer_image, ivec2(pixel), 0));
    vec3 position = positionFromDistance(pixel, distance);
    Surface s = makeSurface(position, g.normal_view, g.roughness);
    LightSum sum = sumLights(s, pixel, distance, covered && !g.unlit);
    vec3 lit = shadeSum(sum, g.base_color, g.metallic) +
               ambientRadiance(s, g.base_color, g.metallic, g.occlusion) + g.emissive;
    if (g.unlit) {
        lit = g.base_color;
    }
    return covered ? lit : frame.background;
}
