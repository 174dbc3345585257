// Textures of materials in the device's pictures, against the double-precision reference (R2).
#include "reference_pictures.h"

namespace froxel::test {

namespace {

using settings::Renderer;

class ReferenceOfTextures : public GpuTest {};

} // namespace

// Floor and wall, matt and glossy, in even light, in the studio and under lights.
TEST_F(ReferenceOfTextures, RoomOfOcclusion_IsWithinArithmetic) {
    auto room = makeNearestRoom();
    for (auto& material : room.materials) {
        material.occlusion_texture = {0, 0, {0.1F, 0.2F}, 0.3F, {2, 1}}; // 0.35 and 0.78
        material.occlusion_strength = 0.5F;
    }
    for (const float roughness : {0.3F, 0.9F}) {
        room.materials[0].roughness = roughness;
        Compared compared(device(), room);
        for (const auto around :
             {settings::EnvironmentLight::kOff, settings::EnvironmentLight::kStudio}) {
            auto inputs = inputsFor(room.cameras[0].camera, Renderer::kForwardPlus);
            inputs.settings.lights.count = 5;
            inputs.settings.environment = {around, 40, 1.5F};
            const Errors errors = compared.against(inputs);
            EXPECT_LT(errors.median, 1e-6);
            EXPECT_LT(errors.p999, nearestBound());
            inputs.settings.renderer = Renderer::kClusteredDeferred;
            EXPECT_LT(compared.against(inputs).rmse, 5e-3); // G-buffer's steps
        }
    }
}

// Dents half as deep and twice as deep.
TEST_F(ReferenceOfTextures, NormalScale_IsOfBothAxes) {
    for (const float scale : {0.5F, 2.0F}) {
        auto room = makeNearestRoom();
        room.materials[0].normal_texture.texture = 1;
        room.materials[0].normal_scale = scale;
        Compared compared(device(), room);
        expectInBothStages(compared, room, 1e-6, nearestBound());
    }
}

TEST_F(ReferenceOfTextures, CoatNormalScale_IsOfBothAxes) {
    for (const float scale : {0.5F, 2.0F}) {
        auto room = makeNearestRoom();
        auto& floor = room.materials[0];
        floor.coat.strength = 1;
        floor.coat.roughness = 0.3F;
        floor.coat_normal_texture.texture = 1;
        floor.coat.normal_scale = scale;
        Compared compared(device(), room);
        const Errors errors =
            compared.against(inputsFor(room.cameras[0].camera, Renderer::kForwardPlus));
        EXPECT_LT(errors.median, 1e-6);
        EXPECT_LT(errors.p999, nearestBound());
    }
}

// All that is seen is rough by its texture's A, which is 0 or 1, and by its own factor.
TEST_F(ReferenceOfTextures, RoomOfGlossiness_IsWithinArithmetic) {
    auto room = makeNearestRoom();
    for (auto& material : room.materials) {
        material.specular_color_texture.texture = 2;
        material.glossiness_texture = true;
        material.roughness = 0.6F;
        material.metallic = 0;
    }
    Compared compared(device(), room);
    expectInBothStages(compared, room, 1e-5, 4 * nearestBound()); // sRGB, too
}

// Strength, colour and glossiness out of textures.
TEST_F(ReferenceOfTextures, RoomOfTexturedReflectances_IsWithinArithmetic) {
    auto room = makeNearestRoom();
    auto& floor = room.materials[0];
    floor.ior = 1.8F;
    floor.specular_texture.texture = 2; // with holes in A
    floor.specular_color_texture = {0, 0, {0.1F, 0.2F}, 0.3F, {2, 1}};
    auto& glossy = room.materials[4];
    glossy.ior = 0;
    glossy.specular_color_texture.texture = 2;
    glossy.glossiness_texture = true;
    glossy.roughness = 0.5F;
    glossy.metallic = 0;
    Compared compared(device(), room);
    // The driver's sRGB polynomial; 6.1e-5. A GPU also has texels at whose edges a pixel lies.
    expectInBothStages(compared, room, 1e-5, onGpu() ? 5e-3 : 1.5e-4);
}

// Strength, roughness and bumps out of textures.
TEST_F(ReferenceOfTextures, RoomOfTexturedCoats_IsWithinArithmetic) {
    auto room = makeNearestRoom();
    giveCoats(room);
    Compared compared(device(), room);
    expectInBothStages(compared, room, 1e-5, onGpu() ? 5e-3 : 5e-5); // 1.8e-5
}

namespace {

// Every slot has a texture, and each finds its texels by a transform of its own: `shift` is added
// to all of them.
void giveEveryTexture(scene::Material& material, uint32_t texcoord, float shift) {
    material.base_color = {0.9F, 0.8F, 0.7F, 1};
    material.metallic = 0.6F;
    material.roughness = 0.9F;
    material.emissive = {0.3F, 0.2F, 0.4F};
    material.ior = 1.8F;
    material.specular = 0.9F;
    material.specular_color = {1, 0.8F, 0.6F};
    material.coat.strength = 0.7F;
    material.coat.roughness = 0.8F;
    material.sheen = {.color = {0.5F, 0.8F, 0.3F}, .roughness = 0.9F};
    material.anisotropy = {.strength = 0.8F, .rotation_rad = 0.4F};
    material.diffuse_transmission = {.color = {0.8F, 0.9F, 0.5F}, .strength = 0.8F};
    material.volume = {
        .attenuation_color = {0.6F, 0.3F, 0.8F}, .attenuation_m = 0.5F, .thickness_m = 0.7F};
    material.film = {.strength = 0.7F, .ior = 1.4F, .least_nm = 350, .most_nm = 450};
    float turn = shift;
    for (auto* slot : scene::textureSlots(material)) {
        *slot = {0, texcoord, {turn, 0.7F * turn}, 0.9F * turn, {1 + turn, 1.3F - 0.5F * turn}};
        turn += 0.11F;
    }
    material.normal_texture.texture = 1;
    material.coat_normal_texture.texture = 1;
    material.specular_texture.texture = 2;
}

} // namespace

// A floor out of the second set of coordinates; walls out of the first, with tangents of their own,
// those of one mirrored. Both are coloured by vertices.
TEST_F(ReferenceOfTextures, EverySlot_FindsItsTexels) {
    auto room = makeNearestRoom();
    giveEveryTexture(room.materials[0], 1, 0.1F);
    giveEveryTexture(room.materials[3], 0, 0.25F);
    for (auto& mesh : room.meshes) {
        for (auto& p : mesh.primitives) {
            const bool mirrored = p.normals[0].x < 0;
            for (size_t i = 0; i < p.positions.size(); ++i) {
                const glm::vec2 uv = p.uv0[i];
                p.uv1.emplace_back(0.6F * uv.y + 0.1F, 1.2F * uv.x);
                p.colors.emplace_back(1 - 0.1F * uv.x, 0.5F + 0.1F * uv.y, 0.8F, 1);
                if (p.material == 3) {
                    const glm::vec3 any(0.3F, 0.8F, 0.5F);
                    p.tangents.emplace_back(glm::normalize(glm::cross(p.normals[i], any)),
                                            mirrored ? -1 : 1);
                }
            }
        }
    }
    Compared compared(device(), room);
    // The driver's sRGB polynomial, of what the surface sends out too: 7e-5 and 6.1e-4.
    expectInBothStages(compared, room, 1.5e-4, onGpu() ? 5e-3 : 1.5e-3);
}

// A floor without light whose levels have other colours than their halves would have; the last
// two are made of the last that is given.
TEST_F(ReferenceOfTextures, GivenMipLevels_AreThoseThatAreDrawn) {
    auto room = makePlainRoom();
    room.materials[0].unlit = true;
    room.materials[0].base_color_texture.texture = 0;
    room.images[0].mips = {std::vector(size_t{4} * 16 * 16, std::byte{60}),
                           std::vector(size_t{4} * 8 * 8, std::byte{180}),
                           std::vector(size_t{4} * 4 * 4, std::byte{250})};
    Compared compared(device(), room);
    const auto inputs = inputsFor(room.cameras[0].camera, Renderer::kForwardPlus);
    const Errors errors = compared.against(inputs);
    EXPECT_LT(errors.median, 1e-3);
    EXPECT_LT(errors.rmse, 0.02); // the level of detail is one for four pixels
}

// Seen from behind, bumps are dents: normal maps on both sides of a pane. No mip levels: what
// is left is lavapipe's 8-bit filter of the normal map.
TEST_F(ReferenceOfTextures, NormalMapSeenFromBehind_IsReversed) {
    auto room = makeRoom();
    room.samplers[0].mipmapped = false;
    room.materials[1].alpha_mode = scene::AlphaMode::kOpaque;
    room.materials[1].base_color_texture = {};
    room.materials[1].normal_texture.texture = 1;
    room.instances.erase(room.instances.begin() + 3, room.instances.end());
    room.instances[0].world_from_object[3].y = -1;
    Compared compared(device(), room);
    const auto behind = settings::lookAt({-2, 1, -1.5}, {-2, 1, 1}, {0, 1, 0});
    auto inputs = inputsFor(behind, Renderer::kForwardPlus);
    EXPECT_LT(compared.against(inputs).rmse, 2e-3);
}

// The coat of a sheet that has two sides looks to the eye, its map too.
TEST_F(ReferenceOfTextures, CoatSeenFromBehind_IsReversed) {
    auto room = makeNearestRoom();
    auto& sheet = room.materials[1];
    sheet.alpha_mode = scene::AlphaMode::kOpaque;
    sheet.coat.strength = 1;
    sheet.coat.roughness = 0.3F;
    room.instances.erase(room.instances.begin() + 3, room.instances.end());
    room.instances[0].world_from_object[3].y = -1;
    const auto behind = settings::lookAt({-2, 1, -1.5}, {-2, 1, 1}, {0, 1, 0});
    for (const bool mapped : {false, true}) {
        sheet.coat_normal_texture.texture = mapped ? 1 : scene::kNone;
        Compared compared(device(), room);
        const Errors errors = compared.against(inputsFor(behind, Renderer::kForwardPlus));
        EXPECT_LT(errors.median, 1e-6);
        EXPECT_LT(errors.p999, nearestBound());
    }
}

} // namespace froxel::test
