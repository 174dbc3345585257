// What a frame does, what it leaves out and why, in short lines for people.
#pragma once

#include "render/frame/frame_plan.h"
#include "render/scene/scene_needs.h"

#include <span>
#include <string>
#include <vector>

namespace froxel::render {

// Of the scene alone, whatever is asked for.
[[nodiscard]] std::vector<std::string> sceneWords(const SceneNeeds& needs);

// Of a frame: a pure function of what planFrame() took and gave.
[[nodiscard]] std::vector<std::string> frameWords(const settings::ViewSettings& settings,
                                                  const FrameFacts& facts,
                                                  const FramePlan& plan,
                                                  std::span<const StepRow* const> rows);

} // namespace froxel::render
