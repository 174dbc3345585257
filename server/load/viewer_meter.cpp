#include "load/viewer_meter.h"

#include "core/text.h"

#include <chrono>

namespace froxel::load {
namespace {

double msOf(Clock::duration time) {
    return std::chrono::duration<double, std::milli>(time).count();
}

double msOfUs(uint64_t time_us) {
    return static_cast<double>(time_us) / 1000;
}

} // namespace

uint64_t ViewerMeter::stampOf(TimePoint now) {
    const auto time = std::chrono::duration_cast<std::chrono::microseconds>(now.time_since_epoch());
    return static_cast<uint64_t>(time.count());
}

void ViewerMeter::begin(TimePoint now) {
    counting_ = true;
    began_ = now;
    last_frame_.reset();
    unseen_.clear();
    dropped_before_ = dropped_now_;
    measured_ = {};
}

void ViewerMeter::end(TimePoint now) {
    counting_ = false;
    measured_.seconds = Seconds(now - began_).count();
    measured_.server_dropped = dropped_now_ - dropped_before_;
}

void ViewerMeter::onCommand(uint64_t seq, bool shows, TimePoint due, TimePoint now) {
    if (counting_) {
        if (shows) {
            unseen_.emplace_back(seq, now);
        }
        ++measured_.commands;
        measured_.samples.timer_lag_ms.push_back(msOf(now - due));
    }
}

void ViewerMeter::onCommandSkipped() {
    measured_.commands_skipped += counting_ ? 1 : 0;
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
    if (last_frame_) {
        measured_.samples.interval_ms.push_back(msOf(now - *last_frame_));
    }
    last_frame_ = now;
    std::optional<double> latency_ms;
    if (shows_new) {
        latency_ms = msOfUs(stampOf(now) - stamp_us);
        measured_.samples.latency_ms.push_back(*latency_ms);
        measured_.samples.age_ms.push_back(*latency_ms - msOfUs(header.queue_us()));
    }
    while (!unseen_.empty() && unseen_.front().first <= shown_seq_) {
        measured_.samples.reaction_ms.push_back(msOf(now - unseen_.front().second));
        unseen_.pop_front();
    }
    addStages(header, latency_ms);
    return {};
}

void ViewerMeter::addStages(const v1::FrameHeader& header, std::optional<double> latency_ms) {
    const auto add = [this](Stage stage, double time_ms) {
        measured_.samples.stage_ms[static_cast<size_t>(stage)].push_back(time_ms);
    };
    const uint64_t after_queue_us = uint64_t{header.render_us()} + header.encode_wait_us() +
                                    header.encode_us() + header.send_wait_us();
    add(Stage::kRender, msOfUs(header.render_us()));
    add(Stage::kEncodeWait, msOfUs(header.encode_wait_us()));
    add(Stage::kEncode, msOfUs(header.encode_us()));
    add(Stage::kSendWait, msOfUs(header.send_wait_us()));
    measured_.samples.gpu_ms.push_back(msOfUs(header.gpu_us()));
    if (latency_ms) {
        add(Stage::kQueue, msOfUs(header.queue_us()));
        add(Stage::kNetwork, *latency_ms - msOfUs(header.queue_us() + after_queue_us));
    }
}

void ViewerMeter::onFrameDropped() {
    measured_.client_dropped += counting_ ? 1 : 0;
}

void ViewerMeter::onRefusal(const v1::Error& error) {
    if (counting_) {
        ++measured_.refusals;
        if (!measured_.refusal) {
            measured_.refusal = printable(error.message(), 200);
        }
    }
}

} // namespace froxel::load
