// Commands that say how the lit picture looks, applied.
#include "unit/session/state_fixture.h"

namespace froxel::session {
namespace {

using LookState = State;

TEST_F(LookState, SetFog_PartsAreSetOneByOne) {
    SetFog command;
    command.density = 0.5;
    command.base_height_m = 2;
    command.half_rate = true;
    SessionState state = applied(initial, command);
    command = {};
    command.height_falloff = 0.25;
    command.anisotropy = -0.5;
    command.albedo = glm::dvec3(0.5, 0.25, 1);
    command.tile_px = 8;
    command.slice_count = 32;
    command.noise = true;
    state = applied(state, command);
    EXPECT_EQ(state.settings.fog,
              (view::Fog{0.5F, 0.25F, 2, -0.5F, {0.5F, 0.25F, 1}, 8, 32, true, true}));
}

TEST_F(LookState, SetPostAndOutline_PartsAreSetOneByOne) {
    SetPost command;
    command.bloom = view::BloomKind::kMipChain;
    command.bloom_threshold = 2;
    SessionState state = applied(initial, command);
    command = {};
    command.bloom_knee = 0.25;
    command.bloom_strength = 0.5;
    command.bloom_radius = 0.03;
    state = applied(state, command);
    EXPECT_EQ(state.settings.bloom,
              (view::Bloom{view::BloomKind::kMipChain, 2, 0.25F, 0.5F, 0.03F}));
    SetToon outline;
    outline.outline_strength = 0.5;
    state = applied(state, outline);
    outline = {};
    outline.outline_width = 0.01;
    state = applied(state, outline);
    EXPECT_EQ(state.settings.toon_outline, (view::ToonOutline{0.5F, 0.01F}));
    EXPECT_EQ(state.settings.toon_fragment, initial.settings.toon_fragment);
}

TEST_F(LookState, SetShadows_PartsAreSetOneByOne) {
    EXPECT_EQ(initial.settings.shadows.light_count, 0U);
    SetShadows command;
    command.lights = 4;
    SessionState state = applied(initial, command);
    EXPECT_EQ(state.settings.shadows, (view::Shadows{4, 256}));
    command = {};
    command.size_px = 128;
    state = applied(state, command);
    EXPECT_EQ(state.settings.shadows, (view::Shadows{4, 128}));
    EXPECT_GT(state.version, initial.version);
}

} // namespace
} // namespace froxel::session
