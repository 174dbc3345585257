// --light-set.
#include "unit/app/parsed_options.h"

#include <fstream>
#include <gmock/gmock.h>

namespace froxel::app {
namespace {

using testing::HasSubstr;

// A file of a light set, as the page saves it.
class LightSetFile : public testing::Test {
  protected:
    std::string write(const std::string& text) const {
        std::ofstream(path_) << text;
        return path_;
    }
    // Tests run side by side.
    const std::string path_ = testing::TempDir() + "lights_" +
                              testing::UnitTest::GetInstance()->current_test_info()->name() +
                              ".json";
};

TEST_F(LightSetFile, OfEveryCommandThatDraws_IsRead) {
    const std::string file = write(R"({"lights":[{"id":3,"position":{"y":2}}]})");
    const auto render = parseRender({"--light-set", file.c_str()});
    ASSERT_EQ(render.settings.lights.placed.lights().size(), 1U);
    EXPECT_EQ(render.settings.lights.placed.find(3)->position_world.y, 2);
    EXPECT_EQ(render.light_set, file);
    const auto serve =
        std::get<ServeOptions>(parse({"serve", "--light-set", file.c_str()}).command);
    EXPECT_EQ(serve.first_view.lights.placed.lights().size(), 1U);
    const auto bench = std::get<BenchOptions>(
        parse({"bench", "--out", "a.json", "--light-set", file.c_str()}).command);
    EXPECT_EQ(bench.settings.lights.placed.lights().size(), 1U);
    EXPECT_EQ(bench.light_set, file);
}

TEST_F(LightSetFile, Bad_IsRefusedWithFileFieldAndValue) {
    const auto said = [&](const std::string& text) {
        const std::string file = write(text);
        return refusal({"render", "--out", "a.png", "--light-set", file.c_str()});
    };
    EXPECT_THAT(said("nonsense"), HasSubstr(path_ + "': not JSON: error at byte 2"));
    EXPECT_THAT(said(R"({"lights":[{"id":1,"position":{},"radiusM":0}]})"),
                HasSubstr("lights[0].radius_m is 0; it must be from 0.001 to 10000"));
    EXPECT_THAT(said(R"({"lights":[{"id":1,"position":{},"kind":"LIGHT_KIND_MOON"}]})"),
                HasSubstr("kind has no value \"LIGHT_KIND_MOON\""));
    EXPECT_THAT(refusal({"render", "--out", "a.png", "--light-set", "no.json"}),
                HasSubstr("cannot read 'no.json': No such file"));
}

} // namespace
} // namespace froxel::app
