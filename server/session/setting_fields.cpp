#include "session/setting_fields.h"

#include "core/assert.h"
#include "froxel/v1/client.pb.h"
#include "froxel/v1/options.pb.h"
#include "session/proto_enums.h"
#include "session/proto_vec.h"

#include <algorithm>
#include <map>

namespace froxel::session {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using settings::SettingKind;
using settings::SettingValue;

// A field that holds a setting, or a message in which there are some.
struct HoldingField {
    const FieldDescriptor* field = nullptr;
    const SessionSetting* setting = nullptr; // null: a message of some
    std::vector<int> numbers;                // of a choice's names, in their order
};
using HoldingFields = std::vector<HoldingField>;

FieldDescriptor::CppType typeOf(SettingKind kind) {
    switch (kind) {
    case SettingKind::kSwitch:
        return FieldDescriptor::CPPTYPE_BOOL;
    case SettingKind::kWhole:
        return FieldDescriptor::CPPTYPE_UINT32;
    case SettingKind::kReal:
        return FieldDescriptor::CPPTYPE_DOUBLE;
    case SettingKind::kChoice:
        return FieldDescriptor::CPPTYPE_ENUM;
    case SettingKind::kColor:
        break;
    }
    return FieldDescriptor::CPPTYPE_MESSAGE;
}

HoldingFields fieldsOf(const Descriptor& message);

HoldingField holding(const FieldDescriptor& field) {
    HoldingField held{&field, nullptr, {}};
    const std::string& name = field.options().GetExtension(v1::setting);
    if (name.empty()) {
        const bool some = field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE &&
                          !field.is_repeated() && !fieldsOf(*field.message_type()).empty();
        return some ? held : HoldingField{};
    }
    held.setting = findSetting(name);
    FROXEL_ASSERT(held.setting != nullptr, "every setting of the schema has a row");
    const settings::Setting& facts = held.setting->facts();
    FROXEL_ASSERT(field.cpp_type() == typeOf(facts.kind), "a setting's field is of its kind");
    if (facts.kind == SettingKind::kChoice) {
        held.numbers = enumNumbers(*field.enum_type(), facts.names);
    }
    return held;
}

HoldingFields fieldsOf(const Descriptor& message) {
    HoldingFields all;
    for (int index = 0; index < message.field_count(); ++index) {
        if (HoldingField held = holding(*message.field(index)); held.field != nullptr) {
            all.push_back(std::move(held));
        }
    }
    return all;
}

// Of each message of these files, looked up once.
const HoldingFields& heldBy(const Descriptor& message) {
    static const auto known = [] {
        std::map<const Descriptor*, HoldingFields> all;
        for (const auto* file :
             {v1::ViewState::descriptor()->file(), v1::ClientMessage::descriptor()->file()}) {
            for (int index = 0; index < file->message_type_count(); ++index) {
                all.emplace(file->message_type(index), fieldsOf(*file->message_type(index)));
            }
        }
        return all;
    }();
    return known.at(&message);
}

double inRange(FieldValidator& fields,
               const settings::Setting& facts,
               const std::string& field,
               double value) {
    return fields.number(settings::Range<double>{field, facts.min, facts.max}, value);
}

SettingValue decodeValue(const Message& command, const HoldingField& held, FieldValidator& fields) {
    const auto& reflection = *command.GetReflection();
    const settings::Setting& facts = held.setting->facts();
    const std::string name(facts.name);
    switch (facts.kind) {
    case SettingKind::kSwitch:
        return reflection.GetBool(command, held.field);
    case SettingKind::kWhole: {
        const uint32_t value = reflection.GetUInt32(command, held.field);
        inRange(fields, facts, name, value);
        return value;
    }
    case SettingKind::kReal:
        return inRange(fields, facts, name, reflection.GetDouble(command, held.field));
    case SettingKind::kChoice:
        return settings::Choice{enumIndex(fields, name, *held.field->enum_type(), held.numbers,
                                          reflection.GetEnumValue(command, held.field))};
    case SettingKind::kColor:
        break;
    }
    const auto& color = static_cast<const v1::Vec3&>(reflection.GetMessage(command, held.field));
    return glm::dvec3(inRange(fields, facts, name + ".x", color.x()),
                      inRange(fields, facts, name + ".y", color.y()),
                      inRange(fields, facts, name + ".z", color.z()));
}

void addChanges(const Message& command, FieldValidator& fields, SettingChanges& changes) {
    const auto& reflection = *command.GetReflection();
    for (const HoldingField& held : heldBy(*command.GetDescriptor())) {
        if (held.field->has_presence() && !reflection.HasField(command, held.field)) {
            continue;
        }
        if (held.setting == nullptr) {
            addChanges(reflection.GetMessage(command, held.field), fields, changes);
        } else {
            changes.push_back({held.setting, decodeValue(command, held, fields)});
        }
    }
}

} // namespace

bool holdsSettingsAlone(const Descriptor& command) {
    const HoldingFields& held = heldBy(command);
    return !held.empty() && static_cast<int>(held.size()) == command.field_count() &&
           std::ranges::all_of(held, [](const HoldingField& one) {
               return one.setting != nullptr || holdsSettingsAlone(*one.field->message_type());
           });
}

SettingChanges decodeSettings(const Message& command, FieldValidator& fields) {
    SettingChanges changes;
    addChanges(command, fields, changes);
    const std::string& needed = command.GetDescriptor()->options().GetExtension(v1::needs);
    fields.require(!changes.empty() || needed.empty(), needed);
    return changes;
}

void fillSettings(Message& out, const SessionState& state) {
    const auto& reflection = *out.GetReflection();
    for (const HoldingField& held : heldBy(*out.GetDescriptor())) {
        if (held.setting == nullptr) {
            fillSettings(*reflection.MutableMessage(&out, held.field), state);
            continue;
        }
        const SettingValue value = held.setting->valueIn(state);
        switch (held.setting->facts().kind) {
        case SettingKind::kSwitch:
            reflection.SetBool(&out, held.field, std::get<bool>(value));
            break;
        case SettingKind::kWhole:
            reflection.SetUInt32(&out, held.field, std::get<uint32_t>(value));
            break;
        case SettingKind::kReal:
            reflection.SetDouble(&out, held.field, std::get<double>(value));
            break;
        case SettingKind::kChoice:
            reflection.SetEnumValue(&out, held.field,
                                    held.numbers[std::get<settings::Choice>(value).index]);
            break;
        case SettingKind::kColor:
            fillVec(static_cast<v1::Vec3&>(*reflection.MutableMessage(&out, held.field)),
                    std::get<glm::dvec3>(value));
            break;
        }
    }
}

} // namespace froxel::session
