#include "net/outbox.h"

#include "core/assert.h"
#include "froxel/v1/server.pb.h"

#include <algorithm>
#include <utility>

namespace froxel::net {

void Outgoing::make() {
    head = protocol::encodeServerMessage(*unmade, format);
    unmade.reset();
}

bool Outbox::putAnswer(Outgoing answer) {
    if (answers_.size() >= kMaxAnswers) {
        return false;
    }
    answers_.push_back(std::move(answer));
    return true;
}

Outbox::Put Outbox::putFrame(session::ReadyFrame frame) {
    const bool video = frame.isVideo();
    if (!video || frame.record.key) {
        const bool breaks = !video && std::any_of(frames_.begin(), frames_.end(),
                                                  [](const auto& f) { return f.isVideo(); });
        decodable_ = video || (decodable_ && !breaks);
        drop(frames_.size());
        frames_.clear();
    } else if (!decodable_) {
        drop(1);
        return Put::kLost;
    } else if (frames_.size() >= kMaxFrames ||
               (!frames_.empty() && frame.ready_at - frames_.front().ready_at > kMaxWait)) {
        decodable_ = false;
        drop(frames_.size() + 1);
        frames_.clear();
        return Put::kLost;
    }
    frames_.push_back(std::move(frame));
    return Put::kKept;
}

bool Outbox::interruptVideo() {
    const bool waits = !frames_.empty() && frames_.back().isVideo();
    if (waits) {
        drop(frames_.size());
        frames_.clear();
    }
    return std::exchange(decodable_, false);
}

void Outbox::keepAnswersOnly() {
    room_due_ = false;
    scene_due_ = false;
    state_due_ = false;
    frames_.clear();
}

Outbox::Next Outbox::next(const Allowed& allowed) const {
    if (!answers_.empty()) {
        return Next::kAnswer;
    }
    if (room_due_ && allowed.room) {
        return Next::kRoom;
    }
    if (scene_due_ && allowed.scene) {
        return Next::kScene;
    }
    if (state_due_ && allowed.state) {
        return Next::kState;
    }
    return !frames_.empty() && allowed.frame ? Next::kFrame : Next::kNothing;
}

Outgoing Outbox::takeAnswer() {
    FROXEL_ASSERT(!answers_.empty(), "no answer waits");
    Outgoing answer = std::move(answers_.front());
    answers_.pop_front();
    return answer;
}

const session::ReadyFrame& Outbox::frame() const {
    FROXEL_ASSERT(!frames_.empty(), "no picture waits");
    return frames_.front();
}

session::ReadyFrame Outbox::takeFrame() {
    FROXEL_ASSERT(!frames_.empty(), "no picture waits");
    session::ReadyFrame frame = std::move(frames_.front());
    frames_.pop_front();
    return frame;
}

} // namespace froxel::net
