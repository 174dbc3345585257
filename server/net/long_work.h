// Threads for what takes long and is one connection's matter: reading long messages, and writing
// them. Of low priority, so that pictures and everybody's short messages go first. Any thread.
#pragma once

#include "core/clock.h"
#include "core/cpu_time.h"

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>

#include <cstdint>
#include <thread>
#include <utility>
#include <vector>

namespace froxel::net {

class LongWork {
  public:
    // Messages of up to so many bytes are no long work.
    static constexpr size_t kShortBytes = 2048;

    explicit LongWork(uint32_t thread_count);
    // What has not begun is dropped.
    ~LongWork();
    LongWork(const LongWork&) = delete;
    LongWork& operator=(const LongWork&) = delete;

    // Has `work` done, which must not throw. What has not begun at the end is never done.
    template <class Work>
    void post(Work work) {
        boost::asio::post(io_, std::move(work));
    }
    // Has `work` done, then `then(its result, what it took)` on `home`, which goes on meanwhile.
    // `work` must not throw.
    template <class Executor, class Work, class Then>
    void run(const Executor& home, Work work, Then then) {
        boost::asio::post(io_, [home = boost::asio::make_work_guard(home), work = std::move(work),
                                then = std::move(then)]() mutable {
            const Seconds before = threadTime();
            auto result = work();
            boost::asio::post(
                home.get_executor(),
                [result = std::move(result), took = threadTime() - before,
                 then = std::move(then)]() mutable { then(std::move(result), took); });
        });
    }

  private:
    boost::asio::io_context io_;
    boost::asio::executor_work_guard<boost::asio::io_context::executor_type> open_;
    std::vector<std::jthread> threads_;
};

} // namespace froxel::net
