// Materials, and the textures, samplers and images that they use: each read when first asked for,
// so that what no triangle uses is neither read nor decoded.
#pragma once

#include "gltf/document.h"
#include "gltf/failure.h"
#include "gltf/material_extensions.h"
#include "scene/scene.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace froxel::gltf {

// Not thread-safe. Appends to `scene`. What is out of range is brought to the nearest that makes
// sense, and what is not there is left out, with a warning.
class MaterialReader {
  public:
    MaterialReader(const Document& document, scene::Scene& scene, Warnings& warnings)
        : document_(document), scene_(scene), warnings_(warnings) {}

    // The scene's index of the material of the file that the primitive which `pointer` and `user`
    // name uses; -1 means glTF's default material.
    [[nodiscard]] uint32_t material(int index, const std::string& pointer, const std::string& user);

    // The material without the textures that need a set of coordinates which the primitive that
    // `pointer` and `user` name does not have; itself where there are none.
    [[nodiscard]] uint32_t withTexcoords(uint32_t material,
                                         bool has_uv0,
                                         bool has_uv1,
                                         const std::string& pointer,
                                         const std::string& user);

    // For every image in `scene.images`, which hold no pixels yet, the numbers of the file's that
    // may be it, the best first.
    [[nodiscard]] const std::vector<std::vector<size_t>>& images() const { return images_; }

  private:
    [[nodiscard]] scene::Material read(const tinygltf::Material& source, const std::string& name);
    void readMetallicRoughness(const tinygltf::Material& source,
                               const std::string& name,
                               scene::Material& material);
    void readGlossiness(const tinygltf::Value& extension,
                        const std::string& name,
                        scene::Material& material);
    void readExtension(const MaterialExtension& row,
                       const tinygltf::Value& object,
                       const std::string& name,
                       scene::Material& material);
    // A texture that an extension's object names; none where it does not.
    [[nodiscard]] scene::TextureSlot
    slotIn(const tinygltf::Value& extension, const char* key, const std::string& name);
    template <class Info>
    [[nodiscard]] scene::TextureSlot slot(const Info& info, const std::string& user);
    [[nodiscard]] uint32_t texture(size_t index, const std::string& user);
    [[nodiscard]] uint32_t sampler(int index, const std::string& user);
    [[nodiscard]] uint32_t image(const std::vector<size_t>& sources);
    // `index` where the file has such a thing.
    [[nodiscard]] std::optional<size_t>
    existing(int index, size_t size, const char* kind, const std::string& user);
    [[nodiscard]] scene::AlphaMode alphaModeFrom(const std::string& text, const std::string& name);
    // Of an extension's object, where the name may stand for things of two types.
    [[nodiscard]] double numberIn(const tinygltf::Value& object,
                                  const char* key,
                                  double fallback,
                                  const std::string& name);
    [[nodiscard]] std::vector<double> factorsIn(const tinygltf::Value& object,
                                                const char* key,
                                                const std::vector<double>& fallback,
                                                const std::string& name);
    [[nodiscard]] float unit(double value, const char* factor, const std::string& name);
    // usual: of a factor that has no nearest right value.
    [[nodiscard]] float
    inRange(double value, const MaterialFactor& factor, float usual, const std::string& name);

    const Document& document_;
    scene::Scene& scene_;
    Warnings& warnings_;
    std::map<int, uint32_t> known_materials_;
    std::map<std::array<uint32_t, 3>, uint32_t> without_texcoords_; // by what withTexcoords() takes
    std::string pointer_; // of the material that is being read, or of who uses it
    std::map<size_t, uint32_t> known_textures_;
    std::map<int, uint32_t> known_samplers_;
    std::map<std::vector<size_t>, uint32_t> known_images_; // by their sources
    std::vector<std::vector<size_t>> images_;
};

} // namespace froxel::gltf
