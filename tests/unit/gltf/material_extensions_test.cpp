// The table of material extensions: whole, and what docs/guide/scenes.md says of it.
// FROXEL_WRITE_DOCS=1 writes that anew.
#include "gltf/json_check.h"
#include "gltf/material_extensions.h"
#include "gltf_writer/glb_writer.h"
#include "support/places.h"
#include "unit/gltf/scene_file.h"
#include "unit/png/png_file.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <gmock/gmock.h>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <vector>

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

// What rows say of a material, by key.
std::map<std::string, std::vector<float>> numbersOf(scene::Material material) {
    std::map<std::string, std::vector<float>> all;
    for (const MaterialExtension& row : materialExtensions()) {
        for (const MaterialFactor& factor : row.factors) {
            const auto numbers = factor.of(material);
            all[factor.key].assign(numbers.begin(), numbers.end());
        }
        for (const MaterialTexture& texture : row.textures) {
            const scene::TextureSlot& slot = *scene::textureSlots(material)[texture.slot];
            all[texture.key] = {static_cast<float>(slot.texture), static_cast<float>(slot.texcoord),
                                texture.scale != nullptr ? texture.scale(material) : 0};
        }
    }
    return all;
}

// All rows at once are read with their numbers, and are the same again when they are written.
TEST(MaterialExtensions, EveryRow_IsReadAndWrittenWithItsNumbers) {
    test::SceneFile file;
    for (const char* set : {"TEXCOORD_0", "TEXCOORD_1"}) {
        file.attributes()[set] = file.addAccessor<float>({0, 0, 1, 0, 0, 1}, 2);
    }
    const int view = file.addView(froxel::test::plainPng(10, 20, 30));
    file.add("images", {{"bufferView", view}, {"mimeType", "image/png"}});
    file.add("textures", {{"source", 0}});
    const test::Json wanted = test::everyExtension();
    file.add("materials", {{"extensions", wanted}});
    file.primitive()["material"] = 0;
    for (const auto& [name, keys] : wanted.items()) {
        file.useExtension(name.c_str());
    }
    const scene::Scene read = test::loaded(file.load());
    EXPECT_THAT(test::warningLines(read), ::testing::IsEmpty());
    const auto numbers = numbersOf(read.materials.at(0));
    for (const auto& [name, keys] : wanted.items()) {
        for (const auto& [key, value] : keys.items()) {
            std::vector<float> expected;
            if (value.is_object()) {
                expected = {0, value["texCoord"].template get<float>(), value.value("scale", 0.0F)};
            } else if (value.is_array()) {
                expected = value.template get<std::vector<float>>();
            } else {
                expected = {value.template get<float>()};
            }
            EXPECT_EQ(numbers.at(key), expected) << name << " " << key;
        }
    }
    const test::TempFolder folder;
    const auto path = folder.path() / "again.glb";
    ASSERT_TRUE(gltf_writer::writeGlb(read, path));
    EXPECT_EQ(numbersOf(test::loaded(load(path)).materials.at(0)), numbers);
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
