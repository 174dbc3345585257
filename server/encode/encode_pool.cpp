#include "encode/encode_pool.h"

#include "core/assert.h"
#include "encode/jpeg_encoder.h"

#include <utility>

namespace froxel::encode {
namespace {

Result<EncodedFrame> encodeOne(JpegEncoder& encoder, EncodeJob& job, TimePoint queued_at) {
    const TimePoint start = Clock::now();
    auto jpeg = encoder.encode(job.pixels.view(), job.encoding);
    if (!jpeg) {
        return jpeg.error();
    }
    EncodedFrame frame;
    frame.width_px = job.pixels.view().width_px;
    frame.height_px = job.pixels.view().height_px;
    frame.bytes = std::make_shared<const std::vector<std::byte>>(std::move(*jpeg));
    frame.wait_us = Microseconds(start - queued_at).count();
    frame.encode_us = Microseconds(Clock::now() - start).count();
    return frame;
}

} // namespace

EncodePool::EncodePool(size_t thread_count, size_t queue_limit) : queue_limit_(queue_limit) {
    FROXEL_ASSERT(thread_count > 0 && queue_limit > 0, "an encode pool needs threads and a queue");
    threads_.reserve(thread_count);
    for (size_t i = 0; i < thread_count; ++i) {
        // Made here, where a failure can still be thrown.
        threads_.emplace_back([this, encoder = JpegEncoder()](const std::stop_token& stop) mutable {
            work(stop, encoder);
        });
    }
}

EncodePool::~EncodePool() {
    for (std::jthread& thread : threads_) {
        thread.request_stop();
    }
    threads_.clear();
    for (Queued& queued : queue_) {
        queued.job.pixels.end();
        queued.job.done(Error{ErrorCode::kCapacity, "the encoder is stopping"});
    }
}

bool EncodePool::submit(EncodeJob&& job) {
    {
        const std::lock_guard lock(mutex_);
        if (queue_.size() >= queue_limit_) {
            return false;
        }
        queue_.push_back({std::move(job), Clock::now()});
    }
    wake_.notify_one();
    return true;
}

void EncodePool::work(const std::stop_token& stop, JpegEncoder& encoder) {
    for (;;) {
        std::unique_lock lock(mutex_);
        if (!wake_.wait(lock, stop, [this] { return !queue_.empty(); }) || stop.stop_requested()) {
            return;
        }
        Queued queued = std::move(queue_.front());
        queue_.pop_front();
        lock.unlock();
        auto frame = encodeOne(encoder, queued.job, queued.at);
        queued.job.pixels.end();
        queued.job.done(std::move(frame));
    }
}

} // namespace froxel::encode
