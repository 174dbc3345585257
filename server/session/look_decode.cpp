#include "session/look_decode.h"

#include "session/enum_field.h"

#include <string>

namespace froxel::session {
namespace {

view::ToonRamp
decodeRamp(const std::string& name, const v1::ToonRamp& ramp, FieldValidator& fields) {
    const auto count = static_cast<uint32_t>(ramp.points_size());
    if (count < 2 || count > view::ToonRamp::kMaxPoints) {
        fields.fail(RejectCode::kOutOfRange, name,
                    "has " + numberText(count) + " points; it must have 2 to " +
                        numberText(view::ToonRamp::kMaxPoints));
        return {};
    }
    view::ToonRamp command;
    command.count = count;
    command.points = {};
    for (uint32_t i = 0; i < count; ++i) {
        const v1::ToonRamp::Point& point = ramp.points(static_cast<int>(i));
        const std::string field = name + ".points[" + numberText(i) + "]";
        const auto number = [&](const char* part, const view::Range<double>& range, double value) {
            return static_cast<float>(fields.number(field + part, range, value));
        };
        command.points[i] = {number(".x", view::kToonRange, point.x()),
                             number(".y", view::kToonRange, point.y()),
                             number(".slope", view::kToonSlopeRange, point.slope())};
        // In float, as the shader will see them: equal neighbours would divide by zero.
        if (i > 0 && !(command.points[i].x > command.points[i - 1].x)) {
            fields.fail(RejectCode::kOutOfRange, field + ".x",
                        "is " + numberText(point.x()) + "; it must be above " +
                            numberText(command.points[i - 1].x) + ", the one before it");
        }
    }
    return command;
}

} // namespace

SetToon decodeToon(const v1::SetToon& toon, FieldValidator& fields) {
    SetToon command;
    if (toon.has_fragment()) {
        command.fragment = decodeRamp("toon_fragment", toon.fragment(), fields);
    }
    if (toon.has_compute()) {
        command.compute = decodeRamp("toon_compute", toon.compute(), fields);
    }
    if (toon.has_outline_strength()) {
        command.outline_strength =
            fields.number(view::kOutlineStrengthRange, toon.outline_strength());
    }
    if (toon.has_outline_width()) {
        command.outline_width = fields.number(view::kOutlineWidthRange, toon.outline_width());
    }
    return command;
}

SetPost decodePost(const v1::SetPost& set, FieldValidator& fields) {
    fields.require(set.has_bloom() || set.has_bloom_threshold() || set.has_bloom_knee() ||
                       set.has_bloom_strength() || set.has_bloom_radius() || set.has_antialiasing(),
                   "bloom");
    SetPost command;
    if (set.has_bloom()) {
        command.bloom = enumeration(fields, "bloom", kBloomKindTable, set.bloom());
    }
    if (set.has_bloom_threshold()) {
        command.bloom_threshold = fields.number(view::kBloomThresholdRange, set.bloom_threshold());
    }
    if (set.has_bloom_knee()) {
        command.bloom_knee = fields.number(view::kBloomKneeRange, set.bloom_knee());
    }
    if (set.has_bloom_strength()) {
        command.bloom_strength = fields.number(view::kBloomStrengthRange, set.bloom_strength());
    }
    if (set.has_bloom_radius()) {
        command.bloom_radius = fields.number(view::kBloomRadiusRange, set.bloom_radius());
    }
    if (set.has_antialiasing()) {
        command.antialiasing =
            enumeration(fields, "antialiasing", kAntialiasingTable, set.antialiasing());
    }
    return command;
}

SetTransparency decodeTransparency(const v1::SetTransparency& set, FieldValidator& fields) {
    fields.require(set.has_transparency() || set.has_peel_layers(), "transparency");
    SetTransparency command;
    if (set.has_transparency()) {
        command.transparency =
            enumeration(fields, "transparency", kTransparencyTable, set.transparency());
    }
    if (set.has_peel_layers()) {
        command.peel_layers = fields.number(view::kPeelLayersRange, set.peel_layers());
    }
    return command;
}

SetFog decodeFog(const v1::Fog& fog, FieldValidator& fields) {
    fields.require(fog.has_density() || fog.has_height_falloff() || fog.has_base_height() ||
                       fog.has_anisotropy() || fog.has_albedo() || fog.has_tile() ||
                       fog.has_slices() || fog.has_half_rate() || fog.has_noise(),
                   "fog");
    SetFog command;
    if (fog.has_density()) {
        command.density = fields.number(view::kFogDensityRange, fog.density());
    }
    if (fog.has_height_falloff()) {
        command.height_falloff = fields.number(view::kFogHeightFalloffRange, fog.height_falloff());
    }
    if (fog.has_base_height()) {
        command.base_height_m = fields.number(view::kFogBaseHeightRange, fog.base_height());
    }
    if (fog.has_anisotropy()) {
        command.anisotropy = fields.number(view::kFogAnisotropyRange, fog.anisotropy());
    }
    if (fog.has_albedo()) {
        command.albedo = {fields.number("fog_albedo.x", view::kFogAlbedoRange, fog.albedo().x()),
                          fields.number("fog_albedo.y", view::kFogAlbedoRange, fog.albedo().y()),
                          fields.number("fog_albedo.z", view::kFogAlbedoRange, fog.albedo().z())};
    }
    if (fog.has_tile()) {
        command.tile_px = fields.number(view::kFogTileRange, fog.tile());
    }
    if (fog.has_slices()) {
        command.slice_count = fields.number(view::kFogSlicesRange, fog.slices());
    }
    if (fog.has_half_rate()) {
        command.half_rate = fog.half_rate();
    }
    if (fog.has_noise()) {
        command.noise = fog.noise();
    }
    return command;
}

SetShadows decodeShadows(const v1::SetShadows& set, FieldValidator& fields) {
    fields.require(set.has_lights() || set.has_size(), "shadow_lights");
    SetShadows command;
    if (set.has_lights()) {
        command.lights = fields.number(view::kShadowLightsRange, set.lights());
    }
    if (set.has_size()) {
        command.size_px = fields.number(view::kShadowSizeRange, set.size());
    }
    return command;
}

} // namespace froxel::session
