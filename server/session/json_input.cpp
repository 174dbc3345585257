#include "session/json_input.h"

#include "core/text.h"
#include "protocol/limits.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/util/json_util.h>
#include <nlohmann/json.hpp>

#include <charconv>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

namespace froxel::session {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
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

std::optional<Rejection> checkInteger(const FieldDescriptor& field, const Json& value) {
    const double max = field.cpp_type() == FieldDescriptor::CPPTYPE_UINT32
                           ? double{std::numeric_limits<uint32_t>::max()}
                           : static_cast<double>(std::numeric_limits<uint64_t>::max());
    const double number = value.get<double>();
    if (number >= 0 && number <= max && number == std::floor(number)) {
        return std::nullopt;
    }
    return reject(RejectCode::kOutOfRange, field.name(),
                  field.name() + " is " + numberText(number) +
                      "; it must be a whole number from 0 to " + numberText(max));
}

std::optional<Rejection> checkScalar(const FieldDescriptor& field, const Json& value) {
    if (value.is_structured()) {
        return reject(RejectCode::kMalformed, field.name(),
                      field.name() + " is " + value.type_name() + "; it must be a single value");
    }
    if (const auto* values = field.enum_type(); values != nullptr && value.is_string()) {
        const auto& name = value.get_ref<const std::string&>();
        if (values->FindValueByName(name) == nullptr) {
            return reject(RejectCode::kUnsupported, field.name(),
                          field.name() + " has no value \"" + printable(name) + "\"");
        }
    }
    const bool is_integer = field.cpp_type() == FieldDescriptor::CPPTYPE_UINT32 ||
                            field.cpp_type() == FieldDescriptor::CPPTYPE_UINT64;
    return is_integer && value.is_number() ? checkInteger(field, value) : std::nullopt;
}

// Removes members that the schema does not know and checks the others' shape. What is left is no
// deeper than the schema, so that protobuf's parser only ever meets bounded input.
// NOLINTNEXTLINE(misc-no-recursion): as deep as the schema
std::optional<Rejection> fitToSchema(const Descriptor& type, Json& object) {
    if (!object.is_object()) {
        return reject(RejectCode::kMalformed, "",
                      type.name() + " is " + object.type_name() + "; it must be an object");
    }
    for (auto member = object.begin(); member != object.end();) {
        const FieldDescriptor* field = findField(type, member.key());
        if (field == nullptr) {
            member = object.erase(member);
            continue;
        }
        Json& value = member.value();
        ++member;
        if (value.is_null()) {
            continue; // absent, in protobuf's JSON
        }
        if (field->is_repeated() != value.is_array()) {
            return reject(RejectCode::kMalformed, field->name(),
                          field->name() + " is " + value.type_name() + "; it must be " +
                              (field->is_repeated() ? "an array" : "a single value"));
        }
        const auto check = [&](Json& item) {
            const Descriptor* nested = field->message_type();
            return nested != nullptr ? fitToSchema(*nested, item) : checkScalar(*field, item);
        };
        if (!field->is_repeated()) {
            if (auto fault = check(value)) {
                return fault;
            }
            continue;
        }
        for (Json& item : value) {
            if (auto fault = check(item)) {
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
    if (auto fault = fitToSchema(*message.GetDescriptor(), document)) {
        fault->ref_seq = seq;
        return *fault;
    }
    const auto status = google::protobuf::util::JsonStringToMessage(document.dump(), &message);
    if (!status.ok()) {
        auto fault = reject(RejectCode::kMalformed, "",
                            "not a " + message.GetDescriptor()->name() + ": " +
                                printable(status.ToString(), 100));
        fault.ref_seq = seq;
        return fault;
    }
    return {};
}

} // namespace froxel::session
