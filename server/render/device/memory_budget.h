// How much memory the views of a device may take, together and each. Asked before anything is
// allocated: a picture that would pass either limit is refused, and what was there stays. Render
// thread.
#pragma once

#include "core/error.h"

#include <cstdint>
#include <limits>
#include <string>

namespace froxel::render {

struct MemoryLimits {
    static constexpr uint64_t kNone = std::numeric_limits<uint64_t>::max();
    uint64_t device_bytes = kNone;  // scenes and all views
    uint64_t host_bytes = kNone;    // likewise of the host's, where that is not the device's
    uint64_t session_bytes = kNone; // one view, with what encodes its pictures, wherever it is
};

struct MemoryTaken {
    uint64_t device_bytes = 0;
    uint64_t host_bytes = 0; // 0 on a CPU device: all is the device's there
    [[nodiscard]] uint64_t total() const { return device_bytes + host_bytes; }
};

class MemoryBudget {
  public:
    explicit MemoryBudget(const MemoryLimits& limits = {}) : limits_(limits) {}
    MemoryBudget(const MemoryBudget&) = delete;
    MemoryBudget& operator=(const MemoryBudget&) = delete;

    // What views and scenes take.
    [[nodiscard]] uint64_t takenBytes() const { return scene_bytes_ + views_.total(); }

  private:
    friend class SceneMemory;
    friend class MemoryShare;
    const MemoryLimits limits_;
    uint64_t scene_bytes_ = 0;
    MemoryTaken views_;
};

// One scene's part, of the device's memory. The budget outlives it.
class SceneMemory {
  public:
    explicit SceneMemory(MemoryBudget& budget) : budget_(budget) {}
    ~SceneMemory() { budget_.scene_bytes_ -= bytes_; }
    SceneMemory(const SceneMemory&) = delete;
    SceneMemory& operator=(const SceneMemory&) = delete;

    // From now on the scene takes so much more, which is allocated already.
    void add(uint64_t bytes);
    // Errors: kCapacity, with the figures, and nothing changes. `what`: what the memory is for, in
    // words.
    [[nodiscard]] Result<void> take(uint64_t bytes, const std::string& what);
    [[nodiscard]] uint64_t bytes() const { return bytes_; }

  private:
    MemoryBudget& budget_;
    uint64_t bytes_ = 0;
};

// One view's part. The budget outlives it.
class MemoryShare {
  public:
    explicit MemoryShare(MemoryBudget& budget) : budget_(budget) {}
    ~MemoryShare() { replace({}); }
    MemoryShare(const MemoryShare&) = delete;
    MemoryShare& operator=(const MemoryShare&) = delete;

    // From now on the view takes `need`, in place of what it took before. Errors: kCapacity, with
    // the figures; it goes on to take as before. `picture`: what the memory is for, in words.
    [[nodiscard]] Result<void> take(const MemoryTaken& need, const std::string& picture);

  private:
    void replace(const MemoryTaken& taken);

    MemoryBudget& budget_;
    MemoryTaken taken_;
};

} // namespace froxel::render
