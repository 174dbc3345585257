#include "path/path_file.h"

#include <gmock/gmock.h>
#include <string>

namespace froxel::path {
namespace {

using testing::HasSubstr;

constexpr const char* kTwo = R"({"seconds": 8, "keys": [
    {"at_s": 1, "eye": [0, 1, 2], "target": [0, 1, 0]},
    {"at_s": 3, "eye": [4, 1, 2], "target": [0, 1, 0], "up": [0, 0, 1], "fov_deg": 60}]})";

std::string faultOf(const std::string& text) {
    const auto path = parsePath(text);
    return path ? "read" : path.error().message;
}

std::string keysOf(const std::string& keys) {
    return R"({"keys": [)" + keys + "]}";
}

TEST(PathFile, Keys_AreReadAndWritten) {
    const auto path = parsePath(kTwo).value();
    ASSERT_EQ(path.keys.size(), 2U);
    EXPECT_EQ(path.seconds, 8);
    EXPECT_FALSE(path.loop || path.constant_speed);
    EXPECT_EQ(path.keys[1].camera.eye_world, glm::dvec3(4, 1, 2));
    EXPECT_NEAR(glm::degrees(path.keys[0].camera.yfov_rad), 45, 1e-12);
    EXPECT_NEAR(glm::degrees(path.keys[1].camera.yfov_rad), 60, 1e-12);
    const auto again = parsePath(pathText(path)).value();
    ASSERT_EQ(again.keys.size(), 2U);
    for (size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(again.keys[i].at_s, path.keys[i].at_s);
        EXPECT_LT(glm::distance(again.keys[i].camera.eye_world, path.keys[i].camera.eye_world),
                  1e-12);
        EXPECT_LT(
            glm::distance(again.keys[i].camera.target_world(), path.keys[i].camera.target_world()),
            1e-12);
    }
}

TEST(PathFile, WithoutTimes_KeysAreEvenlySpaced) {
    const std::string keys = R"("keys": [{"eye": [0, 0, 1], "target": [0, 0, 0]},
        {"eye": [0, 0, 2], "target": [0, 0, 0]}, {"eye": [0, 0, 3], "target": [0, 0, 0]}]})";
    const auto open = parsePath(R"({"seconds": 6, )" + keys).value();
    EXPECT_EQ(open.keys[1].at_s, 3);
    EXPECT_EQ(open.keys[2].at_s, 6);
    const auto loop = parsePath(R"({"seconds": 6, "loop": true, )" + keys).value();
    EXPECT_EQ(loop.keys[2].at_s, 4);
}

TEST(PathFile, Faults_NameTheFieldTheValueAndWhatIsRight) {
    for (const char* text : {"", "[]", "{}", "not JSON", R"({"keys": 5})"}) {
        EXPECT_THAT(faultOf(text), HasSubstr("is not a camera path: expected a JSON object"))
            << text;
    }
    EXPECT_THAT(faultOf(R"({"keys": []})"), HasSubstr("keys has 0; it must have 1 to 1000"));
    EXPECT_THAT(faultOf(R"({"keys": [], "speed": 1})"), HasSubstr("speed is not a member"));
    EXPECT_THAT(faultOf(R"({"keys": [], "loop": 1})"),
                HasSubstr("loop is 1; it must be true or false"));
    EXPECT_THAT(faultOf(R"({"keys": [], "seconds": 4000})"),
                HasSubstr("seconds is 4000; it must be a number from 0 to 3600"));
    EXPECT_THAT(faultOf(keysOf("7")), HasSubstr("keys[0] is 7; it must be an object"));
    EXPECT_THAT(faultOf(keysOf(R"({"eye": [0, 0, 0]})")), HasSubstr("keys[0].target is missing"));
    EXPECT_THAT(faultOf(keysOf(R"({"eye": [0, 0], "target": [0, 0, 1]})")),
                HasSubstr("keys[0].eye is [0,0]; it must be three numbers"));
    EXPECT_THAT(faultOf(keysOf(R"({"eye": [0, 0, 1e9], "target": [0, 0, 1]})")),
                HasSubstr("keys[0].eye[2] is 1000000000.0; it must be a number from"));
    EXPECT_THAT(faultOf(keysOf(R"({"eye": [0, 0, 1], "target": [0, 0, 1]})")),
                HasSubstr("keys[0].target is 0 m from the eye"));
    EXPECT_THAT(faultOf(keysOf(R"({"eye": [0, 0, 1], "target": [0, 0, 0], "up": [0, 0, 0]})")),
                HasSubstr("keys[0].up is 0 m long"));
    EXPECT_THAT(faultOf(keysOf(R"({"eye": [0, 0, 1], "target": [0, 0, 0], "fov_deg": 180})")),
                HasSubstr("keys[0].fov_deg is 180; it must be a number from 1 to 170"));
    EXPECT_THAT(faultOf(keysOf(R"({"eye": [0, 0, 1], "target": [0, 0, 0], "at_s": 1},
                                  {"eye": [0, 0, 2], "target": [0, 0, 0]})")),
                HasSubstr("keys: 1 of 2 have at_s; expected all or none"));
    EXPECT_THAT(faultOf(std::string(kMaxFileBytes + 1, ' ')),
                HasSubstr("a camera path may have 1048576"));
}

} // namespace
} // namespace froxel::path
