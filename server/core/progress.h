// How something that takes long tells how far it is, and hears that it is to end early.
#pragma once

#include <functional>
#include <string>

namespace froxel {

struct Progress {
    std::string stage;   // what is being done, for a person
    double fraction = 0; // 0..1
};

// Called now and then by the thread that works. False: nobody wants the outcome any more.
using ProgressReport = std::function<bool(const Progress&)>;

// Of those whom nobody asks.
[[nodiscard]] inline bool workOn(const Progress& /*progress*/) {
    return true;
}

} // namespace froxel
