// A mailbox of one: a newer value replaces an older one that nobody has taken yet.
#pragma once

#include <mutex>
#include <optional>
#include <utility>

namespace froxel {

template <class T>
class LatestSlot {
  public:
    // Returns whether an untaken value was replaced (and is lost by design).
    bool put(T value) {
        const std::lock_guard lock(mutex_);
        const bool replaced = value_.has_value();
        value_ = std::move(value);
        return replaced;
    }
    [[nodiscard]] std::optional<T> take() {
        const std::lock_guard lock(mutex_);
        return std::exchange(value_, std::nullopt);
    }
    [[nodiscard]] bool full() const {
        const std::lock_guard lock(mutex_);
        return value_.has_value();
    }

  private:
    mutable std::mutex mutex_;
    std::optional<T> value_;
};

} // namespace froxel
