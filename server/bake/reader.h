// The process that reads a scene's file and owns nothing.
#pragma once

namespace froxel::bake {

// Where the one that started it put its end of the channel, and the memory for the scene.
inline constexpr int kChannelDescriptor = 3;
inline constexpr int kOutputDescriptor = 4;

// Reads one scene, as the channel asks for it, and writes it to the output. Gives up all rights
// before it looks at a file. For the start of a process, which ends with what this returns: 0, or 1
// where the channel broke.
[[nodiscard]] int runReader();

} // namespace froxel::bake
