#include "bench/html.h"

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

namespace froxel::bench {

std::string jsonForScript(const nlohmann::ordered_json& report) {
    std::string text;
    for (const char c : report.dump()) {
        if (c == '<') { // only ever inside a string
            text += "\\u003c";
        } else {
            text += c;
        }
    }
    return text;
}

Result<std::string> fillReport(std::string_view page, const nlohmann::ordered_json& report) {
    const size_t at = page.find(kResultsPlace);
    if (at == std::string_view::npos ||
        page.find(kResultsPlace, at + 1) != std::string_view::npos) {
        return Error{
            ErrorCode::kIo,
            fmt::format("the report's template does not contain exactly one '{}'", kResultsPlace)};
    }
    constexpr std::string_view kNull = "null";
    const size_t null_at = at + kResultsPlace.find(kNull);
    return std::string(page.substr(0, null_at)) + jsonForScript(report) +
           std::string(page.substr(null_at + kNull.size()));
}

} // namespace froxel::bench
