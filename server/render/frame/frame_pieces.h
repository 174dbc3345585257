// A frame's commands, cut into pieces between which the device may draw for others.
#pragma once

#include "core/clock.h"
#include "gpu/command_context.h"
#include "gpu/vulkan.h"

#include <functional>
#include <vector>

namespace froxel::render {

// What recording over a part of the picture takes: the same for each part (vertices, culling), and
// what depends on it.
struct RegionCost {
    Seconds each{0};
    std::function<Seconds(const vk::Rect2D&)> of;
    Seconds least{0}; // that a region takes besides `each`, however small it is
};

// Keep one a frame slot: its command buffers are used again. Recorded in turn, submitted in turn.
class FramePieces {
  public:
    // `current` is where everybody records: ending a piece puts another buffer in its place.
    FramePieces(const gpu::Timeline& timeline, vk::raii::CommandBuffer& current);

    // Starts over, in an empty buffer that has begun. What can be cut without doing anything twice
    // gets `share`, of 1, of the limit.
    void begin(Seconds limit, double share);
    // What was recorded last may take much longer than was said: nothing else goes into its piece.
    void close() { closed_ = true; }
    // What is recorded next takes about this long and is not cut: a piece ends here where both
    // would take longer than that share. Outside of rendering; buffers that views share must hold
    // nothing that is still needed.
    void add(Seconds cost);
    // Calls record(part) for parts of a picture, each within the limit where its cost lets it be,
    // with corners that are those of workgroups. Each is add()ed.
    void over(const vk::Extent2D& size,
              const RegionCost& cost,
              const std::function<void(const vk::Rect2D&)>& record);
    // How many things that take this long go into a piece, at least one.
    [[nodiscard]] size_t fits(Seconds cost) const;
    void end();

    // After end(): pieces, in order, and what they take together.
    [[nodiscard]] uint32_t count() const { return used_ + 1; }
    [[nodiscard]] const vk::raii::CommandBuffer& piece(uint32_t index) const;
    [[nodiscard]] Seconds estimate() const { return estimate_; }

  private:
    void cut();
    void overPart(const vk::Rect2D& part,
                  const RegionCost& cost,
                  const std::function<void(const vk::Rect2D&)>& record);

    const gpu::Timeline& timeline_;
    vk::raii::CommandBuffer& current_;
    std::vector<vk::raii::CommandBuffer> ended_;
    uint32_t used_ = 0; // of `ended_`, in this frame
    Seconds limit_{0};
    Seconds fine_{0};  // the share of it
    Seconds piece_{0}; // of the present one
    bool closed_ = false;
    Seconds estimate_{0};
};

} // namespace froxel::render
