#include "load/random_values.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace froxel::load {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

// Which range of Welcome a number keeps to.
const std::map<std::string_view, std::string_view> kRangeOf = {
    {"SetLights.count", "lights"},
    {"SetLights.radius_m", "light_radius"},
    {"SetLights.intensity", "light_intensity"},
    {"SetLights.speed", "light_speed"},
    {"SetLights.ambient", "ambient"},
    {"SetLights.time_s", "time"},
    {"SetLights.cutoff", "light_cutoff"},
    {"SetLights.list_cap", "list_cap"},
    {"Grid.x", "grid.x"},
    {"Grid.y", "grid.y"},
    {"Grid.z", "grid.z"},
    {"SetExposure.exposure", "exposure"},
    {"SetToon.outline_strength", "outline_strength"},
    {"SetToon.outline_width", "outline_width"},
    {"SetPost.bloom_threshold", "bloom_threshold"},
    {"SetPost.bloom_knee", "bloom_knee"},
    {"SetPost.bloom_strength", "bloom_strength"},
    {"SetPost.bloom_radius", "bloom_radius"},
    {"Fog.density", "fog_density"},
    {"Fog.height_falloff", "fog_height_falloff"},
    {"Fog.base_height", "fog_base_height"},
    {"Fog.anisotropy", "fog_anisotropy"},
    {"Fog.tile", "fog_tile"},
    {"Fog.slices", "fog_slices"},
    {"SetShadows.lights", "shadow_lights"},
    {"SetShadows.size", "shadow_size"},
    {"SetDebugView.scale_max", "debug_scale_max"},
    {"SetTransparency.peel_layers", "peel_layers"},
    {"SetSize.width", "width"},
    {"SetSize.height", "height"},
    {"SetEncoding.quality", "quality"},
    {"SetEncoding.video_kbps", "video_kbps"},
    {"SetDelivery.target_fps", "target_fps"},
    {"PlacedLight.intensity", "light_intensity"},
    {"PlacedLight.radius_m", "light_radius"},
    {"PlacedLight.outer_cone_deg", "lights.cone_deg"},
    {"PlacedLight.width_m", "lights.side_m"},
    {"PlacedLight.height_m", "lights.side_m"},
    {"PlacedLight.roll_deg", "lights.roll_deg"},
};

} // namespace

RandomValues::RandomValues(const v1::Welcome& welcome, uint32_t seed)
    : box_(welcome.state().light_box()), random_(seed) {
    for (const v1::FieldRange& range : welcome.ranges()) {
        ranges_[range.field()] = {range.min(), range.max()};
    }
}

uint32_t RandomValues::whole(uint32_t from, uint32_t to) {
    return std::uniform_int_distribution<uint32_t>(from, std::max(from, to))(random_);
}

double RandomValues::real(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random_);
}

// What is no end is more often small, however far the range goes: large values are mostly refused.
double RandomValues::within(std::string_view range) {
    const auto known = ranges_.find(range);
    const auto [least, most] = known == ranges_.end() ? std::pair(0.0, 0.0) : known->second;
    if (once(3)) {
        return once(2) ? least : most;
    }
    const double small = std::clamp(0.0, least, most);
    const double end = least < 0 && once(2) ? least : most;
    return small + (end - small) * std::pow(real(0, 1), 8);
}

v1::Vec3 RandomValues::place() {
    v1::Vec3 made;
    if (once(8)) {
        made.set_x(within("position"));
        made.set_y(within("position"));
        made.set_z(within("position"));
    } else {
        made.set_x(real(box_.min().x(), box_.max().x()));
        made.set_y(real(box_.min().y(), box_.max().y()));
        made.set_z(real(box_.min().z(), box_.max().z()));
    }
    return made;
}

void RandomValues::fill(Message& message, Fields which) {
    const auto& fields = *message.GetDescriptor();
    for (int index = 0; index < fields.field_count(); ++index) {
        const FieldDescriptor& field = *fields.field(index);
        if (field.is_repeated() || (which == Fields::kSome && field.has_presence() && once(2))) {
            continue;
        }
        switch (field.cpp_type()) {
        case FieldDescriptor::CPPTYPE_BOOL:
            message.GetReflection()->SetBool(&message, &field, once(2));
            break;
        case FieldDescriptor::CPPTYPE_ENUM:
            fillName(message, field);
            break;
        case FieldDescriptor::CPPTYPE_MESSAGE:
            fill(*message.GetReflection()->MutableMessage(&message, &field), which);
            break;
        default:
            fillNumber(message, field);
        }
    }
}

void RandomValues::fillNumber(Message& message, const FieldDescriptor& field) {
    const auto range = kRangeOf.find(field.containing_type()->name() + "." + field.name());
    if (range == kRangeOf.end()) {
        return;
    }
    const double value = within(range->second);
    if (field.cpp_type() == FieldDescriptor::CPPTYPE_DOUBLE) {
        message.GetReflection()->SetDouble(&message, &field, value);
    } else if (field.cpp_type() == FieldDescriptor::CPPTYPE_UINT32) {
        message.GetReflection()->SetUInt32(&message, &field, static_cast<uint32_t>(value));
    }
}

// But the first, which is UNSPECIFIED everywhere.
void RandomValues::fillName(Message& message, const FieldDescriptor& field) {
    const auto count = static_cast<uint32_t>(field.enum_type()->value_count());
    const auto index = static_cast<int>(whole(1, count - 1));
    message.GetReflection()->SetEnum(&message, &field, field.enum_type()->value(index));
}

} // namespace froxel::load
