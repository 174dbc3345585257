// Encoder threads of one priority with one bounded queue, first in first out but for lossless ones.
// A large picture is shared by as many threads as are idle when its turn comes, where its codec has
// parts.
#pragma once

#include "core/encoded_frame.h"
#include "encode/encoder.h"

#include <array>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <vector>

namespace froxel::encode {

// How a picture becomes the next frame of a video.
struct VideoJob {
    std::shared_ptr<Encoder> encoder; // in no other job meanwhile
    bool key = false;                 // a key frame is asked for
    TimePoint drawn_at{};
};

struct EncodeJob {
    PixelLease pixels;           // ends before `done` is called, so that rendering can go on
    settings::Encoding encoding; // lossless codecs wait behind the others, whose viewers move
    // Called once, on an encoder thread; must not throw and should return soon. Jobs of one viewer
    // may finish out of order when several are queued.
    std::function<void(Result<EncodedFrame>)> done;
    std::optional<VideoJob> video = std::nullopt; // with a codec whose frames depend on others
    const void* owner = nullptr;                  // whoever may withdraw it
    // What the picture is made of `pixels` by, on an encoder thread, before it is encoded; must not
    // throw, but for std::bad_alloc. None: they are the picture.
    std::function<PixelLease(PixelLease)> prepare = nullptr;

    [[nodiscard]] bool lossless() const { return settings::rowOf(encoding.codec).lossless; }
};

class EncodeLane {
  public:
    // niceness: how much its threads give way, as nice(2).
    EncodeLane(size_t thread_count, size_t queue_limit, int niceness);
    // Finishes jobs under way; those still queued get `done` with kCapacity, on this thread.
    ~EncodeLane();
    EncodeLane(const EncodeLane&) = delete;
    EncodeLane& operator=(const EncodeLane&) = delete;

    // Takes the job (moved from) and returns true, or leaves it untouched and returns false when
    // queue_limit jobs are waiting. Any thread.
    [[nodiscard]] bool submit(EncodeJob&& job);
    // Takes the owner's lossless job back, unless it was begun; `done` is not called. Any thread.
    [[nodiscard]] bool withdrawLossless(const void* owner);
    [[nodiscard]] size_t threadCount() const { return threads_.size(); }

  private:
    // A thread's own, of codecs whose frames stand alone.
    using Encoders = std::array<std::unique_ptr<Encoder>, settings::kCodecRows.size()>;
    struct Work;
    struct Share {
        std::shared_ptr<Work> work;
        size_t part = 0;
    };

    [[nodiscard]] static Encoders makeEncoders();
    void run(const std::stop_token& stop, const Encoders& own);
    // What to encode next; none: the pool stops. Waits.
    [[nodiscard]] std::optional<Share> takeShare(const std::stop_token& stop, const Encoders& own);

    const size_t queue_limit_;
    std::mutex mutex_;
    std::condition_variable_any wake_;
    std::deque<std::shared_ptr<Work>> queue_; // not begun
    std::deque<std::shared_ptr<Work>> begun_; // have parts that nobody has taken
    size_t idle_count_ = 0;
    std::vector<std::jthread> threads_; // last: stops before the queue goes
};

} // namespace froxel::encode
