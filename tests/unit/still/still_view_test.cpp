#include "context.h"
#include "still/named_views.h"
#include "still/still_view.h"

#include <gtest/gtest.h>

#include <gmock/gmock.h>

namespace froxel::still {
namespace {

using session::RejectCode;
using testing::HasSubstr;

const TimePoint kViewed = TimePoint() + std::chrono::hours(1);

session::SharedContext makeScene() {
    auto context = session::makeContext();
    context.looks = {{"mist", "Mist", "", "fog_density=0.25&lights=7"}};
    context.scene.material_variants = {"red", "blue"};
    return std::make_shared<const session::SessionContext>(std::move(context));
}

session::CommandResult<session::SessionState> view(const Entries& entries) {
    return viewOf(makeScene(), entries, kViewed);
}

void expectRefused(const Entries& entries, RejectCode code, const std::string& text) {
    const auto state = view(entries);
    ASSERT_FALSE(state) << text;
    EXPECT_EQ(state.error().code, code);
    EXPECT_THAT(state.error().message, HasSubstr(text));
}

TEST(StillView, Nothing_IsTheFirstView_AndStands) {
    const auto state = view({}).value();
    const auto first = session::initialState(*makeScene(), kViewed);
    EXPECT_EQ(state.settings.camera, first.settings.camera);
    EXPECT_EQ(state.settings.size, first.settings.size);
    EXPECT_EQ(state.light_clock.secondsAt(kViewed + std::chrono::hours(2)), 0);
    EXPECT_FALSE(state.animatingAt(kViewed));
    EXPECT_TRUE(state.scene);
    EXPECT_FALSE(state.delivery.adaptive);
}

// Every setting, at another value than usual, in the address's form.
TEST(StillView, EachSetting_IsRead) {
    for (const session::SessionSetting& row : session::sessionSettings()) {
        const settings::Setting& facts = row.facts();
        const auto usual = row.valueIn(view({}).value());
        std::string text;
        switch (facts.kind) {
        case settings::SettingKind::kSwitch:
            text = std::get<bool>(usual) ? "0" : "1";
            break;
        case settings::SettingKind::kChoice:
            text = facts.names[(std::get<settings::Choice>(usual).index + 1) % facts.names.size()];
            break;
        case settings::SettingKind::kColor:
            text = settings::textOf(facts, glm::dvec3(facts.min));
            break;
        case settings::SettingKind::kWhole:
            text = settings::textOf(facts, static_cast<uint32_t>(facts.max));
            break;
        case settings::SettingKind::kReal:
            text = settings::textOf(facts, facts.max);
            break;
        }
        const auto state = view({{std::string(facts.name), text}, {"size", "64x64"}});
        ASSERT_TRUE(state) << facts.name << " " << state.error().message;
        const bool stands = facts.name == "animate" || facts.name == "animation_playing";
        const bool of_delivery =
            facts.name == "adaptive" || facts.name == "target_fps" || facts.name == "refine";
        if (!stands && !of_delivery) {
            EXPECT_NE(row.valueIn(*state), usual) << facts.name << "=" << text;
        }
    }
}

// All of the scene from that side; what else moves the camera starts there.
TEST(StillView, NamedView_LooksAtTheWholeScene) {
    for (const NamedView& named : kNamedViews) {
        const auto state = view({{"view", std::string(named.name)}}).value();
        const settings::Camera& camera = state.settings.camera;
        if (!named.toward_eye) {
            EXPECT_EQ(camera, view({}).value().settings.camera);
            continue;
        }
        const auto& sphere = state.scene->first_view.sphere_world;
        const glm::dvec3 toward = glm::normalize(camera.eye_world - sphere.center);
        EXPECT_NEAR(glm::dot(toward, glm::normalize(*named.toward_eye)), 1, 1e-12) << named.name;
        EXPECT_NEAR(glm::distance(camera.target_world(), sphere.center), 0, 1e-9) << named.name;
    }
    const auto state = view({{"view", "top"}, {"half_height", "3"}}).value();
    EXPECT_EQ(state.settings.camera.projection, settings::Projection::kOrthographic);
    EXPECT_NEAR(state.settings.camera.world_from_view[2].y, 1, 1e-12);
    const auto refused = view({{"view", "above"}});
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("it must be first, iso, "), std::string::npos);
}

TEST(StillView, WhatNoSettingHolds_IsRead) {
    const auto state = view({{"size", "320x200"},
                             {"eye", "1,2,3"},
                             {"target", "1,2,-7"},
                             {"up", "0,1,0"},
                             {"fov_deg", "60"},
                             {"lens_shift.x", "0.5"},
                             {"lens_shift.y", "-0.5"},
                             {"grid.auto", "0"},
                             {"grid.x", "4"},
                             {"grid.y", "5"},
                             {"grid.z", "6"},
                             {"light_time", "12.5"},
                             {"light_box", "-1,-1,-1;1,2,3"},
                             {"material_variant", "2"},
                             {"toon_fragment", "0,0,1;1,1,1"},
                             {"placed_lights", R"({"lights":[{"id":7,"position":{"x":1}}]})"},
                             {"debug_frozen", "1"}})
                           .value();
    const settings::ViewSettings& settings = state.settings;
    EXPECT_EQ(settings.size, (settings::Size{320, 200}));
    EXPECT_EQ(settings.camera.eye_world, glm::dvec3(1, 2, 3));
    EXPECT_NEAR(glm::degrees(settings.camera.yfov_rad), 60, 1e-12);
    EXPECT_EQ(settings.camera.lens_shift, glm::dvec2(0.5, -0.5));
    EXPECT_EQ(settings.grid, (settings::Grid{.automatic = false, .size = {4, 5, 6}}));
    EXPECT_EQ(state.light_clock.secondsAt(kViewed), 12.5);
    EXPECT_EQ(settings.lights.box->max, glm::dvec3(1, 2, 3));
    EXPECT_EQ(settings.material_variant, 2U);
    EXPECT_EQ(settings.toon_fragment.count, 2U);
    EXPECT_NE(settings.lights.placed.find(7), nullptr);
    EXPECT_TRUE(view({{"placed_lights", "{}"}})->settings.lights.placed.lights().empty());
    EXPECT_TRUE(settings.debug.grid_camera);
    EXPECT_FALSE(state.followed);
}

TEST(StillView, HalfHeight_IsOrthographic) {
    const auto state = view({{"half_height", "3"}}).value();
    EXPECT_EQ(state.settings.camera.projection, settings::Projection::kOrthographic);
    EXPECT_EQ(state.settings.camera.half_height_m, 3);
}

TEST(StillView, SidesOfAnAutomaticGrid_DoNotCount) {
    const auto state = view({{"grid.auto", "1"}, {"grid.x", "4"}}).value();
    EXPECT_TRUE(state.settings.grid.automatic);
}

TEST(StillView, WindowsSize_IsPassedOver) {
    EXPECT_EQ(view({{"size", "auto@0.5"}})->settings.size, view({})->settings.size);
}

TEST(StillView, Look_IsBelowWhatElseIsSaid) {
    const auto state = view({{"lights", "9"}, {"look", "mist"}}).value();
    EXPECT_EQ(state.settings.fog.density, 0.25F);
    EXPECT_EQ(state.settings.lights.count, 9U);
}

TEST(StillView, Comparison_IsOnePictureWithADivider) {
    const auto state = view({{"compare", "renderer:naive,list_cap:8"},
                             {"compare_split", "0.25"},
                             {"compare_show", "heat_map"}})
                           .value();
    ASSERT_TRUE(state.comparison);
    EXPECT_EQ(session::textOf(state.comparison->right), "renderer:naive,list_cap:8");
    EXPECT_EQ(state.comparison->show, session::CompareShow::kHeatMap);
    EXPECT_TRUE(state.comparison->divided);
    EXPECT_EQ(state.compare_split, 0.25);
    EXPECT_FALSE(view({{"compare", ""}, {"compare_show", "sides"}}).value().comparison);
    expectRefused({{"compare", "seed:5"}}, RejectCode::kOutOfRange,
                  "compare: seed is the same on both sides");
    expectRefused({{"compare_split", "2"}}, RejectCode::kOutOfRange, "compare_split: '2' is not");
    expectRefused({{"compare_show", "both"}}, RejectCode::kOutOfRange, "compare_show: 'both' is");
}

TEST(StillView, BadEntries_AreToldWhatWouldBeRight) {
    expectRefused({{"nonsense", "1"}}, RejectCode::kUnsupported,
                  "nonsense is not a name of the page's address");
    expectRefused({{"lights", "-1"}}, RejectCode::kOutOfRange,
                  "lights: '-1' is not a whole number from 0 to");
    expectRefused({{"exposure", "nan"}}, RejectCode::kOutOfRange, "exposure: 'nan' is not");
    expectRefused({{"animate", "yes"}}, RejectCode::kOutOfRange, "animate: 'yes' is not 0 or 1");
    expectRefused({{"renderer", "best"}}, RejectCode::kOutOfRange, "'best' is not naive");
    expectRefused({{"size", "1x1"}}, RejectCode::kOutOfRange, "WIDTHxHEIGHT");
    expectRefused({{"eye", "1,2"}}, RejectCode::kOutOfRange, "\"x,y,z\" in metres");
    expectRefused({{"eye", "0,2,0"}, {"target", "0,2,0"}}, RejectCode::kOutOfRange, "focus");
    expectRefused({{"placed_lights", "{"}}, RejectCode::kOutOfRange, "placed_lights: ");
    expectRefused({{"placed_lights", R"({"remove":[1]})"}}, RejectCode::kOutOfRange, "lights");
    expectRefused({{"fov_deg", "200"}}, RejectCode::kOutOfRange, "fov_deg: '200' is not");
    expectRefused({{"fov_deg", "60"}, {"half_height", "3"}}, RejectCode::kOutOfRange,
                  "set one of them");
    expectRefused({{"toon_compute", "0,0,1;0,1,1"}}, RejectCode::kOutOfRange, "ascending x");
    expectRefused({{"material_variant", "3"}}, RejectCode::kOutOfRange, "this scene has");
    expectRefused({{"animation", "1"}}, RejectCode::kOutOfRange, "this scene has");
    expectRefused({{"look", "haze"}}, RejectCode::kOutOfRange, "this server has mist");
    expectRefused({{"size", "4096x4096"}, {"antialiasing", "ssaa4"}}, RejectCode::kCapacity,
                  "draws at most");
}

TEST(Smaller, KeepsTheShape) {
    EXPECT_EQ(smaller({1600, 900}, 4), (settings::Size{800, 450}));
    EXPECT_EQ(smaller({1600, 900}, 0.5), (settings::Size{1600, 900}));
    EXPECT_EQ(smaller({1600, 900}, 1e12), (settings::Size{16, 16}));
}

} // namespace
} // namespace froxel::still
