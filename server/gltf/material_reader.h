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

// Of a primitive: where its sets of texture coordinates are, by their numbers in the file; as
// Primitive::uv0 and uv1, so at most two places. Sets that are equal share one.
using TexcoordPlaces = std::map<uint32_t, uint32_t>;

// Not thread-safe. Appends to `scene`. What is out of range is brought to the nearest that makes
// sense, and what is not there is left out, with a warning.
class MaterialReader {
  public:
    MaterialReader(const Document& document, scene::Scene& scene, Warnings& warnings)
        : document_(document), scene_(scene), warnings_(warnings) {}

    // The scene's index of the material of the file that the primitive which `pointer` and `user`
    // name uses; -1 means glTF's default material. Its textures' coordinates are those of
    // withTexcoords() alone.
    [[nodiscard]] uint32_t material(int index, const std::string& pointer, const std::string& user);

    // The sets of texture coordinates that a material reads, by their numbers in the file: its
    // base colour's first.
    [[nodiscard]] std::vector<uint32_t> texcoordSets(uint32_t material) const;

    // The material for the primitive that `pointer` and `user` name: its textures take their
    // coordinates from where that has them, and those whose set has no place are left out. Itself
    // where it needs no change.
    [[nodiscard]] uint32_t withTexcoords(uint32_t material,
                                         const TexcoordPlaces& places,
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
    // Of materials of scene_, by their indices: the set of each slot, by its number in the file.
    std::map<uint32_t, std::array<uint32_t, io::kMaterialSlots>> texcoord_sets_;
    std::map<std::pair<uint32_t, TexcoordPlaces>, uint32_t> with_texcoords_; // by what it takes
    std::string pointer_; // of the material that is being read, or of who uses it
    std::map<size_t, uint32_t> known_textures_;
    std::map<int, uint32_t> known_samplers_;
    std::map<std::vector<size_t>, uint32_t> known_images_; // by their sources
    std::vector<std::vector<size_t>> images_;
};

} // namespace froxel::gltf
