#include "bench/compare.h"

#include "bench/json.h"
#include "core/text.h"
#include "report/settings_report.h"
#include "report/statistics.h"

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <map>
#include <set>
#include <utility>

namespace froxel::bench {

namespace {

using Json = nlohmann::ordered_json;

// Relative change of an error below which two runs round differently, no more.
constexpr double kSameError = 1e-3;

struct ReportRow {
    std::string name;
    const Json* json;
};

std::string nameOf(const Json& sweep, const Json& row) {
    return fmt::format("{}: {}, {}", sweep.at("name").get<std::string>(),
                       row.at("series").get<std::string>(), row.at("label").get<std::string>());
}

// Values by their paths, "lights.count"; a list is a value.
using Leaves = std::map<std::string, Json>;

void addLeaves(const Json& value, const std::string& path, Leaves& leaves) {
    if (!value.is_object()) {
        leaves.emplace(path, value);
        return;
    }
    for (const auto& [name, part] : value.items()) {
        addLeaves(part, path.empty() ? name : path + "." + name, leaves);
    }
}

Leaves settingsOf(const Json& row) {
    Leaves leaves;
    addLeaves(row.at("settings"), "", leaves);
    return leaves;
}

// The settings that any row tells.
std::set<std::string> toldBy(const Json& report) {
    std::set<std::string> told;
    for (const auto& sweep : report.at("sweeps")) {
        for (const auto& row : sweep.at("rows")) {
            for (const auto& [path, value] : settingsOf(row)) {
                told.insert(path);
            }
        }
    }
    return told;
}

// By everything that makes a row what it is. Settings at their defaults are no part of that: a
// report may be from before they came in. Those that the other does not tell are added to
// `left_out`.
std::map<std::string, ReportRow> rowsOf(const Json& report,
                                        const std::set<std::string>& told_by_other,
                                        std::set<std::string>& left_out) {
    Leaves defaults;
    addLeaves(report::settingsReport({}), "", defaults);
    std::map<std::string, ReportRow> rows;
    for (const auto& sweep : report.at("sweeps")) {
        for (const auto& row : sweep.at("rows")) {
            auto key = nameOf(sweep, row) + row.at("scaled_to").dump();
            for (const auto& [path, value] : settingsOf(row)) {
                const auto usual = defaults.find(path);
                if (usual == defaults.end() || usual->second != value) {
                    key += path + value.dump();
                } else if (!told_by_other.contains(path)) {
                    left_out.insert(path);
                }
            }
            if (const auto& stream = row.at("stream"); !stream.is_null()) {
                key += stream.at("quality").dump() + stream.at("chroma").dump();
            }
            rows.insert_or_assign(std::move(key), ReportRow{nameOf(sweep, row), &row});
        }
    }
    return rows;
}

std::vector<double> samplesOf(const Json& row, const std::string& measure) {
    std::vector<double> samples;
    for (const auto& tenths : row.at("samples").at(measure)) {
        samples.push_back(tenths.get<double>() / 10);
    }
    if (samples.empty() || std::ranges::min(samples) < 0) {
        throw StartupError({ErrorCode::kInvalidArgument,
                            fmt::format("a row's samples of {} are none or negative", measure)});
    }
    return samples;
}

// How `field` of one reference's error changed, or nothing.
void compareError(const Json& a, const Json& b, const std::string& name, RowComparison& row) {
    if (!a.at("skipped").is_null() || !b.at("skipped").is_null()) {
        return;
    }
    const auto note = [&](const char* what, double before, double after) {
        if (std::abs(after - before) <= kSameError * std::max(before, after)) {
            return;
        }
        row.error += fmt::format("{}{} {} {:.3g} to {:.3g}", row.error.empty() ? "" : ", ", name,
                                 what, before, after);
        row.error_grew = row.error_grew || after > before;
    };
    const auto maximum = [](const Json& error) {
        return error.at("linear").at("max_abs").get<double>();
    };
    const auto flip = [](const Json& error) {
        return error.at("perceived").at("flip").get<double>();
    };
    note("maximum", maximum(a), maximum(b));
    note("FLIP", flip(a), flip(b));
}

RowComparison compareRows(const ReportRow& a, const ReportRow& b, const std::string& measure) {
    const auto samples_a = samplesOf(*a.json, measure);
    const auto samples_b = samplesOf(*b.json, measure);
    const auto times = report::compareSamples(samples_a, samples_b);
    RowComparison row{.row = a.name,
                      .median_a_us = report::summarize(samples_a).median,
                      .median_b_us = report::summarize(samples_b).median,
                      .words = times.words,
                      .slower = times.differs && times.ratio > 1,
                      .faster = times.differs && times.ratio < 1,
                      .error = {}};
    compareError(a.json->at("error_r1"), b.json->at("error_r1"), "R1", row);
    compareError(a.json->at("error_r2"), b.json->at("error_r2"), "R2", row);
    return row;
}

std::vector<std::string> warningsOf(const Json& a, const Json& b) {
    std::vector<std::string> warnings;
    for (const char* field : {"device", "host", "build", "scene", "views"}) {
        if (a.at(field) != b.at(field)) {
            warnings.push_back(fmt::format("'{}' differs: {} and {}", field, a.at(field).dump(),
                                           b.at(field).dump()));
        }
    }
    return warnings;
}

Comparison compareValid(const Json& a, const Json& b) {
    Comparison comparison;
    const bool is_cpu = a.at("device").at("kind") == "cpu" || b.at("device").at("kind") == "cpu";
    comparison.measure = is_cpu ? "cpu_us" : "gpu_us";
    comparison.warnings = warningsOf(a, b);
    std::set<std::string> left_out;
    const auto rows_a = rowsOf(a, toldBy(b), left_out);
    const auto rows_b = rowsOf(b, toldBy(a), left_out);
    if (!left_out.empty()) {
        comparison.warnings.push_back(
            fmt::format("only in one result, with its default: {}", fmt::join(left_out, ", ")));
    }
    for (const auto& [key, row] : rows_a) {
        const auto other = rows_b.find(key);
        if (other == rows_b.end()) {
            comparison.only_a.push_back(row.name);
        } else {
            comparison.rows.push_back(compareRows(row, other->second, comparison.measure));
        }
    }
    for (const auto& [key, row] : rows_b) {
        if (!rows_a.contains(key)) {
            comparison.only_b.push_back(row.name);
        }
    }
    return comparison;
}

} // namespace

bool Comparison::worse() const {
    return std::ranges::any_of(
        rows, [](const RowComparison& row) { return row.slower || row.error_grew; });
}

Result<Comparison> compareReports(const Json& a, const Json& b) {
    for (const auto* report : {&a, &b}) {
        if (!report->is_object() || report->value("schema", Json()) != kSchema) {
            return Error{ErrorCode::kInvalidArgument,
                         fmt::format("the {} file is not a {} result",
                                     report == &a ? "first" : "second", kSchema)};
        }
    }
    try {
        return compareValid(a, b);
    } catch (const std::exception& error) {
        return Error{ErrorCode::kInvalidArgument, fmt::format("not a whole {} result: {}", kSchema,
                                                              printable(error.what(), 200))};
    }
}

std::string toText(const Comparison& comparison) {
    std::string text;
    for (const auto& warning : comparison.warnings) {
        text += "warning: " + warning + "\n";
    }
    size_t width = 3;
    for (const auto& row : comparison.rows) {
        width = std::max(width, row.row.size());
    }
    text += fmt::format("{:<{}}  {:>12}  {:>12}  b against a, {}\n", "row", width, "median a, us",
                        "median b, us", comparison.measure);
    size_t slower = 0;
    size_t faster = 0;
    size_t changed = 0;
    for (const auto& row : comparison.rows) {
        slower += row.slower ? 1U : 0U;
        faster += row.faster ? 1U : 0U;
        changed += row.error.empty() ? 0U : 1U;
        text += fmt::format("{:<{}}  {:>12.1f}  {:>12.1f}  {}{}\n", row.row, width, row.median_a_us,
                            row.median_b_us, row.words,
                            row.error.empty() ? "" : "; error: " + row.error);
    }
    for (const auto& row : comparison.only_a) {
        text += "only in a: " + row + "\n";
    }
    for (const auto& row : comparison.only_b) {
        text += "only in b: " + row + "\n";
    }
    return text +
           fmt::format("{} rows: {} slower, {} faster, {} with another error (Mann-Whitney U, "
                       "p < {}, medians {:.0f} % apart)\n",
                       comparison.rows.size(), slower, faster, changed, report::kSignificance,
                       100 * report::kLeastEffect);
}

} // namespace froxel::bench
