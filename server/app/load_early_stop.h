// Whether a load test has been against its requirements for so long that it may end. Not for
// several threads.
#pragma once

#include "load/load_run.h"
#include "load/requirement.h"

#include <optional>
#include <vector>

namespace froxel::app {

class LoadEarlyStop {
  public:
    // After a requirement has been broken for `patience` in a row, by all that was measured so far.
    LoadEarlyStop(std::vector<load::Requirement> requirements, Seconds patience);
    // Each second of the run, in order. Whether the run should go on.
    [[nodiscard]] bool goesOn(const load::RunSecond& second);

  private:
    const std::vector<load::Requirement> requirements_;
    const Seconds patience_;
    load::RunResult so_far_;
    std::vector<Seconds> broken_for_; // each requirement
};

} // namespace froxel::app
