// The protocol's numbers: versions, caps, deadlines and close codes. README.md explains them.
#pragma once

#include "core/enumerators.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace froxel::protocol {

// The WebSocket subprotocol that both sides name in the upgrade.
inline constexpr std::string_view kSubprotocol = "froxel.v1";
inline constexpr uint32_t kMajor = 1;
// Since 2: rooms, resuming, Pause; 3: SelectScene; 4: RequestDepth; 5: SetCompare.
inline constexpr uint32_t kMinor = 5;

inline constexpr size_t kMaxHelloBytes = 4 * 1024;         // first message of a connection
inline constexpr size_t kMaxMessageBytes = 64 * 1024;      // any later message from a client
inline constexpr size_t kMaxFrameHeaderBytes = 4096;       // FrameHeader in a frame's prefix
inline constexpr size_t kMaxFrameBytes = 64 * 1024 * 1024; // what a client must be ready to take
inline constexpr uint32_t kMaxJsonDepth = 16;              // brackets in a text message
inline constexpr size_t kMaxClientNameBytes = 64;          // Hello.client_name
inline constexpr size_t kMaxNameBytes = 256;               // any other name in a command
inline constexpr size_t kMaxSceneIdBytes = 64;             // SelectScene.scene
inline constexpr size_t kMaxRoomNameBytes = 64;            // Hello.room
inline constexpr size_t kMaxCompareBytes = 1024;           // SetCompare.right
inline constexpr size_t kMaxTokenBytes = 512;              // Hello.token
inline constexpr size_t kMaxRoomMembersTold = 32;          // in a RoomState
inline constexpr size_t kMaxSceneWarningsTold = 32;        // in a SceneInfo

inline constexpr std::chrono::seconds kHelloTimeout{5};

// More than kMaxRejects refused messages within kRejectPeriod close the connection with 1008.
inline constexpr uint32_t kMaxRejects = 20;
inline constexpr std::chrono::seconds kRejectPeriod{10};

// WebSocket close codes that this protocol uses.
enum class CloseCode : uint16_t {
    kNormal = 1000,
    kPolicy = 1008,       // no Hello in time, or too many messages; do not retry
    kTooBig = 1009,       // a message over the cap; do not retry
    kVersion = 4001,      // protocol_major differs; do not retry
    kToken = 4003,        // no valid token; retry with another
    kSlowConsumer = 4008, // answers are not read, or a write was stuck; retry
    kReplaced = 4009,     // a newer connection took the session up; do not retry
    kDraining = 4010,     // the server is going down; retry elsewhere or later
    kResting = 4011,      // nobody watched, and the place is needed; retry when somebody does
    // No place now, each for its own reason; retry with back-off.
    kAllTaken = 4029,   // all sessions of the server are taken
    kDeviceBusy = 4030, // one more moving view would slow the others below the floor rate
    kShareTaken = 4031, // the caller's address or token has as many places as it may
    kRoomFull = 4032,   // all places of the room are taken
    kNoPicture = 4033,  // the first picture does not fit into the server's memory
    kDeviceLost = 4050, // the rendering device was lost; retry with back-off
};
constexpr bool isCloseCode(CloseCode code) {
    switch (code) {
    case CloseCode::kNormal:
    case CloseCode::kPolicy:
    case CloseCode::kTooBig:
    case CloseCode::kVersion:
    case CloseCode::kToken:
    case CloseCode::kSlowConsumer:
    case CloseCode::kReplaced:
    case CloseCode::kDraining:
    case CloseCode::kResting:
    case CloseCode::kAllTaken:
    case CloseCode::kDeviceBusy:
    case CloseCode::kShareTaken:
    case CloseCode::kRoomFull:
    case CloseCode::kNoPicture:
    case CloseCode::kDeviceLost:
        return true;
    }
    return false;
}
inline constexpr auto kCloseCodes = enumerators<CloseCode, 4999, isCloseCode>();

} // namespace froxel::protocol
