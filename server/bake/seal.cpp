#include "bake/seal.h"

#include <cerrno>
#include <fcntl.h>
#include <thread>

namespace froxel::bake {

bool seal(int descriptor, std::chrono::milliseconds patience) {
    constexpr std::chrono::milliseconds kPause(1);
    const auto end = std::chrono::steady_clock::now() + patience;
    while (fcntl(descriptor, F_ADD_SEALS,
                 F_SEAL_SEAL | F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_WRITE) != 0) {
        if (errno != EBUSY || std::chrono::steady_clock::now() >= end) {
            return false;
        }
        std::this_thread::sleep_for(kPause);
    }
    return true;
}

} // namespace froxel::bake
