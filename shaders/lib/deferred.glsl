// Lights the surface that the geometry pass left in a pixel.

// Every invocation of a subgroup calls this together; `inside` is false beyond the picture's edge.
vec4 lightPixel(uvec2 pixel, bool inside) {
    uvec4 extra = uvec4(0u);
    if (readsExtra()) {
        extra = texelFetch(extra_image, ivec2(pixel), 0);
    }
    float depth = 0.0;
    if (inside) {
        depth = kPositionSource == kPositionStoredDepth
                    ? uintBitsToFloat(extra.x)
                    : texelFetch(depth_image, ivec2(pixel), 0).x;
    }
    bool covered = depth > 0.0;
    float distance = distanceFromDepth(covered ? depth : 1.0);
    GbufferSample g = unpackGbuffer(texelFetch(gbuffer_image, ivec2(pixel), 0), extra);
    vec3 position = extraPosition(extra, positionFromDistance(pixel, distance));
    Surface s = makeSurface(position, g.normal_view, g.roughness);
    LightSum sum = sumLights(s, pixel, distance, covered && !g.unlit);
    vec3 lit = surfaceRadiance(g, s, sum);
    if (g.unlit) {
        lit = g.base_color;
    }
    return covered ? vec4(lit, radianceAlpha(g)) : vec4(0.0);
}
