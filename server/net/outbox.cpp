#include "net/outbox.h"

#include "core/assert.h"

#include <utility>

namespace froxel::net {

bool Outbox::putAnswer(Outgoing answer) {
    if (answers_.size() >= kMaxAnswers) {
        return false;
    }
    answers_.push_back(std::move(answer));
    return true;
}

void Outbox::putFrame(session::ReadyFrame frame) {
    dropped_count_ += frame_ ? 1U : 0U;
    frame_ = std::move(frame);
}

void Outbox::keepAnswersOnly() {
    room_due_ = false;
    state_due_ = false;
    frame_.reset();
}

Outbox::Next Outbox::next(bool frame_allowed) const {
    if (!answers_.empty()) {
        return Next::kAnswer;
    }
    if (room_due_) {
        return Next::kRoom;
    }
    const bool frame_due = frame_ && frame_allowed;
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
    FROXEL_ASSERT(frame_.has_value(), "no picture waits");
    return *frame_;
}

session::ReadyFrame Outbox::takeFrame() {
    FROXEL_ASSERT(frame_.has_value(), "no picture waits");
    state_was_last_ = false;
    return *std::exchange(frame_, std::nullopt);
}

} // namespace froxel::net
