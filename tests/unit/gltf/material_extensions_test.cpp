// The table of material extensions: whole, and what docs/guide/scenes.md says of it.
// FROXEL_WRITE_DOCS=1 writes that anew.
#include "gltf/json_check.h"
#include "gltf/material_extensions.h"
#include "support/places.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

namespace froxel::gltf {
namespace {

// What the core of glTF reads by itself.
constexpr uint32_t kOfTheCore[] = {io::base_color_slot, io::normal_slot,
                                   io::metallic_roughness_slot, io::occlusion_slot,
                                   io::emissive_slot};

TEST(MaterialExtensions, EverySlot_IsReadInOnePlace) {
    std::multiset<uint32_t> read(std::begin(kOfTheCore), std::end(kOfTheCore));
    for (const MaterialExtension& row : materialExtensions()) {
        for (const MaterialTexture& texture : row.textures) {
            read.insert(texture.slot);
        }
    }
    for (uint32_t slot = 0; slot < io::kMaterialSlots; ++slot) {
        EXPECT_EQ(read.count(slot), 1U) << scene::kSlotRows[slot].name;
    }
}

TEST(MaterialExtensions, EveryFactor_IsANumberOfItsOwn) {
    scene::Material material;
    std::set<const float*> seen;
    for (const MaterialExtension& row : materialExtensions()) {
        EXPECT_TRUE(isSupportedExtension(row.name)) << row.name;
        for (const MaterialFactor& factor : row.factors) {
            for (float& number : factor.of(material)) {
                EXPECT_TRUE(seen.insert(&number).second) << factor.key;
            }
        }
    }
}

std::string rowsForReaders() {
    std::string text;
    for (const MaterialExtension& row : materialExtensions()) {
        text += "| " + std::string(row.name) + " | " + row.what + " |\n";
    }
    return text;
}

TEST(MaterialExtensions, ScenesPage_HasTheTable) {
    const std::string head = "| extension of a material | what it gives |\n|---|---|\n";
    const auto path = froxel::test::repositoryPath("docs/guide/scenes.md");
    std::ifstream file(path);
    std::string text{std::istreambuf_iterator<char>(file), {}};
    const size_t begin = text.find(head);
    ASSERT_NE(begin, std::string::npos);
    const size_t first = begin + head.size();
    const size_t size = text.find("\n\n", first) + 1 - first;
    if (std::getenv("FROXEL_WRITE_DOCS") != nullptr) {
        text.replace(first, size, rowsForReaders());
        std::ofstream(path) << text;
    } else {
        EXPECT_EQ(text.substr(first, size), rowsForReaders()) << "FROXEL_WRITE_DOCS=1 writes it";
    }
}

} // namespace
} // namespace froxel::gltf
