#include "load/viewer_meter.h"

#include "core/text.h"

#include <algorithm>
#include <chrono>
#include <utility>

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
    case Said::kRequestDepth:
        return false;
    default:
        return true;
    }
}

constexpr std::array kCounts = {&Counts::frames,           &Counts::frame_bytes,
                                &Counts::depth_meshes,     &Counts::depth_bytes,
                                &Counts::server_dropped,   &Counts::client_dropped,
                                &Counts::commands,         &Counts::commands_skipped,
                                &Counts::commands_unshown, &Counts::errors};

void subtract(Counts& from, const Counts& before) {
    for (const auto count : kCounts) {
        from.*count -= before.*count;
    }
    for (const auto& [code, count] : before.errors_by_code) {
        from.errors_by_code[code] -= count;
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
    taken_ = {};
    taken_seconds_ = 0;
    taken_samples_ = {};
}

void ViewerMeter::end(TimePoint now) {
    counting_ = false;
    measured_.seconds = Seconds(now - began_).count();
    measured_.server_dropped = dropped_now_ - dropped_before_;
    measured_.commands_unshown = unseen_.size();
    measured_.samples.add(waiting(now));
    measured_.samples.age_ms = ages_.all();
}

Samples ViewerMeter::waiting(TimePoint now) const {
    Samples samples;
    if (const auto since = dueSince()) {
        samples.interval_ms.push_back(msOf(now - *since));
    }
    for (const Unseen& command : unseen_) {
        samples.reaction_ms.push_back(msOf(now - command.sent));
    }
    return samples;
}

Measured ViewerMeter::takeNew(TimePoint now) {
    if (counting_) {
        measured_.server_dropped = dropped_now_ - dropped_before_;
    }
    const Counts before = std::exchange(taken_, measured_);
    Measured fresh;
    static_cast<Counts&>(fresh) = measured_;
    subtract(fresh, before);
    const double seconds = counting_ ? Seconds(now - began_).count() : measured_.seconds;
    fresh.seconds = seconds - std::exchange(taken_seconds_, seconds);
    fresh.first_error = measured_.first_error;
    for (size_t index = 0; index < kSampleSeries.size(); ++index) {
        const auto& all = measured_.samples.*kSampleSeries[index].samples;
        const size_t known = std::exchange(taken_samples_[index], all.size());
        (fresh.samples.*kSampleSeries[index].samples)
            .assign(all.begin() + static_cast<ptrdiff_t>(known), all.end());
    }
    return fresh;
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

void ViewerMeter::onDepth(size_t bytes) {
    if (counting_) {
        ++measured_.depth_meshes;
        measured_.depth_bytes += bytes;
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
    Samples& samples = measured_.samples;
    samples.render_ms.push_back(msOfUs(header.render_us()));
    samples.encode_wait_ms.push_back(msOfUs(header.encode_wait_us()));
    samples.encode_ms.push_back(msOfUs(header.encode_us()));
    samples.send_wait_ms.push_back(msOfUs(header.send_wait_us()));
    if (header.has_gpu_us()) {
        samples.gpu_ms.push_back(msOfUs(header.gpu_us()));
    }
    if (latency_ms) {
        samples.queue_ms.push_back(msOfUs(header.queue_us()));
        samples.network_ms.push_back(*latency_ms - msOfUs(header.queue_us()) - stagesMs(header));
    }
}

void Samples::add(const Samples& other) {
    for (const SampleSeries& series : kSampleSeries) {
        auto& to = this->*series.samples;
        const auto& from = other.*series.samples;
        to.insert(to.end(), from.begin(), from.end());
    }
}

void Measured::add(const Measured& other) {
    samples.add(other.samples);
    for (const auto count : kCounts) {
        this->*count += other.*count;
    }
    for (const auto& [code, count] : other.errors_by_code) {
        errors_by_code[code] += count;
    }
    for (const auto& size : {other.smallest, other.largest}) {
        if (size) {
            addSize(*size);
        }
    }
    first_error = first_error ? first_error : other.first_error;
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

void ViewerMeter::onError(const v1::Error& error) {
    // The last of this number: cameras that were skipped have that of the next one sent.
    const auto refused = std::find_if(unseen_.rbegin(), unseen_.rend(), [&](const Unseen& one) {
        return one.seq == error.ref_seq();
    });
    if (refused != unseen_.rend()) {
        unseen_.erase(std::next(refused).base());
    }
    if (counting_) {
        ++measured_.errors;
        ++measured_.errors_by_code[error.code()];
        if (!measured_.first_error) {
            measured_.first_error = printable(error.message(), 200);
        }
    }
}

} // namespace froxel::load
