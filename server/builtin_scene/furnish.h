// Puts fountain, statue, parapets, lamps, banners and plants in their places.
#pragma once

#include "builtin_scene/stage.h"

namespace froxel::builtin_scene {

void furnish(Stage& stage);

} // namespace froxel::builtin_scene
