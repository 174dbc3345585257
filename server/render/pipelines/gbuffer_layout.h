// What a G-buffer layout costs and how shaders are told of it.
#pragma once

#include "gpu/vulkan.h"
#include "settings/settings.h"

#include <cstdint>

namespace froxel::render {

// The layout as output flags (shaders/interface/gbuffer_io.h); 0 for the default.
[[nodiscard]] uint32_t layoutFlags(const settings::GbufferLayout& layout);

// Whether it has room for a word of what dielectrics reflect: not normals of three halves besides
// positions of three words.
[[nodiscard]] bool holdsSpecular(const settings::GbufferLayout& layout);

// The second target: eUndefined where there is none. specular: it holds that word, too.
[[nodiscard]] vk::Format extraFormat(const settings::GbufferLayout& layout, bool specular);
[[nodiscard]] vk::Format extraFormat(uint32_t output_flags);

// Of one of its texels.
[[nodiscard]] uint32_t extraBytes(vk::Format format);

// Of both targets, without the depth buffer's 4; wide: SceneNeeds::wide_gbuffer; specular: as
// above.
[[nodiscard]] uint32_t
gbufferBytesPerPixel(const settings::GbufferLayout& layout, bool wide, bool specular);

} // namespace froxel::render
