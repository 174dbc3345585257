// Set 1 of the screen passes: what the geometry left, and where the picture goes.
layout(set = 1, binding = 0) uniform utexture2D gbuffer_image;
layout(set = 1, binding = 1) uniform texture2D depth_image;
layout(set = 1, binding = 2, rgba32f) uniform image2D radiance_image;
layout(set = 1, binding = 3, scalar) writeonly buffer PixelBlock { uint pixels[]; };
layout(set = 1, binding = 4) uniform utexture2D extra_image; // the G-buffer's second target

// Without &&: what it guards would be loaded for each invocation on a software rasteriser.
bool insideScreen(uvec2 pixel) {
    return all(lessThan(pixel, uvec2(frame.camera.width_px, frame.camera.height_px)));
}

#ifndef FROXEL_CAMERA_ALONE
void storePixel(uvec2 pixel, vec4 radiance) {
    pixels[pixel.y * frame.camera.width_px + pixel.x] =
        packDisplay(displayColor(radiance, backgroundAt(pixel.y, frame.camera.height_px)));
}
#endif
