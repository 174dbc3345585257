// A connection's ReadBudget as Beast's RatePolicy (beast::basic_stream): what may not be read yet
// stays in the kernel, and so with who sends it. One strand.
#pragma once

#include "net/read_budget.h"

#include <boost/beast/core/rate_policy.hpp>

#include <functional>
#include <limits>
#include <utility>

namespace froxel::net {

class PacedReads {
  public:
    using Standing = ReadBudget::Standing;

    // A fresh budget, as of a new connection: what was read so far was of another kind. `told` is
    // called within a read, or a charge, that makes its standing worse.
    void begin(std::function<void(Standing)> told) {
        budget_ = {};
        told_ = std::move(told);
    }
    // A body whose bytes are counted elsewhere comes as fast as it can; what was read of it is
    // forgotten.
    void beginBody() { in_body_ = true; }
    void endBody() {
        in_body_ = false;
        budget_ = {};
    }
    [[nodiscard]] Standing standing() const { return budget_.standing(); }
    // Counts something by a function of ReadBudget.
    template <class... Args>
    void count(void (ReadBudget::*what)(Args...), Args... args) {
        const Standing before = budget_.standing();
        (budget_.*what)(args...);
        if (told_ && budget_.standing() != before) {
            told_(budget_.standing());
        }
    }

  private:
    friend class boost::beast::rate_policy_access;
    static constexpr size_t kAny = std::numeric_limits<size_t>::max();

    [[nodiscard]] size_t available_read_bytes() const {
        return in_body_ ? kAny : budget_.readable(Clock::now());
    }
    [[nodiscard]] static size_t available_write_bytes() noexcept { return kAny; }
    void transfer_read_bytes(size_t bytes) {
        if (!in_body_) {
            count(&ReadBudget::onBytes, bytes, Clock::now());
        }
    }
    static void transfer_write_bytes(size_t /*bytes*/) noexcept {}
    static void on_timer() noexcept {}

    ReadBudget budget_;
    bool in_body_ = false;
    std::function<void(Standing)> told_;
};

} // namespace froxel::net
