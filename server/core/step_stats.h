// What the steps of a frame tell of themselves. Reports and the protocol walk it: they know no
// step.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace froxel {

// A figure of one step.
struct StatRow {
    std::string_view group; // an object of the report, a message of FrameHeader; empty: of neither
    std::string_view name;  // in the report
    std::string_view field; // in the message; empty: not there
    bool whole = true;      // a count, up to 2^53
};

struct Stat {
    const StatRow* row;
    double value;
};

// Of one frame. Rows outlive it.
class StepStats {
  public:
    void set(const StatRow& row, double value) {
        for (Stat& stat : all_) {
            if (stat.row == &row) {
                stat.value = value;
                return;
            }
        }
        all_.push_back({&row, value});
    }
    // None: no step of the frame told.
    [[nodiscard]] std::optional<double> find(std::string_view group, std::string_view name) const {
        for (const Stat& stat : all_) {
            if (stat.row->group == group && stat.row->name == name) {
                return stat.value;
            }
        }
        return {};
    }
    // The same, as a count; 0: none told.
    [[nodiscard]] uint64_t count(std::string_view group, std::string_view name) const {
        return static_cast<uint64_t>(find(group, name).value_or(0));
    }
    [[nodiscard]] const std::vector<Stat>& all() const { return all_; }

  private:
    std::vector<Stat> all_;
};

} // namespace froxel
