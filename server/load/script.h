// What a viewer says, and when.
#pragma once

#include "core/clock.h"
#include "froxel/v1/client.pb.h"
#include "froxel/v1/server.pb.h"
#include "path/camera_path.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace froxel::load {

struct Step {
    Clock::duration at{};      // since the script's start
    v1::ClientMessage message; // seq and client_time_us are the viewer's affair
};

// One viewer's; not for several threads.
class Script {
  public:
    virtual ~Script() = default;
    // In the order of `at`; none: it is over.
    [[nodiscard]] virtual std::optional<Step> next() = 0;
};

// Nothing after the greeting.
struct Idle {};
// The camera circles about its target once in kOrbitPeriod, kOrbitRate commands a second.
struct Orbit {};
// Every command of the protocol that sets the view, and Ping, in turn, kStormRate a second, each
// with random values over the whole of what the server says it takes, often the least or the most;
// the same ones in every run. Much of it costs too much and is refused as that.
struct Storm {};
// Goes over to another of these scenes every kSceneStay; each fourth time the one before is
// selected again at once, which calls the new one off. Viewers two and two do the same.
struct Scenes {
    std::vector<std::string> ids; // at least one
};
// The camera along a path, from its end to its beginning at once unless it is a loop, kPathRate
// commands a second. A path that takes no time is one command.
using Path = std::shared_ptr<const path::CameraPath>;
// From a file; played once.
using Recording = std::shared_ptr<const std::vector<Step>>;
using ScriptChoice = std::variant<Orbit, Idle, Storm, Scenes, Path, Recording>;

// How long viewers rest after each pass of their script: a circle of Orbit, kStormPass, one scene,
// a path, a recording. Evenly spread between the two, the same in every run.
struct ThinkTime {
    Seconds least{0};
    Seconds most{0};
};

inline constexpr Seconds kOrbitPeriod{10};
inline constexpr uint32_t kOrbitRate = 60;
inline constexpr uint32_t kPathRate = 60;
inline constexpr uint32_t kStormRate = 200;
inline constexpr Seconds kStormPass{10};
inline constexpr Seconds kSceneStay{2};

// `viewer` counts from 1; viewers of one script start at different points of it. With a time to
// think, a recording is played again and again.
[[nodiscard]] std::unique_ptr<Script> makeScript(const ScriptChoice& choice,
                                                 const v1::Welcome& welcome,
                                                 uint32_t viewer,
                                                 const std::optional<ThinkTime>& think = {});

// Whether it never stops sending commands.
[[nodiscard]] bool isRestless(const ScriptChoice& choice, const std::optional<ThinkTime>& think);

} // namespace froxel::load
