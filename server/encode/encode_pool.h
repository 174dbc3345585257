// Encoder threads with one bounded queue, first in first out. When the queue is full, submit()
// refuses at once and never waits: the caller decides what to drop.
#pragma once

#include "core/clock.h"
#include "core/encoded_frame.h"
#include "core/error.h"
#include "core/pixel_view.h"
#include "view/settings.h"

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <stop_token>
#include <thread>
#include <vector>

namespace froxel::encode {

class JpegEncoder;

struct EncodeJob {
    PixelLease pixels; // ends before `done` is called, so that rendering can go on
    view::Encoding encoding;
    // Called once, on an encoder thread; must not throw and should return soon. Jobs of one viewer
    // may finish out of order when several are queued.
    std::function<void(Result<EncodedFrame>)> done;
};

class EncodePool {
  public:
    EncodePool(size_t thread_count, size_t queue_limit);
    // Finishes jobs under way; those still queued get `done` with kCapacity, on this thread.
    ~EncodePool();
    EncodePool(const EncodePool&) = delete;
    EncodePool& operator=(const EncodePool&) = delete;

    // Takes the job (moved from) and returns true, or leaves it untouched and returns false when
    // queue_limit jobs are waiting. Any thread.
    [[nodiscard]] bool submit(EncodeJob&& job);

  private:
    struct Queued {
        EncodeJob job;
        TimePoint at;
    };
    void work(const std::stop_token& stop, JpegEncoder& encoder);

    const size_t queue_limit_;
    std::mutex mutex_;
    std::condition_variable_any wake_;
    std::deque<Queued> queue_;
    std::vector<std::jthread> threads_; // last: stops before the queue goes
};

} // namespace froxel::encode
