// A fixed set of threads that run one job together, many times a second.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace froxel::cluster {

// The caller's thread is member 0; the others sleep between jobs. One run() at a time.
class Crew {
  public:
    explicit Crew(unsigned members);
    ~Crew();
    Crew(const Crew&) = delete;
    Crew& operator=(const Crew&) = delete;

    [[nodiscard]] unsigned members() const { return static_cast<unsigned>(threads_.size()) + 1U; }
    // Calls job(member) once for each of the first `count` members and returns when all are done.
    // The job must not throw: an exception in it ends the program.
    void run(unsigned count, const std::function<void(unsigned member)>& job) noexcept;

  private:
    void work(unsigned member);

    std::mutex mutex_;
    std::condition_variable begin_;
    std::condition_variable done_;
    const std::function<void(unsigned)>* job_ = nullptr; // of the round in progress
    uint64_t round_ = 0;
    unsigned count_ = 0;     // members in this round
    unsigned remaining_ = 0; // of them, threads still at work
    bool stopping_ = false;
    std::vector<std::thread> threads_;
};

} // namespace froxel::cluster
