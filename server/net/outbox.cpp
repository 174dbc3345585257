#include "net/outbox.h"

#include "core/assert.h"

#include <algorithm>
#include <utility>

namespace froxel::net {

bool Outbox::putAnswer(Outgoing answer) {
    if (answers_.size() >= kMaxAnswers) {
        return false;
    }
    answers_.push_back(std::move(answer));
    return true;
}

Outbox::Put Outbox::putFrame(session::ReadyFrame frame) {
    const bool video = view::isVideo(frame.record.delivered.encoding.codec);
    if (!video || frame.record.key) {
        const bool breaks =
            !video && std::any_of(frames_.begin(), frames_.end(), [](const auto& f) {
                return view::isVideo(f.record.delivered.encoding.codec);
            });
        decodable_ = video || (decodable_ && !breaks);
        drop(frames_.size());
        frames_.clear();
    } else if (!decodable_ || frames_.size() >= kMaxFrames) {
        decodable_ = false;
        drop(1);
        return Put::kLost;
    }
    frames_.push_back(std::move(frame));
    return Put::kKept;
}

void Outbox::keepAnswersOnly() {
    room_due_ = false;
    state_due_ = false;
    frames_.clear();
}

Outbox::Next Outbox::next(bool frame_allowed) const {
    if (!answers_.empty()) {
        return Next::kAnswer;
    }
    if (room_due_) {
        return Next::kRoom;
    }
    const bool frame_due = !frames_.empty() && frame_allowed;
    if (state_due_ && !(frame_due && state_was_last_)) {
        return Next::kState;
    }
    return frame_due ? Next::kFrame : Next::kNothing;
}

Outgoing Outbox::takeAnswer() {
    FROXEL_ASSERT(!answers_.empty(), "no answer waits");
    Outgoing answer = std::move(answers_.front());
    answers_.pop_front();
    return answer;
}

void Outbox::takeState() {
    state_due_ = false;
    state_was_last_ = true;
}

const session::ReadyFrame& Outbox::frame() const {
    FROXEL_ASSERT(!frames_.empty(), "no picture waits");
    return frames_.front();
}

session::ReadyFrame Outbox::takeFrame() {
    FROXEL_ASSERT(!frames_.empty(), "no picture waits");
    state_was_last_ = false;
    session::ReadyFrame frame = std::move(frames_.front());
    frames_.pop_front();
    return frame;
}

} // namespace froxel::net
