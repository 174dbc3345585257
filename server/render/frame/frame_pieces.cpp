#include "render/frame/frame_pieces.h"

#include "interface/constants.h"
#include "render/pipelines/barrier.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace froxel::render {
namespace {

// A software rasteriser's tile, where a side is long enough for it; else a workgroup's.
constexpr uint32_t kCoarse = 64;

// Where a side is halved; none: it cannot be.
std::optional<uint32_t> middleOf(uint32_t side_px) {
    const uint32_t unit = side_px >= 2 * kCoarse ? kCoarse : io::kScreenGroup;
    const uint32_t units = (side_px + unit - 1) / unit;
    return units > 1 ? std::optional(units / 2 * unit) : std::nullopt;
}

// Rows first: a wide part is what the rasteriser likes best.
std::optional<std::array<vk::Rect2D, 2>> halves(const vk::Rect2D& part) {
    auto first = part;
    auto second = part;
    if (const auto y = middleOf(part.extent.height)) {
        first.extent.height = *y;
        second.offset.y += static_cast<int32_t>(*y);
        second.extent.height -= *y;
    } else if (const auto x = middleOf(part.extent.width)) {
        first.extent.width = *x;
        second.offset.x += static_cast<int32_t>(*x);
        second.extent.width -= *x;
    } else {
        return {};
    }
    return std::array{first, second};
}

void beginBuffer(const vk::raii::CommandBuffer& cmd) {
    cmd.reset();
    cmd.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    // the piece before and other views' frames, which share buffers and targets -> this one
    barrier(cmd, vk::PipelineStageFlagBits2::eAllCommands, vk::AccessFlagBits2::eMemoryWrite,
            vk::PipelineStageFlagBits2::eAllCommands,
            vk::AccessFlagBits2::eMemoryRead | vk::AccessFlagBits2::eMemoryWrite);
}

} // namespace

FramePieces::FramePieces(const gpu::Timeline& timeline, vk::raii::CommandBuffer& current)
    : timeline_(timeline), current_(current) {}

void FramePieces::begin(Seconds limit, double share) {
    used_ = 0;
    limit_ = limit;
    fine_ = share * limit;
    piece_ = estimate_ = Seconds(0);
    closed_ = false;
    beginBuffer(current_);
}

void FramePieces::cut() {
    current_.end();
    if (used_ == ended_.size()) {
        ended_.push_back(timeline_.makeCommandBuffer());
    }
    std::swap(current_, ended_[used_]);
    ++used_;
    piece_ = Seconds(0);
    closed_ = false;
    beginBuffer(current_);
}

void FramePieces::add(Seconds cost) {
    if (closed_ || (piece_ > Seconds(0) && piece_ + cost > fine_)) {
        cut();
    }
    piece_ += cost;
    estimate_ += cost;
}

void FramePieces::over(const vk::Extent2D& size,
                       const RegionCost& cost,
                       const std::function<void(const vk::Rect2D&)>& record) {
    overPart({{0, 0}, size}, cost, record);
}

// A part's fixed cost is not made less by halving it: half of the limit is always left for the
// rest, and what takes its least time is left whole.
void FramePieces::overPart(const vk::Rect2D& part,
                           const RegionCost& cost,
                           const std::function<void(const vk::Rect2D&)>& record) {
    const Seconds own = cost.of(part);
    const Seconds limit = cost.each > Seconds(0) ? limit_ : fine_;
    const Seconds room = std::max(limit - std::min(cost.each, limit / 2), cost.least);
    const auto parts = own > room ? halves(part) : std::nullopt;
    if (parts) {
        overPart((*parts)[0], cost, record);
        overPart((*parts)[1], cost, record);
        return;
    }
    add(cost.each + std::max(own, cost.least));
    record(part);
}

size_t FramePieces::fits(Seconds cost) const {
    return std::max<size_t>(1, static_cast<size_t>(fine_ / std::max(cost, Seconds(1e-9))));
}

void FramePieces::end() {
    current_.end();
}

const vk::raii::CommandBuffer& FramePieces::piece(uint32_t index) const {
    return index < used_ ? ended_[index] : current_;
}

} // namespace froxel::render
