// Exit codes beyond those of an ErrorCode; all are in froxel --help and docs/guide/commands.md.
#pragma once

namespace froxel::app {

// The device was lost, or the render thread never came back, while serving: start the process anew.
inline constexpr int kExitDeviceLost = 6;

// What `froxel load --require` asks for was broken; k6 has the same code for it.
inline constexpr int kExitRequirement = 99;

} // namespace froxel::app
