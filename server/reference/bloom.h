// Bloom as it is meant, in double: the Gaussian that every kind comes to.
#pragma once

#include "core/linear_image.h"
#include "settings/settings.h"

namespace froxel::reference {

// The part of a colour that bloom spreads: what its largest channel has above `threshold`, setting
// in as a parabola from `knee` below it to `knee` above it.
[[nodiscard]] glm::dvec3 brightPart(const glm::dvec3& color, double threshold, double knee);

// picture + strength (Gaussian of the bright part - bright part); the Gaussian's standard deviation
// is radius times the smaller side, it ends at six of them, and the picture is mirrored at its
// borders.
[[nodiscard]] LinearImage
spread(const LinearImage& picture, const settings::Bloom& bloom, double exposure);

} // namespace froxel::reference
