#include "encode/encode_pool.h"

#include <utility>

namespace froxel::encode {
namespace {

// Nine times less of a core than a thread of the usual priority (sched(7): 1.25 a step).
constexpr int kPatient = 10;

} // namespace

EncodePool::EncodePool(size_t thread_count, size_t queue_limit)
    : quick_(thread_count, queue_limit, 0), patient_(thread_count, queue_limit, kPatient) {}

bool EncodePool::submit(EncodeJob&& job) {
    const PixelView& pixels = job.pixels.view();
    const uint64_t area_px = uint64_t{pixels.width_px} * pixels.height_px;
    const bool waits = job.lossless() || job.prepare || area_px > kLargeArea_px;
    return (waits ? patient_ : quick_).submit(std::move(job));
}

} // namespace froxel::encode
