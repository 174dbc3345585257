#include "app/info_report.h"

#include "render/frame/plan_words.h"
#include "session/session_context.h"

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cstddef>

namespace froxel::app {

namespace {

using Json = nlohmann::ordered_json;

template <class T>
size_t bytesOf(const std::vector<T>& items) {
    return items.size() * sizeof(T);
}

size_t geometryBytes(const scene::Scene& scene) {
    size_t bytes = 0;
    for (const auto& mesh : scene.meshes) {
        for (const auto& p : mesh.primitives) {
            bytes += bytesOf(p.positions) + bytesOf(p.normals) + bytesOf(p.tangents) +
                     bytesOf(p.uv0) + bytesOf(p.uv1) + bytesOf(p.colors) + bytesOf(p.indices);
        }
    }
    return bytes;
}

size_t textureBytes(const scene::Scene& scene) {
    size_t bytes = 0;
    for (const auto& image : scene.images) {
        bytes += image.rgba8.size();
        for (const auto& level : image.mips) {
            bytes += level.size();
        }
    }
    return bytes;
}

Json boundsOf(const scene::Scene& scene) {
    const auto& bounds = scene.bounds_world;
    if (bounds.empty()) {
        return nullptr;
    }
    return {{"min", {bounds.min.x, bounds.min.y, bounds.min.z}},
            {"max", {bounds.max.x, bounds.max.y, bounds.max.z}}};
}

Json lightsOf(const scene::Scene& scene) {
    const auto count = [&](scene::LightType type) {
        return std::ranges::count(scene.lights, type, &scene::PunctualLight::type);
    };
    return {{"point", count(scene::LightType::kPoint)},
            {"spot", count(scene::LightType::kSpot)},
            {"directional", count(scene::LightType::kDirectional)}};
}

// In the shape of the Khronos validator's issues.
Json warningsOf(const scene::Scene& scene) {
    Json warnings = Json::array();
    for (const scene::Warning& warning : scene.warnings) {
        warnings.push_back({{"code", warning.code},
                            {"severity", static_cast<int>(warning.severity)},
                            {"pointer", warning.pointer},
                            {"message", warning.message}});
    }
    return warnings;
}

// Strings without JSON's quotes.
std::string plain(const Json& value) {
    return value.is_string() ? value.get<std::string>() : value.dump();
}

// Lists of words or of objects take a line each.
bool onOneLine(const Json& value) {
    const auto is_long = [](const Json& item) { return item.is_string() || item.is_object(); };
    return !value.is_object() &&
           !(value.is_array() && std::any_of(value.begin(), value.end(), is_long));
}

// An object of a list: its values, "CODE 1 /nodes/3 what it is".
std::string rowOf(const Json& object) {
    std::string row;
    for (const auto& [key, item] : object.items()) {
        row += (row.empty() ? "" : " ") + plain(item);
    }
    return row;
}

void append(std::string& text, const Json& value, const std::string& indent) {
    for (const auto& [key, item] : value.items()) {
        const std::string label = value.is_array() ? indent + "- " : indent + key + ": ";
        if (value.is_array() && item.is_object()) {
            text += label + rowOf(item) + "\n";
        } else if (onOneLine(item)) {
            text += label + plain(item) + "\n";
        } else {
            text += indent + key + ":\n";
            append(text, item, indent + "  ");
        }
    }
}

} // namespace

Json sceneReport(const scene::Scene& scene) {
    const auto summary = session::summarize(scene);
    Json cameras = Json::array();
    for (const auto& camera : scene.cameras) {
        cameras.push_back(camera.name);
    }
    return {{"name", summary.name},
            {"triangles", summary.triangle_count},
            {"draws", summary.draw_count},
            {"meshes", scene.meshes.size()},
            {"instances", scene.instances.size()},
            {"materials", summary.material_count},
            {"textures", summary.texture_count},
            {"geometry_bytes", geometryBytes(scene)},
            {"texture_bytes", textureBytes(scene)},
            {"cameras", cameras},
            {"material_variants", scene.material_variants},
            {"lights", lightsOf(scene)},
            {"bounds_m", boundsOf(scene)},
            {"needs", render::sceneWords(render::findNeeds(scene))},
            {"warnings", warningsOf(scene)},
            {"warnings_left_out", scene.warnings_left_out}};
}

std::string toText(const Json& report) {
    std::string text;
    append(text, report, "");
    return text;
}

} // namespace froxel::app
