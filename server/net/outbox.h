// What waits to be written to one connection, bounded: answers in a short queue, room, scene and
// state in a slot each, pictures in a short queue. Newer ones replace older ones, but for frames of
// video that need those before them: they wait in their order, not for long, and where one is lost,
// all are that follow it, up to the next key frame. One strand.
#pragma once

#include "core/encoded_frame.h"
#include "protocol/framing.h"
#include "session/stream_port.h"

#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <string>

namespace froxel::net {

// One WebSocket message: the head, then the body if there is one.
struct Outgoing {
    std::string head;
    SharedBytes body;
    protocol::WireFormat format = protocol::WireFormat::kBinary;
    // What the head is still to be made of, since that takes long; null: it is there.
    std::shared_ptr<const v1::ServerMessage> unmade{};

    // Any thread.
    void make();
    [[nodiscard]] size_t size() const { return head.size() + (body ? body->size() : 0); }
};

class Outbox {
  public:
    static constexpr size_t kMaxAnswers = 64;
    // Frames of video that wait: those of a window and one, and of a room's viewer not for longer
    // than this, counted from when they were ready.
    static constexpr size_t kMaxFrames = 9;
    static constexpr Seconds kMaxWait{0.25};

    // False, and nothing kept, when kMaxAnswers are waiting: the client does not read.
    [[nodiscard]] bool putAnswer(Outgoing answer);
    void putState() { state_due_ = true; }
    void putRoom() { room_due_ = true; }
    void putScene() { scene_due_ = true; }
    enum class Put { kKept, kLost };
    // kLost: this one cannot be decoded without one that was dropped; a key frame is needed.
    [[nodiscard]] Put putFrame(session::ReadyFrame frame);
    // Frames of video are not wanted from here to the next key frame; whether any is missed.
    [[nodiscard]] bool interruptVideo();
    // Pictures and states are not wanted any more.
    void keepAnswersOnly();

    enum class Next { kNothing, kAnswer, kRoom, kScene, kState, kFrame };
    struct Allowed {
        bool room = true;
        bool scene = true;
        bool state = true;
        bool frame = true;
    };
    // Answers first, then who is in the room, what there is of the scene, and the state, which the
    // caller allows seldom enough for pictures, all three.
    [[nodiscard]] Next next(const Allowed& allowed) const;
    [[nodiscard]] Outgoing takeAnswer();
    void takeState() { state_due_ = false; }
    void takeRoom() { room_due_ = false; }
    void takeScene() { scene_due_ = false; }
    [[nodiscard]] session::ReadyFrame takeFrame();

    [[nodiscard]] bool hasRoom() const { return room_due_; }
    [[nodiscard]] bool hasScene() const { return scene_due_; }
    [[nodiscard]] bool hasState() const { return state_due_; }
    [[nodiscard]] bool hasFrame() const { return !frames_.empty(); }
    // The picture that takeFrame() gives next.
    [[nodiscard]] const session::ReadyFrame& frame() const;
    // Pictures that were not taken.
    [[nodiscard]] uint32_t droppedCount() const { return dropped_count_; }

  private:
    void drop(size_t count) { dropped_count_ += static_cast<uint32_t>(count); }

    std::deque<Outgoing> answers_;
    std::deque<session::ReadyFrame> frames_;
    bool decodable_ = false; // whether the last frame of video put here was kept, and all before it
    bool room_due_ = false;
    bool scene_due_ = false;
    bool state_due_ = false;
    uint32_t dropped_count_ = 0;
};

} // namespace froxel::net
