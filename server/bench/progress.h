// Where `froxel bench` stands, as one line on stderr that is written over.
#pragma once

#include "core/clock.h"

#include <string>

namespace froxel::bench {

// Shares of a row's time are guesses: they only place the bar.
class Progress {
  public:
    static constexpr double kWarmupShare = 0.2;
    static constexpr double kTimingShare = 0.5;
    static constexpr double kErrorShare = 0.3; // the three make one row

    // Silent where stderr is no terminal.
    explicit Progress(double row_count);
    ~Progress(); // clears the line
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void at(const std::string& sweep, const std::string& what);
    void done(double rows);

  private:
    const bool shown_;
    const TimePoint start_ = Clock::now();
    const double row_count_;
    double done_ = 0;
};

// "[=====>      ]  42 %, 3 min left  light_count: naive, 100 lights", cut to `columns`. Pure.
[[nodiscard]] std::string
progressLine(double done_share, double elapsed_s, const std::string& what, size_t columns);

} // namespace froxel::bench
