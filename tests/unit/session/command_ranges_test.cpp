// Every ranged field, at both edges and one step beyond, in both encodings.
#include "core/text.h"
#include "session/settings.h"
#include "settings/ranges.h"
#include "unit/session/setting_messages.h"

#include <google/protobuf/util/json_util.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>

namespace froxel::session {
namespace {

using Set = std::function<void(v1::ClientMessage&, double)>;

struct RangedField {
    std::string field;
    double min = 0;
    double max = 0;
    bool is_integer = false;
    Set set;
};

template <class T>
RangedField ranged(const settings::Range<T>& range, Set set, std::string field = {}) {
    return {field.empty() ? std::string(range.field) : std::move(field),
            static_cast<double>(range.min), static_cast<double>(range.max), std::is_integral_v<T>,
            std::move(set)};
}

uint32_t u32(double value) {
    return static_cast<uint32_t>(value);
}

v1::Vec3& unit(v1::Vec3& vec) {
    vec.set_x(1);
    return vec;
}

v1::SetGrid& grid(v1::ClientMessage& message) {
    auto& set = *message.mutable_set_grid();
    set.mutable_grid()->set_x(4);
    set.mutable_grid()->set_y(4);
    set.mutable_grid()->set_z(4);
    return set;
}

v1::SetCamera& camera(v1::ClientMessage& message) {
    auto& set = *message.mutable_set_camera();
    set.mutable_eye();
    unit(*set.mutable_target());
    return set;
}

v1::PickLight& picked(v1::ClientMessage& message) {
    message.mutable_pick_light()->set_id(1);
    return *message.mutable_pick_light();
}

v1::PlacedLight& placed(v1::ClientMessage& message) {
    auto& light = *message.mutable_set_placed_lights()->add_lights();
    light.set_id(1);
    return light;
}

v1::ToonRamp::Point& firstPoint(v1::ClientMessage& message) {
    auto& ramp = *message.mutable_set_toon()->mutable_compute();
    ramp.add_points();
    ramp.add_points()->set_x(1);
    return *ramp.mutable_points(0);
}

using M = v1::ClientMessage;

std::vector<RangedField> ofView() {
    return {
        ranged(settings::kWidthRange,
               [](M& m, double v) {
                   m.mutable_set_size()->set_height(64);
                   m.mutable_set_size()->set_width(u32(v));
               }),
        ranged(settings::kHeightRange,
               [](M& m, double v) {
                   m.mutable_set_size()->set_width(64);
                   m.mutable_set_size()->set_height(u32(v));
               }),
        ranged(settings::kGridXRange,
               [](M& m, double v) { grid(m).mutable_grid()->set_x(u32(v)); }),
        ranged(settings::kGridYRange,
               [](M& m, double v) { grid(m).mutable_grid()->set_y(u32(v)); }),
        ranged(settings::kGridZRange,
               [](M& m, double v) { grid(m).mutable_grid()->set_z(u32(v)); }),
        ranged(settings::kTimeRange, [](M& m, double v) { m.mutable_set_lights()->set_time_s(v); }),
        ranged(settings::kFovRange, [](M& m, double v) { camera(m).set_fov_deg(v); }),
        ranged(settings::kLensShiftXRange,
               [](M& m, double v) { camera(m).mutable_lens_shift()->set_x(v); }),
        ranged(settings::kLensShiftYRange,
               [](M& m, double v) { camera(m).mutable_lens_shift()->set_y(v); }),
        ranged(settings::kHalfHeightRange, [](M& m, double v) { camera(m).set_half_height_m(v); }),
        ranged(
            settings::kPositionRange, [](M& m, double v) { camera(m).mutable_eye()->set_z(v); },
            "eye.z"),
        ranged(
            settings::kPositionRange, [](M& m, double v) { camera(m).mutable_target()->set_y(v); },
            "target.y"),
        ranged(
            settings::kPositionRange,
            [](M& m, double v) { unit(*camera(m).mutable_up()).set_y(v); }, "up.y"),
        ranged(
            settings::kToonRange, [](M& m, double v) { firstPoint(m).set_y(v); },
            "toon_compute.points[0].y"),
        ranged(
            settings::kToonSlopeRange, [](M& m, double v) { firstPoint(m).set_slope(v); },
            "toon_compute.points[0].slope"),
    };
}

std::vector<RangedField> ofPlacedLights() {
    return {
        ranged(
            settings::kPlacedColorRange,
            [](M& m, double v) { placed(m).mutable_color()->set_z(v); }, "lights[0].color"),
        ranged(
            settings::kLightRadiusRange, [](M& m, double v) { placed(m).set_radius_m(v); },
            "lights[0].radius_m"),
        ranged(
            settings::kConeRange, [](M& m, double v) { placed(m).set_outer_cone_deg(v); },
            "lights[0].outer_cone_deg"),
        ranged(
            settings::kAreaSideRange, [](M& m, double v) { placed(m).set_height_m(v); },
            "lights[0].height_m"),
        ranged(
            settings::kAreaSideRange, [](M& m, double v) { placed(m).set_width_m(v); },
            "lights[0].width_m"),
        ranged(
            settings::kRollRange, [](M& m, double v) { placed(m).set_roll_deg(v); },
            "lights[0].roll_deg"),
        ranged(
            settings::kReplacedRange, [](M& m, double v) { placed(m).set_replaces_scene(u32(v)); },
            "lights[0].replaces_scene"),
        ranged(
            settings::kPickRange, [](M& m, double v) { picked(m).set_x(v); }, "x"),
        ranged(
            settings::kPickRange, [](M& m, double v) { picked(m).set_y(v); }, "y"),
        ranged(
            settings::kPositionRange,
            [](M& m, double v) { placed(m).mutable_position()->set_x(v); }, "lights[0].position.x"),
    };
}

// From their rows.
void addSettings(std::vector<RangedField>& all) {
    for (const SessionSetting& setting : sessionSettings()) {
        const settings::Setting& facts = setting.facts();
        const auto add = [&](const std::string& field, bool whole, auto value_of) {
            all.push_back({field, facts.min, facts.max, whole, [&facts, value_of](M& m, double v) {
                               m.MergeFrom(commandOf(facts, value_of(v)));
                           }});
        };
        const std::string name(facts.name);
        if (facts.kind == settings::SettingKind::kReal) {
            add(name, false, [](double v) -> settings::SettingValue { return v; });
        } else if (facts.kind == settings::SettingKind::kColor) {
            add(name + ".y", false,
                [](double v) -> settings::SettingValue { return glm::dvec3(0, v, 0); });
        } else if (facts.kind == settings::SettingKind::kWhole &&
                   facts.max < std::numeric_limits<uint32_t>::max()) {
            add(name, true, [](double v) -> settings::SettingValue { return u32(v); });
        }
    }
}

const std::vector<RangedField>& fields() {
    static const std::vector<RangedField> all = [] {
        std::vector<RangedField> every = ofView();
        std::ranges::move(ofPlacedLights(), std::back_inserter(every));
        addSettings(every);
        return every;
    }();
    return all;
}

class RangedFields : public ::testing::TestWithParam<protocol::WireFormat> {
  protected:
    static CommandResult<CommandMessage> decode(const RangedField& field, double value) {
        v1::ClientMessage message;
        field.set(message, value);
        message.set_seq(5);
        return decodeCommand(protocol::bytesOf(protocol::encodeClientMessage(message, GetParam())),
                             GetParam());
    }
    static void expectRefused(const RangedField& field, double value) {
        const Rejection rejection = refused(decode(field, value));
        EXPECT_EQ(rejection.code, RejectCode::kOutOfRange) << field.field;
        EXPECT_EQ(rejection.field, field.field);
        EXPECT_EQ(rejection.ref_seq, 5U);
        EXPECT_EQ(rejection.message, field.field + " is " + numberText(value) +
                                         "; it must be from " + numberText(field.min) + " to " +
                                         numberText(field.max));
    }
};

TEST_P(RangedFields, Edges_AreAccepted) {
    for (const RangedField& field : fields()) {
        for (const double edge : {field.min, field.max}) {
            const auto result = decode(field, edge);
            EXPECT_TRUE(result) << field.field << " = " << edge << ": " << result.error().message;
        }
    }
}

TEST_P(RangedFields, OneStepBeyond_IsRefusedByNameValueAndRange) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    for (const RangedField& field : fields()) {
        expectRefused(field,
                      field.is_integer ? field.max + 1 : std::nextafter(field.max, kInfinity));
        if (!field.is_integer) {
            expectRefused(field, std::nextafter(field.min, -kInfinity));
        } else if (field.min > 0) {
            expectRefused(field, field.min - 1);
        }
    }
}

TEST_P(RangedFields, NanAndInfinity_AreRefused) {
    for (const RangedField& field : fields()) {
        if (!field.is_integer) {
            expectRefused(field, std::numeric_limits<double>::quiet_NaN());
            expectRefused(field, std::numeric_limits<double>::infinity());
            expectRefused(field, -std::numeric_limits<double>::infinity());
            expectRefused(field, std::numeric_limits<double>::max());
        } else {
            expectRefused(field, double{std::numeric_limits<uint32_t>::max()});
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Wire,
                         RangedFields,
                         ::testing::Values(protocol::WireFormat::kBinary,
                                           protocol::WireFormat::kText),
                         [](const auto& format) {
                             return format.param == protocol::WireFormat::kBinary ? "Binary"
                                                                                  : "Text";
                         });

} // namespace
} // namespace froxel::session
