// An environment as surfaces see it, made of a panorama once and looked up from then on.
#pragma once

#include "environment/diffuse.h"
#include "environment/prefiltered.h"

namespace froxel::environment {

struct Surroundings {
    Diffuse matt;
    Prefiltered glossy;

    // Over all directions.
    [[nodiscard]] const glm::dvec3& mean() const { return matt.terms[0]; }
};

// Takes some seconds, on several threads. Any thread.
[[nodiscard]] Surroundings surroundingsOf(LinearImage panorama);

// Of the studio: as surroundingsOf() makes them of its panorama, to the bit. Any thread.
[[nodiscard]] const Surroundings& studioSurroundings();

} // namespace froxel::environment
