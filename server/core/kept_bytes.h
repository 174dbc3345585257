// Bytes that are one's own, or lie in memory that something else keeps.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace froxel {

// As a std::vector<std::byte>, but that copies of what is kept elsewhere share it. To change it
// makes it one's own, unless it was given to be filled. As thread-safe as a vector.
class KeptBytes {
  public:
    KeptBytes() = default;
    KeptBytes(std::vector<std::byte> own) // NOLINT(google-explicit-constructor)
        : own_(std::move(own)) {}
    explicit KeptBytes(size_t size, std::byte value = {}) : own_(size, value) {}
    // `bytes` stay as they are for as long as `keeper` lives.
    KeptBytes(std::span<const std::byte> bytes, std::shared_ptr<const void> keeper)
        : elsewhere_(bytes), keeper_(std::move(keeper)) {}

    // Likewise, but that whoever has it may fill them.
    KeptBytes(std::span<std::byte> room, std::shared_ptr<const void> keeper)
        : elsewhere_(room), room_(room.data()), keeper_(std::move(keeper)) {}

    [[nodiscard]] std::span<const std::byte> span() const {
        return keeper_ ? elsewhere_ : std::span<const std::byte>(own_);
    }
    operator std::span<const std::byte>() const { // NOLINT(google-explicit-constructor)
        return span();
    }
    [[nodiscard]] const std::byte* data() const { return span().data(); }
    [[nodiscard]] size_t size() const { return span().size(); }
    [[nodiscard]] bool empty() const { return span().empty(); }
    [[nodiscard]] const std::byte& operator[](size_t i) const { return span()[i]; }
    [[nodiscard]] auto begin() const { return span().begin(); }
    [[nodiscard]] auto end() const { return span().end(); }

    [[nodiscard]] std::vector<std::byte>& own() {
        if (keeper_) {
            own_.assign(elsewhere_.begin(), elsewhere_.end());
            room_ = nullptr;
            keeper_.reset();
        }
        return own_;
    }
    [[nodiscard]] std::span<std::byte> writable() {
        return room_ != nullptr ? std::span(room_, elsewhere_.size()) : std::span(own());
    }
    [[nodiscard]] std::byte* data() { return writable().data(); }
    [[nodiscard]] std::byte& operator[](size_t i) { return writable()[i]; }
    [[nodiscard]] auto begin() { return writable().begin(); }
    [[nodiscard]] auto end() { return writable().end(); }
    void resize(size_t size) { own().resize(size); }
    void assign(size_t size, std::byte value) { own().assign(size, value); }
    void clear() { own().clear(); }

    bool operator==(const KeptBytes& other) const {
        const auto left = span();
        const auto right = other.span();
        return std::equal(left.begin(), left.end(), right.begin(), right.end());
    }

  private:
    std::vector<std::byte> own_;
    std::span<const std::byte> elsewhere_;
    std::byte* room_ = nullptr;          // elsewhere_, where it may be filled
    std::shared_ptr<const void> keeper_; // of elsewhere_; null: own_
};

} // namespace froxel
