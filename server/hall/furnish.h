// Puts fountain, statue, parapets, lamps, banners and plants in their places.
#pragma once

#include "hall/stage.h"

namespace froxel::hall {

void furnish(Stage& stage);

} // namespace froxel::hall
