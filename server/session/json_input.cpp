#include "session/json_input.h"

#include "core/text.h"
#include "protocol/limits.h"

#include <google/protobuf/descriptor.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <vector>

namespace froxel::session {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::Reflection;
using Json = nlohmann::json;

Rejection reject(RejectCode code, std::string field, std::string message) {
    return Rejection{code, 0, std::move(field), std::move(message)};
}

// Watches a parse for what nlohmann's library allows and the protocol does not.
struct ParseGuard {
    bool too_deep = false;
    std::optional<std::string> repeated_key;
    std::vector<std::set<std::string>> open_objects;

    bool operator()(int depth, Json::parse_event_t event, const Json& parsed) {
        if (event == Json::parse_event_t::object_start) {
            open_objects.emplace_back();
        } else if (event == Json::parse_event_t::object_end) {
            open_objects.pop_back();
        } else if (event == Json::parse_event_t::key) {
            const auto& key = parsed.get_ref<const std::string&>();
            if (!open_objects.back().insert(key).second) {
                repeated_key = key;
            }
        }
        too_deep = too_deep || depth > static_cast<int>(protocol::kMaxJsonDepth);
        return true;
    }
};

CommandResult<void> parseDocument(std::string_view text, Json& document) {
    ParseGuard guard;
    try {
        document = Json::parse(text, std::ref(guard));
    } catch (const Json::parse_error& error) {
        return reject(RejectCode::kMalformed, "",
                      "not JSON: error at byte " + numberText(error.byte));
    } catch (const Json::out_of_range&) {
        return reject(RejectCode::kOutOfRange, "", "a number is beyond what a double can hold");
    }
    if (guard.too_deep) {
        return reject(RejectCode::kMalformed, "",
                      "JSON nested deeper than " + numberText(protocol::kMaxJsonDepth));
    }
    if (guard.repeated_key) {
        return reject(RejectCode::kMalformed, printable(*guard.repeated_key),
                      "the key \"" + printable(*guard.repeated_key) + "\" is there twice");
    }
    return {};
}

const FieldDescriptor* findField(const Descriptor& type, const std::string& key) {
    const FieldDescriptor* field = type.FindFieldByCamelcaseName(key);
    return field != nullptr ? field : type.FindFieldByName(key);
}

std::optional<Rejection>
wrongType(const FieldDescriptor& field, const Json& value, std::string_view wanted) {
    const std::string given = value.is_string()
                                  ? '"' + printable(value.get_ref<const std::string&>()) + '"'
                                  : value.type_name();
    return reject(RejectCode::kMalformed, field.name(),
                  field.name() + " is " + given + "; it must be " + std::string(wanted));
}

// A number may be written as a string, as canonical JSON writes 64-bit integers.
template <class T>
std::optional<T> numberIn(const std::string& text) {
    T number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool whole = error == std::errc() && end == text.data() + text.size();
    return whole ? std::optional(number) : std::nullopt;
}

template <class T>
std::optional<Rejection> readInteger(const FieldDescriptor& field, const Json& value, T& integer) {
    constexpr T kMax = std::numeric_limits<T>::max();
    if (value.is_string()) {
        if (const auto number = numberIn<T>(value.get_ref<const std::string&>())) {
            integer = *number;
            return std::nullopt;
        }
        return wrongType(field, value, "a whole number from 0 to " + numberText(kMax));
    }
    if (!value.is_number()) {
        return wrongType(field, value, "a number");
    }
    if (value.is_number_unsigned() && value.get<uint64_t>() <= kMax) {
        integer = static_cast<T>(value.get<uint64_t>());
        return std::nullopt;
    }
    // Below 2^32 and 2^64: the largest of 64 bits is no double.
    const double number = value.get<double>();
    if (number >= 0 && number < std::ldexp(1.0, std::numeric_limits<T>::digits) &&
        number == std::floor(number)) {
        integer = static_cast<T>(number);
        return std::nullopt;
    }
    return reject(RejectCode::kOutOfRange, field.name(),
                  field.name() + " is " + numberText(number) +
                      "; it must be a whole number from 0 to " + numberText(kMax));
}

std::optional<Rejection> readReal(const FieldDescriptor& field, const Json& value, double& real) {
    if (value.is_number()) {
        real = value.get<double>();
        return std::nullopt;
    }
    if (value.is_string()) {
        const auto& text = value.get_ref<const std::string&>();
        if (text == "NaN") {
            real = std::numeric_limits<double>::quiet_NaN();
            return std::nullopt;
        }
        if (text == "Infinity" || text == "-Infinity") {
            real = std::copysign(std::numeric_limits<double>::infinity(),
                                 text.front() == '-' ? -1.0 : 1.0);
            return std::nullopt;
        }
        if (const auto number = numberIn<double>(text); number && std::isfinite(*number)) {
            real = *number;
            return std::nullopt;
        }
    }
    return wrongType(field, value, "a number");
}

// A number without a name is kept, as protobuf keeps it.
std::optional<Rejection> readEnum(const FieldDescriptor& field, const Json& value, int& number) {
    if (value.is_string()) {
        const auto& name = value.get_ref<const std::string&>();
        const auto* known = field.enum_type()->FindValueByName(name);
        if (known == nullptr) {
            return reject(RejectCode::kUnsupported, field.name(),
                          field.name() + " has no value \"" + printable(name) + "\"");
        }
        number = known->number();
        return std::nullopt;
    }
    if (value.is_number()) {
        const double wanted = value.get<double>();
        number = static_cast<int>(std::clamp(wanted, -1.0, 1.0e9));
        if (number == wanted) {
            return std::nullopt;
        }
    }
    return wrongType(field, value, "the name or the number of a value");
}

// Where values of one field go.
struct Place {
    Message& message;
    const FieldDescriptor& field;

    // By Reflection's function for a field of one value, or of several.
    template <class Set, class Add, class Value>
    void put(Set set, Add add, Value value) const {
        const Reflection& reflection = *message.GetReflection();
        if (field.is_repeated()) {
            (reflection.*add)(&message, &field, std::move(value));
        } else {
            (reflection.*set)(&message, &field, std::move(value));
        }
    }
};

// Recurses as deep as the schema.
std::optional<Rejection> readObject(const Json& object, Message& message);

// Recurses as deep as the schema.
std::optional<Rejection> readValue(const Json& value, const Place& place) {
    const FieldDescriptor& field = place.field;
    if (field.message_type() != nullptr) {
        const Reflection& reflection = *place.message.GetReflection();
        return readObject(value, field.is_repeated()
                                     ? *reflection.AddMessage(&place.message, &field)
                                     : *reflection.MutableMessage(&place.message, &field));
    }
    if (value.is_structured()) {
        return wrongType(field, value, "a single value");
    }
    const auto read = [&](auto number, const auto& reader, auto set, auto add) {
        auto fault = reader(field, value, number);
        place.put(set, add, number);
        return fault;
    };
    switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_UINT32:
        return read(uint32_t{}, readInteger<uint32_t>, &Reflection::SetUInt32,
                    &Reflection::AddUInt32);
    case FieldDescriptor::CPPTYPE_UINT64:
        return read(uint64_t{}, readInteger<uint64_t>, &Reflection::SetUInt64,
                    &Reflection::AddUInt64);
    case FieldDescriptor::CPPTYPE_DOUBLE:
        return read(double{}, readReal, &Reflection::SetDouble, &Reflection::AddDouble);
    case FieldDescriptor::CPPTYPE_ENUM:
        return read(int{}, readEnum, &Reflection::SetEnumValue, &Reflection::AddEnumValue);
    case FieldDescriptor::CPPTYPE_BOOL:
        if (!value.is_boolean()) {
            return wrongType(field, value, "true or false");
        }
        place.put(&Reflection::SetBool, &Reflection::AddBool, value.get<bool>());
        return std::nullopt;
    case FieldDescriptor::CPPTYPE_STRING:
        if (!value.is_string()) {
            return wrongType(field, value, "a string");
        }
        place.put(&Reflection::SetString, &Reflection::AddString, value.get<std::string>());
        return std::nullopt;
    default:
        throw std::logic_error("bug: field " + field.full_name() +
                               " is of a type that no text has");
    }
}

// One value of a field, and one field of a choice: two spellings of a name are two keys.
std::optional<Rejection> alreadyThere(const Message& message, const FieldDescriptor& field) {
    const Reflection& reflection = *message.GetReflection();
    if (!field.is_repeated() && reflection.HasField(message, &field)) {
        return reject(RejectCode::kMalformed, field.name(), field.name() + " is there twice");
    }
    const auto* choice = field.real_containing_oneof();
    const FieldDescriptor* other =
        choice != nullptr ? reflection.GetOneofFieldDescriptor(message, choice) : nullptr;
    if (other != nullptr) {
        return reject(RejectCode::kMalformed, field.name(),
                      other->name() + " and " + field.name() + " are both there");
    }
    return std::nullopt;
}

// Each member of an object, where the schema has it.
// Recurses as deep as the schema.
std::optional<Rejection> readObject(const Json& object, Message& message) {
    const Descriptor& type = *message.GetDescriptor();
    if (!object.is_object()) {
        return reject(RejectCode::kMalformed, "",
                      type.name() + " is " + object.type_name() + "; it must be an object");
    }
    for (const auto& [key, value] : object.items()) {
        const FieldDescriptor* field = findField(type, key);
        if (field == nullptr || value.is_null()) {
            continue; // null is absent, in protobuf's JSON
        }
        if (field->is_repeated() != value.is_array()) {
            return wrongType(*field, value, field->is_repeated() ? "an array" : "a single value");
        }
        if (auto fault = alreadyThere(message, *field)) {
            return fault;
        }
        const Place place{message, *field};
        if (!field->is_repeated()) {
            if (auto fault = readValue(value, place)) {
                return fault;
            }
            continue;
        }
        for (const Json& item : value) {
            if (auto fault = readValue(item, place)) {
                return fault;
            }
        }
    }
    return std::nullopt;
}

// 0 where there is none; canonical JSON writes 64-bit integers as strings.
uint64_t seqOf(const Json& document) {
    const auto member = document.is_object() ? document.find("seq") : document.end();
    if (member == document.end()) {
        return 0;
    }
    if (member->is_number_unsigned()) {
        return member->get<uint64_t>();
    }
    uint64_t seq = 0;
    if (member->is_string()) {
        const auto& text = member->get_ref<const std::string&>();
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seq);
        return error == std::errc() && end == text.data() + text.size() ? seq : 0;
    }
    return 0;
}

} // namespace

CommandResult<void> parseJson(protocol::ByteSpan text, google::protobuf::Message& message) {
    Json document;
    const std::string_view json(reinterpret_cast<const char*>(text.data()), text.size());
    if (const auto parsed = parseDocument(json, document); !parsed) {
        return parsed.error();
    }
    const uint64_t seq = seqOf(document);
    if (auto fault = readObject(document, message)) {
        fault->ref_seq = seq;
        return *fault;
    }
    return {};
}

} // namespace froxel::session
