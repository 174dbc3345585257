// Agones' SDK as a server sees it: the REST interface on 127.0.0.1, on a thread of its own. It
// keeps what it is told, and answers, refuses or says nothing.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace froxel::test {

class SdkMock {
  public:
    enum class Answer { kAccepts, kFails, kHangs };

    // `port` 0: any free one.
    explicit SdkMock(Answer answer = Answer::kAccepts, uint16_t port = 0);
    ~SdkMock();
    SdkMock(const SdkMock&) = delete;
    SdkMock& operator=(const SdkMock&) = delete;

    // One that nobody listens on.
    [[nodiscard]] static uint16_t freePort();

    [[nodiscard]] uint16_t port() const;
    void answer(Answer answer);

    // "POST /ready", in their order, but for those of health.
    [[nodiscard]] std::vector<std::string> calls() const;
    [[nodiscard]] size_t healthCount() const;
    // What the counter was set to last: "1/8"; empty before that.
    [[nodiscard]] std::string counter() const;
    // Whether this comes to be the last of calls() that is no counter's.
    [[nodiscard]] bool comesToState(const std::string& call) const;
    [[nodiscard]] bool comesToCounter(const std::string& value) const;

  private:
    struct Impl;
    const std::unique_ptr<Impl> impl_;
};

} // namespace froxel::test
