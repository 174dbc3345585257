// What an operation on a socket takes, by types that do not grow. Beast's and Asio's operations
// carry the types of their handlers and buffers, and nest: TLS and TCP would be compiled again for
// each operation of HTTP and WebSocket that ends in them.
#pragma once

#include <boost/asio/buffer.hpp>
#include <boost/beast/core/error.hpp>

#include <array>
#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>

namespace froxel::transport {

// A handler, called once, of void(error_code, size_t) or of void(error_code). It is asked for no
// executor and no allocator of its own.
class IoEnd {
  public:
    template <class Handler>
    requires(!std::is_same_v<std::remove_cvref_t<Handler>, IoEnd>) explicit IoEnd(Handler&& handler)
        : held_(std::make_unique<Held<std::decay_t<Handler>>>(std::forward<Handler>(handler))) {}

    void operator()(boost::beast::error_code error, size_t bytes = 0) {
        std::exchange(held_, nullptr).release()->callAndDelete(error, bytes);
    }

  private:
    struct Holder {
        Holder() = default;
        Holder(const Holder&) = delete;
        Holder& operator=(const Holder&) = delete;
        virtual ~Holder() = default;
        virtual void callAndDelete(boost::beast::error_code error, size_t bytes) = 0;
    };
    template <class Handler>
    struct Held final : Holder {
        template <class From>
        explicit Held(From&& from) : handler(std::forward<From>(from)) {}
        // Memory goes before the call, which may begin the next operation.
        void callAndDelete(boost::beast::error_code error, size_t bytes) override {
            Handler called(std::move(handler));
            delete this;
            if constexpr (std::is_invocable_v<Handler&, boost::beast::error_code, size_t>) {
                called(error, bytes);
            } else {
                called(error);
            }
        }
        Handler handler;
    };
    std::unique_ptr<Holder> held_;
};

// The first of a sequence of buffers that have bytes: an operation on "some" may leave the rest.
template <class Buffer>
class IoBuffers {
  public:
    template <class Sequence>
    explicit IoBuffers(const Sequence& sequence) {
        const auto last = boost::asio::buffer_sequence_end(sequence);
        for (auto at = boost::asio::buffer_sequence_begin(sequence);
             at != last && count_ < buffers_.size(); ++at) {
            if (const Buffer buffer(*at); buffer.size() > 0) {
                buffers_[count_++] = buffer;
            }
        }
    }
    // Names of Asio's buffer sequences.
    [[nodiscard]] const Buffer* begin() const { return buffers_.data(); }
    [[nodiscard]] const Buffer* end() const { return buffers_.data() + count_; }

  private:
    std::array<Buffer, 16> buffers_;
    size_t count_ = 0;
};

} // namespace froxel::transport
