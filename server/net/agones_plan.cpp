#include "net/agones_plan.h"

#include "core/text.h"

#include <algorithm>

namespace froxel::net {
namespace {

constexpr std::string_view kHealth = "/health";
constexpr std::string_view kReady = "/ready";
constexpr std::string_view kAllocate = "/allocate";
constexpr std::string_view kShutdown = "/shutdown";
constexpr std::string_view kCounters = "/v1beta1/counters/";

} // namespace

// Allocated servers are left alone when a fleet shrinks or is renewed: so one is from its first
// viewer to its last, whoever sent them.
std::string_view AgonesPlan::stateFor(const AgonesNews& news) const {
    if (news.over) {
        return kShutdown;
    }
    if (!news.started) {
        return {};
    }
    if (told_state_.empty()) {
        return kReady; // once, before anything else
    }
    if (news.sessions > 0) {
        return kAllocate;
    }
    return news.draining ? std::string_view(told_state_) : kReady;
}

// A server that drains has no room for one more.
std::string AgonesPlan::counterFor(const AgonesNews& news) const {
    const uint32_t capacity =
        news.draining ? news.sessions : std::max(sessions_max_, news.sessions);
    return R"({"count":")" + numberText(news.sessions) + R"(","capacity":")" +
           numberText(capacity) + R"("})";
}

std::optional<AgonesCall> AgonesPlan::next(const AgonesNews& news, TimePoint now) const {
    const auto is_due = [&](AgonesTopic topic) {
        return topics_[static_cast<size_t>(topic)].due <= now;
    };
    if (const std::string_view state = stateFor(news);
        !state.empty() && state != told_state_ && is_due(AgonesTopic::kState)) {
        return AgonesCall{.topic = AgonesTopic::kState, .path = std::string(state)};
    }
    if (news.over) {
        return {};
    }
    if (is_due(AgonesTopic::kHealth)) {
        return AgonesCall{.topic = AgonesTopic::kHealth, .path = std::string(kHealth)};
    }
    if (std::string counter = counterFor(news);
        news.started && counter != told_counter_ && is_due(AgonesTopic::kCounter)) {
        return AgonesCall{AgonesTopic::kCounter, "PATCH",
                          std::string(kCounters) + std::string(kAgonesCounter), std::move(counter)};
    }
    return {};
}

void AgonesPlan::onAccepted(const AgonesCall& call, TimePoint now) {
    topics_[static_cast<size_t>(call.topic)] = {};
    switch (call.topic) {
    case AgonesTopic::kHealth:
        skipHealth(now);
        break;
    case AgonesTopic::kState:
        told_state_ = call.path;
        break;
    case AgonesTopic::kCounter:
        told_counter_ = call.body;
        break;
    }
}

bool AgonesPlan::saidEnd() const {
    return told_state_ == kShutdown;
}

void AgonesPlan::onFailed(const AgonesCall& call, TimePoint now) {
    Topic& topic = topics_[static_cast<size_t>(call.topic)];
    topic.due = now + std::chrono::duration_cast<Clock::duration>(topic.retry);
    topic.retry = std::min(2 * topic.retry, kRetryMost);
}

void AgonesPlan::retryNow() {
    topics_ = {};
}

} // namespace froxel::net
