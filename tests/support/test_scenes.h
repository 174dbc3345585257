// The scenes that picture tests draw.
#pragma once

#include "scene/scene.h"

#include <optional>

namespace froxel::test {

// A floor and a wall with a masked and a glass pane, a mirrored and a squashed box: small, and
// every kind of material and transform.
[[nodiscard]] scene::Scene makeRoom();

// Its floor, wall, glass and boxes under clear coats: strong and weak, smooth and rough, one bumpy
// and one in holes.
void giveCoats(scene::Scene& room);

// The same under fibres: of every roughness, one in colours and one in holes; and with highlights
// longer in one direction, or under a film. Below coats where it has them.
void giveLobes(scene::Scene& room);

// Crytek Sponza from FROXEL_SPONZA or beside the checkout; none where it is absent.
[[nodiscard]] std::optional<scene::Scene> loadSponza();

} // namespace froxel::test
