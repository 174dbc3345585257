// Several scenes on one device.
#include "render/device/device_resources.h"
#include "render/view/renderer.h"
#include "support/draw.h"
#include "support/gpu_fixture.h"
#include "support/test_scenes.h"

#include <future>
#include <memory>
#include <vector>

namespace froxel::test {
namespace {

class Scenes : public SharedGpuTest {
  protected:
    // Another one of the same materials' kinds.
    static scene::Scene makeOtherRoom() {
        scene::Scene scene = makeRoom();
        for (auto& material : scene.materials) {
            material.base_color = {0.2F, 0.9F, 0.4F, 1};
        }
        for (auto& instance : scene.instances) {
            instance.world_from_object[3].y += 0.25;
        }
        return scene;
    }
    static render::FrameInputs inputs() {
        render::FrameInputs inputs;
        inputs.settings.size = {160, 90};
        inputs.settings.lights.count = 40;
        inputs.settings.camera = makeRoom().cameras.at(0).camera;
        inputs.settings.fog.density = 0.05F;
        inputs.settings.bloom.kind = settings::BloomKind::kMipChain;
        return inputs;
    }
    uint64_t allocated() { return device().memoryLedger()->totalBytes(); }
};

TEST_F(Scenes, OnOneDevice_AreDrawnAsEachAlone) {
    const scene::Scene room = makeRoom();
    const scene::Scene other = makeOtherRoom();
    render::Renderer alone(device(), room);
    render::Renderer other_alone(device(), other);
    const Picture meant = draw(alone, inputs());
    const Picture other_meant = draw(other_alone, inputs());
    ASSERT_GT(differingFloats(meant, other_meant), meant.radiance.size() / 2);

    render::RenderDevice on(device());
    render::Renderer one(on, room);
    render::Renderer two(on, other);
    render::ViewRenderer view(one);
    render::ViewRenderer other_view(two);
    for (int turn = 0; turn < 2; ++turn) {
        EXPECT_EQ(differingFloats(draw(view, inputs()), meant), 0U);
        EXPECT_EQ(differingFloats(draw(other_view, inputs()), other_meant), 0U);
    }
}

TEST_F(Scenes, SecondOne_CompilesNothingThatIsThere) {
    render::RenderDevice on(device());
    render::Renderer one(on, makeRoom());
    (void)draw(one, inputs());
    const auto made = on.resources().variantsMade();
    ASSERT_FALSE(made.empty());
    render::Renderer two(on, makeOtherRoom());
    (void)draw(two, inputs());
    EXPECT_EQ(on.resources().variantsMade().size(), made.size());
}

TEST_F(Scenes, OneThatGoes_GivesItsMemoryBackAndLeavesTheOther) {
    render::RenderDevice on(device());
    render::Renderer stays(on, makeRoom());
    render::ViewRenderer view(stays);
    const Picture before = draw(view, inputs());
    const uint64_t allocated_before = allocated();
    const uint64_t taken_before = on.resources().memory.takenBytes();
    {
        render::Renderer goes(on, makeOtherRoom());
        (void)draw(goes, inputs());
        EXPECT_GT(on.resources().memory.takenBytes(), taken_before);
    }
    EXPECT_EQ(allocated(), allocated_before);
    EXPECT_EQ(on.resources().memory.takenBytes(), taken_before);
    EXPECT_EQ(differingFloats(draw(view, inputs()), before), 0U);
}

// Of a texture that takes several slices.
scene::Scene makeLargeRoom() {
    scene::Scene scene = makeRoom();
    scene::Image& image = scene.images.at(0);
    constexpr uint32_t kSize_px = 4096;
    std::vector<std::byte> texels;
    for (uint32_t y = 0; y < kSize_px; ++y) {
        for (uint32_t x = 0; x < kSize_px; ++x) {
            for (const uint32_t value : {x / 8, y / 8, (x ^ y) / 8, 255U}) {
                texels.push_back(static_cast<std::byte>(value));
            }
        }
    }
    image = {image.name, kSize_px, kSize_px, std::move(texels)};
    return scene;
}

TEST_F(Scenes, PreparedAsideAndMovedInSlices_IsDrawnAsLoadedAtOnce) {
    const auto large = std::make_shared<const scene::Scene>(makeLargeRoom());
    render::Renderer at_once(device(), *large);
    const Picture meant = draw(at_once, inputs());

    render::RenderDevice on(device());
    render::Renderer room(on, makeRoom());
    render::ViewRenderer view(room);
    const Picture before = draw(view, inputs());
    auto prepared = std::async(std::launch::async,
                               [&] { return std::make_unique<render::SceneUpload>(on, large); });
    auto upload = prepared.get();
    const uint64_t taken = on.resources().memory.takenBytes();
    std::unique_ptr<render::Renderer> moved;
    uint32_t slice_count = 0;
    for (; !moved; ++slice_count) {
        EXPECT_EQ(differingFloats(draw(view, inputs()), before), 0U);
        auto result = upload->advance();
        ASSERT_TRUE(result) << result.error().message;
        moved = std::move(*result);
    }
    EXPECT_GT(slice_count, 3U);
    EXPECT_EQ(upload->fraction(), 1);
    EXPECT_GT(on.resources().memory.takenBytes(), taken + (uint64_t{64} << 20U));
    upload.reset();
    EXPECT_EQ(differingFloats(draw(*moved, inputs()), meant), 0U);
}

TEST_F(Scenes, GivenUpOnItsWay_LeavesNothing) {
    const auto large = std::make_shared<const scene::Scene>(makeLargeRoom());
    render::RenderDevice on(device());
    render::Renderer room(on, makeRoom());
    render::ViewRenderer view(room);
    const Picture before = draw(view, inputs());
    const uint64_t allocated_before = allocated();
    const uint64_t taken_before = on.resources().memory.takenBytes();
    {
        render::SceneUpload upload(on, large);
        const auto moved = upload.advance();
        ASSERT_TRUE(moved) << moved.error().message;
        ASSERT_FALSE(*moved);
        EXPECT_LT(upload.fraction(), 1);
    }
    EXPECT_EQ(allocated(), allocated_before);
    EXPECT_EQ(on.resources().memory.takenBytes(), taken_before);
    EXPECT_EQ(differingFloats(draw(view, inputs()), before), 0U);
}

} // namespace
} // namespace froxel::test
