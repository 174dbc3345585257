#include "app/log_line.h"

#include "core/text.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>

namespace froxel::app {
namespace {

constexpr size_t kMaxBytes = 4096;
constexpr std::string_view kEvent = "event=";

// Up to the value's end, and what is left behind it.
std::pair<std::string, std::string_view> readValue(std::string_view text) {
    if (text.empty() || text.front() != '"') {
        const size_t end = std::min(text.find(' '), text.size());
        return {std::string(text.substr(0, end)), text.substr(end)};
    }
    std::string value;
    size_t at = 1;
    for (; at < text.size() && text[at] != '"'; ++at) {
        at += text[at] == '\\' && at + 1 < text.size() ? 1U : 0U;
        value += text[at];
    }
    return {value, text.substr(std::min(at + 1, text.size()))};
}

// Digits that read back as they are: no sign, no leading zero, and within a double's integers.
bool isNumber(std::string_view text) {
    return !text.empty() && text.size() <= 15 && (text == "0" || text.front() != '0') &&
           std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

} // namespace

std::string_view eventOf(std::string_view payload) {
    if (payload.substr(0, kEvent.size()) != kEvent) {
        return {};
    }
    const std::string_view rest = payload.substr(kEvent.size());
    return rest.substr(0, rest.find(' '));
}

std::string textLine(std::string_view payload) {
    return printable(payload, kMaxBytes);
}

std::string jsonFields(std::string_view payload) {
    const std::string line = textLine(payload);
    nlohmann::ordered_json fields = nlohmann::ordered_json::object();
    if (eventOf(line).empty()) {
        fields["message"] = line;
    }
    for (std::string_view rest = fields.empty() ? line : std::string_view(); !rest.empty();) {
        const size_t equals = rest.find('=');
        if (equals == std::string_view::npos) {
            fields["message"] = std::string(rest); // an event that ends in words
            break;
        }
        const std::string key(rest.substr(0, equals));
        const bool bare = equals + 1 < rest.size() && rest[equals + 1] != '"';
        auto [value, behind] = readValue(rest.substr(equals + 1));
        if (bare && isNumber(value)) {
            fields[key] = std::stoull(value);
        } else {
            fields[key] = std::move(value);
        }
        rest = behind.substr(std::min(behind.find_first_not_of(' '), behind.size()));
    }
    const std::string object = fields.dump();
    return object.substr(1, object.size() - 2);
}

} // namespace froxel::app
