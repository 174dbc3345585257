// Messages that hold a setting, whichever the schema says that it is.
#pragma once

#include "froxel/v1/options.pb.h"
#include "settings/setting.h"
#include "unit/session/messages.h"

#include <cctype>
#include <map>
#include <vector>

namespace froxel::session {

using FieldPath = std::vector<const google::protobuf::FieldDescriptor*>;

// Where the schema has settings, in the messages below one.
inline void findFields(const google::protobuf::Descriptor& message,
                       const FieldPath& above,
                       std::map<std::string, FieldPath>& found) {
    for (int index = 0; index < message.field_count(); ++index) {
        const google::protobuf::FieldDescriptor& field = *message.field(index);
        FieldPath path = above;
        path.push_back(&field);
        const std::string& name = field.options().GetExtension(v1::setting);
        if (!name.empty()) {
            EXPECT_TRUE(found.emplace(name, path).second) << name << " is held twice";
        } else if (field.message_type() != nullptr && !field.is_repeated()) {
            findFields(*field.message_type(), path, found);
        }
    }
}

inline std::map<std::string, FieldPath> fieldsOf(const google::protobuf::Descriptor& message) {
    std::map<std::string, FieldPath> found;
    findFields(message, {}, found);
    return found;
}

// The message that holds the path's last field.
inline google::protobuf::Message& holderOf(google::protobuf::Message& message,
                                           const FieldPath& path) {
    google::protobuf::Message* holder = &message;
    for (size_t step = 0; step + 1 < path.size(); ++step) {
        holder = holder->GetReflection()->MutableMessage(holder, path[step]);
    }
    return *holder;
}

inline int numberOf(const google::protobuf::FieldDescriptor& field, std::string_view name) {
    std::string upper;
    for (const char c : name) {
        upper += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    }
    for (int index = 1; index < field.enum_type()->value_count(); ++index) {
        const auto& value = *field.enum_type()->value(index);
        const std::string& full = value.name();
        if (full.size() > upper.size() && full.ends_with("_" + upper) &&
            field.enum_type()->value(0)->name() ==
                full.substr(0, full.size() - upper.size()) + "UNSPECIFIED") {
            return value.number();
        }
    }
    ADD_FAILURE() << "the schema does not know " << name;
    return 0;
}

inline void put(google::protobuf::Message& message,
                const FieldPath& path,
                const settings::Setting& setting,
                const settings::SettingValue& value) {
    google::protobuf::Message& holder = holderOf(message, path);
    const google::protobuf::FieldDescriptor* field = path.back();
    const auto& reflection = *holder.GetReflection();
    switch (setting.kind) {
    case settings::SettingKind::kSwitch:
        return reflection.SetBool(&holder, field, std::get<bool>(value));
    case settings::SettingKind::kWhole:
        return reflection.SetUInt32(&holder, field, std::get<uint32_t>(value));
    case settings::SettingKind::kReal:
        return reflection.SetDouble(&holder, field, std::get<double>(value));
    case settings::SettingKind::kChoice:
        return reflection.SetEnumValue(
            &holder, field,
            numberOf(*field, setting.names[std::get<settings::Choice>(value).index]));
    case settings::SettingKind::kColor:
        break;
    }
    auto& color = static_cast<v1::Vec3&>(*reflection.MutableMessage(&holder, field));
    color.set_x(std::get<glm::dvec3>(value).x);
    color.set_y(std::get<glm::dvec3>(value).y);
    color.set_z(std::get<glm::dvec3>(value).z);
}

// A command with this one value; a renderer, which is never absent, stays the usual one.
inline v1::ClientMessage commandOf(const settings::Setting& setting,
                                   const settings::SettingValue& value) {
    static const auto paths = fieldsOf(*v1::ClientMessage::descriptor());
    v1::ClientMessage message = clientMessage(7);
    const auto path = paths.find(std::string(setting.name));
    if (path == paths.end()) {
        ADD_FAILURE() << "no command holds " << setting.name;
        return message;
    }
    put(message, path->second, setting, value);
    if (message.has_set_renderer() && setting.name != "renderer") {
        message.mutable_set_renderer()->set_renderer(v1::RENDERER_CLUSTERED_DEFERRED);
    }
    return message;
}

} // namespace froxel::session
