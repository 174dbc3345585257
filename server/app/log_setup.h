// The log of the program: lines on stderr, escaped, cut to a bound, and limited for each kind of
// event. A thread that logs never waits for whoever reads them (app/log_queue.h).
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace froxel::app {

// In spdlog's order, so that an index is a level.
inline constexpr std::array kLogLevelNames = {std::string_view("debug"), std::string_view("info"),
                                              std::string_view("warn"), std::string_view("error")};
enum class LogLevel : uint8_t { kDebug, kInfo, kWarn, kError };

inline constexpr std::array kLogFormatNames = {std::string_view("text"), std::string_view("json")};
enum class LogFormat : uint8_t { kText, kJson };

// Lines of one kind of event within kLogPeriod_s; more are counted, and the count is a line of its
// own when the period is over.
inline constexpr uint32_t kLogBurst = 20;
inline constexpr double kLogPeriod_s = 10;

// Makes it the default logger; once, before any thread logs.
void startLog(LogLevel level, LogFormat format);

// Lines that whoever reads the log did not take, since the start. Any thread.
[[nodiscard]] uint64_t logLinesLost();

} // namespace froxel::app
