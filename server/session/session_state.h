// A session's state and the pure reducer that commands go through. No threads, no clock, no
// protobuf: the caller serialises access and passes the time.
#pragma once

#include "motion/playback.h"
#include "session/command.h"
#include "session/comparison.h"
#include "session/delivery.h"
#include "session/light_clock.h"
#include "session/rejection.h"
#include "session/session_context.h"

namespace froxel::session {

struct SessionState {
    settings::ViewSettings settings;
    settings::Encoding encoding;
    DeliverySettings delivery;
    LightClock light_clock;
    CommandStamp applied; // newest accepted command that sets state
    uint64_t version = 1; // grows with each change of any other member except `applied`
    settings::CodecSet decodable = settings::commonCodecs(); // by all who see it
    uint64_t key_requests = 0;                               // key frames asked for so far
    bool sends_depth = false;           // with pictures of a moving view: somebody asked for it
    motion::Playback playback{};        // of the scene's animations, by secondsOf(the host's clock)
    std::optional<uint32_t> followed{}; // of SceneSummary::cameras, one that moves
    std::optional<Comparison> comparison{};
    // Where the divider of a comparison is, as a share of the width. Clients draw it: no picture is
    // another for it, and `version` stays.
    double compare_split = 0.5;
    // Of the scene that is shown, which stays on the device for it; null: the only one.
    std::shared_ptr<const SessionContext> scene{};

    // Whether pictures after that time are others without a command.
    [[nodiscard]] bool animatingAt(TimePoint now) const {
        return (light_clock.moving() && settings.lights.count > 0) ||
               playback.movesAt(secondsOf(now));
    }
    // The one that is followed, or settings.camera.
    [[nodiscard]] settings::Camera cameraAt(TimePoint now) const;

    [[nodiscard]] static double secondsOf(TimePoint now) {
        return Seconds(now.time_since_epoch()).count();
    }
};

// What a viewer of a picture of that size sees first.
[[nodiscard]] settings::Camera openingCamera(const SessionContext& context,
                                             const settings::Size& size);

// The first scene camera, or the whole scene in view when it has none.
[[nodiscard]] SessionState initialState(const SessionContext& context, TimePoint now);

// Whether the command sets state; the others are the connection's and the room's affair.
[[nodiscard]] bool setsState(const Command& command);

// The state after the command; `version` tells whether anything differs. Refused: kOutOfRange
// (unknown scene camera or animation), kCapacity (picture too large), kUnsupported (a codec that is
// not decodable). Only for commands with setsState().
[[nodiscard]] CommandResult<SessionState> apply(SessionState state,
                                                const CommandMessage& message,
                                                const SessionContext& context,
                                                TimePoint now);

} // namespace froxel::session
