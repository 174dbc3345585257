// Materials, textures and samplers of a scene as glTF objects.
#pragma once

#include "gltf_writer/binary_buffer.h"
#include "scene/scene.h"

#include <set>
#include <string>

namespace froxel::gltf_writer {

// `extensions` collects the names of those used.
[[nodiscard]] Json materialJson(const scene::Material& material, std::set<std::string>& extensions);
[[nodiscard]] Json samplerJson(const scene::Sampler& sampler);
[[nodiscard]] Json textureJson(const scene::Texture& texture);

} // namespace froxel::gltf_writer
