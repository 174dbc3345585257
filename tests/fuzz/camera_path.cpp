// A file of a camera path, as --path reads it.
#include "core/assert.h"
#include "fuzz/target.h"
#include "path/path_file.h"

#include <cmath>

namespace {

bool isFinite(const froxel::settings::Camera& camera) {
    double sum = camera.yfov_rad + camera.focus_m;
    for (int axis = 0; axis < 3; ++axis) {
        sum += camera.eye_world[axis] + camera.world_from_view[0][axis] +
               camera.world_from_view[1][axis] + camera.world_from_view[2][axis];
    }
    return std::isfinite(sum);
}

} // namespace

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace froxel;
    const auto keys = path::parsePath(fuzz::textOf(data, size));
    if (!keys) {
        FROXEL_ASSERT(fuzz::isOneLine(keys.error().message), "a refusal is one line");
        return 0;
    }
    const path::CameraPath path(*keys);
    for (const double share : {-0.5, 0.0, 0.1, 0.5, 0.999, 1.0, 7.3}) {
        FROXEL_ASSERT(isFinite(path.at(share * path.seconds())), "a camera is somewhere");
    }
    const auto again = path::parsePath(path::pathText(*keys));
    FROXEL_ASSERT(again && again->keys.size() == keys->keys.size(),
                  "a path that was written reads back");
    return 0;
}
