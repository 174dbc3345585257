#include "gpu/timestamps.h"

#include "core/assert.h"

#include <algorithm>
#include <optional>

namespace froxel::gpu {

namespace {

using Time = std::optional<double>;

Time sum(Time a, Time b) {
    return a && b ? Time(*a + *b) : std::nullopt;
}

} // namespace

void addTimes(const std::vector<std::string>& names,
              std::span<const uint64_t> ticks,
              double us_per_tick,
              bool cut,
              FrameStats& stats) {
    const auto micros = [&](uint64_t from, uint64_t to) {
        return from > 0 && to >= from ? Time(static_cast<double>(to - from) * us_per_tick)
                                      : std::nullopt;
    };
    Time sum_us = 0;
    for (size_t i = 0; i < names.size(); ++i) {
        const Time us = micros(ticks[2 * i], ticks[2 * i + 1]);
        sum_us = sum(sum_us, us);
        const auto same = std::find_if(stats.passes.begin(), stats.passes.end(),
                                       [&](const auto& pass) { return pass.name == names[i]; });
        if (same == stats.passes.end()) {
            stats.passes.push_back({names[i], us});
        } else {
            same->gpu_us = sum(same->gpu_us, us);
        }
    }
    stats.gpu_us = cut ? sum_us : micros(ticks.front(), ticks.back());
}

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
    // llvmpipe queues it for its rasteriser but runs compute at once; a barrier clears the queue.
    if (device_.traits().is_cpu) {
        cmd.pipelineBarrier2({});
    }
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
    addTimes(names_, ticks, device_.traits().timestamp_period_ns * 1e-3, cut, stats);
}

} // namespace froxel::gpu
