// What is known of a step of the frame before anybody draws it: whether a frame has it, what it
// uses, and what it asks of other steps. Pure.
#pragma once

#include "core/error.h"
#include "core/step_stats.h"
#include "render/frame/uses.h"
#include "settings/settings.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace froxel::gpu {
class Device;
}

namespace froxel::render {

class SceneResources;
class Step;
struct FrameFacts;
struct FramePlan;

// A step that a frame has.
struct StepPlan {
    uint32_t way = 0;                  // which of the step's own ways
    uint32_t count = 0;                // how often at most, where it repeats itself
    uint32_t light_flags = 0;          // what it asks of the variants that light surfaces later
    uint32_t blended_output_flags = 0; // and of those of blended surfaces
    // It can expose and pack the radiance that it makes, and does where it is the last to touch it.
    bool can_pack = false;
    bool filters = false;                // it reads packed pixels and packs others
    bool leaves_radiance = true;         // somebody reads the radiance that it makes
    std::optional<Resource> packed = {}; // which packed pixels it reads
    std::optional<Resource> packs = {};  // and which it writes
    bool operator==(const StepPlan&) const = default;
};

struct PlanInputs {
    const settings::ViewSettings& settings;
    const FrameFacts& facts;
    const FramePlan& plan; // its earlier steps and what they ask for
};

// What of a frame a step works on.
enum class StepPart : uint8_t {
    kAny,
    kPicture, // what is lit; a frame whose picture a debug view replaces has none of it
};

struct StepRow {
    const char* name; // of its passes' label, or of the first
    StepPart part = StepPart::kAny;
    // None: the frame lacks it.
    std::optional<StepPlan> (*plan)(const PlanInputs& inputs);
    // Before its first pass and after its last: barriers between steps, and which targets there
    // are, follow from it. Null: it touches nothing that is shared.
    std::vector<Use> (*uses)(const FramePlan& frame, const StepPlan& plan) = nullptr;
    // What it does, or what its absence saves (plan: null), in a line for people; empty: nothing to
    // speak of. Null: never.
    std::string (*words)(const PlanInputs& inputs, const StepPlan* plan) = nullptr;
    // One view's. Throws vk::SystemError.
    std::unique_ptr<Step> (*make)(SceneResources& scene);
    // Whether Step::look() has something to see before a frame is planned. Null: never.
    bool (*looks)(const settings::ViewSettings& settings) = nullptr;
    // Whether the device can do what is asked for. Errors: kUnsupported. Null: always.
    Result<void> (*able)(const settings::ViewSettings& settings,
                         const gpu::Device& device) = nullptr;
    // What it takes memory for, in words for people; none: for nothing of these settings. Null: for
    // nothing to speak of.
    std::optional<std::string> (*memory_words)(const settings::ViewSettings& settings) = nullptr;
    // What it tells of a frame besides its times.
    std::span<const StatRow> stats = {};
    // Whether it looks lights up where there is no surface. Null: never.
    bool (*lights_medium)(const settings::ViewSettings& settings) = nullptr;
};

struct PlannedStep {
    const StepRow* row = nullptr;
    StepPlan plan;
    std::vector<Use> uses = {}; // StepRow::uses of it
    // What it would draw is there from the view's frame before: it is not recorded.
    bool reused = false;
    bool operator==(const PlannedStep&) const = default;

    [[nodiscard]] bool touches(Resource what) const {
        return std::ranges::find(uses, what, &Use::what) != uses.end();
    }
};

} // namespace froxel::render
