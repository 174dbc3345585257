// Things of a scene that people choose by name or by number, such as clips.
#pragma once

#include <string>
#include <vector>

namespace froxel::scene {

// "1 walk, 2 (nameless)", for messages: printable and of bounded length. "none": there are none.
[[nodiscard]] std::string numberedList(const std::vector<std::string>& names);

} // namespace froxel::scene
