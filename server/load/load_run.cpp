#include "load/load_run.h"

#include "core/assert.h"
#include "core/thread_name.h"

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

namespace froxel::load {
namespace {

namespace asio = boost::asio;
using namespace std::chrono_literals;

// A thread and the viewers that live on it: no lock is needed between them.
struct Crew {
    asio::io_context io{1};
    asio::executor_work_guard<asio::io_context::executor_type> work{io.get_executor()};
    std::vector<std::shared_ptr<Viewer>> viewers;
    std::jthread thread; // last: joins before what it runs goes
};

class Run {
  public:
    Run(const RunOptions& options, const std::stop_token& stop)
        : options_(options), stop_(stop), crews_(options.thread_count) {
        FROXEL_ASSERT(options.viewer_count > 0 && options.thread_count > 0, "an empty run");
        for (uint32_t index = 0; index < options.viewer_count; ++index) {
            Crew& crew = crews_[index % crews_.size()];
            crew.viewers.push_back(std::make_shared<Viewer>(
                crew.io.get_executor(), options_.viewer, index + 1, counters_,
                [this](Viewer::Event event) { onEvent(event); }));
        }
    }

    RunResult run(const std::function<void(const RunProgress&)>& each_second) {
        const TimePoint start = Clock::now();
        for (size_t index = 0; index < crews_.size(); ++index) {
            startCrew(crews_[index], index, start);
        }
        // Patience is the viewers' own: each has a first frame or fails in its time.
        watch(start, TimePoint::max(), each_second, [this] { return joined_ == count(); });
        const TimePoint begin = Clock::now();
        measuring_ = true;
        forAll([begin](Viewer& viewer) { viewer.begin(begin); });
        const auto length = std::chrono::duration_cast<Clock::duration>(options_.seconds);
        watch(begin, begin + length, each_second, [this] { return ended_ == count(); });
        const TimePoint end = Clock::now();
        forAll([end](Viewer& viewer) { viewer.end(end); });
        {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [this] { return ended_ == count(); });
        }
        for (Crew& crew : crews_) {
            crew.io.stop(); // what is left are Beast's timers for connections that have ended
            crew.thread.join();
        }
        return {collect(), Seconds(end - begin).count(), stop_.stop_requested()};
    }

  private:
    [[nodiscard]] uint32_t count() const { return options_.viewer_count; }

    void startCrew(Crew& crew, size_t crew_index, TimePoint start) {
        for (size_t place = 0; place < crew.viewers.size(); ++place) {
            const auto index = static_cast<double>(crew_index + place * crews_.size());
            const Seconds wait = options_.ramp * (index / count());
            crew.viewers[place]->connectAt(start +
                                           std::chrono::duration_cast<Clock::duration>(wait));
        }
        crew.thread = std::jthread([&crew] {
            nameThread("viewers");
            crew.io.run();
        });
    }

    void onEvent(Viewer::Event event) {
        const std::lock_guard lock(mutex_);
        ++(event == Viewer::Event::kJoined ? joined_ : ended_);
        changed_.notify_all();
    }

    template <class Work>
    void forAll(Work work) {
        for (Crew& crew : crews_) {
            asio::post(crew.io, [&crew, work] {
                for (const auto& viewer : crew.viewers) {
                    work(*viewer);
                }
            });
        }
    }

    // Until `done`, `end` or a stop, whichever comes first.
    template <class Done>
    void watch(TimePoint start,
               TimePoint end,
               const std::function<void(const RunProgress&)>& each_second,
               Done done) {
        std::unique_lock lock(mutex_);
        for (TimePoint tick = start + 1s;; tick += 1s) {
            changed_.wait_until(lock, stop_, std::min(tick, end), done);
            if (done() || stop_.stop_requested() || Clock::now() >= end) {
                return;
            }
            const RunProgress progress{measuring_, Clock::now() - start, joined_,
                                       ended_,     counters_.frames,     counters_.bytes};
            lock.unlock();
            each_second(progress);
            lock.lock();
        }
    }

    // In the order in which they were made: round the crews.
    std::vector<ViewerResult> collect() const {
        std::vector<ViewerResult> results;
        results.reserve(count());
        for (uint32_t index = 0; index < count(); ++index) {
            results.push_back(
                crews_[index % crews_.size()].viewers[index / crews_.size()]->result());
        }
        return results;
    }

    const RunOptions& options_;
    const std::stop_token& stop_;
    LiveCounters counters_;
    bool measuring_ = false;
    std::mutex mutex_;
    std::condition_variable_any changed_;
    uint32_t joined_ = 0;
    uint32_t ended_ = 0;
    std::vector<Crew> crews_;
};

} // namespace

RunResult runLoad(const RunOptions& options,
                  const std::stop_token& stop,
                  const std::function<void(const RunProgress&)>& each_second) {
    return Run(options, stop).run(each_second);
}

} // namespace froxel::load
