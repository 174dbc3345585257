// Placed lights: commands, their effect, sets from files.
#include "session/placed_lights.h"
#include "unit/session/messages.h"

#include <gmock/gmock.h>

namespace froxel::session {
namespace {

using ::testing::HasSubstr;

SetPlacedLights decoded(const std::string& body) {
    return accepted<SetPlacedLights>(decodeBody("\"setPlacedLights\":{" + body + "}"));
}

settings::PlacedLights after(const settings::PlacedLights& before, const std::string& body) {
    const auto result = changed(before, decoded(body));
    if (!result) {
        ADD_FAILURE() << result.error().message;
        return before;
    }
    return *result;
}

std::string refusal(const settings::PlacedLights& before, const std::string& body) {
    const auto result = changed(before, decoded(body));
    EXPECT_FALSE(result) << body;
    return result ? "" : result.error().message;
}

const std::string kTwo = R"("lights":[{"id":9,"position":{"x":1}},
                                      {"id":2,"position":{"y":1},"kind":"LIGHT_KIND_SPOT"}])";

TEST(PlacedLights, New_HaveDefaultsAndAscendById) {
    const auto placed = after({}, kTwo);
    ASSERT_EQ(placed.lights().size(), 2U);
    EXPECT_EQ(placed.lights()[0].id, 2U);
    EXPECT_EQ(placed.lights()[1].id, 9U);
    const settings::PlacedLight* light = placed.find(9);
    ASSERT_NE(light, nullptr);
    EXPECT_EQ(light->kind, settings::LightKind::kPoint);
    EXPECT_EQ(light->position_world, glm::dvec3(1, 0, 0));
    EXPECT_EQ(light->color, glm::vec3(1));
    EXPECT_EQ(light->intensity, 1);
    EXPECT_EQ(light->radius_m, 2);
    EXPECT_EQ(placed.find(2)->kind, settings::LightKind::kSpot);
    EXPECT_EQ(placed.find(3), nullptr);
}

TEST(PlacedLights, Changed_KeepWhatIsAbsent) {
    const auto before = after({}, kTwo);
    const auto placed = after(before, R"("lights":[{"id":9,"radiusM":5,"color":{"x":0.5}}])");
    EXPECT_EQ(placed.find(9)->position_world, glm::dvec3(1, 0, 0));
    EXPECT_EQ(placed.find(9)->radius_m, 5);
    EXPECT_EQ(placed.find(9)->color, glm::vec3(0.5F, 0, 0));
    EXPECT_EQ(before.find(9)->radius_m, 2); // the set before is another
    EXPECT_FALSE(placed == before);
    EXPECT_TRUE(after(placed, R"("lights":[{"id":9,"radiusM":2,"color":{"x":1,"y":1,"z":1}}])") ==
                before);
}

TEST(PlacedLights, ClearAndRemove_ComeFirst) {
    const auto before = after({}, kTwo);
    EXPECT_EQ(after(before, R"("remove":[2])").lights().size(), 1U);
    EXPECT_TRUE(after(before, R"("clear":true)").lights().empty());
    const auto replaced = after(before, R"("clear":true,"lights":[{"id":2,"position":{}}])");
    ASSERT_EQ(replaced.lights().size(), 1U);
    EXPECT_EQ(replaced.find(2)->kind, settings::LightKind::kPoint); // new, not changed
}

TEST(PlacedLights, WhatCannotBe_IsRefusedByName) {
    const auto before = after({}, kTwo);
    EXPECT_EQ(refusal(before, R"("remove":[9,4])"), "remove[1] is 4; no such light exists");
    EXPECT_EQ(refusal(before, R"("lights":[{"id":4,"radiusM":1}])"),
              "lights[0].position is missing; light 4 does not exist yet");
    EXPECT_EQ(refusal(before, R"("lights":[{"id":2,"innerConeDeg":60}])"),
              "lights[0].inner_cone_deg is 60; it must be at most outer_cone_deg, 45");
    EXPECT_EQ(
        refusal(before, R"("lights":[{"id":2,"replacesScene":3},{"id":9,"replacesScene":3}])"),
        "lights 2 and 9 would replace the same light; only one can");
    EXPECT_EQ(
        refusal(before, R"("lights":[{"id":2,"kind":"LIGHT_KIND_AREA","widthM":6,"heightM":8}])"),
        "lights[0].radius_m is 2; the rectangle's corners must lie within it; they are at 5");
}

TEST(PlacedLights, WhatALightStandsFor_IsKeptAndTold) {
    const auto before = after({}, R"("lights":[{"id":3,"position":{},"replacesSeeded":7}])");
    const auto placed = after(before, R"("lights":[{"id":3,"intensity":4}])");
    const settings::LightRef seventh{settings::LightRef::Of::kSeed, 7};
    EXPECT_EQ(placed.find(3)->replaces, seventh);
    EXPECT_EQ(changeOf({}, placed).lights(0).replaces_seeded(), 7U);
    EXPECT_FALSE(changeOf({}, placed).lights(0).has_replaces_scene());
    EXPECT_EQ(parseLightSet(lightSetJson(placed)).value(), placed);
}

// The light of an id anew, with another light's place or with none.
TEST(PlacedLights, WhatALightNoLongerStandsFor_IsTold) {
    const auto before = after({}, R"("lights":[{"id":3,"position":{},"replacesSeeded":7}])");
    for (const char* anew :
         {R"({"id":3,"position":{"x":1}})", R"({"id":3,"position":{},"replacesScene":2})"}) {
        const auto now = after(before, std::string(R"("clear":true,"lights":[)") + anew + "]");
        FieldValidator fields;
        const auto told = decodePlacedLights(changeOf(before, now), fields);
        ASSERT_FALSE(fields.rejection());
        EXPECT_EQ(changed(before, told).value(), now) << anew;
    }
}

TEST(PlacedLights, Picked_IsOneMore_UnlessItsIdIsInUse) {
    const auto before = after({}, kTwo);
    settings::PlacedLight picked;
    picked.id = 5;
    picked.position_world = {1, 2, 3};
    picked.replaces = settings::LightRef{settings::LightRef::Of::kScene, 0};
    const auto placed = withPicked(before, picked).value();
    EXPECT_EQ(placed.lights().size(), 3U);
    EXPECT_EQ(*placed.find(5), picked);
    picked.id = 9;
    EXPECT_EQ(withPicked(before, picked).error().message, "id is 9; another light already has it");
}

TEST(PlacedLights, Fields_AreCheckedWhenDecoded) {
    const auto message = [](const std::string& body) {
        return refused(decodeBody("\"setPlacedLights\":{" + body + "}")).message;
    };
    EXPECT_EQ(message(""), "lights is missing");
    EXPECT_THAT(message(R"("lights":[{"position":{}}])"), HasSubstr("lights[0].id is 0"));
    EXPECT_EQ(message(R"("lights":[{"id":1,"position":{}},{"id":1,"position":{}}])"),
              "lights[1].id is 1; another light already has it");
    EXPECT_THAT(message(R"("lights":[{"id":1,"direction":{}}])"),
                HasSubstr("lights[0].direction is 0"));
    EXPECT_THAT(message(R"("lights":[{"id":1,"intensity":-1}])"),
                HasSubstr("lights[0].intensity is -1"));
    EXPECT_THAT(message(R"("lights":[{"id":1,"replacesScene":1,"replacesSeeded":1}])"),
                HasSubstr("lights[0].replaces_scene is set together with replaces_seeded"));
    EXPECT_THAT(message(R"("lights":[{"id":1,"kind":9}])"),
                HasSubstr("known are LIGHT_KIND_POINT"));
}

TEST(PlacedLights, MoreThanAreKept_AreRefused) {
    SetPlacedLights command;
    for (uint32_t id = 1; id <= settings::kPlacedCountRange.max + 1; ++id) {
        PlacedLightChange light;
        light.id = id;
        light.position_world = glm::dvec3(id);
        command.lights.push_back(light);
    }
    EXPECT_THAT(changed({}, command).error().message,
                HasSubstr("lights would be 2049; at most 2048"));
    command.lights.pop_back();
    EXPECT_EQ(changed({}, command)->lights().size(), 2048U);
}

TEST(LightSet, OfAFile_IsTheMessageWithLightsAlone) {
    const auto set = parseLightSet("{" + kTwo + "}");
    ASSERT_TRUE(set) << set.error().message;
    EXPECT_EQ(set->lights().size(), 2U);
    EXPECT_EQ(parseLightSet(R"({"lights":[],"clear":true})").error().message,
              "clear is set; a light set may contain only lights");
    EXPECT_THAT(parseLightSet("[1]").error().message, HasSubstr("must be an object"));
    EXPECT_THAT(parseLightSet("{\"lights\":[{").error().message, HasSubstr("not JSON"));
    EXPECT_THAT(parseLightSet("{\"lights\":[{\"id\":1}]}").error().message,
                HasSubstr("lights[0].position is missing"));
}

TEST(LightSet, Written_IsReadBackAsTheSame) {
    const auto set =
        after({}, R"("lights":[{"id":3,"position":{"x":0.1,"y":-7e-3},"kind":"LIGHT_KIND_AREA",
                                            "intensity":0.3,"color":{"x":0.7,"y":0.1},"rollDeg":12.3}])");
    EXPECT_TRUE(*parseLightSet(lightSetJson(set)) == set);
}

TEST(LightSet, Change_TakesOneToTheOther) {
    const auto before = after({}, kTwo);
    const auto now = after(before, R"("remove":[2],"lights":[{"id":3,"position":{"z":1}}])");
    v1::ClientMessage message = clientMessage();
    *message.mutable_set_placed_lights() = changeOf(before, now);
    const auto command = accepted<SetPlacedLights>(decodeBinary(message));
    EXPECT_TRUE(*changed(before, command) == now);
    EXPECT_EQ(changeOf(now, now).ByteSizeLong(), 0U);
}

} // namespace
} // namespace froxel::session
