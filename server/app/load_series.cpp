#include "app/load_series.h"

#include "app/output_file.h"
#include "core/error.h"
#include "core/text.h"
#include "report/statistics.h"

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <system_error>
#include <utility>
#include <vector>

namespace froxel::app {
namespace {

std::optional<double> percentile(const std::vector<double>& samples, double percent) {
    return samples.empty() ? std::nullopt : std::optional(report::percentileOf(samples, percent));
}

// Counts without a point.
nlohmann::ordered_json numberOf(double value) {
    const auto whole = static_cast<int64_t>(value);
    return static_cast<double>(whole) == value ? nlohmann::ordered_json(whole)
                                               : nlohmann::ordered_json(value);
}

} // namespace

SeriesRow seriesRowOf(const load::RunSecond& second) {
    load::Measured all;
    double viewers = 0;
    double joining = 0;
    double refused = 0;
    double failed = 0;
    double bytes = 0;
    std::vector<double> waits_ms;
    for (const load::ViewerChange& change : second.changes) {
        all.add(change.measured);
        viewers += change.watching ? 1 : 0;
        joining += change.joining ? 1 : 0;
        refused += change.failure && change.refused ? 1 : 0;
        failed += change.failure && !change.refused ? 1 : 0;
        bytes += static_cast<double>(change.received_bytes);
        for (const auto* samples : {&change.measured.samples, &change.waiting}) {
            waits_ms.insert(waits_ms.end(), samples->interval_ms.begin(),
                            samples->interval_ms.end());
        }
    }
    const double length = std::max(second.length.count(), 1e-9);
    return {second.elapsed.count(),
            viewers,
            joining,
            refused,
            failed,
            static_cast<double>(all.frames) / length,
            bytes * 8 / 1e6 / length,
            percentile(all.samples.latency_ms, 50),
            percentile(all.samples.latency_ms, 95),
            percentile(all.samples.latency_ms, 99),
            percentile(all.samples.reaction_ms, 95),
            percentile(waits_ms, 100),
            static_cast<double>(all.errors)};
}

std::optional<double> valueIn(const SeriesRow& row, std::string_view column) {
    const auto* const at = std::find(kSeriesColumns.begin(), kSeriesColumns.end(), column);
    return row.at(static_cast<size_t>(at - kSeriesColumns.begin()));
}

nlohmann::ordered_json jsonOf(const SeriesRow& row) {
    nlohmann::ordered_json json;
    for (size_t column = 0; column < row.size(); ++column) {
        const auto& value = row[column];
        json[std::string(kSeriesColumns[column])] =
            value ? numberOf(*value) : nlohmann::ordered_json(nullptr);
    }
    return json;
}

std::string csvOf(const SeriesRow& row) {
    std::string line;
    for (size_t column = 0; column < row.size(); ++column) {
        line += column == 0 ? "" : ",";
        line += row[column] ? fmt::format("{:.6g}", *row[column]) : "";
    }
    return line + "\n";
}

std::string prometheusOf(const SeriesRow& row) {
    std::string text;
    for (size_t column = 0; column < row.size(); ++column) {
        if (row[column]) {
            text += fmt::format("# TYPE froxel_load_{0} gauge\nfroxel_load_{0} {1:.6g}\n",
                                kSeriesColumns[column], *row[column]);
        }
    }
    return text;
}

SeriesFile::SeriesFile(std::filesystem::path path) : path_(std::move(path)) {
    if (path_.extension() == ".prom") {
        return;
    }
    stream_.open(path_);
    if (path_.extension() == ".csv") {
        write(fmt::format("{}\n", fmt::join(kSeriesColumns, ",")));
    }
}

void SeriesFile::add(const SeriesRow& row) {
    if (path_.extension() == ".prom") {
        auto whole = path_;
        whole += ".new"; // the collector reads *.prom alone
        writeText(whole, prometheusOf(row));
        std::error_code failure;
        std::filesystem::rename(whole, path_, failure);
        if (failure) {
            throw StartupError(
                {ErrorCode::kIo,
                 "cannot replace '" + printable(path_.string(), 400) + "': " + failure.message()});
        }
    } else {
        write(path_.extension() == ".csv" ? csvOf(row) : jsonOf(row).dump() + "\n");
    }
}

void SeriesFile::write(const std::string& text) {
    stream_ << text << std::flush;
    if (!stream_) {
        throw StartupError(
            {ErrorCode::kIo, "cannot write to '" + printable(path_.string(), 400) + "'"});
    }
}

} // namespace froxel::app
