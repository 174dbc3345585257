// What GET /metrics tells, in Prometheus' text format. Fed by connections as they send, never by
// the render thread. Any thread; a lock inside is held for a few additions.
#pragma once

#include "core/frame_stats.h"
#include "session/state_message.h"

#include <cstddef>
#include <memory>
#include <string>

namespace froxel::net {

class Metrics {
  public:
    static constexpr const char* kContentType = "text/plain; version=0.0.4; charset=utf-8";

    Metrics();
    ~Metrics();
    Metrics(const Metrics&) = delete;
    Metrics& operator=(const Metrics&) = delete;

    void sessionOpened();
    void sessionClosed();
    // A picture on its way to the socket, all stages known.
    void frameSent(const session::FrameRecord& record);
    // A picture that a newer one replaced unsent.
    void frameDropped();
    void bytesSent(size_t count);

    // The README lists the names.
    [[nodiscard]] std::string text() const;

  private:
    struct Impl;
    const std::unique_ptr<Impl> impl_;
};

} // namespace froxel::net
