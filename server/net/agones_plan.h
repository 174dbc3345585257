// What Agones' SDK is to be told of a server, and when: what it should know, less what it knows.
// Pure; one thread.
#pragma once

#include "core/clock.h"
#include "net/facts.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace froxel::net {

// The server at a moment.
struct AgonesNews {
    bool started = false;  // device and scene are there
    bool draining = false; // no session begins any more
    bool over = false;     // nobody is served any more
    uint32_t sessions = 0; // a room is one
};

enum class AgonesTopic : uint8_t { kHealth, kState, kCounter };
inline constexpr size_t kAgonesTopics = 3;

// A request to the SDK's REST interface.
struct AgonesCall {
    AgonesTopic topic = AgonesTopic::kHealth;
    std::string_view method = "POST";
    std::string path;
    std::string body = "{}";
};

class AgonesPlan {
  public:
    static constexpr Seconds kRetryFirst{0.5};
    static constexpr Seconds kRetryMost{10};

    explicit AgonesPlan(uint32_t sessions_max) : sessions_max_(sessions_max) {}

    // None while nothing is due. A ping of health says that the server lives: whoever sends it has
    // asked.
    [[nodiscard]] std::optional<AgonesCall> next(const AgonesNews& news, TimePoint now) const;
    // It was accepted: it is not said again until something changes.
    void onAccepted(const AgonesCall& call, TimePoint now);
    // It is tried again, ever later.
    void onFailed(const AgonesCall& call, TimePoint now);
    // Whether the end was said and accepted.
    [[nodiscard]] bool saidEnd() const;
    // All that failed is due again, as when little time is left.
    void retryNow();
    // Nothing is said of health before this.
    void skipHealth(TimePoint now) { due(AgonesTopic::kHealth) = now + kAgonesHealthPeriod; }

  private:
    struct Topic {
        Seconds retry = kRetryFirst;
        TimePoint due{};
    };
    [[nodiscard]] std::string_view stateFor(const AgonesNews& news) const;
    [[nodiscard]] std::string counterFor(const AgonesNews& news) const;
    [[nodiscard]] TimePoint& due(AgonesTopic topic) {
        return topics_[static_cast<size_t>(topic)].due;
    }

    const uint32_t sessions_max_;
    std::array<Topic, kAgonesTopics> topics_;
    std::string told_state_; // the path of it
    std::string told_counter_;
};

} // namespace froxel::net
