#include "path/path_file.h"

#include "core/text.h"
#include "settings/ranges.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace froxel::path {
namespace {

using Json = nlohmann::ordered_json;

constexpr settings::Range<double> kSecondsRange{"seconds", 0.0, 3600.0};
constexpr double kUsualFov_deg = 45;

// Reads members and keeps the first fault.
class Reader {
  public:
    double
    number(const Json& value, const std::string& name, const settings::Range<double>& range) {
        const double number = value.is_number() ? value.get<double>() : std::nan("");
        if (!range.contains(number)) {
            fail(name + " is " + printable(value.dump()) + "; it must be a number from " +
                 numberText(range.min) + " to " + numberText(range.max));
        }
        return number;
    }
    bool boolean(const Json& value, const std::string& name) {
        if (!value.is_boolean()) {
            fail(name + " is " + printable(value.dump()) + "; it must be true or false");
            return false;
        }
        return value.get<bool>();
    }
    glm::dvec3 place(const Json& value, const std::string& name) {
        if (!value.is_array() || value.size() != 3) {
            fail(name + " is " + printable(value.dump()) + "; it must be three numbers");
            return {};
        }
        glm::dvec3 place;
        for (int axis = 0; axis < 3; ++axis) {
            const auto i = static_cast<size_t>(axis);
            place[axis] =
                number(value[i], name + "[" + numberText(i) + "]", settings::kPositionRange);
        }
        return place;
    }
    void length(double metres,
                const std::string& name,
                const char* what,
                const settings::Range<double>& range) {
        if (!range.contains(metres)) {
            fail(name + " is " + numberText(metres) + " m " + what + "; it must be " +
                 numberText(range.min) + " to " + numberText(range.max));
        }
    }
    void knownMembers(const Json& object,
                      const std::string& path,
                      std::initializer_list<const char*> names) {
        for (const auto& [name, value] : object.items()) {
            if (std::ranges::find(names, name, [](const char* known) {
                    return std::string(known);
                }) == names.end()) {
                fail(path + printable(name) + " is not a member of a camera path");
            }
        }
    }
    void fail(std::string message) {
        if (!fault_) {
            fault_ = Error{ErrorCode::kInvalidArgument, std::move(message)};
        }
    }
    [[nodiscard]] const std::optional<Error>& fault() const { return fault_; }

  private:
    std::optional<Error> fault_;
};

// Null: it is absent.
const Json* memberOf(const Json& object, const char* name) {
    const auto found = object.find(name);
    return found == object.end() ? nullptr : &*found;
}

struct ReadKey {
    settings::Camera camera;
    std::optional<double> at_s;
};

ReadKey readKey(Reader& reader, const Json& json, const std::string& name) {
    ReadKey key;
    if (!json.is_object()) {
        reader.fail(name + " is " + printable(json.dump()) + "; it must be an object");
        return key;
    }
    const std::string path = name + ".";
    reader.knownMembers(json, path, {"at_s", "eye", "target", "up", "fov_deg"});
    const auto place = [&](const char* member) -> std::optional<glm::dvec3> {
        const Json* value = memberOf(json, member);
        return value != nullptr ? std::optional(reader.place(*value, path + member)) : std::nullopt;
    };
    const auto eye = place("eye");
    const auto target = place("target");
    if (!eye || !target) {
        reader.fail(path + (eye ? "target" : "eye") + " is missing");
        return key;
    }
    reader.length(glm::distance(*eye, *target), path + "target", "from the eye",
                  settings::kFocusRange);
    const glm::dvec3 up = place("up").value_or(glm::dvec3(0, 1, 0));
    reader.length(glm::length(up), path + "up", "long", settings::kUpRange);
    key.camera = settings::lookAt(*eye, *target, up);
    const Json* fov = memberOf(json, "fov_deg");
    key.camera.yfov_rad =
        glm::radians(fov != nullptr ? reader.number(*fov, path + "fov_deg", settings::kFovRange)
                                    : kUsualFov_deg);
    if (const Json* at = memberOf(json, "at_s")) {
        key.at_s = reader.number(*at, path + "at_s", kSecondsRange);
    }
    return key;
}

void placeInTime(Reader& reader, PathKeys& path, const std::vector<ReadKey>& read) {
    const auto timed =
        std::ranges::count_if(read, [](const ReadKey& key) { return key.at_s.has_value(); });
    if (timed != 0 && static_cast<size_t>(timed) != read.size()) {
        reader.fail("keys: " + numberText(timed) + " of " + numberText(read.size()) +
                    " have at_s; expected all or none");
        return;
    }
    const size_t steps = path.loop ? read.size() : read.size() - 1;
    for (size_t i = 0; i < read.size(); ++i) {
        const double even =
            steps > 0 ? path.seconds * static_cast<double>(i) / static_cast<double>(steps) : 0;
        path.keys.push_back({read[i].at_s.value_or(even), read[i].camera});
    }
}

} // namespace

Result<PathKeys> parsePath(std::string_view text) {
    if (text.size() > kMaxFileBytes) {
        return Error{ErrorCode::kInvalidArgument, "has " + numberText(text.size()) +
                                                      " bytes; a camera path may have " +
                                                      numberText(kMaxFileBytes)};
    }
    const Json json = Json::parse(text, nullptr, false);
    if (!json.is_object() || !json.contains("keys") || !json["keys"].is_array()) {
        return Error{ErrorCode::kInvalidArgument,
                     "is not a camera path: expected a JSON object with a list of keys"};
    }
    Reader reader;
    reader.knownMembers(json, "", {"seconds", "constant_speed", "loop", "keys"});
    PathKeys path;
    if (const Json* even = memberOf(json, "constant_speed")) {
        path.constant_speed = reader.boolean(*even, "constant_speed");
    }
    if (const Json* loop = memberOf(json, "loop")) {
        path.loop = reader.boolean(*loop, "loop");
    }
    std::vector<ReadKey> keys;
    for (const Json& key : json["keys"]) {
        keys.push_back(readKey(reader, key, "keys[" + numberText(keys.size()) + "]"));
        if (reader.fault() || keys.size() > kMaxKeys) {
            break;
        }
    }
    const double last_s = keys.empty() ? 0 : keys.back().at_s.value_or(0);
    const Json* seconds = memberOf(json, "seconds");
    path.seconds = seconds != nullptr ? reader.number(*seconds, "seconds", kSecondsRange) : last_s;
    if (!reader.fault() && !keys.empty()) {
        placeInTime(reader, path, keys);
    }
    if (reader.fault()) {
        return *reader.fault();
    }
    if (auto checked = check(path); !checked) {
        return checked.error();
    }
    return path;
}

std::string pathText(const PathKeys& path) {
    const auto list = [](const glm::dvec3& v) { return Json::array({v.x, v.y, v.z}); };
    Json keys = Json::array();
    for (const Key& key : path.keys) {
        keys.push_back({{"at_s", key.at_s},
                        {"eye", list(key.camera.eye_world)},
                        {"target", list(key.camera.target_world())},
                        {"up", list(key.camera.world_from_view[1])},
                        {"fov_deg", glm::degrees(key.camera.yfov_rad)}});
    }
    const Json json = {{"seconds", path.seconds},
                       {"constant_speed", path.constant_speed},
                       {"loop", path.loop},
                       {"keys", keys}};
    return json.dump(1) + "\n";
}

} // namespace froxel::path
