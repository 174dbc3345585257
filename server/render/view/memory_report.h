// FrameStats::details: made anew only when what it says has changed.
#pragma once

#include "core/frame_stats.h"
#include "gpu/memory_ledger.h"
#include "render/frame/frame_plan.h"
#include "render/scene/scene_needs.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace froxel::render {

// Largest first. Of all viewers: the device's memory is theirs together.
[[nodiscard]] std::vector<MemoryUse> memoryReport(const gpu::MemoryLedger& ledger);

// One a viewer.
class FrameDetailsKeeper {
  public:
    // The frame's details (legend: null without a debug view); logs the plan's lines when they are
    // new.
    [[nodiscard]] std::shared_ptr<const FrameDetails> update(const settings::ViewSettings& settings,
                                                             const FrameFacts& facts,
                                                             const FramePlan& plan,
                                                             const SceneNeeds& needs,
                                                             const gpu::MemoryLedger& ledger,
                                                             const DebugLegend* legend);

  private:
    using Words = std::vector<std::string>;

    void logOnce(const Words& words);

    Words words_; // of the frame
    std::optional<DebugLegend> legend_;
    std::vector<Words> logged_; // a viewer may go to and fro: each is told once
    uint64_t ledger_version_ = 0;
    std::shared_ptr<const FrameDetails> details_;
};

} // namespace froxel::render
