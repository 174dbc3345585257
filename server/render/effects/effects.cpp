#include "render/effects/effects.h"

#include "render/effects/background.h"
#include "render/effects/bloom.h"
#include "render/effects/environment.h"
#include "render/effects/exposure.h"
#include "render/effects/fog.h"
#include "render/effects/fxaa.h"
#include "render/effects/shadows.h"

#include <algorithm>
#include <array>

namespace froxel::render {

std::span<const EffectRow* const> effectRows() {
    static constexpr std::array kRows = {&kShadowsEffect, &kEnvironmentEffect, &kBackgroundEffect,
                                         &kFogEffect,     &kExposureEffect,    &kBloomEffect,
                                         &kFxaaEffect};
    return kRows;
}

Effect& ViewEffects::findOrMake(const EffectRow& row) {
    auto& effect = made_[&row];
    if (!effect) {
        effect = row.make(scene_);
    }
    return *effect;
}

void ViewEffects::look(const EffectInputs& inputs, FrameFacts& facts) {
    for (const EffectRow* row : effectRows()) {
        if (row->looks != nullptr && row->looks(inputs.settings)) {
            findOrMake(*row).look(inputs, facts);
        }
    }
}

Result<void> ViewEffects::build(const FramePlan& plan, const EffectInputs& inputs) {
    of_frame_.clear();
    for (const auto& [row, effect_plan] : plan.effects) {
        Effect& effect = findOrMake(*row);
        if (auto built = effect.build(inputs, effect_plan); !built) {
            return built;
        }
        of_frame_.push_back({row->place, &effect});
    }
    return {};
}

void ViewEffects::freeUnfit(const ViewTargets* view) {
    for (const auto& [row, effect] : made_) {
        const bool in_frame =
            std::ranges::any_of(of_frame_, [&effect = effect](const ActiveEffect& active) {
                return active.effect == effect.get();
            });
        in_frame ? effect->freeUnfit(view) : effect->freeTargets();
    }
}

void ViewEffects::freeTargets() {
    for (const auto& [row, effect] : made_) {
        effect->freeTargets();
    }
}

} // namespace froxel::render
