#include "load/random_values.h"

#include "froxel/v1/options.pb.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace froxel::load {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

// Which range of Welcome a number keeps to; empty: none.
std::string_view rangeOf(const FieldDescriptor& field) {
    const std::string& setting = field.options().GetExtension(v1::setting);
    return setting.empty() ? field.options().GetExtension(v1::range) : setting;
}

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
    if (once(8)) {
        return vecWithin("position");
    }
    v1::Vec3 made;
    made.set_x(real(box_.min().x(), box_.max().x()));
    made.set_y(real(box_.min().y(), box_.max().y()));
    made.set_z(real(box_.min().z(), box_.max().z()));
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
            fillMessage(*message.GetReflection()->MutableMessage(&message, &field), field, which);
            break;
        default:
            fillNumber(message, field);
        }
    }
}

// A colour is a setting of three numbers.
void RandomValues::fillMessage(Message& message, const FieldDescriptor& field, Fields which) {
    if (const std::string_view range = rangeOf(field); range.empty()) {
        fill(message, which);
    } else {
        static_cast<v1::Vec3&>(message) = vecWithin(range);
    }
}

v1::Vec3 RandomValues::vecWithin(std::string_view range) {
    v1::Vec3 made;
    made.set_x(within(range));
    made.set_y(within(range));
    made.set_z(within(range));
    return made;
}

void RandomValues::fillNumber(Message& message, const FieldDescriptor& field) {
    const std::string_view range = rangeOf(field);
    if (range.empty()) {
        return;
    }
    const double value = within(range);
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
