// What can't be drawn, before anything is tried.
#pragma once

#include "core/error.h"
#include "render/frame/frame_inputs.h"
#include "render/frame/frame_pieces.h"

#include <string>

namespace froxel::render {

class MaterialSet;
class SceneResources;

// Whether this device and these settings can give what is asked for; `material_set` is that of the
// settings' variant. Errors: kUnsupported, saying what lacks and what would do.
[[nodiscard]] Result<void>
canDraw(const FrameInputs& inputs, const SceneResources& scene, MaterialSet& material_set);

// What takes memory of a picture, in words: "a picture of 640x360 with 20000 lights".
[[nodiscard]] std::string pictureWords(const settings::ViewSettings& settings);

// kTooLong: cut into its pieces the frame would take longer than the limit.
[[nodiscard]] Error
tooLongInPieces(const settings::Size& size, const FramePieces& pieces, Seconds limit);

// kCapacity: lists are to be capped, and the host cannot hold them whole.
[[nodiscard]] Error tooManyToCap(uint32_t light_count);

// kCapacity: targets of these settings did not fit the device's memory.
[[nodiscard]] Error noMemoryFor(const settings::ViewSettings& settings);

} // namespace froxel::render
