#include "render/view/memory_report.h"

#include "render/frame/plan_words.h"
#include "render/steps/order.h"

#include <spdlog/fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <algorithm>

namespace froxel::render {

namespace {

bool sameUses(const std::vector<MemoryUse>& a, const std::vector<MemoryUse>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
        return x.purpose == y.purpose && x.bytes == y.bytes;
    });
}

} // namespace

std::vector<MemoryUse> memoryReport(const gpu::MemoryLedger& ledger) {
    std::vector<MemoryUse> uses;
    for (const auto& [purpose, bytes] : ledger.byPurpose()) {
        uses.push_back({purpose, bytes});
    }
    std::stable_sort(uses.begin(), uses.end(),
                     [](const auto& a, const auto& b) { return a.bytes > b.bytes; });
    return uses;
}

void FrameDetailsKeeper::logOnce(const Words& words) {
    constexpr size_t kMost = 64;
    if (logged_.size() < kMost && std::ranges::find(logged_, words) == logged_.end()) {
        logged_.push_back(words);
        spdlog::info("plan: {}", fmt::join(words, "; "));
    }
}

std::shared_ptr<const FrameDetails>
FrameDetailsKeeper::update(const settings::ViewSettings& settings,
                           const FrameFacts& facts,
                           const FramePlan& plan,
                           const SceneNeeds& needs,
                           const gpu::MemoryLedger& ledger,
                           const DebugLegend* legend) {
    Words words = frameWords(settings, facts, plan, kOrder);
    const auto shown = legend != nullptr ? std::optional(*legend) : std::nullopt;
    const uint64_t version = ledger.version();
    const bool same_plan = words_ == words && legend_ == shown;
    if (details_ && same_plan && ledger_version_ == version) {
        return details_;
    }
    FrameDetails made;
    if (details_ && same_plan) {
        made.plan = details_->plan;
    } else {
        logOnce(words);
        made.plan = words;
        const auto scene_words = sceneWords(needs);
        made.plan.insert(made.plan.end(), scene_words.begin(), scene_words.end());
    }
    made.memory = memoryReport(ledger);
    made.legend = shown;
    words_ = std::move(words);
    legend_ = shown;
    ledger_version_ = version;
    if (details_ && same_plan && sameUses(made.memory, details_->memory)) {
        return details_;
    }
    details_ = std::make_shared<const FrameDetails>(std::move(made));
    return details_;
}

} // namespace froxel::render
