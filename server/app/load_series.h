// What the viewers of `froxel load` did in each second: a row of figures, in several formats.
//
//   elapsed_s             since the run's start
//   viewers               that have a picture and have not left
//   joining               that have none yet
//   refused, failed       since the run's start
//   frames_per_s, mbit_per_s   of all viewers together
//   latency_p50_ms, latency_p95_ms, latency_p99_ms, reaction_p95_ms   of this second
//   longest_wait_ms       for a frame that was due, up to now
//   errors                Error messages in this second
//
// A time without a sample is null in JSON, empty in CSV and absent for Prometheus.
#pragma once

#include "load/load_run.h"

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>

namespace froxel::app {

inline constexpr std::array kSeriesColumns = {
    std::string_view("elapsed_s"),       std::string_view("viewers"),
    std::string_view("joining"),         std::string_view("refused"),
    std::string_view("failed"),          std::string_view("frames_per_s"),
    std::string_view("mbit_per_s"),      std::string_view("latency_p50_ms"),
    std::string_view("latency_p95_ms"),  std::string_view("latency_p99_ms"),
    std::string_view("reaction_p95_ms"), std::string_view("longest_wait_ms"),
    std::string_view("errors")};

// In the order of the columns.
using SeriesRow = std::array<std::optional<double>, kSeriesColumns.size()>;

// Pure.
[[nodiscard]] SeriesRow seriesRowOf(const load::RunSecond& second);
[[nodiscard]] std::optional<double> valueIn(const SeriesRow& row, std::string_view column);
[[nodiscard]] nlohmann::ordered_json jsonOf(const SeriesRow& row);
[[nodiscard]] std::string csvOf(const SeriesRow& row);
// For node_exporter's textfile collector: gauges named froxel_load_COLUMN.
[[nodiscard]] std::string prometheusOf(const SeriesRow& row);

// A file that has each row as soon as it is added; .prom has the newest alone, and a reader always
// finds a whole one. Throws StartupError(kIo), naming the file.
class SeriesFile {
  public:
    explicit SeriesFile(std::filesystem::path path);
    void add(const SeriesRow& row);

  private:
    void write(const std::string& text);

    const std::filesystem::path path_;
    std::ofstream stream_; // of .jsonl and .csv
};

} // namespace froxel::app
