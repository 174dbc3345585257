// Whether the device makes viewers' JPEGs, or the encoders of the host do.
#pragma once

#include "core/error.h"
#include "render/view/renderer.h"
#include "stream/jpeg_place.h"

#include <cstdint>

namespace froxel::stream {

// Makes a picture by both, compares their bytes, and logs what each took. `encoder_count`: threads
// that encode at once. Before the first view. Errors: kUnsupported where the device was asked for
// and its file is another one, kDevice. Throws vk::SystemError.
[[nodiscard]] Result<bool>
deviceMakesJpegs(render::RenderDevice& on, bool is_cpu, JpegPlace place, uint32_t encoder_count);

} // namespace froxel::stream
