#include "load/load_run.h"

#include "core/assert.h"
#include "core/cpu_time.h"
#include "core/thread_name.h"

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>

#include <algorithm>
#include <condition_variable>
#include <latch>
#include <mutex>
#include <thread>
#include <utility>

namespace froxel::load {
namespace {

namespace asio = boost::asio;
using namespace std::chrono_literals;

// What is left at the end of a run is a second of its own from this on.
constexpr auto kLeastSecond = 500ms;

// A thread and the viewers that live on it: no lock is needed between them.
struct Crew {
    asio::io_context io{1};
    asio::executor_work_guard<asio::io_context::executor_type> work{io.get_executor()};
    std::vector<std::shared_ptr<Viewer>> viewers;
    std::jthread thread; // last: joins before what it runs goes
};

class Run {
  public:
    using EachSecond = std::function<bool(const RunSecond&)>;
    Run(const RunOptions& options, const std::stop_token& stop, const EachSecond& each_second)
        : options_(options), stop_(stop), each_second_(each_second), crews_(options.thread_count) {
        FROXEL_ASSERT(!options.visits.empty() && options.thread_count > 0, "an empty run");
        std::vector<uint32_t> shares;
        for (const ScriptShare& script : options.scripts) {
            shares.push_back(script.share);
        }
        const auto scripts = dealOut(shares, options.visits.size());
        for (uint32_t index = 0; index < options.visits.size(); ++index) {
            Crew& crew = crews_[index % crews_.size()];
            crew.viewers.push_back(std::make_shared<Viewer>(
                crew.io.get_executor(), options_.viewer,
                ViewerPlan{index + 1, options.scripts[scripts[index]].script, options.visits[index],
                           !options.measures_together},
                [this](Viewer::Event event) { onEvent(event); }));
        }
    }

    RunResult run() {
        start_ = Clock::now();
        last_look_ = start_;
        next_look_ = start_ + 1s;
        for (Crew& crew : crews_) {
            startCrew(crew);
        }
        TimePoint begin = start_;
        measuring_ = !options_.measures_together;
        if (options_.measures_together) {
            // Patience is the viewers' own: each has a first frame or fails in its time.
            watch(TimePoint::max(), [this] { return joined_ == count(); });
            begin = Clock::now();
            measuring_ = true;
            forAll([begin](Viewer& viewer) { viewer.begin(begin); });
        }
        const auto busy_before = processTime();
        const auto length = std::chrono::duration_cast<Clock::duration>(options_.seconds);
        // Who left as the stages say is no reason to end: a last stage may have no viewers at all.
        watch(begin + length, [this] { return failed_ == count(); });
        const TimePoint end = Clock::now();
        const Seconds busy = processTime() - busy_before;
        if (end - last_look_ >= kLeastSecond) {
            const bool ended_early = ended_early_;
            look();
            ended_early_ = ended_early; // it is over anyway
        }
        forAll([end](Viewer& viewer) { viewer.end(end); });
        {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [this] { return ended_ == count(); });
        }
        for (Crew& crew : crews_) {
            crew.io.stop(); // what is left are Beast's timers for connections that have ended
            crew.thread.join();
        }
        const Seconds measured = end - begin;
        return {collect(), measured.count(), stop_.stop_requested(), ended_early_,
                measured > Seconds(0) ? busy / measured : 0};
    }

  private:
    [[nodiscard]] uint32_t count() const { return static_cast<uint32_t>(options_.visits.size()); }

    void startCrew(Crew& crew) {
        for (const auto& viewer : crew.viewers) {
            viewer->start(start_);
        }
        crew.thread = std::jthread([&crew] {
            nameThread("viewers");
            crew.io.run();
        });
    }

    void onEvent(Viewer::Event event) {
        const std::lock_guard lock(mutex_);
        if (event == Viewer::Event::kJoined) {
            ++joined_;
        } else {
            ++ended_;
            failed_ += event == Viewer::Event::kFailed ? 1 : 0;
        }
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

    // Until `done`, `end`, a stop, or where each_second_ says so, whichever comes first.
    template <class Done>
    void watch(TimePoint end, Done done) {
        std::unique_lock lock(mutex_);
        while (!ended_early_) {
            changed_.wait_until(lock, stop_, std::min(next_look_, end), done);
            if (done() || stop_.stop_requested() || Clock::now() >= end) {
                return;
            }
            lock.unlock();
            look();
            lock.lock();
        }
    }

    // The viewers' changes, each taken on its own thread.
    void look() {
        const TimePoint now = Clock::now();
        RunSecond second;
        {
            const std::lock_guard lock(mutex_);
            second.measuring = measuring_;
            second.ended = ended_;
            second.joined = joined_;
        }
        second.elapsed = now - start_;
        second.length = now - last_look_;
        last_look_ = now;
        next_look_ = now + 1s;
        second.changes.resize(count());
        std::latch taken(static_cast<ptrdiff_t>(crews_.size()));
        for (size_t crew_index = 0; crew_index < crews_.size(); ++crew_index) {
            asio::post(crews_[crew_index].io, [this, crew_index, now, &second, &taken] {
                const Crew& crew = crews_[crew_index];
                for (size_t place = 0; place < crew.viewers.size(); ++place) {
                    second.changes[crew_index + place * crews_.size()] =
                        crew.viewers[place]->takeChange(now);
                }
                taken.count_down();
            });
        }
        taken.wait();
        ended_early_ = !each_second_(second);
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
    const EachSecond& each_second_;
    TimePoint start_;
    TimePoint last_look_;
    TimePoint next_look_;
    bool measuring_ = false;
    bool ended_early_ = false;
    std::mutex mutex_;
    std::condition_variable_any changed_;
    uint32_t joined_ = 0;
    uint32_t ended_ = 0; // left or failed
    uint32_t failed_ = 0;
    std::vector<Crew> crews_;
};

} // namespace

RunResult runLoad(const RunOptions& options,
                  const std::stop_token& stop,
                  const std::function<bool(const RunSecond&)>& each_second) {
    return Run(options, stop, each_second).run();
}

ViewerResult pool(const RunResult& result) {
    ViewerResult all;
    for (const ViewerResult& viewer : result.viewers) {
        all.measured.add(viewer.measured);
        all.received_bytes += viewer.received_bytes;
        all.sent_bytes += viewer.sent_bytes;
        all.key_frames += viewer.key_frames;
    }
    all.measured.seconds = result.seconds;
    return all;
}

} // namespace froxel::load
