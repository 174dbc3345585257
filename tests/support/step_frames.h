// Frames that between them have every step of render/steps/order.h, for tests that walk all of
// them.
#pragma once

#include "render/frame/frame_inputs.h"

#include <functional>
#include <span>

namespace froxel::test {

struct StepFrame {
    const char* name;
    std::function<void(render::FrameInputs&)> change; // of one with lights that looks at makeRoom()
};

[[nodiscard]] std::span<const StepFrame> stepFrames();

} // namespace froxel::test
