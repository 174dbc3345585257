#include "gpu/sample_counter.h"

#include "core/assert.h"

#include <numeric>

namespace froxel::gpu {

SampleCounter::SampleCounter(const Device& device)
    : pool_(device.handle().createQueryPool(
          {.queryType = vk::QueryType::eOcclusion, .queryCount = kMaxParts})) {
    pool_.reset(0, kMaxParts);
}

void SampleCounter::restart() {
    if (part_count_ > 0) {
        pool_.reset(0, part_count_);
    }
    part_count_ = 0;
}

void SampleCounter::begin(const vk::raii::CommandBuffer& cmd) {
    FROXEL_ASSERT(part_count_ < kMaxParts, "more parts than queries");
    cmd.beginQuery(*pool_, part_count_++, vk::QueryControlFlagBits::ePrecise);
}

void SampleCounter::end(const vk::raii::CommandBuffer& cmd) const {
    cmd.endQuery(*pool_, part_count_ - 1);
}

uint64_t SampleCounter::read() const {
    if (part_count_ == 0) {
        return 0;
    }
    const auto [result, counts] =
        pool_.getResults<uint64_t>(0, part_count_, part_count_ * sizeof(uint64_t), sizeof(uint64_t),
                                   vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait);
    FROXEL_ASSERT(result == vk::Result::eSuccess, "samples of a completed frame are counted");
    return std::accumulate(counts.begin(), counts.end(), uint64_t{0});
}

} // namespace froxel::gpu
