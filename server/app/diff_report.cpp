#include "app/diff_report.h"

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>
#include <spdlog/fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace froxel::app {
namespace {

using Json = nlohmann::ordered_json;

Json numberOf(const std::optional<double>& number) {
    return number && std::isfinite(*number) ? Json(*number) : Json(nullptr);
}

Json firstOf(const diff::Difference& difference) {
    const auto& first = difference.beyond.first;
    if (!first) {
        return nullptr;
    }
    return {{"x", first->x},
            {"y", first->y},
            {"picture", first->picture},
            {"reference", first->reference}};
}

Json jsonOf(const diff::Difference& difference) {
    const auto& values = difference.values;
    return {{"width_px", difference.size.width_px},
            {"height_px", difference.size.height_px},
            {"unit", difference.radiance ? "radiance" : "srgb"},
            {"equal", difference.equal()},
            {"flip", numberOf(difference.flip)},
            {"rmse", numberOf(values.rmse)},
            {"relative_rmse", numberOf(values.relative_rmse)},
            {"psnr_db", numberOf(values.psnr_db)},
            {"max", numberOf(values.max_abs)},
            {"p999", numberOf(values.p999_abs)},
            {"mssim", numberOf(difference.mssim)},
            {"pixels", values.pixel_count},
            {"differing", difference.beyond.count},
            {"nonfinite", values.nonfinite_count},
            {"first", firstOf(difference)}};
}

} // namespace

std::string diffTable(const std::vector<DiffPair>& pairs) {
    std::string text;
    size_t failed = 0;
    size_t equal = 0;
    for (const DiffPair& pair : pairs) {
        failed += pair.failed() ? 1U : 0U;
        equal += pair.difference && pair.difference->equal() ? 1U : 0U;
        std::vector<std::string> words;
        if (pair.difference) {
            words.push_back(diff::wordsOf(*pair.difference));
        }
        words.insert(words.end(), pair.faults.begin(), pair.faults.end());
        text += fmt::format("{} {}: {}\n", pair.failed() ? "FAIL" : "ok  ", pair.name,
                            fmt::join(words, "; "));
    }
    if (pairs.size() > 1) {
        text +=
            fmt::format("{} pairs of pictures: {} equal, {} failed\n", pairs.size(), equal, failed);
    }
    return text;
}

Json diffReport(const DiffOptions& options, const std::vector<DiffPair>& pairs) {
    Json rows = Json::array();
    for (const DiffPair& pair : pairs) {
        rows.push_back({{"name", pair.name},
                        {"failed", pair.failed()},
                        {"faults", pair.faults},
                        {"difference", pair.difference ? jsonOf(*pair.difference) : nullptr}});
    }
    const diff::Limits& limits = options.limits;
    return {{"schema", "froxel.diff.v1"},
            {"version", FROXEL_VERSION},
            {"picture", options.picture.string()},
            {"reference", options.reference.string()},
            {"limits",
             {{"tolerance", limits.tolerance},
              {"max_flip", numberOf(limits.max_flip)},
              {"max_rmse", numberOf(limits.max_rmse)},
              {"max_differing", numberOf(limits.max_differing)}}},
            {"failed", std::ranges::count_if(pairs, &DiffPair::failed)},
            {"pairs", rows}};
}

std::vector<JunitCase> casesOf(const std::vector<DiffPair>& pairs) {
    std::vector<JunitCase> cases;
    for (const DiffPair& pair : pairs) {
        cases.push_back({pair.name, fmt::format("{}", fmt::join(pair.faults, "; "))});
    }
    return cases;
}

std::vector<size_t> worstOf(const std::vector<DiffPair>& pairs, size_t count) {
    std::vector<size_t> worst;
    for (size_t i = 0; i < pairs.size(); ++i) {
        if (pairs[i].difference && !pairs[i].difference->equal()) {
            worst.push_back(i);
        }
    }
    const auto rank = [&pairs](size_t i) {
        const double flip = pairs[i].difference->flip;
        return std::tuple(!pairs[i].failed(), std::isnan(flip) ? -2 : -flip, i);
    };
    std::ranges::sort(worst, {}, rank);
    worst.resize(std::min(worst.size(), count));
    return worst;
}

} // namespace froxel::app
