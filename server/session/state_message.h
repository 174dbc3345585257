// Session values to the protocol's messages. Pure; any thread.
#pragma once

#include "core/frame_stats.h"
#include "protocol/depth_mesh.h"
#include "protocol/framing.h"
#include "session/room.h"
#include "session/scene_port.h"
#include "session/session_state.h"

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace froxel::session {

[[nodiscard]] v1::ServerMessage
makeWelcome(uint64_t session_id, const SessionContext& context, const SessionState& state);
// What Welcome says beyond that of a viewer's place in its session.
struct WelcomePlace {
    std::string resume_token; // empty: the session is not kept
    std::chrono::milliseconds resume_grace{0};
    bool resumed = false;
    const Room* room = nullptr;             // absent: a session of one's own
    MemberId member = 0;                    // in the room
    const SessionState* defaults = nullptr; // where `state` is not that of a new session
    bool offers_depth = false;
};
void addPlace(v1::ServerMessage& welcome, const SessionContext& context, const WelcomePlace& place);
// As `you` is told it.
[[nodiscard]] v1::ServerMessage makeRoomState(const Room& room, MemberId you);
// Answers the command of `state.applied`; `told` are the placed lights that the viewer knows of.
[[nodiscard]] v1::ServerMessage makeStateChanged(const SessionContext& context,
                                                 const SessionState& state,
                                                 const settings::PlacedLights& told);
// A scene and all that goes by it; `first` is what a new session on it begins with.
[[nodiscard]] v1::ServerMessage
makeSceneChanged(const SessionState& state, const SessionState& first, uint64_t ref_seq);
// An empty id: none is being loaded.
[[nodiscard]] v1::ServerMessage makeLoading(const Progress& progress);
[[nodiscard]] v1::ServerMessage makeSceneLoading(const std::string& id, const Progress& progress);
// The protocol's name of it in small letters: "out_of_range".
[[nodiscard]] std::string nameOf(RejectCode code);

[[nodiscard]] v1::ServerMessage makeError(const Rejection& rejection);
[[nodiscard]] v1::ServerMessage makePong(const CommandStamp& ping);
// `reconnect_url` is empty where viewers come back to the same address.
[[nodiscard]] v1::ServerMessage makeDraining(std::chrono::milliseconds deadline,
                                             const std::string& reconnect_url);
[[nodiscard]] v1::ServerMessage makeFrameDetails(const FrameDetails& details);

// Both sides of a compared frame. Durations in microseconds.
struct ComparedRecord {
    bool layered = true;   // false: a heat map, or one picture with a divider
    bool promised = false; // promisesEqualBits()
    double left_us = 0;    // host and device work up to readable pixels
    double right_us = 0;
    FrameStats right_stats; // the left side's are the frame's
    // From here on as the encoder's thread finds it.
    uint64_t differing_count = 0; // pixels
    double max_abs = 0;           // of display colours of 0..1
    double rmse = 0;
    std::optional<double> flip; // mean LDR-FLIP; none: not measured
    struct Pixel {
        uint32_t x = 0;
        uint32_t y = 0;
        uint32_t left_rgb = 0; // 0xRRGGBB
        uint32_t right_rgb = 0;
    };
    std::optional<Pixel> first; // that differs, row by row
};

// One frame's way through the server, in microseconds where not said otherwise.
struct FrameRecord {
    uint64_t frame_id = 0;
    CommandStamp applied;
    uint32_t width_px = 0;
    uint32_t height_px = 0;
    size_t encoded_bytes = 0; // of the whole picture
    Delivered delivered;
    bool key = true; // decodes without any frame before it
    // What the picture would take of the device at the size asked for, where that is too much; 0:
    // it is that size, or smaller for another reason.
    double full_size_us = 0;
    double queue_us = 0;  // from the applied command's arrival to the start of rendering
    double render_us = 0; // host and device work up to readable pixels
    double encode_wait_us = 0;
    double encode_us = 0;
    double send_wait_us = 0; // in the slot before the socket
    uint32_t dropped_count = 0;
    double queue_delay_us = 0;                // on the link, of late
    double link_bits_per_s = 0;               // 0: unknown
    double time_s = 0;                        // the lights' clock
    std::optional<double> animation_time_s;   // of the one that is chosen
    std::optional<settings::Camera> followed; // as it stood
    settings::Camera camera;                  // that it was drawn with
    uint64_t depth_mesh = 0;                  // number of that of its depth; 0: it comes without
    FrameStats stats;
    std::optional<ComparedRecord> compared = {}; // none: one picture

    // Of the encoded picture, which has both sides' pixels one above the other.
    [[nodiscard]] uint32_t encodedHeight() const {
        return compared && compared->layered ? 2 * height_px : height_px;
    }
};

[[nodiscard]] v1::FrameHeader makeFrameHeader(const FrameRecord& record);
[[nodiscard]] v1::DepthMeshHeader makeDepthMeshHeader(const protocol::CodedDepthMesh& mesh,
                                                      uint64_t number);

} // namespace froxel::session
