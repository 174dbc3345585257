// Values as bytes, for another process of the same binary: numbers as they lie in memory, and of
// structs the members that fields.h has of them.
#pragma once

#include "bake/fields.h"
#include "core/kept_bytes.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace froxel::bake {

using ByteSink = std::function<void(std::span<const std::byte>)>;

template <class T>
inline constexpr bool kCopied = (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) ||
                                std::is_same_v<T, std::byte> || kAnyBits<T>;

class FlatWriter {
  public:
    // pool: bytes that whoever reads has before him; KeptBytes there are told by their place alone.
    explicit FlatWriter(const ByteSink& sink, std::span<const std::byte> pool = {})
        : sink_(sink), pool_(pool) {}

    template <class T>
    void put(const T& value) {
        if constexpr (kCopied<T>) {
            static_assert(std::is_trivially_copyable_v<T>);
            copy(&value, sizeof(T));
        } else if constexpr (std::is_same_v<T, bool>) {
            put(static_cast<uint8_t>(value));
        } else if constexpr (std::is_enum_v<T>) {
            put(static_cast<uint8_t>(value));
        } else {
            static_assert(HasFields<T>);
            std::apply([this](const auto&... field) { (put(field), ...); }, Fields<T>::of(value));
        }
    }
    void put(const std::string& text) {
        put(uint64_t{text.size()});
        copy(text.data(), text.size());
    }
    void put(const KeptBytes& bytes) {
        const std::byte* const first = bytes.span().data();
        const bool pooled = std::less_equal<>()(pool_.data(), first) &&
                            std::less<>()(first, pool_.data() + pool_.size());
        put(pooled);
        put(uint64_t{bytes.size()});
        if (pooled) {
            put(static_cast<uint64_t>(first - pool_.data()));
        } else {
            copy(first, bytes.size());
        }
    }
    template <class T>
    void put(const std::vector<T>& values) {
        put(uint64_t{values.size()});
        if constexpr (kCopied<T>) {
            copy(values.data(), values.size() * sizeof(T));
        } else {
            for (const T& value : values) {
                put(value);
            }
        }
    }
    template <class T>
    void put(const std::optional<T>& value) {
        put(value.has_value());
        if (value) {
            put(*value);
        }
    }
    template <class T>
    void put(const std::shared_ptr<const T>& value) {
        put(value != nullptr);
        if (value) {
            put(*value);
        }
    }
    void finish() { sink_(std::as_bytes(std::span(gathered_).first(gathered_count_))); }

  private:
    // Small pieces together, large ones as they are.
    void copy(const void* data, size_t size) {
        if (size > gathered_.size() - gathered_count_) {
            sink_(std::as_bytes(std::span(gathered_).first(gathered_count_)));
            gathered_count_ = 0;
        }
        if (size > gathered_.size()) {
            sink_({static_cast<const std::byte*>(data), size});
            return;
        }
        if (size > 0) {
            std::memcpy(gathered_.data() + gathered_count_, data, size);
            gathered_count_ += size;
        }
    }

    const ByteSink& sink_;
    std::span<const std::byte> pool_;
    std::array<std::byte, 1U << 16U> gathered_;
    size_t gathered_count_ = 0;
};

// Bytes that are not what was to be read.
class Broken : public std::exception {};

// Each get() throws Broken; std::bad_alloc. Takes memory in proportion to the bytes, whatever these
// say.
class FlatReader {
  public:
    // pool: as FlatWriter has it, with `keeper` of it.
    explicit FlatReader(std::span<const std::byte> bytes,
                        std::span<const std::byte> pool = {},
                        std::shared_ptr<const void> keeper = {})
        : rest_(bytes), pool_(pool), keeper_(std::move(keeper)) {}

    template <class T>
    void get(T& value) {
        if constexpr (kCopied<T>) {
            copy(&value, sizeof(T));
        } else if constexpr (std::is_same_v<T, bool>) {
            value = upTo(0, 1) == 1;
        } else if constexpr (std::is_enum_v<T>) {
            value = static_cast<T>(upTo(static_cast<uint8_t>(Values<T>::kFirst),
                                        static_cast<uint8_t>(Values<T>::kLast)));
        } else {
            static_assert(HasFields<T>);
            std::apply([this](auto&... field) { (get(field), ...); }, Fields<T>::of(value));
        }
    }
    void get(std::string& text) {
        text.resize(count(1));
        copy(text.data(), text.size());
    }
    void get(KeptBytes& bytes) {
        if (upTo(0, 1) == 0) {
            bytes.resize(count(1));
            copy(bytes.data(), bytes.size());
            return;
        }
        uint64_t size = 0;
        uint64_t offset = 0;
        get(size);
        get(offset);
        if (offset > pool_.size() || size > pool_.size() - offset) {
            throw Broken();
        }
        bytes = KeptBytes(pool_.subspan(offset, size), keeper_);
    }
    template <class T>
    void get(std::vector<T>& values) {
        if constexpr (kCopied<T>) {
            values.resize(count(sizeof(T)));
            copy(values.data(), values.size() * sizeof(T));
        } else {
            // One at a time: each takes a byte at least, and memory only once it is there.
            for (size_t left = count(1); left > 0; --left) {
                get(values.emplace_back());
            }
        }
    }
    template <class T>
    void get(std::optional<T>& value) {
        if (upTo(0, 1) == 1) {
            get(value.emplace());
        }
    }
    template <class T>
    void get(std::shared_ptr<const T>& value) {
        if (upTo(0, 1) == 1) {
            auto read = std::make_shared<T>();
            get(*read);
            value = std::move(read);
        }
    }
    [[nodiscard]] bool atEnd() const { return rest_.empty(); }

  private:
    size_t count(size_t bytes_each) {
        uint64_t number = 0;
        get(number);
        if (number > rest_.size() / bytes_each) {
            throw Broken();
        }
        return number;
    }
    uint8_t upTo(uint8_t least, uint8_t most) {
        uint8_t number = 0;
        get(number);
        if (number < least || number > most) {
            throw Broken();
        }
        return number;
    }
    void copy(void* data, size_t size) {
        if (size > rest_.size()) {
            throw Broken();
        }
        if (size > 0) {
            std::memcpy(data, rest_.data(), size);
        }
        rest_ = rest_.subspan(size);
    }

    std::span<const std::byte> rest_;
    std::span<const std::byte> pool_;
    std::shared_ptr<const void> keeper_;
};

} // namespace froxel::bake
