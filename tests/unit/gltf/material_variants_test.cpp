// KHR_materials_variants: what is read of it, written again, and shown.
#include "gltf_writer/glb_writer.h"
#include "scene/material_variants.h"
#include "scene/scene_check.h"
#include "support/places.h"
#include "unit/gltf/scene_file.h"

#include <gtest/gtest.h>

#include <gmock/gmock.h>

namespace froxel::gltf::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kExtension = "KHR_materials_variants";

Json mapping(int material, const std::vector<int>& variants) {
    return {{"material", material}, {"variants", variants}};
}

// Materials a, b and c; the triangle has a, and what `mappings` say.
SceneFile withMappings(Json mappings) {
    SceneFile file;
    file.useExtension(kExtension, true);
    file.json["extensions"][kExtension]["variants"] = {
        {{"name", "one"}}, Json::object(), {{"name", "one"}}};
    for (const char* name : {"a", "b", "c"}) {
        file.add("materials", {{"name", name}});
    }
    file.primitive()["material"] = 0;
    file.primitive()["extensions"][kExtension]["mappings"] = std::move(mappings);
    return file;
}

// Names of the triangle's material without variants, and in each.
std::vector<std::string> shownIn(const scene::Scene& scene) {
    std::vector<std::string> names;
    for (uint32_t number = 0; number <= scene.material_variants.size(); ++number) {
        const scene::Scene shown = scene::inMaterialVariant(scene, number);
        EXPECT_EQ(scene::findFault(shown), std::nullopt);
        names.push_back(shown.materials[shown.meshes.at(0).primitives.at(0).material].name);
    }
    return names;
}

TEST(MaterialVariants, Mappings_GiveEachVariantItsMaterial) {
    const auto scene = loaded(withMappings({mapping(2, {0}), mapping(1, {2})}).load());
    EXPECT_THAT(scene.warnings, IsEmpty());
    EXPECT_THAT(scene.material_variants, ElementsAre("one", "", "one"));
    EXPECT_EQ(scene.material_variant, 0U);
    EXPECT_THAT(shownIn(scene), ElementsAre("a", "c", "a", "b"));
    EXPECT_EQ(scene::findFault(scene), std::nullopt);
}

TEST(MaterialVariants, WithoutMaterial_HasTheDefaultOneInOthers) {
    SceneFile file = withMappings({mapping(1, {1})});
    file.primitive().erase("material");
    EXPECT_THAT(shownIn(loaded(file.load())), ElementsAre("default", "default", "b", "default"));
}

TEST(MaterialVariants, BrokenMapping_IsLeftOutWithAWarning) {
    const auto warningsOf = [](Json mappings) {
        const auto scene = loaded(withMappings(std::move(mappings)).load());
        EXPECT_EQ(shownIn(scene)[1], "c") << "what is good counts";
        return warningLines(scene);
    };
    const Json good = mapping(2, {0});
    EXPECT_THAT(warningsOf({good, {{"variants", {1}}}}),
                ElementsAre("UNDEFINED_PROPERTY at "
                            "/meshes/0/primitives/0/extensions/KHR_materials_variants: mesh 0 "
                            "primitive 0 has a mapping of variants without a material"));
    EXPECT_THAT(warningsOf({good, mapping(1, {3})}),
                ElementsAre(HasSubstr("uses variant 3; the file has 3, counted from 0")));
    EXPECT_THAT(warningsOf({good, mapping(1, {1, 0})}),
                ElementsAre(HasSubstr("has two materials for variant 0; the first counts")));
    EXPECT_THAT(warningsOf({good, mapping(9, {1})}),
                ElementsAre(HasSubstr("uses material 9, which it goes without; the file has 3")));
    EXPECT_THAT(warningsOf({good, {{"material", 1}, {"variants", "all"}}}),
                ElementsAre(HasSubstr("/variants is \"all\"; expected an array")));
    EXPECT_THAT(warningsOf({good, {{"material", 1}, {"variants", {{{"name", "one"}}}}}}),
                ElementsAre(HasSubstr("uses variant -1; the file has 3")));
    EXPECT_THAT(warningsOf({good, {{"material", 1.5}, {"variants", {1}}}}).size(), 2U);
    EXPECT_THAT(warningsOf({good, 7}), ElementsAre(HasSubstr("taken for an empty one")));
}

TEST(MaterialVariants, BrokenNames_LeaveTheFileWithoutVariants) {
    for (const Json& variants : {Json(7), Json::array({3}), Json::array({0, 1})}) {
        SceneFile file = withMappings({mapping(2, {0})});
        file.json["extensions"][kExtension]["variants"] = variants;
        const auto scene = loaded(file.load());
        EXPECT_FALSE(scene.warnings.empty()) << variants;
        EXPECT_EQ(shownIn(scene)[0], "a") << variants;
    }
}

TEST(MaterialVariants, TextureWithoutCoordinates_IsLeftOutInTheVariantToo) {
    SceneFile file = withMappings({mapping(2, {0})});
    file.add("images", {{"uri", "missing.png"}});
    file.add("textures", {{"source", 0}});
    file.json["materials"][2]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
    const auto scene = loaded(file.load());
    EXPECT_THAT(warningLines(scene),
                testing::Contains(HasSubstr("MESH_PRIMITIVE_TOO_FEW_TEXCOORDS")));
    EXPECT_THAT(shownIn(scene), ElementsAre("a", "c", "a", "a"));
}

TEST(MaterialVariants, Written_AreReadAgain) {
    const auto scene = loaded(withMappings({mapping(2, {0, 1}), mapping(1, {2})}).load());
    const TempFolder folder;
    const auto path = folder.path() / "variants.glb";
    ASSERT_TRUE(gltf_writer::writeGlb(scene, path));
    const auto again = loaded(load(path));
    EXPECT_THAT(again.warnings, IsEmpty());
    EXPECT_EQ(again.material_variants, scene.material_variants);
    EXPECT_EQ(shownIn(again), shownIn(scene));
}

TEST(MaterialVariants, CaseFile_HasItsTwo) {
    const auto path =
        froxel::test::repositoryPath("../shared/scenes/cases/materials") / "18_variants.gltf";
    if (!std::filesystem::exists(path)) {
        GTEST_SKIP() << "no file at " << path;
    }
    const auto scene = loaded(load(path));
    EXPECT_THAT(scene.material_variants, ElementsAre("Variant_Red", "Variant_Blue"));
    EXPECT_THAT(scene.warnings, IsEmpty());
}

} // namespace
} // namespace froxel::gltf::test
