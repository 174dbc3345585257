#include "encode/encode_lane.h"

#include "core/assert.h"
#include "core/thread_name.h"
#include "encode/jpeg_encoder.h"
#include "encode/jpeg_stripes.h"
#include "encode/video_encoder.h"
#include "png/writer.h"

#include <algorithm>
#include <atomic>
#include <ctime>
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

// What this thread has worked so far.
std::chrono::microseconds threadTime() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return std::chrono::duration_cast<std::chrono::microseconds>(
        std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec));
}

} // namespace

// One picture in the lane. Stripes are taken under the lane's mutex; whoever finishes the last one
// joins them.
struct EncodeLane::Work {
    Work(EncodeJob its_job, TimePoint at) : job(std::move(its_job)), queued_at(at) {}

    void begin(size_t thread_count) {
        started_at = Clock::now();
        stripes = job.video || job.lossless
                      ? std::vector<PixelView>{job.pixels.view()}
                      : cutStripes(job.pixels.view(), job.encoding.chroma, thread_count);
        parts.resize(stripes.size());
    }
    void encode(JpegEncoder& encoder, size_t stripe) {
        const auto begin = threadTime();
        auto part = withinMemory([&] {
            return job.video      ? encodeVideo()
                   : job.lossless ? png::write(stripes[stripe])
                                  : encoder.encode(stripes[stripe], job.encoding);
        });
        if (part) {
            parts[stripe] = std::move(*part);
        } else if (!failed.exchange(true)) {
            error = part.error();
        }
        busy_us += (threadTime() - begin).count();
        if (finished.fetch_add(1) + 1 == stripes.size()) {
            auto frame = withinMemory([this] { return join(); });
            job.pixels.end();
            job.done(std::move(frame));
        }
    }
    Result<std::vector<std::byte>> encodeVideo() {
        const VideoJob& video = *job.video;
        auto frame =
            video.encoder->encode(job.pixels.view(), job.encoding, video.key, video.drawn_at);
        if (!frame) {
            return frame.error();
        }
        key = frame->key;
        return std::move(frame->bytes);
    }
    Result<EncodedFrame> join() {
        const PixelView pixels = job.pixels.view();
        auto picture = failed              ? Result<std::vector<std::byte>>(error)
                       : parts.size() == 1 ? std::move(parts.front())
                                           : joinStripes(parts, pixels.height_px);
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
        frame.busy_us = job.video ? frame.encode_us : static_cast<double>(busy_us);
        return frame;
    }

    EncodeJob job;
    TimePoint queued_at;
    TimePoint started_at{};
    std::vector<PixelView> stripes;
    std::vector<std::vector<std::byte>> parts; // of each stripe
    size_t taken = 0;                          // stripes that a thread has; under the mutex
    std::atomic<size_t> finished = 0;
    std::atomic<int64_t> busy_us = 0; // of all threads, before joining
    std::atomic<bool> failed = false;
    bool key = true; // of video; written before the last stripe is counted
    Error error;     // written once, by whom set `failed`; read after the last stripe
};

EncodeLane::EncodeLane(size_t thread_count, size_t queue_limit, int niceness)
    : queue_limit_(queue_limit) {
    FROXEL_ASSERT(thread_count > 0 && queue_limit > 0, "an encode lane needs threads and a queue");
    threads_.reserve(thread_count);
    for (size_t i = 0; i < thread_count; ++i) {
        // Made here, where a failure can still be thrown.
        threads_.emplace_back(
            [this, niceness, encoder = JpegEncoder()](const std::stop_token& stop) mutable {
                nameThread("encode");
                // On Linux of this thread alone, and of those that a video encoder starts on it.
                (void)nice(niceness);
                run(stop, encoder);
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
    {
        const std::lock_guard lock(mutex_);
        if (queue_.size() >= queue_limit_) {
            return false;
        }
        const auto first_lossless = std::find_if(
            queue_.begin(), queue_.end(), [](const auto& work) { return work->job.lossless; });
        const auto place = job.lossless ? queue_.end() : first_lossless;
        queue_.insert(place, std::make_shared<Work>(std::move(job), Clock::now()));
    }
    wake_.notify_one();
    return true;
}

bool EncodeLane::withdrawLossless(const void* owner) {
    std::shared_ptr<Work> withdrawn; // ends without the mutex
    const std::lock_guard lock(mutex_);
    const auto found = std::find_if(queue_.begin(), queue_.end(), [owner](const auto& work) {
        return work->job.lossless && work->job.owner == owner;
    });
    if (found == queue_.end()) {
        return false;
    }
    withdrawn = std::move(*found);
    queue_.erase(found);
    return true;
}

void EncodeLane::run(const std::stop_token& stop, JpegEncoder& encoder) {
    while (const auto share = takeShare(stop)) {
        share->work->encode(encoder, share->stripe);
    }
}

std::optional<EncodeLane::Share> EncodeLane::takeShare(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    ++idle_count_;
    wake_.wait(lock, stop, [this] { return !begun_.empty() || !queue_.empty(); });
    --idle_count_;
    if (begun_.empty()) {
        if (stop.stop_requested() || queue_.empty()) {
            return std::nullopt;
        }
        queue_.front()->begin(1 + idle_count_);
        begun_.push_back(std::move(queue_.front()));
        queue_.pop_front();
        wake_.notify_all();
    }
    Share share{begun_.front(), begun_.front()->taken++};
    if (share.work->taken == share.work->stripes.size()) {
        begun_.pop_front();
    }
    return share;
}

} // namespace froxel::encode
