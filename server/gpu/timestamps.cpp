#include "gpu/timestamps.h"

#include "core/assert.h"

#include <algorithm>

namespace froxel::gpu {

Timestamps::Timestamps(const Device& device)
    : device_(device),
      pool_(device.handle().createQueryPool(
          {.queryType = vk::QueryType::eTimestamp, .queryCount = 2 * kMaxPasses})) {
    pool_.reset(0, 2 * kMaxPasses);
}

void Timestamps::reset() {
    if (!names_.empty()) {
        pool_.reset(0, static_cast<uint32_t>(2 * names_.size()));
    }
    names_.clear();
}

void Timestamps::begin(const vk::raii::CommandBuffer& cmd, const char* name) {
    FROXEL_ASSERT(names_.size() < kMaxPasses, "more passes than timestamp slots");
    if (device_.labels()) {
        cmd.beginDebugUtilsLabelEXT(vk::DebugUtilsLabelEXT{.pLabelName = name});
    }
    cmd.writeTimestamp2(vk::PipelineStageFlagBits2::eAllCommands, *pool_,
                        static_cast<uint32_t>(2 * names_.size()));
    names_.emplace_back(name);
}

void Timestamps::end(const vk::raii::CommandBuffer& cmd) {
    cmd.writeTimestamp2(vk::PipelineStageFlagBits2::eAllCommands, *pool_,
                        static_cast<uint32_t>(2 * names_.size() - 1));
    if (device_.labels()) {
        cmd.endDebugUtilsLabelEXT();
    }
}

void Timestamps::read(FrameStats& stats, bool cut) const {
    if (names_.empty()) {
        return;
    }
    const auto count = static_cast<uint32_t>(2 * names_.size());
    const auto [result, ticks] =
        pool_.getResults<uint64_t>(0, count, count * sizeof(uint64_t), sizeof(uint64_t),
                                   vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait);
    FROXEL_ASSERT(result == vk::Result::eSuccess, "timestamps of a completed frame are available");
    const double us_per_tick = device_.traits().timestamp_period_ns * 1e-3;
    const auto micros = [&](uint64_t from, uint64_t to) {
        return to > from ? static_cast<double>(to - from) * us_per_tick : 0.0;
    };
    double sum_us = 0;
    for (size_t i = 0; i < names_.size(); ++i) {
        const double us = micros(ticks[2 * i], ticks[2 * i + 1]);
        sum_us += us;
        const auto same = std::find_if(stats.passes.begin(), stats.passes.end(),
                                       [&](const auto& pass) { return pass.name == names_[i]; });
        if (same == stats.passes.end()) {
            stats.passes.push_back({names_[i], us});
        } else {
            same->gpu_us += us;
        }
    }
    stats.gpu_us = cut ? sum_us : micros(ticks.front(), ticks.back());
}

} // namespace froxel::gpu
