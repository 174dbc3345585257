// Of what format the scene is that stands in a request's body.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace froxel::net {

// The name that the scene goes by, whose end tells the format; "": none that is read. None: more of
// the body must come first, at most kMostOfKind bytes. `begin`: its first bytes; `size_bytes`: of
// all of it.
inline constexpr size_t kMostOfKind = 512;
[[nodiscard]] std::optional<std::string_view> sceneNameOf(std::string_view begin,
                                                          uint64_t size_bytes);

} // namespace froxel::net
