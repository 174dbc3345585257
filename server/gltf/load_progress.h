// How far a file is on its way to a scene; the way by which a load ends early.
#pragma once

#include "core/clock.h"
#include "core/progress.h"

#include <exception>

namespace froxel::gltf {

// No Failure: nothing is wrong with the file, and no part of it is left out for this.
class CalledOff final : public std::exception {};

// Of the thread that loads; not thread-safe. All throw CalledOff.
class LoadProgress {
  public:
    explicit LoadProgress(const ProgressReport& report) : report_(report) {}

    // Such a part of the nodes, 0 to 1.
    void reading(double part);
    // Such a part of the images.
    void decoding(double part);
    // No further, but asks whether it goes on: in whatever takes longer than a moment.
    void ask();

  private:
    // Whoever listens is told of a new stage at once, and of the rest every kPause.
    void tell(const char* stage, double fraction);

    const ProgressReport& report_; // outlives this
    Progress now_;
    TimePoint told_at_{};
};

} // namespace froxel::gltf
