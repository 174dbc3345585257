// Makes pipelines where nobody waits for them: on a thread of its own, in turn for those who ask.
// Until start() they are made at once, by whoever asks.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <thread>
#include <vector>

namespace froxel::render {

// A frame cannot be recorded yet: variants that it needs are being made.
struct VariantsMissing {};

// All but the work itself on one thread.
class VariantMaker {
  public:
    VariantMaker() = default;
    ~VariantMaker() { stop(); }
    VariantMaker(const VariantMaker&) = delete;
    VariantMaker& operator=(const VariantMaker&) = delete;

    // niceness: how much the thread gives way to others, as nice(2).
    void start(int niceness);
    // Ends what is under way and forgets the rest; nothing is made from then on.
    void stop();
    [[nodiscard]] bool inBackground() const { return thread_.joinable(); }

    // Who asks from now on, in whose turn work is done.
    void setAsker(const void* asker) { asker_ = asker; }
    // Work that is not done yet, of one who asks.
    [[nodiscard]] bool busyFor(const void* asker) const;
    // Runs `make` on the thread; it must not throw.
    void post(std::function<void()> make);
    // The asker is gone: what was not begun for it is dropped.
    void forget(const void* asker);

    // A variant is recorded for the first time: a software device compiles it when it draws.
    void noteFirstUse(bool& used) { first_uses_.push_back(&used); }
    // In the recording that beginRecording() was called for.
    [[nodiscard]] size_t firstUses() const { return first_uses_.size(); }
    void beginRecording() { first_uses_.clear(); }
    // It came to nothing: they are still to be used for the first time.
    void giveUpRecording() {
        for (bool* used : first_uses_) {
            *used = false;
        }
        first_uses_.clear();
    }

  private:
    void run(const std::stop_token& stop);

    const void* asker_ = nullptr;
    std::vector<bool*> first_uses_;

    mutable std::mutex mutex_;
    std::condition_variable_any wake_;
    std::map<const void*, std::deque<std::function<void()>>> queues_; // empty: one is under way
    const void* last_ = nullptr;                                      // whose turn it was
    const void* under_way_ = nullptr;                                 // whose work is being done
    std::jthread thread_;
};

} // namespace froxel::render
