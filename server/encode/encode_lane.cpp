#include "encode/encode_lane.h"

#include "core/assert.h"
#include "core/cpu_time.h"
#include "core/thread_name.h"

#include <algorithm>
#include <atomic>
#include <new>
#include <type_traits>
#include <unistd.h>
#include <utility>

namespace froxel::encode {

namespace {

// A picture that memory does not suffice for is this viewer's loss alone.
template <class Make>
std::invoke_result_t<Make> withinMemory(const Make& make) {
    try {
        return make();
    } catch (const std::bad_alloc&) {
        return Error{ErrorCode::kCapacity, "no memory for the encoded picture"};
    }
}

} // namespace

// One picture in the lane. Its parts are taken under the lane's mutex; whoever finishes the last
// one joins them.
struct EncodeLane::Work {
    Work(EncodeJob its_job, TimePoint at) : job(std::move(its_job)), queued_at(at) {}

    [[nodiscard]] Encoder& encoderOf(const Encoders& own) const {
        return job.video ? *job.video->encoder : *own[static_cast<size_t>(job.encoding.codec)];
    }
    // Without the lane's mutex, by the thread that has taken it off the queue. False: the job has
    // ended.
    [[nodiscard]] bool prepare() {
        started_at = Clock::now();
        const auto begin = threadTime();
        const auto prepared = withinMemory([&]() -> Result<void> {
            job.pixels = job.prepare(std::move(job.pixels));
            return {};
        });
        busy_ns += (threadTime() - begin).count();
        if (!prepared) {
            job.pixels.end();
            job.done(prepared.error());
        }
        return prepared.has_value();
    }
    void begin(const Encoder& encoder, size_t thread_count) {
        started_at = job.prepare ? started_at : Clock::now();
        views = encoder.cut(job.pixels.view(), job.encoding, thread_count);
        parts.resize(views.size());
    }
    void encode(Encoder& encoder, size_t part) {
        const auto begin = threadTime();
        const VideoJob video = job.video.value_or(VideoJob{});
        auto encoded = withinMemory(
            [&] { return encoder.encode(views[part], job.encoding, video.key, video.drawn_at); });
        if (encoded) {
            parts[part] = std::move(encoded->bytes);
            if (!encoded->key) {
                key = false;
            }
        } else if (!failed.exchange(true)) {
            error = encoded.error();
        }
        busy_ns += (threadTime() - begin).count();
        if (finished.fetch_add(1) + 1 == views.size()) {
            auto frame = withinMemory([&] { return join(encoder); });
            job.pixels.end();
            job.done(std::move(frame));
        }
    }
    Result<EncodedFrame> join(const Encoder& encoder) {
        const PixelView pixels = job.pixels.view();
        auto picture = failed              ? Result<std::vector<std::byte>>(error)
                       : parts.size() == 1 ? std::move(parts.front())
                                           : encoder.join(parts, pixels.height_px);
        if (!picture) {
            return picture.error();
        }
        EncodedFrame frame;
        frame.width_px = pixels.width_px;
        frame.height_px = pixels.height_px;
        frame.bytes = std::make_shared<const std::vector<std::byte>>(std::move(*picture));
        frame.key = key;
        frame.wait_us = Microseconds(started_at - queued_at).count();
        frame.encode_us = Microseconds(Clock::now() - started_at).count();
        frame.busy_us = encoder.hasThreads()
                            ? frame.encode_us
                            : Microseconds(std::chrono::nanoseconds(busy_ns)).count();
        return frame;
    }

    EncodeJob job;
    TimePoint queued_at;
    TimePoint started_at{};
    std::vector<PixelView> views;
    std::vector<std::vector<std::byte>> parts; // of each view
    size_t taken = 0;                          // views that a thread has; under the mutex
    std::atomic<size_t> finished = 0;
    std::atomic<int64_t> busy_ns = 0; // of all threads, before joining
    std::atomic<bool> failed = false;
    std::atomic<bool> key = true; // all parts are
    Error error;                  // written once, by whom set `failed`; read after the last part
};

EncodeLane::EncodeLane(size_t thread_count, size_t queue_limit, int niceness)
    : queue_limit_(queue_limit) {
    FROXEL_ASSERT(thread_count > 0 && queue_limit > 0, "an encode lane needs threads and a queue");
    threads_.reserve(thread_count);
    for (size_t i = 0; i < thread_count; ++i) {
        // Made here, where a failure can still be thrown.
        threads_.emplace_back([this, niceness, own = makeEncoders()](const std::stop_token& stop) {
            nameThread("encode");
            // On Linux of this thread alone, and of those that a video encoder starts on it.
            (void)nice(niceness);
            run(stop, own);
        });
    }
}

EncodeLane::~EncodeLane() {
    for (std::jthread& thread : threads_) {
        thread.request_stop();
    }
    threads_.clear();
    for (const auto& work : queue_) {
        work->job.pixels.end();
        work->job.done(Error{ErrorCode::kCapacity, "the encoder is stopping"});
    }
}

bool EncodeLane::submit(EncodeJob&& job) {
    FROXEL_ASSERT(settings::rowOf(job.encoding.codec).frames_depend == job.video.has_value(),
                  "video alone brings its encoder");
    {
        const std::lock_guard lock(mutex_);
        if (queue_.size() >= queue_limit_) {
            return false;
        }
        const auto first_lossless = std::find_if(
            queue_.begin(), queue_.end(), [](const auto& work) { return work->job.lossless(); });
        const auto place = job.lossless() ? queue_.end() : first_lossless;
        queue_.insert(place, std::make_shared<Work>(std::move(job), Clock::now()));
    }
    wake_.notify_one();
    return true;
}

bool EncodeLane::withdrawLossless(const void* owner) {
    std::shared_ptr<Work> withdrawn; // ends without the mutex
    const std::lock_guard lock(mutex_);
    const auto found = std::find_if(queue_.begin(), queue_.end(), [owner](const auto& work) {
        return work->job.lossless() && work->job.owner == owner;
    });
    if (found == queue_.end()) {
        return false;
    }
    withdrawn = std::move(*found);
    queue_.erase(found);
    return true;
}

EncodeLane::Encoders EncodeLane::makeEncoders() {
    Encoders own;
    for (const settings::CodecRow& row : settings::kCodecRows) {
        if (!row.frames_depend) {
            own[static_cast<size_t>(row.codec)] = makeEncoder(row.codec, 1);
        }
    }
    return own;
}

void EncodeLane::run(const std::stop_token& stop, const Encoders& own) {
    while (const auto share = takeShare(stop, own)) {
        share->work->encode(share->work->encoderOf(own), share->part);
    }
}

std::optional<EncodeLane::Share> EncodeLane::takeShare(const std::stop_token& stop,
                                                       const Encoders& own) {
    std::unique_lock lock(mutex_);
    while (true) {
        ++idle_count_;
        wake_.wait(lock, stop, [this] { return !begun_.empty() || !queue_.empty(); });
        --idle_count_;
        if (begun_.empty()) {
            if (stop.stop_requested() || queue_.empty()) {
                return std::nullopt;
            }
            std::shared_ptr<Work> next = std::move(queue_.front());
            queue_.pop_front();
            if (next->job.prepare) {
                lock.unlock();
                const bool ready = next->prepare();
                lock.lock();
                if (!ready) {
                    continue;
                }
            }
            next->begin(next->encoderOf(own), 1 + idle_count_);
            begun_.push_back(std::move(next));
            wake_.notify_all();
        }
        Share share{begun_.front(), begun_.front()->taken++};
        if (share.work->taken == share.work->views.size()) {
            begun_.pop_front();
        }
        return share;
    }
}

} // namespace froxel::encode
