// What recording one frame needs, as passes see it, and how they divide their work into pieces.
#pragma once

#include "render/frame/draw_list.h"
#include "render/frame/frame_costs.h"
#include "render/frame/frame_pieces.h"
#include "render/frame/frame_plan.h"
#include "render/frame/frame_slot.h"
#include "render/scene/scene_resources.h"

#include <algorithm>
#include <span>
#include <vector>

namespace froxel::render {

struct FrameContext {
    SceneResources& scene;
    FrameSlot& slot;
    const FramePlan& plan;
    const DrawList& draws;
    VisibilityScene* visibility = nullptr; // where ids are drawn
    std::span<const ActiveStep> steps = {};
    FramePieces& pieces; // the slot's
    const FrameCosts& costs;
    bool spoil_scratch = false; // FrameInputs::spoil_scratch, of a frame that reuses surfaces

    // What it is drawn at, and what is shown of it.
    [[nodiscard]] const settings::Size& drawn() const { return slot.targets->size.drawn; }
    [[nodiscard]] const settings::Size& shown() const { return slot.targets->size.shown; }
};

// Calls record(frame, part) for parts of a picture of `size`, where pieces may end.
template <class Record>
void inParts(const FrameContext& frame,
             const settings::Size& size,
             const RegionCost& cost,
             const Record& record) {
    VariantMaker& variants = frame.scene.shared.variants;
    frame.pieces.over({size.width_px, size.height_px}, cost, [&](const vk::Rect2D& part) {
        const size_t used = variants.firstUses();
        record(frame, part);
        if (frame.scene.shared.device.traits().is_cpu && variants.firstUses() > used) {
            frame.pieces.close(); // the device compiles them first
        }
    });
}

// Shares of one pass that get a piece each at most, while they are compiled.
inline constexpr size_t kMostAlone = 64;

// Calls record(share, first) for what a pass draws, in turn: all at once, but on a software device
// a piece for each thing whose variant is_new(). It compiles them as it draws, for a material's
// textures anew, which takes it long. `first` also where there is nothing.
template <class Things, class IsNew, class Record>
void inShares(const FrameContext& frame, const Things& things, IsNew is_new, Record record) {
    const std::span all(things);
    const size_t compiled = frame.scene.shared.device.traits().is_cpu ? kMostAlone : 0;
    std::vector<bool> alone(all.size(), false);
    for (size_t i = 0; i < std::min(all.size(), compiled); ++i) {
        alone[i] = is_new(all[i]);
    }
    size_t begin = 0;
    do {
        size_t end = begin + 1;
        while (end < all.size() && !alone[begin] && !alone[end]) {
            ++end;
        }
        if (begin > 0) {
            frame.pieces.close();
            frame.pieces.add(Seconds(0));
        }
        record(all.subspan(begin, std::min(end, all.size()) - begin), begin == 0);
        begin = end;
    } while (begin < all.size());
}

} // namespace froxel::render
