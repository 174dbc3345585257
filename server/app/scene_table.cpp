#include "app/scene_table.h"

#include "app/scene_source.h"
#include "catalogue/catalogue.h"
#include "render/view/renderer.h"
#include "session/session_context.h"

#include <boost/algorithm/string/classification.hpp>
#include <boost/algorithm/string/replace.hpp>
#include <boost/algorithm/string/trim.hpp>
#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

namespace froxel::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::string_view, 10> kColumns = {
    "path",     "bytes",        "triangles",  "draws",    "materials",
    "textures", "device_bytes", "animations", "variants", "warnings"};

Json rowOf(const catalogue::Offered& file, bake::Sandbox sandbox) {
    Json row{{"path", file.path}, {"bytes", file.bytes}};
    const auto scene = loadScene(file.source, {}, workOn, readingBy(sandbox));
    if (!scene) {
        row["problem"] = scene.error().message;
        return row;
    }
    const auto summary = session::summarize(*scene);
    row["triangles"] = summary.triangle_count;
    row["draws"] = summary.draw_count;
    row["materials"] = summary.material_count;
    row["textures"] = summary.texture_count;
    row["device_bytes"] = render::sceneBytes(*scene, {});
    row["animations"] = scene->motion ? scene->motion->clips.size() : 0;
    row["variants"] = summary.material_variants.size();
    row["warnings"] = summary.warnings.size() + summary.warnings_left_out;
    return row;
}

std::string cell(const Json& row, std::string_view column) {
    const auto found = row.find(column);
    if (found == row.end()) {
        return {};
    }
    // As JSON has it, without the quotes: control characters are escaped, others stand.
    std::string text = found->dump(-1, ' ', false, Json::error_handler_t::replace);
    boost::algorithm::trim_if(text, boost::algorithm::is_any_of("\""));
    // Those of ISO 6429 beyond ASCII are none to JSON. Some terminals follow them.
    for (unsigned char second = 0x80; second < 0xA0; ++second) {
        const std::array<char, 2> control = {'\xC2', static_cast<char>(second)};
        boost::algorithm::replace_all(text, std::string_view(control.data(), control.size()),
                                      fmt::format("\\u{:04x}", second));
    }
    return text;
}

// fmt fills up by characters.
size_t widthOf(const std::string& text) {
    return text.size() - static_cast<size_t>(std::ranges::count_if(text, [](char c) {
               return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
           }));
}

} // namespace

Json scenesReport(const std::filesystem::path& folder, bake::Sandbox sandbox) {
    Json rows = Json::array();
    const auto listing = catalogue::Catalogue({}, folder).listing();
    for (const auto& file : listing->scenes()) {
        rows.push_back(rowOf(file, sandbox));
    }
    return rows;
}

std::string sceneTable(const Json& rows) {
    std::array<size_t, kColumns.size()> widths{};
    for (size_t i = 0; i < kColumns.size(); ++i) {
        widths[i] = kColumns[i].size();
        for (const Json& row : rows) {
            widths[i] = std::max(widths[i], widthOf(cell(row, kColumns[i])));
        }
    }
    // The path to the left, numbers to the right.
    const auto put = [&](std::string& text, size_t i, std::string_view value) {
        text += i == 0 ? fmt::format("{:<{}}", value, widths[i])
                       : fmt::format("  {:>{}}", value, widths[i]);
    };
    std::string text;
    for (size_t i = 0; i < kColumns.size(); ++i) {
        put(text, i, kColumns[i]);
    }
    text += "\n";
    for (const Json& row : rows) {
        const bool readable = !row.contains("problem");
        for (size_t i = 0; i < (readable ? kColumns.size() : 2); ++i) {
            put(text, i, cell(row, kColumns[i]));
        }
        text += readable ? "\n" : "  " + cell(row, "problem") + "\n";
    }
    return text;
}

} // namespace froxel::app
