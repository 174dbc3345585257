#include "gpu/sample_counter.h"

#include "core/assert.h"

namespace froxel::gpu {

SampleCounter::SampleCounter(const Device& device)
    : pool_(device.handle().createQueryPool(
          {.queryType = vk::QueryType::eOcclusion, .queryCount = 1})) {}

void SampleCounter::begin(const vk::raii::CommandBuffer& cmd) {
    cmd.resetQueryPool(*pool_, 0, 1);
    cmd.beginQuery(*pool_, 0, vk::QueryControlFlagBits::ePrecise);
}

void SampleCounter::end(const vk::raii::CommandBuffer& cmd) const {
    cmd.endQuery(*pool_, 0);
}

uint64_t SampleCounter::read() const {
    const auto [result, count] = pool_.getResult<uint64_t>(
        0, 1, sizeof(uint64_t), vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait);
    FROXEL_ASSERT(result == vk::Result::eSuccess, "samples of a completed frame are counted");
    return count;
}

} // namespace froxel::gpu
