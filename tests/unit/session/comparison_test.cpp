#include "unit/session/state_fixture.h"

#include <gmock/gmock.h>
#include <string>

namespace froxel::session {
namespace {

using testing::HasSubstr;

SettingChanges rightIs(const std::string& text) {
    return parseRight(text).value();
}

std::string faultOf(const std::string& text) {
    const auto parsed = parseRight(text);
    return parsed ? "parsed" : parsed.error().message;
}

TEST(ParseRight, Text_IsReadAndWritten) {
    for (const char* text :
         {"renderer:naive", "renderer:naive,list_cap:16,light_cutoff:0.02", "fog_noise:1",
          "antialiasing:ssaa4", "quality:40,chroma:420", "bloom:mip_chain"}) {
        EXPECT_EQ(textOf(rightIs(text)), text);
    }
    EXPECT_TRUE(rightIs("").empty());
}

TEST(ParseRight, Faults_NameTheSetting) {
    EXPECT_THAT(faultOf("rendrer:naive"), HasSubstr("rendrer is not a setting"));
    EXPECT_THAT(faultOf("renderer:best"), HasSubstr("renderer: 'best' is not naive, "));
    EXPECT_THAT(faultOf("renderer"), HasSubstr("renderer: '' is not naive, "));
    EXPECT_THAT(faultOf("quality:101"), HasSubstr("quality: '101' is not "));
    EXPECT_THAT(faultOf("renderer:naive,renderer:naive"), HasSubstr("renderer is given twice"));
    EXPECT_THAT(faultOf("renderer:naive,"), HasSubstr(" is not a setting"));
    EXPECT_THAT(faultOf("antialiasing:mean16"), HasSubstr("antialiasing is mean16, which"));
    for (const char* shared : {"lights:5", "seed:1", "animate:true", "codec:png", "refine:none",
                               "debug_view:normal", "background_color:0,0,0"}) {
        EXPECT_THAT(faultOf(shared), HasSubstr("is the same on both sides")) << shared;
    }
}

class CompareState : public State {
  protected:
    SetCompare compare(const std::string& right) { return {rightIs(right), {}, {}}; }
};

TEST_F(CompareState, Comparison_IsSetChangedAndEnded) {
    const auto compared = applied(initial, compare("renderer:naive"));
    ASSERT_TRUE(compared.comparison);
    EXPECT_GT(compared.version, initial.version);
    EXPECT_EQ(compared.settings.renderer, initial.settings.renderer);
    EXPECT_EQ(rightOf(compared).settings.renderer, settings::Renderer::kNaive);
    const auto heat = applied(compared, SetCompare{{}, {}, CompareShow::kHeatMap});
    EXPECT_EQ(heat.comparison->show, CompareShow::kHeatMap);
    EXPECT_EQ(textOf(heat.comparison->right), "renderer:naive");
    EXPECT_GT(heat.version, compared.version);
    EXPECT_FALSE(applied(heat, compare("")).comparison);
}

TEST_F(CompareState, Divider_IsKeptAndDrawsNothingAnew) {
    const auto compared = applied(initial, compare("renderer:naive"));
    const auto moved = applied(compared, SetCompare{{}, 0.25, {}});
    EXPECT_EQ(moved.compare_split, 0.25);
    EXPECT_EQ(moved.version, compared.version);
    EXPECT_EQ(applied(moved, compare("")).compare_split, 0.25);
}

// What both sides share is said once, whatever is asked for later.
TEST_F(CompareState, RightSide_FollowsTheLeftOneInAllElse) {
    auto state = applied(initial, compare("renderer:naive"));
    state = applied(state, SetSize{{320, 200}});
    EXPECT_EQ(rightOf(state).settings.size, (settings::Size{320, 200}));
    EXPECT_EQ(rightOf(state).settings.camera, state.settings.camera);
}

TEST_F(CompareState, Show_WithNothingToCompare_IsRefused) {
    const auto refused =
        apply(initial, {{1}, SetCompare{{}, {}, CompareShow::kHeatMap}}, context, kStart);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().field, "show");
}

TEST_F(CompareState, BothSidesPixels_CountForTheLargestPicture) {
    const settings::Size& size = initial.settings.size;
    const uint64_t area = uint64_t{size.width_px} * size.height_px;
    context.defaults.max_area_px = 2 * area;
    EXPECT_TRUE(apply(initial, {{1}, compare("renderer:naive")}, context, kStart));
    const auto refused = apply(initial, {{1}, compare("antialiasing:ssaa4")}, context, kStart);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, RejectCode::kCapacity);
    EXPECT_THAT(refused.error().message, HasSubstr("with 5 samples a pixel, of both sides"));
    EXPECT_DOUBLE_EQ(refused.error().too_large_by, 2.5);
    const auto compared = applied(initial, compare("renderer:naive"));
    EXPECT_FALSE(
        apply(compared, {{1}, SetSize{{size.width_px, size.height_px + 1}}}, context, kStart));
}

TEST_F(CompareState, EqualBits_ArePromisedForListsGridsStagesAndForwardRenderers) {
    auto state = initial;
    state.settings.renderer = settings::Renderer::kForwardPlus;
    const auto promises = [&](const std::string& right) {
        return promisesEqualBits(applied(state, compare(right)));
    };
    EXPECT_TRUE(promises("light_loop:all_lights"));
    EXPECT_TRUE(promises("grid_law:linear,lighting:fragment"));
    EXPECT_TRUE(promises("renderer:naive"));
    EXPECT_FALSE(promises("renderer:clustered_deferred"));
    EXPECT_FALSE(promises("renderer:naive,list_cap:8"));
    EXPECT_FALSE(promises("light_cutoff:0.1"));
    EXPECT_TRUE(promises("light_cutoff:0")) << "which the left side has, too";
    state.settings.list_cap = 8;
    EXPECT_FALSE(promises("grid_law:linear"));
}

} // namespace
} // namespace froxel::session
