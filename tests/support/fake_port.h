// A StreamPort that keeps what it is told, and the sinks to speak through.
#pragma once

#include "session/stream_port.h"

#include <map>
#include <memory>
#include <vector>

namespace froxel::test {

class FakePort final : public session::StreamPort {
  public:
    static constexpr session::SessionId kFirstId = 7;

    struct Joined {
        std::weak_ptr<session::FrameSink> sink;
        std::vector<session::SessionState> states;
        uint64_t granted = 0;
        bool left = false;
        session::Delivery delivery{};
        session::Account account{};
        bool takes_frames = true;
    };

    Result<session::SessionId> join(std::weak_ptr<session::FrameSink> sink,
                                    const session::SessionState& state,
                                    const session::Account& account,
                                    TimePoint /*now*/) override {
        if (full) {
            return Error{ErrorCode::kCapacity, "full"};
        }
        const session::SessionId id = kFirstId + sessions.size();
        sessions[id] = {std::move(sink), {state}, 0, false, {}, account};
        return id;
    }
    Result<session::SessionId> joinBeside(std::weak_ptr<session::FrameSink> sink,
                                          const session::SessionState& state) override {
        return join(std::move(sink), state, {"beside"}, {});
    }
    Result<void> admits(const session::Account& /*account*/, TimePoint /*now*/) const override {
        return full ? Result<void>(Error{ErrorCode::kCapacity, "full"}) : Result<void>();
    }
    void update(session::SessionId id,
                const session::SessionState& state,
                TimePoint /*arrived*/) override {
        sessions.at(id).states.push_back(state);
    }
    void grant(session::SessionId id, uint64_t frame_total) override {
        sessions.at(id).granted = frame_total;
    }
    void setTakesFrames(session::SessionId id, bool takes) override {
        sessions.at(id).takes_frames = takes;
    }
    void setDelivery(session::SessionId id, const session::Delivery& delivery) override {
        sessions.at(id).delivery = delivery;
    }
    void leave(session::SessionId id) override { sessions.at(id).left = true; }

    [[nodiscard]] Joined& session(session::SessionId id = kFirstId) { return sessions.at(id); }
    [[nodiscard]] std::shared_ptr<session::FrameSink> sink(session::SessionId id = kFirstId) {
        return sessions.at(id).sink.lock();
    }
    // A picture of 16x16 with this id, of the session's newest state.
    void
    deliver(uint64_t frame_id, TimePoint now, session::SessionId id = kFirstId, size_t bytes = 10) {
        session::ReadyFrame frame;
        frame.record.frame_id = frame_id;
        frame.record.applied = session(id).states.back().applied;
        frame.record.width_px = 16;
        frame.record.height_px = 16;
        frame.record.queue_us = 1000;
        frame.bytes = std::make_shared<const std::vector<std::byte>>(bytes);
        frame.ready_at = now;
        sink(id)->deliver(std::move(frame));
    }

    bool full = false;
    std::map<session::SessionId, Joined> sessions;
};

} // namespace froxel::test
