// Every row of the table in every message that can hold it: a setting that somebody forgot to
// carry along cannot pass here.
#include "froxel/v1/server.pb.h"
#include "session/setting_fields.h"
#include "session/state_message.h"
#include "session/view_state.h"
#include "support/settings.h"
#include "unit/session/setting_messages.h"
#include "unit/session/state_fixture.h"

#include <algorithm>
#include <gmock/gmock.h>

namespace froxel::session {
namespace {

using google::protobuf::Message;
using settings::Setting;
using settings::SettingKind;
using settings::SettingValue;
using test::otherValue;

using SettingFields = State;

TEST_F(SettingFields, EverySetting_IsSetByACommandAndToldByTheState_AndNothingElseIs) {
    initial.decodable.set();
    const auto told = fieldsOf(*v1::ViewState::descriptor());
    EXPECT_EQ(told.size(), sessionSettings().size());
    for (const SessionSetting& setting : sessionSettings()) {
        const Setting& facts = setting.facts();
        SCOPED_TRACE(std::string(facts.name));
        const SettingValue value = otherValue(facts, setting.valueIn(initial));
        const auto decoded = decodeBinary(commandOf(facts, value));
        ASSERT_TRUE(decoded) << decoded.error().message;
        const auto state = apply(initial, *decoded, context, kStart);
        ASSERT_TRUE(state) << state.error().message;
        EXPECT_GT(state->version, initial.version);
        for (const SessionSetting& any : sessionSettings()) {
            const bool same = any.valueIn(*state) == any.valueIn(initial);
            EXPECT_EQ(same, &any != &setting) << any.facts().name;
        }
        EXPECT_EQ(setting.valueIn(*state), value);

        v1::ViewState expected;
        fillViewState(expected, context, initial);
        ASSERT_TRUE(told.contains(std::string(facts.name)));
        put(expected, told.at(std::string(facts.name)), facts, value);
        v1::ViewState state_told;
        fillViewState(state_told, context, *state);
        expected.clear_light_time_s();
        state_told.clear_light_time_s(); // of lights that were stopped
        EXPECT_EQ(state_told.DebugString(), expected.DebugString());
    }
}

// Settings of old are in two messages, one that sets them and one that tells them, where they may
// drift apart. Another one goes into a message that ClientMessage and ViewState both hold.
TEST_F(SettingFields, NewSettings_AreWrittenOnce) {
    constexpr size_t kWrittenTwice = 58;
    const auto set = fieldsOf(*v1::ClientMessage::descriptor());
    const auto told = fieldsOf(*v1::ViewState::descriptor());
    const auto twice = std::ranges::count_if(told, [&set](const auto& entry) {
        const auto& [name, path] = entry;
        return set.contains(name) && set.at(name).back() != path.back();
    });
    EXPECT_EQ(twice, kWrittenTwice) << "of " << told.size();
}

TEST_F(SettingFields, WelcomeTellsEveryRange) {
    const auto message = makeWelcome(1, context, initial);
    for (const SessionSetting& setting : sessionSettings()) {
        const Setting& facts = setting.facts();
        const bool ranged = facts.kind == SettingKind::kWhole || facts.kind == SettingKind::kReal ||
                            facts.kind == SettingKind::kColor;
        const auto& ranges = message.welcome().ranges();
        const auto found = std::find_if(ranges.begin(), ranges.end(), [&](const auto& range) {
            return range.field() == facts.name;
        });
        ASSERT_EQ(found != ranges.end(), ranged) << facts.name;
        if (ranged) {
            EXPECT_EQ(found->min(), facts.min) << facts.name;
            EXPECT_EQ(found->max(), facts.max) << facts.name;
            EXPECT_LT(facts.min, facts.max) << facts.name;
        }
    }
}

TEST_F(SettingFields, CommandsWithoutAny_NameWhatIsMissing) {
    const auto missing = [](const auto& fill) {
        v1::ClientMessage message = clientMessage();
        fill(message);
        return refused(decodeBinary(message)).message;
    };
    EXPECT_EQ(missing([](auto& m) { m.mutable_set_post(); }), "bloom is missing");
    EXPECT_EQ(missing([](auto& m) { m.mutable_set_fog(); }), "fog is missing");
    EXPECT_EQ(missing([](auto& m) { m.mutable_set_fog()->mutable_fog(); }), "fog is missing");
    EXPECT_EQ(missing([](auto& m) { m.mutable_set_shadows(); }), "shadow_lights is missing");
    EXPECT_EQ(missing([](auto& m) { m.mutable_set_environment(); }), "environment is missing");
    EXPECT_EQ(missing([](auto& m) { m.mutable_set_transparency(); }), "transparency is missing");
    EXPECT_EQ(missing([](auto& m) { m.mutable_set_delivery(); }), "adaptive is missing");
    EXPECT_EQ(missing([](auto& m) { m.mutable_set_grid(); }), "grid is missing");
    EXPECT_EQ(missing([](auto& m) { m.mutable_set_debug_view(); }), "debug_view is missing");
    v1::ClientMessage message = clientMessage();
    message.mutable_set_lights();
    EXPECT_TRUE(accepted<SetLights>(decodeBinary(message)).changes.empty());
}

TEST_F(SettingFields, UnknownNames_AreRefusedWithThoseThatAreKnown) {
    const auto paths = fieldsOf(*v1::ClientMessage::descriptor());
    for (const SessionSetting& setting : sessionSettings()) {
        const Setting& facts = setting.facts();
        if (facts.kind != SettingKind::kChoice) {
            continue;
        }
        SCOPED_TRACE(std::string(facts.name));
        for (const int number : {0, 99, -1}) {
            v1::ClientMessage message = commandOf(facts, setting.valueIn(initial));
            const FieldPath& path = paths.at(std::string(facts.name));
            Message& holder = holderOf(message, path);
            holder.GetReflection()->SetEnumValue(&holder, path.back(), number);
            const Rejection rejection = refused(decodeBinary(message));
            EXPECT_EQ(rejection.code, RejectCode::kUnsupported);
            EXPECT_EQ(rejection.field, facts.name);
            EXPECT_EQ(rejection.ref_seq, 7U);
            EXPECT_THAT(rejection.message,
                        ::testing::HasSubstr("is " + std::to_string(number) + "; known are "));
            for (const auto& name : facts.names) {
                const int known = numberOf(*path.back(), name);
                EXPECT_THAT(rejection.message,
                            ::testing::HasSubstr(
                                path.back()->enum_type()->FindValueByNumber(known)->name()));
            }
        }
    }
}

} // namespace
} // namespace froxel::session
