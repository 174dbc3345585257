#include "session/compared_report.h"

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

namespace froxel::session {
namespace {

using Json = nlohmann::ordered_json;

std::string colour(uint32_t rgb) {
    return fmt::format("#{:06x}", rgb);
}

} // namespace

Json comparedReport(const ComparedRecord& compared, uint64_t pixel_count) {
    Json first = nullptr;
    if (compared.first) {
        first = {{"x", compared.first->x},
                 {"y", compared.first->y},
                 {"left", colour(compared.first->left_rgb)},
                 {"right", colour(compared.first->right_rgb)}};
    }
    Json report = {{"pixels", pixel_count},
                   {"differing", compared.differing_count},
                   {"max", compared.max_abs},
                   {"rmse", compared.rmse},
                   {"flip", compared.flip ? Json(*compared.flip) : Json(nullptr)},
                   {"first", first},
                   {"promised", compared.promised}};
    if (compared.left_us > 0) {
        report["left_us"] = compared.left_us;
        report["right_us"] = compared.right_us;
    }
    return report;
}

std::string wordsOf(const ComparedRecord& compared, uint64_t pixel_count) {
    if (compared.differing_count == 0) {
        return fmt::format("equal, {} pixels compared", pixel_count);
    }
    std::string words =
        fmt::format("{}{} of {} pixels differ, by at most {:.0f}/255, RMSE {:.3g}",
                    compared.promised ? "should be equal: " : "", compared.differing_count,
                    pixel_count, 255 * compared.max_abs, compared.rmse);
    if (compared.flip) {
        words += fmt::format(", FLIP {:.3g}", *compared.flip);
    }
    if (const auto& first = compared.first) {
        words += fmt::format("; the first is ({}, {}): {} and {}", first->x, first->y,
                             colour(first->left_rgb), colour(first->right_rgb));
    }
    return words;
}

} // namespace froxel::session
