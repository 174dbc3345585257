#include "load/viewer_meter.h"

#include "core/text.h"

#include <algorithm>
#include <chrono>

namespace froxel::load {
namespace {

double msOf(Clock::duration time) {
    return std::chrono::duration<double, std::milli>(time).count();
}

double msOfUs(uint64_t time_us) {
    return static_cast<double>(time_us) / 1000;
}

// Whether frames show what it did: the session answers the others by itself.
bool shows(const v1::ClientMessage& said) {
    using Said = v1::ClientMessage;
    switch (said.body_case()) {
    case Said::kPing:
    case Said::kPause:
    case Said::kRequestControl:
    case Said::kReleaseControl:
    case Said::kGiveControl:
    case Said::kRequestKeyFrame:
        return false;
    default:
        return true;
    }
}

bool setsClock(const v1::SetLights& lights) {
    return lights.has_time_s() || lights.has_speed() || lights.has_animate();
}

} // namespace

uint64_t ViewerMeter::stampOf(TimePoint now) {
    const auto time = std::chrono::duration_cast<std::chrono::microseconds>(now.time_since_epoch());
    return static_cast<uint64_t>(time.count());
}

void ViewerMeter::begin(TimePoint now, bool restless) {
    counting_ = true;
    restless_ = restless;
    began_ = now;
    last_frame_ = now;
    ages_ = FrameAges(clock_rate_);
    unseen_.clear();
    dropped_before_ = dropped_now_;
    measured_ = {};
}

void ViewerMeter::end(TimePoint now) {
    counting_ = false;
    measured_.seconds = Seconds(now - began_).count();
    measured_.server_dropped = dropped_now_ - dropped_before_;
    if (const auto since = dueSince()) {
        measured_.samples.interval_ms.push_back(msOf(now - *since));
    }
    measured_.commands_unshown = unseen_.size();
    for (const Unseen& command : unseen_) {
        measured_.samples.reaction_ms.push_back(msOf(now - command.sent));
    }
    measured_.samples.age_ms = ages_.all();
}

std::optional<TimePoint> ViewerMeter::dueSince() const {
    if (paused_) {
        return std::nullopt;
    }
    if (restless_ || lights_move_) {
        return last_frame_;
    }
    if (unseen_.empty()) {
        return std::nullopt;
    }
    return std::max(last_frame_, unseen_.front().sent);
}

void ViewerMeter::setPaused(bool paused, TimePoint now) {
    paused_ = paused;
    last_frame_ = now;
    unseen_.clear(); // what waited is shown on resuming, whenever that is
}

void ViewerMeter::onState(const v1::ViewState& state, TimePoint now) {
    const bool clock_runs = !state.has_light_time_s();
    const double rate = clock_runs ? state.light_speed() : 0;
    if (rate != clock_rate_) {
        clock_rate_ = rate;
        ages_.forgetClock();
    }
    const bool move = clock_runs && state.light_count() > 0;
    if (move && !lights_move_) {
        last_frame_ = dueSince().value_or(now);
    }
    lights_move_ = move;
}

void ViewerMeter::onCommand(uint64_t seq,
                            const v1::ClientMessage& said,
                            TimePoint due,
                            TimePoint now) {
    if (!counting_) {
        return;
    }
    ++measured_.commands;
    measured_.samples.timer_lag_ms.push_back(msOf(now - due));
    if (said.has_pause() && said.pause().paused() != paused_) {
        setPaused(said.pause().paused(), now);
    }
    if (said.has_set_lights() && setsClock(said.set_lights())) {
        ages_.forgetClock();
    }
    const bool chooses = said.has_select_scene();
    if (chooses && said.select_scene().scene() == scene_) {
        std::erase_if(unseen_, [](const Unseen& command) { return command.other_scene; });
        return;
    }
    if (shows(said) && !paused_) {
        unseen_.push_back({seq, now, chooses});
    }
}

void ViewerMeter::onScene(const std::string& id) {
    scene_ = id;
    for (Unseen& command : unseen_) {
        command.other_scene = false;
    }
}

void ViewerMeter::onCommandSkipped(uint64_t seq, TimePoint due) {
    if (counting_) {
        ++measured_.commands_skipped;
        if (!paused_) {
            unseen_.push_back({seq, due});
        }
    }
}

Result<void> ViewerMeter::onFrame(const v1::FrameHeader& header,
                                  size_t bytes,
                                  uint64_t sent_seq,
                                  TimePoint now) {
    const auto refuse = [](std::string text) {
        return Error{ErrorCode::kInvalidArgument, std::move(text)};
    };
    const uint64_t stamp_us = header.applied_client_time_us();
    if (header.frame_id() <= last_id_) {
        return refuse("frame " + numberText(header.frame_id()) + " after frame " +
                      numberText(last_id_));
    }
    if (header.applied_seq() > sent_seq || header.applied_seq() < shown_seq_) {
        return refuse("frame " + numberText(header.frame_id()) + " shows command " +
                      numberText(header.applied_seq()) + " of " + numberText(sent_seq) +
                      ", after one with " + numberText(shown_seq_));
    }
    const bool shows_new = header.applied_seq() > shown_seq_;
    if (shows_new && (stamp_us == 0 || stamp_us > stampOf(now))) {
        return refuse("frame " + numberText(header.frame_id()) + " echoes a time never sent");
    }
    last_id_ = header.frame_id();
    shown_seq_ = header.applied_seq();
    dropped_now_ = header.dropped_frames();
    if (!counting_) {
        return {};
    }
    ++measured_.frames;
    measured_.frame_bytes += bytes;
    measured_.addSize({header.width(), header.height()});
    if (const auto since = dueSince()) {
        measured_.samples.interval_ms.push_back(msOf(now - *since));
    }
    last_frame_ = now;
    std::optional<double> latency_ms;
    std::optional<double> age_ms;
    if (shows_new) {
        latency_ms = msOfUs(stampOf(now) - stamp_us);
        age_ms = *latency_ms - msOfUs(header.queue_us());
        measured_.samples.latency_ms.push_back(*latency_ms);
    }
    ages_.onFrame(header, now, age_ms);
    while (!unseen_.empty() && unseen_.front().seq <= shown_seq_) {
        measured_.samples.reaction_ms.push_back(msOf(now - unseen_.front().sent));
        unseen_.pop_front();
    }
    addStages(header, latency_ms);
    return {};
}

void ViewerMeter::addStages(const v1::FrameHeader& header, std::optional<double> latency_ms) {
    const auto add = [this](Stage stage, double time_ms) {
        measured_.samples.stage_ms[static_cast<size_t>(stage)].push_back(time_ms);
    };
    add(Stage::kRender, msOfUs(header.render_us()));
    add(Stage::kEncodeWait, msOfUs(header.encode_wait_us()));
    add(Stage::kEncode, msOfUs(header.encode_us()));
    add(Stage::kSendWait, msOfUs(header.send_wait_us()));
    if (header.has_gpu_us()) {
        measured_.samples.gpu_ms.push_back(msOfUs(header.gpu_us()));
    }
    if (latency_ms) {
        add(Stage::kQueue, msOfUs(header.queue_us()));
        add(Stage::kNetwork, *latency_ms - msOfUs(header.queue_us()) - stagesMs(header));
    }
}

void Measured::addSize(const PictureSize& size) {
    if (!smallest || size.area() < smallest->area()) {
        smallest = size;
    }
    if (!largest || size.area() > largest->area()) {
        largest = size;
    }
}

void ViewerMeter::onFrameDropped() {
    measured_.client_dropped += counting_ ? 1 : 0;
}

void ViewerMeter::onRefusal(const v1::Error& error) {
    // The last of this number: cameras that were skipped have that of the next one sent.
    const auto refused = std::find_if(unseen_.rbegin(), unseen_.rend(), [&](const Unseen& one) {
        return one.seq == error.ref_seq();
    });
    if (refused != unseen_.rend()) {
        unseen_.erase(std::next(refused).base());
    }
    if (counting_) {
        ++measured_.refusals[error.code()];
        if (!measured_.refusal) {
            measured_.refusal = printable(error.message(), 200);
        }
    }
}

} // namespace froxel::load
