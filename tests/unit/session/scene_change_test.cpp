#include "context.h"
#include "session/scene_change.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

namespace froxel::session {
namespace {

class SceneChange : public testing::Test {
  protected:
    static SharedContext makeOther() {
        auto other = makeContext();
        other.scene.name = "garden";
        other.scene.cameras.clear();
        other.first_view.scene_camera.reset();
        other.first_view.camera = settings::lookAt({1, 2, 3}, {0, 0, 0}, {0, 1, 0});
        other.defaults.settings.exposure = 4;
        other.defaults.settings.lights.count = 0;
        other.defaults.settings.fog.density = 0.25F;
        return std::make_shared<const SessionContext>(std::move(other));
    }
    SessionState changed() { return withScene(state_, first_, other_, {7, 70, 3}, now_); }

    const TimePoint now_ = TimePoint() + std::chrono::hours(1);
    const SharedContext hall_ = std::make_shared<const SessionContext>(makeContext());
    const SharedContext other_ = makeOther();
    const SessionState first_ = beginOn(hall_, now_);
    SessionState state_ = first_;
};

TEST_F(SceneChange, Untouched_IsWhatANewSessionBeginsWith) {
    const SessionState state = changed();
    const SessionState begun = beginOn(other_, now_);
    EXPECT_EQ(state.settings, begun.settings);
    EXPECT_EQ(state.scene, other_);
    EXPECT_EQ(state.applied.seq, 7U);
    EXPECT_EQ(state.version, state_.version + 1);
}

TEST_F(SceneChange, CameraLightsAndExposure_AreTheScenes) {
    state_.settings.camera = settings::lookAt({9, 9, 9}, {0, 0, 0}, {0, 1, 0});
    state_.settings.exposure = 0.5F;
    state_.settings.lights.count = 321;
    state_.settings.lights.placed = settings::PlacedLights(std::vector<settings::PlacedLight>(1));
    state_.settings.debug.grid_camera = state_.settings.camera;
    state_.followed = 0;
    const SessionState state = changed();
    EXPECT_EQ(state.settings, beginOn(other_, now_).settings);
    EXPECT_FALSE(state.followed);
}

TEST_F(SceneChange, WhatTheViewerHasSetBesides_Stays) {
    state_.settings.renderer = settings::Renderer::kNaive;
    state_.settings.bloom.threshold = 0.125F;
    state_.settings.grid = {.automatic = false, .size = {4, 5, 6}};
    state_.settings.lights.animate = false;
    state_.settings.toon_compute.points[0].slope = 2;
    state_.encoding.quality = 33;
    state_.delivery.target_fps = 12;
    state_.decodable.reset();
    state_.key_requests = 5;
    const SessionState state = changed();
    EXPECT_EQ(state.settings.renderer, settings::Renderer::kNaive);
    EXPECT_EQ(state.settings.bloom.threshold, 0.125F);
    EXPECT_EQ(state.settings.fog.density, 0.25F); // the scene's, since nobody has set it
    EXPECT_EQ(state.settings.grid, state_.settings.grid);
    EXPECT_FALSE(state.settings.lights.animate);
    EXPECT_FALSE(state.light_clock.moving());
    EXPECT_EQ(state.settings.toon_compute, state_.settings.toon_compute);
    EXPECT_EQ(state.encoding, state_.encoding);
    EXPECT_EQ(state.delivery, state_.delivery);
    EXPECT_EQ(state.decodable, state_.decodable);
    EXPECT_EQ(state.key_requests, 5U);
}

TEST_F(SceneChange, PicturesSize_StaysAndAllIsInView) {
    state_.settings.size = {100, 300};
    const SessionState state = changed();
    EXPECT_EQ(state.settings.size, state_.settings.size);
    EXPECT_EQ(state.settings.camera, openingCamera(*other_, {100, 300}));
}

} // namespace
} // namespace froxel::session
