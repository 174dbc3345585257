// Makes pipelines where nobody waits for them: on threads of its own, in turn for those who ask.
// Until start() they are made at once, by whoever asks.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <thread>
#include <utility>
#include <vector>

namespace froxel::render {

// A frame cannot be recorded yet: variants that it needs are being made.
struct VariantsMissing {};

class VariantMaker;

// What a recorded frame uses of the variants: kept until it has run, which pieces do long after
// others that were recorded later. One thread.
class VariantUses {
  public:
    VariantUses() = default;
    VariantUses(VariantMaker& maker, uint64_t since, std::vector<bool*> first_uses);
    ~VariantUses() { end(); }
    VariantUses(const VariantUses&) = delete;
    VariantUses& operator=(const VariantUses&) = delete;
    VariantUses(VariantUses&& other) noexcept { *this = std::move(other); }
    VariantUses& operator=(VariantUses&& other) noexcept;

    // Not all of it will run: what it was the first to use is still to be used for the first time.
    void giveUp() { first_uses_.clear(); }
    // All that will run of it has run: what it used is no longer new.
    void end();

  private:
    VariantMaker* maker_ = nullptr; // null: of no frame
    uint64_t since_ = 0;
    std::vector<bool*> first_uses_;
};

// All but the work itself on one thread.
class VariantMaker {
  public:
    VariantMaker() = default;
    ~VariantMaker() { stop(); }
    VariantMaker(const VariantMaker&) = delete;
    VariantMaker& operator=(const VariantMaker&) = delete;

    // niceness: how much the threads give way to others, as nice(2).
    void start(int niceness, unsigned thread_count);
    // Ends what is under way and forgets the rest; nothing is made from then on.
    void stop();
    [[nodiscard]] bool inBackground() const { return !threads_.empty(); }

    // Who asks from now on, in whose turn work is done.
    void setAsker(const void* asker) {
        asker_ = asker;
        ++recording_;
    }
    // Counts calls of setAsker(), from 1: what one recording asks for twice is posted once.
    [[nodiscard]] uint64_t recording() const { return recording_; }
    // Work that is not done yet, of one who asks.
    [[nodiscard]] bool busyFor(const void* asker) const;
    // Runs `make` on one of the threads; it must not throw.
    void post(std::function<void()> make);
    // The asker is gone: what was not begun for it is dropped.
    void forget(const void* asker);

    // See FirstUse::note(). `used` becomes true once this frame has run.
    void noteFirstUse(bool& used) { first_uses_.push_back(&used); }
    // In the recording that beginRecording() was called for.
    [[nodiscard]] size_t firstUses() const { return first_uses_.size(); }
    void beginRecording() { first_uses_.clear(); }
    // `since`: the timeline's value of a submission at that time, or an earlier one.
    [[nodiscard]] VariantUses endRecording(uint64_t since) {
        return {*this, since, std::exchange(first_uses_, {})};
    }
    // Variants used from then on are still used by frames that have not run. The highest value:
    // none.
    [[nodiscard]] uint64_t heldSince() const { return held_.empty() ? UINT64_MAX : *held_.begin(); }

  private:
    using Queues = std::map<const void*, std::deque<std::function<void()>>>;
    void run(const std::stop_token& stop);
    [[nodiscard]] Queues::iterator nextInTurn();

    const void* asker_ = nullptr;
    uint64_t recording_ = 1;
    std::vector<bool*> first_uses_;
    std::multiset<uint64_t> held_; // of frames that have not run
    friend class VariantUses;

    mutable std::mutex mutex_;
    std::condition_variable_any wake_;
    Queues queues_;                          // of an empty one some is under way
    size_t waiting_ = 0;                     // in all of them
    const void* last_ = nullptr;             // whose turn it was
    std::multiset<const void*> under_way_{}; // whose work is being done
    std::vector<std::jthread> threads_;
};

// Whether frames have drawn with a pipeline: a software device compiles it when the first one does.
// Keep it with the pipeline, as long as frames that use it.
class FirstUse {
  public:
    // It is recorded. Of a pipeline that no frame has drawn with, told once in a recording.
    void note(VariantMaker& maker) {
        if (!used_ && std::exchange(noted_in_, maker.recording()) != maker.recording()) {
            maker.noteFirstUse(used_);
        }
    }
    // Neither this recording nor a frame that has run has used it.
    [[nodiscard]] bool isNew(const VariantMaker& maker) const {
        return !used_ && noted_in_ != maker.recording();
    }

  private:
    bool used_ = false;     // by a frame that has run
    uint64_t noted_in_ = 0; // the last recording that used it before any had
};

} // namespace froxel::render
