// Which effects a frame has, and what they ask of its other passes: the part of its plan that is
// theirs. Pure.
#pragma once

#include "core/error.h"
#include "settings/settings.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace froxel::gpu {
class Device;
}

namespace froxel::render {

class Effect;
class SceneResources;
struct FrameFacts;

// When a frame has its turn for an effect; in this order.
enum class EffectPlace : uint8_t {
    kLights,  // before anything is lit: what lights look up
    kSolid,   // over the radiance of solid surfaces, before anything is blended with it
    kPicture, // over all of the linear picture
    kPixels,  // over packed pixels; a frame has one effect there at most
};

// An effect that a frame has.
struct EffectPlan {
    uint32_t way = 0;                  // which of the effect's own ways
    bool samples_radiance = false;     // it looks at a pixel's neighbours
    uint32_t light_flags = 0;          // what it asks of the variants that light surfaces
    uint32_t blended_output_flags = 0; // and of those of blended surfaces
    bool operator==(const EffectPlan&) const = default;
};

// What is known of an effect before anybody has it.
struct EffectRow {
    EffectPlace place;
    // None: the frame lacks it.
    std::optional<EffectPlan> (*plan)(const settings::ViewSettings& settings,
                                      const FrameFacts& facts);
    // What it does, in a line for people; empty: nothing to speak of.
    std::string (*words)(const settings::ViewSettings& settings, const EffectPlan& plan);
    // One view's. Throws vk::SystemError.
    std::unique_ptr<Effect> (*make)(SceneResources& scene);
    // Whether Effect::look() has something to see before a frame is planned. Null: never.
    bool (*looks)(const settings::ViewSettings& settings) = nullptr;
    // Whether the device can do what is asked for. Errors: kUnsupported. Null: always.
    Result<void> (*able)(const settings::ViewSettings& settings,
                         const gpu::Device& device) = nullptr;
    // What it takes memory for, in words for people; none: for nothing of these settings. Null: for
    // nothing to speak of.
    std::optional<std::string> (*memory_words)(const settings::ViewSettings& settings) = nullptr;
};

// All that there are, in the order of the frame: effects.cpp.
[[nodiscard]] std::span<const EffectRow* const> effectRows();

struct PlannedEffect {
    const EffectRow* row = nullptr;
    EffectPlan plan;
    bool operator==(const PlannedEffect&) const = default;
};

} // namespace froxel::render
