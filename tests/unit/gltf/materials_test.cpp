// Materials, textures, samplers.
#include "unit/gltf/scene_file.h"
#include "unit/png/png_file.h"

#include <gtest/gtest.h>

#include <gmock/gmock.h>

namespace froxel::gltf {
namespace {

using froxel::test::plainPng;
using test::failure;
using test::Json;
using test::loaded;
using test::SceneFile;
using testing::ElementsAre;
using testing::HasSubstr;

// The triangle with this material.
SceneFile withMaterial(const char* material) {
    SceneFile file;
    file.json["materials"] = Json::array({Json::parse(material)});
    file.primitive()["material"] = 0;
    return file;
}

// As above, with two textures of two images in bufferViews.
SceneFile textured(const char* material) {
    SceneFile file = withMaterial(material);
    for (const char* set : {"TEXCOORD_0", "TEXCOORD_1"}) {
        file.attributes()[set] = file.addAccessor<float>({0, 0, 1, 0, 0, 1}, 2);
    }
    for (int i = 0; i < 2; ++i) {
        const int view = file.addView(plainPng(static_cast<uint8_t>(10 + i), 20, 30));
        file.add("images", {{"bufferView", view},
                            {"mimeType", "image/png"},
                            {"name", "image" + std::to_string(i)}});
        file.add("textures", {{"source", i}});
    }
    return file;
}

scene::Material onlyMaterial(const SceneFile& file) {
    const scene::Scene scene = loaded(file.load());
    if (scene.materials.size() != 1) {
        ADD_FAILURE() << scene.materials.size() << " materials";
        return {};
    }
    return scene.materials[0];
}

TEST(Materials, Missing_GetsTheDefault) {
    const scene::Scene scene = loaded(SceneFile().load());
    ASSERT_EQ(scene.materials.size(), 1U);
    EXPECT_EQ(scene.meshes.at(0).primitives.at(0).material, 0U);
    EXPECT_EQ(scene.materials[0].base_color, glm::vec4(1));
    EXPECT_EQ(scene.materials[0].metallic, 1);
    EXPECT_EQ(scene.materials[0].roughness, 1);
    EXPECT_EQ(scene.materials[0].base_color_texture.texture, scene::kNone);
}

TEST(Materials, Factors_AreRead) {
    const scene::Material material = onlyMaterial(withMaterial(R"({
        "name": "paint", "doubleSided": true, "alphaMode": "MASK", "alphaCutoff": 0.25,
        "emissiveFactor": [0.1, 0.2, 0.3],
        "pbrMetallicRoughness": {"baseColorFactor": [0.1, 0.2, 0.3, 0.4],
                                 "metallicFactor": 0.5, "roughnessFactor": 0.75}})"));
    EXPECT_EQ(material.name, "paint");
    EXPECT_EQ(material.base_color, glm::vec4(0.1F, 0.2F, 0.3F, 0.4F));
    EXPECT_EQ(material.metallic, 0.5F);
    EXPECT_EQ(material.roughness, 0.75F);
    EXPECT_EQ(material.emissive, glm::vec3(0.1F, 0.2F, 0.3F));
    EXPECT_EQ(material.alpha_mode, scene::AlphaMode::kMask);
    EXPECT_EQ(material.alpha_cutoff, 0.25F);
    EXPECT_TRUE(material.double_sided);
    EXPECT_FALSE(material.unlit);
}

TEST(Materials, BlendMode_IsRead) {
    EXPECT_EQ(onlyMaterial(withMaterial(R"({"alphaMode": "BLEND"})")).alpha_mode,
              scene::AlphaMode::kBlend);
}

TEST(Materials, UnknownAlphaMode_IsOpaque) {
    for (const auto& [material, words] :
         {std::pair(R"({"alphaMode": "GLASS"})",
                    "material 0 has alphaMode 'GLASS'; OPAQUE is used"),
          std::pair(R"({"alphaMode": 2})", "material 0 has alphaMode '2'")}) {
        const scene::Scene scene = loaded(withMaterial(material).load());
        EXPECT_EQ(scene.materials.at(0).alpha_mode, scene::AlphaMode::kOpaque);
        EXPECT_THAT(test::warningLines(scene), ElementsAre(HasSubstr(words)));
    }
}

TEST(Materials, FactorOutOfRange_IsClampedWithAWarning) {
    const scene::Scene scene =
        loaded(withMaterial(R"({"pbrMetallicRoughness": {"roughnessFactor": 1.5}})").load());
    EXPECT_EQ(scene.materials.at(0).roughness, 1);
    EXPECT_THAT(test::warningLines(scene),
                ElementsAre(HasSubstr("material 0 has the roughnessFactor 1.5")));
}

TEST(Materials, Unlit_IsRead) {
    SceneFile file = withMaterial(R"({"extensions": {"KHR_materials_unlit": {}}})");
    file.useExtension("KHR_materials_unlit", true);
    EXPECT_TRUE(onlyMaterial(file).unlit);
}

TEST(Materials, EmissiveStrength_MultipliesTheFactor) {
    SceneFile file = withMaterial(R"({"emissiveFactor": [1, 0.5, 0],
        "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 8}}})");
    file.useExtension("KHR_materials_emissive_strength", true);
    EXPECT_EQ(onlyMaterial(file).emissive, glm::vec3(8, 4, 0));
}

TEST(Materials, IorAndSpecular_AreRead) {
    SceneFile file = textured(R"({"extensions": {
        "KHR_materials_ior": {"ior": 2},
        "KHR_materials_specular": {
            "specularFactor": 0.25, "specularColorFactor": [0.5, 1, 3],
            "specularTexture": {"index": 1, "texCoord": 1},
            "specularColorTexture": {"index": 0, "extensions": {
                "KHR_texture_transform": {"scale": [2, 3]}}}}}})");
    file.useExtension("KHR_materials_ior", true);
    file.useExtension("KHR_materials_specular", true);
    const scene::Scene scene = loaded(file.load());
    const scene::Material& material = scene.materials.at(0);
    EXPECT_EQ(material.ior, 2);
    EXPECT_EQ(material.specular, 0.25F);
    EXPECT_EQ(material.specular_color, glm::vec3(0.5F, 1, 3));
    EXPECT_EQ(scene.images.at(scene.textures.at(material.specular_texture.texture).image).name,
              "image1");
    EXPECT_EQ(material.specular_texture.texcoord, 1U);
    EXPECT_EQ(
        scene.images.at(scene.textures.at(material.specular_color_texture.texture).image).name,
        "image0");
    EXPECT_EQ(material.specular_color_texture.scale, glm::vec2(2, 3));
    EXPECT_FALSE(material.glossiness_texture);
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(Materials, WithoutIorAndSpecular_ReflectAsGlass) {
    const scene::Material material = onlyMaterial(withMaterial(R"({"extensions": {
        "KHR_materials_ior": {}, "KHR_materials_specular": {}}})"));
    EXPECT_EQ(material.ior, 1.5F);
    EXPECT_EQ(material.specular, 1);
    EXPECT_EQ(material.specular_color, glm::vec3(1));
}

TEST(Materials, IorOfZero_IsTaken) {
    const scene::Scene scene =
        loaded(withMaterial(R"({"extensions": {"KHR_materials_ior": {"ior": 0}}})").load());
    EXPECT_EQ(scene.materials.at(0).ior, 0);
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(Materials, WrongIorOrSpecular_IsTold) {
    const scene::Scene scene = loaded(withMaterial(R"({"extensions": {
        "KHR_materials_ior": {"ior": 0.5},
        "KHR_materials_specular": {"specularFactor": 2, "specularColorFactor": [-1, 0, 0]}}})")
                                          .load());
    EXPECT_EQ(scene.materials.at(0).ior, 1.5F);
    EXPECT_EQ(scene.materials.at(0).specular, 1);
    EXPECT_EQ(scene.materials.at(0).specular_color, glm::vec3(0));
    EXPECT_THAT(test::warningLines(scene),
                ElementsAre(HasSubstr("material 0 has the ior 0.5"),
                            HasSubstr("material 0 has the specularFactor 2"),
                            HasSubstr("material 0 has the specularColorFactor -1")));
    for (const auto& [wrong, told] :
         {std::pair(R"({"specularFactor": [1, 1, 1]})", "a specularFactor that is not used"),
          std::pair(R"({"specularColorFactor": [1, 1]})", "specularColorFactor is an array of 2"),
          std::pair(R"({"specularColorFactor": [1, 1, 1e99]})", "single precision"),
          std::pair(R"({"specularTexture": {"texCoord": 1}})", "specularTexture has no index")}) {
        const std::string material =
            R"({"extensions": {"KHR_materials_specular": )" + std::string(wrong) + "}}";
        EXPECT_THAT(test::told(withMaterial(material.c_str()).load()), HasSubstr(told));
    }
}

TEST(Materials, Clearcoat_IsRead) {
    SceneFile file = textured(R"({"extensions": {"KHR_materials_clearcoat": {
        "clearcoatFactor": 0.75, "clearcoatRoughnessFactor": 0.25,
        "clearcoatTexture": {"index": 1}, "clearcoatRoughnessTexture": {"index": 0, "texCoord": 1},
        "clearcoatNormalTexture": {"index": 0, "scale": 0.5}}}})");
    file.useExtension("KHR_materials_clearcoat", true);
    const scene::Scene scene = loaded(file.load());
    const scene::Material& material = scene.materials.at(0);
    EXPECT_EQ(material.coat.strength, 0.75F);
    EXPECT_EQ(material.coat.roughness, 0.25F);
    EXPECT_EQ(material.coat.normal_scale, 0.5F);
    EXPECT_EQ(scene.images.at(scene.textures.at(material.coat_texture.texture).image).name,
              "image1");
    EXPECT_EQ(
        scene.images.at(scene.textures.at(material.coat_roughness_texture.texture).image).name,
        "image0");
    EXPECT_EQ(material.coat_roughness_texture.texcoord, 1U);
    EXPECT_EQ(material.coat_normal_texture.texture, material.coat_roughness_texture.texture);
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(Materials, WithoutClearcoat_HaveNone) {
    for (const char* extensions : {R"({"extensions": {"KHR_materials_clearcoat": {}}})",
                                   R"({"extensions": {"KHR_materials_unlit": {},
                             "KHR_materials_clearcoat": {"clearcoatFactor": 1}}})"}) {
        EXPECT_EQ(onlyMaterial(withMaterial(extensions)).coat.strength, 0);
    }
}

TEST(Materials, WrongClearcoat_IsTold) {
    const scene::Scene scene = loaded(withMaterial(R"({"extensions": {
        "KHR_materials_clearcoat": {"clearcoatFactor": 3, "clearcoatRoughnessFactor": -1}}})")
                                          .load());
    EXPECT_EQ(scene.materials.at(0).coat.strength, 1);
    EXPECT_EQ(scene.materials.at(0).coat.roughness, 0);
    EXPECT_THAT(test::warningLines(scene),
                ElementsAre(HasSubstr("material 0 has the clearcoatFactor 3"),
                            HasSubstr("material 0 has the clearcoatRoughnessFactor -1")));
    EXPECT_THAT(test::told(withMaterial(R"({"extensions": {"KHR_materials_clearcoat": {
                            "clearcoatTexture": {"texCoord": 0}}}})")
                               .load()),
                HasSubstr("clearcoatTexture has no index"));
    EXPECT_THAT(test::told(textured(R"({"extensions": {"KHR_materials_clearcoat": {
                            "clearcoatNormalTexture": {"index": 0, "scale": [1, 1]}}}})")
                               .load()),
                HasSubstr("a scale that is not used"));
}

TEST(Materials, Sheen_IsRead) {
    SceneFile file = textured(R"({"extensions": {"KHR_materials_sheen": {
        "sheenColorFactor": [0.5, 0.25, 3], "sheenRoughnessFactor": 0.75,
        "sheenColorTexture": {"index": 1}, "sheenRoughnessTexture": {"index": 0, "texCoord": 1}}}})");
    file.useExtension("KHR_materials_sheen", true);
    const scene::Scene scene = loaded(file.load());
    const scene::Material& material = scene.materials.at(0);
    EXPECT_EQ(material.sheen.color, glm::vec3(0.5F, 0.25F, 1));
    EXPECT_EQ(material.sheen.roughness, 0.75F);
    const auto imageOf = [&](const scene::TextureSlot& slot) {
        return scene.images.at(scene.textures.at(slot.texture).image).name;
    };
    EXPECT_EQ(imageOf(material.sheen_color_texture), "image1");
    EXPECT_EQ(imageOf(material.sheen_roughness_texture), "image0");
    EXPECT_EQ(material.sheen_roughness_texture.texcoord, 1U);
    EXPECT_THAT(test::warningLines(scene),
                ElementsAre(HasSubstr("material 0 has the sheenColorFactor 3")));
    for (const char* extensions : {R"({"extensions": {"KHR_materials_sheen": {}}})",
                                   R"({"extensions": {"KHR_materials_unlit": {},
                             "KHR_materials_sheen": {"sheenColorFactor": [1, 1, 1]}}})"}) {
        EXPECT_EQ(onlyMaterial(withMaterial(extensions)).sheen.color, glm::vec3(0));
    }
}

TEST(Materials, Anisotropy_IsRead) {
    SceneFile file = textured(R"({"extensions": {"KHR_materials_anisotropy": {
        "anisotropyStrength": 0.5, "anisotropyRotation": -7.5,
        "anisotropyTexture": {"index": 1, "texCoord": 1}}}})");
    file.useExtension("KHR_materials_anisotropy", true);
    const scene::Scene scene = loaded(file.load());
    const scene::Material& material = scene.materials.at(0);
    EXPECT_EQ(material.anisotropy.strength, 0.5F);
    EXPECT_EQ(material.anisotropy.rotation_rad, -7.5F); // any angle is right
    EXPECT_NE(material.anisotropy_texture.texture, scene::kNone);
    EXPECT_EQ(material.anisotropy_texture.texcoord, 1U);
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(Materials, Iridescence_IsRead) {
    SceneFile file = textured(R"({"extensions": {"KHR_materials_iridescence": {
        "iridescenceFactor": 0.5, "iridescenceIor": 0.5, "iridescenceThicknessMinimum": -1,
        "iridescenceThicknessMaximum": 2000, "iridescenceTexture": {"index": 0},
        "iridescenceThicknessTexture": {"index": 1, "texCoord": 1}}}})");
    file.useExtension("KHR_materials_iridescence", true);
    const scene::Scene scene = loaded(file.load());
    const scene::Material& material = scene.materials.at(0);
    EXPECT_EQ(material.film.strength, 0.5F);
    EXPECT_EQ(material.film.ior, 1);
    EXPECT_EQ(material.film.least_nm, 0);
    EXPECT_EQ(material.film.most_nm, 2000);
    EXPECT_NE(material.film_texture.texture, scene::kNone);
    EXPECT_EQ(material.film_thickness_texture.texcoord, 1U);
    EXPECT_THAT(
        test::warningLines(scene),
        ElementsAre(
            HasSubstr("material 0 has the iridescenceIor 0.5; 1 is used; expected 1 or more"),
            HasSubstr("material 0 has the iridescenceThicknessMinimum -1")));
}

// A dielectric of infinite index, so that it reflects its specular colour; and what would have been
// its metalness and roughness is not even loaded.
TEST(Materials, SpecularGlossiness_WinsOverMetallicRoughness) {
    const scene::Scene scene = loaded(textured(R"({
        "pbrMetallicRoughness": {"metallicFactor": 1, "baseColorTexture": {"index": 1}},
        "extensions": {"KHR_materials_pbrSpecularGlossiness": {
            "diffuseFactor": [0.5, 0.25, 1, 0.75], "specularFactor": [0.1, 0.2, 0.3],
            "glossinessFactor": 0.75,
            "specularGlossinessTexture": {"index": 0}}}})")
                                          .load());
    const scene::Material& material = scene.materials.at(0);
    EXPECT_EQ(material.base_color, glm::vec4(0.5F, 0.25F, 1, 0.75F));
    EXPECT_EQ(material.base_color_texture.texture, scene::kNone);
    EXPECT_EQ(material.metallic, 0);
    EXPECT_EQ(material.roughness, 0.25F);
    EXPECT_EQ(material.ior, 0);
    EXPECT_EQ(material.specular, 1);
    EXPECT_EQ(material.specular_color, glm::vec3(0.1F, 0.2F, 0.3F));
    EXPECT_TRUE(material.glossiness_texture);
    ASSERT_EQ(scene.images.size(), 1U);
    EXPECT_EQ(scene.images[0].name, "image0");
}

TEST(Materials, SpecularOfAnUnlitMaterial_IsLeftOut) {
    const scene::Material material = onlyMaterial(withMaterial(R"({
        "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.5, 0.5, 1]},
        "extensions": {"KHR_materials_unlit": {}, "KHR_materials_ior": {"ior": 2},
                       "KHR_materials_pbrSpecularGlossiness": {"diffuseFactor": [1, 0, 0, 1]}}})"));
    EXPECT_EQ(material.ior, 1.5F);
    EXPECT_EQ(material.base_color, glm::vec4(0.5F, 0.5F, 0.5F, 1));
}

TEST(Materials, AllFiveTextures_AreRead) {
    const SceneFile file = textured(R"({
        "pbrMetallicRoughness": {"baseColorTexture": {"index": 0},
                                 "metallicRoughnessTexture": {"index": 1, "texCoord": 1}},
        "normalTexture": {"index": 0, "scale": 0.5},
        "occlusionTexture": {"index": 1, "strength": 0.25},
        "emissiveTexture": {"index": 1}})");
    const scene::Scene scene = loaded(file.load());
    const scene::Material& material = scene.materials.at(0);
    EXPECT_EQ(material.base_color_texture.texture, 0U);
    EXPECT_EQ(material.metallic_roughness_texture.texture, 1U);
    EXPECT_EQ(material.metallic_roughness_texture.texcoord, 1U);
    EXPECT_EQ(material.normal_texture.texture, 0U);
    EXPECT_EQ(material.normal_scale, 0.5F);
    EXPECT_EQ(material.occlusion_texture.texture, 1U);
    EXPECT_EQ(material.occlusion_strength, 0.25F);
    EXPECT_EQ(material.emissive_texture.texture, 1U);
    ASSERT_EQ(scene.images.size(), 2U);
    EXPECT_EQ(scene.images[1].name, "image1");
    EXPECT_EQ(scene.images[1].rgba8[0], std::byte{11});
    EXPECT_EQ(scene.textures.at(0).sampler, scene::kNone);
}

TEST(Materials, OnlyWhatIsUsed_IsLoaded) {
    SceneFile file = textured(R"({"emissiveTexture": {"index": 1}})");
    file.json["images"][0] = {{"uri", "missing.png"}};
    file.json["materials"].push_back({{"emissiveTexture", {{"index", 0}}}});
    const scene::Scene scene = loaded(file.load());
    EXPECT_EQ(scene.materials.size(), 1U);
    ASSERT_EQ(scene.images.size(), 1U);
    EXPECT_EQ(scene.images[0].name, "image1");
    EXPECT_EQ(scene.materials[0].emissive_texture.texture, 0U);
}

TEST(Materials, ImageOfTwoTextures_IsDecodedOnce) {
    SceneFile file = textured(R"({"emissiveTexture": {"index": 1},
                                  "occlusionTexture": {"index": 0}})");
    file.json["textures"][0]["source"] = 1;
    const scene::Scene scene = loaded(file.load());
    EXPECT_EQ(scene.textures.size(), 2U);
    EXPECT_EQ(scene.images.size(), 1U);
}

TEST(Materials, TextureTransform_IsRead) {
    SceneFile file = textured(R"({"emissiveTexture": {"index": 0, "extensions":
        {"KHR_texture_transform": {"offset": [0.5, 0.25], "rotation": 1.5, "scale": [2, 3],
                                   "texCoord": 1}}}})");
    file.useExtension("KHR_texture_transform", true);
    const scene::TextureSlot slot = onlyMaterial(file).emissive_texture;
    EXPECT_EQ(slot.offset, glm::vec2(0.5, 0.25));
    EXPECT_EQ(slot.rotation_rad, 1.5F);
    EXPECT_EQ(slot.scale, glm::vec2(2, 3));
    EXPECT_EQ(slot.texcoord, 1U);
}

// Sets 2 and on: each begins with its own number.
SceneFile withManyTexcoords(const char* material) {
    SceneFile file = textured(material);
    for (const float set : {2.0F, 3.0F, 4.0F}) {
        file.attributes()["TEXCOORD_" + std::to_string(static_cast<int>(set))] =
            file.addAccessor<float>({set, 0, 1, 0, 0, 1}, 2);
    }
    return file;
}

// A primitive has room for two sets, whichever its materials read.
TEST(Materials, AnyTwoSetsOfTexcoords_AreRead) {
    const scene::Scene scene = loaded(withManyTexcoords(
                                          R"({"emissiveTexture": {"index": 0, "texCoord": 3},
            "occlusionTexture": {"index": 1, "texCoord": 2}})")
                                          .load());
    EXPECT_THAT(test::warningLines(scene), testing::IsEmpty());
    const scene::Primitive& primitive = scene.meshes.at(0).primitives.at(0);
    const scene::Material& material = scene.materials.at(primitive.material);
    const auto firstOf = [&](const scene::TextureSlot& slot) {
        return (slot.texcoord == 0 ? primitive.uv0 : primitive.uv1).at(0).x;
    };
    EXPECT_EQ(firstOf(material.emissive_texture), 3);
    EXPECT_EQ(firstOf(material.occlusion_texture), 2);
    EXPECT_NE(material.emissive_texture.texture, scene::kNone);
    EXPECT_NE(material.occlusion_texture.texture, scene::kNone);
}

TEST(Materials, EqualSetsOfTexcoords_AreOne) {
    SceneFile file = withManyTexcoords(
        R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}},
            "emissiveTexture": {"index": 0, "texCoord": 4},
            "occlusionTexture": {"index": 1, "texCoord": 2}})");
    file.attributes()["TEXCOORD_4"] = file.addAccessor<float>({0, 0, 1, 0, 0, 1}, 2);
    const scene::Scene scene = loaded(file.load());
    EXPECT_THAT(test::warningLines(scene), testing::IsEmpty());
    const scene::Primitive& primitive = scene.meshes.at(0).primitives.at(0);
    const scene::Material& material = scene.materials.at(primitive.material);
    EXPECT_EQ(material.base_color_texture.texcoord, 0U);
    EXPECT_EQ(material.emissive_texture.texcoord, 0U) << "as set 0";
    EXPECT_EQ(material.occlusion_texture.texcoord, 1U);
    EXPECT_EQ(primitive.uv1.at(0).x, 2);
}

TEST(Materials, AThirdSetOfTexcoords_IsLeftOutWithAWarning) {
    const scene::Scene scene =
        loaded(withManyTexcoords(
                   R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}},
            "emissiveTexture": {"index": 0, "texCoord": 4},
            "occlusionTexture": {"index": 1, "texCoord": 2}})")
                   .load());
    EXPECT_THAT(test::warningLines(scene),
                ElementsAre(HasSubstr("TEXCOORD_4 as the third set"), HasSubstr("for 1 textures")));
    const scene::Primitive& primitive = scene.meshes.at(0).primitives.at(0);
    const scene::Material& material = scene.materials.at(primitive.material);
    EXPECT_EQ(primitive.uv1.at(0).x, 2);
    EXPECT_EQ(material.occlusion_texture.texcoord, 1U);
    EXPECT_EQ(material.emissive_texture.texture, scene::kNone);
    EXPECT_NE(material.base_color_texture.texture, scene::kNone);
}

TEST(Materials, PrimitivesOfOneMaterial_ReadItsSetsFromTheirOwnPlaces) {
    SceneFile file = withManyTexcoords(R"({"emissiveTexture": {"index": 0, "texCoord": 2}})");
    auto other = file.primitive();
    other["attributes"].erase("TEXCOORD_2");
    file.json["meshes"][0]["primitives"].push_back(other);
    const scene::Scene scene = loaded(file.load());
    EXPECT_THAT(test::warningLines(scene), ElementsAre(HasSubstr("for 1 textures")));
    const auto& primitives = scene.meshes.at(0).primitives;
    EXPECT_NE(scene.materials.at(primitives.at(0).material).emissive_texture.texture, scene::kNone);
    EXPECT_EQ(scene.materials.at(primitives.at(1).material).emissive_texture.texture, scene::kNone);
}

TEST(Materials, Sampler_IsRead) {
    SceneFile file = textured(R"({"emissiveTexture": {"index": 0}})");
    file.json["textures"][0]["sampler"] = 0;
    file.json["samplers"] =
        Json::parse(R"([{"magFilter": 9728, "minFilter": 9985, "wrapS": 33071, "wrapT": 33648}])");
    const scene::Scene scene = loaded(file.load());
    ASSERT_EQ(scene.samplers.size(), 1U);
    EXPECT_EQ(scene.textures.at(0).sampler, 0U);
    scene::Sampler expected;
    expected.wrap_u = scene::Wrap::kClampToEdge;
    expected.wrap_v = scene::Wrap::kMirroredRepeat;
    expected.mag = scene::Filter::kNearest;
    expected.min = scene::Filter::kLinear;
    expected.mip = scene::Filter::kNearest;
    EXPECT_EQ(scene.samplers[0], expected);
}

struct MinFilter {
    int value;
    scene::Filter min;
    scene::Filter mip;
    bool mipmapped;
};
class MinFilters : public testing::TestWithParam<MinFilter> {};

TEST_P(MinFilters, Value_GivesMinMipAndMipmapping) {
    SceneFile file = textured(R"({"emissiveTexture": {"index": 0}})");
    file.json["textures"][0]["sampler"] = 0;
    file.json["samplers"] = Json::array({{{"minFilter", GetParam().value}}});
    const scene::Sampler sampler = loaded(file.load()).samplers.at(0);
    EXPECT_EQ(sampler.min, GetParam().min);
    EXPECT_EQ(sampler.mipmapped, GetParam().mipmapped);
    if (sampler.mipmapped) {
        EXPECT_EQ(sampler.mip, GetParam().mip);
    }
}

constexpr auto kNearest = scene::Filter::kNearest;
constexpr auto kLinear = scene::Filter::kLinear;
INSTANTIATE_TEST_SUITE_P(All,
                         MinFilters,
                         testing::Values(MinFilter{9728, kNearest, kNearest, false},
                                         MinFilter{9729, kLinear, kNearest, false},
                                         MinFilter{9984, kNearest, kNearest, true},
                                         MinFilter{9985, kLinear, kNearest, true},
                                         MinFilter{9986, kNearest, kLinear, true},
                                         MinFilter{9987, kLinear, kLinear, true}));

TEST(Materials, BadSampler_RepeatsAndIsLinear) {
    SceneFile file = textured(R"({"emissiveTexture": {"index": 0}})");
    file.json["textures"][0]["sampler"] = 0;
    file.json["samplers"] = Json::array({{{"minFilter", 1}}});
    EXPECT_THAT(test::told(file.load()), HasSubstr("sampler 0 has minFilter 1; it is linear with"));
    file.json["samplers"] = Json::array({{{"magFilter", 9987}}});
    EXPECT_THAT(test::told(file.load()), HasSubstr("sampler 0 has magFilter 9987; it is linear"));
    file.json["samplers"] = Json::array({{{"wrapS", 0}, {"wrapT", 33071}}});
    const scene::Scene scene = loaded(file.load());
    EXPECT_THAT(test::warningLines(scene),
                ElementsAre(HasSubstr("/samplers/0/wrapS: sampler 0 has wrapS 0; it repeats")));
    EXPECT_EQ(scene.samplers.at(0).wrap_u, scene::Wrap::kRepeat);
    EXPECT_EQ(scene.samplers.at(0).wrap_v, scene::Wrap::kClampToEdge);
}

TEST(Materials, WhatDoesNotExist_IsGoneWithout) {
    SceneFile file = textured(R"({"emissiveTexture": {"index": 2}})");
    EXPECT_THAT(test::told(file.load()),
                HasSubstr("material 0 emissiveTexture uses texture 2, which it goes without; the "
                          "file has 2"));
    file.json["materials"][0]["emissiveTexture"]["index"] = 0;
    file.json["textures"][0]["source"] = 5;
    EXPECT_THAT(test::told(file.load()), HasSubstr("texture 0 uses image 5"));
    file.json["textures"][0] = {{"source", 0}, {"sampler", 0}};
    EXPECT_THAT(test::told(file.load()),
                HasSubstr("texture 0 uses sampler 0, which it goes without; the file has 0"));
    file.primitive()["material"] = 1;
    const scene::Scene scene = loaded(file.load());
    EXPECT_THAT(
        test::warningLines(scene),
        ElementsAre(HasSubstr("/meshes/0/primitives/0: mesh 0 primitive 0 uses material 1")));
    EXPECT_EQ(scene.materials.at(0).name, "default");
}

TEST(Extensions, UnsupportedOptional_IsIgnoredWithAWarning) {
    SceneFile file;
    file.useExtension("KHR_materials_subsurface");
    EXPECT_THAT(test::warningLines(loaded(file.load())),
                ElementsAre(HasSubstr("KHR_materials_subsurface")));
}

TEST(Extensions, TextureWithoutSupportedSource_IsIgnoredWithAWarning) {
    SceneFile file = textured(R"({"emissiveTexture": {"index": 0}})");
    file.json["textures"][0] = {{"extensions", {{"MSFT_texture_dds", {{"source", 0}}}}}};
    const scene::Scene scene = loaded(file.load());
    EXPECT_EQ(scene.materials.at(0).emissive_texture.texture, scene::kNone);
    EXPECT_THAT(test::warningLines(scene),
                ElementsAre(HasSubstr("'MSFT_texture_dds' is not supported"),
                            HasSubstr("texture 0 has no image")));
}

} // namespace
} // namespace froxel::gltf
