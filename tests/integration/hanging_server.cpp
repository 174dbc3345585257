// A server whose device takes the first piece and does not come back: hanging_server WAIT_MS
// WATCHDOG_MS. After the wait it says so, as a real one does; 0: never. As a driver may, it ends
// the process by SIGABRT when it is asked anything more, or what it uses is freed.
#include "app/log_setup.h"
#include "app/serve_end.h"
#include "stream/frame_source.h"

#include <cstdio>
#include <cstdlib>
#include <semaphore>

namespace froxel::test {
namespace {

class HangingView final : public stream::ViewSource {
  public:
    explicit HangingView(std::chrono::milliseconds wait) : wait_(wait) {}
    HangingView(const HangingView&) = delete;
    HangingView& operator=(const HangingView&) = delete;
    ~HangingView() override { std::abort(); }

    [[nodiscard]] bool canBegin() const override { return true; }
    [[nodiscard]] Result<FrameWork> begin(const settings::ViewSettings& /*settings*/,
                                          const stream::FrameTime& /*time*/,
                                          const stream::FrameTerms& /*terms*/) override {
        return FrameWork{Seconds(0), 2};
    }
    [[nodiscard]] Result<void> submitPiece() override { return {}; }
    void abandon() override { std::abort(); }
    [[nodiscard]] Result<stream::Collected> collect() override {
        if (asked_++ > 0) {
            std::abort();
        }
        std::puts("the device has a piece");
        std::fflush(stdout);
        std::binary_semaphore answer{0}; // which never comes
        if (wait_.count() == 0) {
            answer.acquire();
        }
        (void)answer.try_acquire_for(wait_);
        return Error{ErrorCode::kDevice, "the device did not finish"};
    }

  private:
    const std::chrono::milliseconds wait_;
    int asked_ = 0;
};

class HangingSource final : public stream::FrameSource {
  public:
    explicit HangingSource(std::chrono::milliseconds wait) : wait_(wait) {}
    HangingSource(const HangingSource&) = delete;
    HangingSource& operator=(const HangingSource&) = delete;
    ~HangingSource() override { std::abort(); }
    [[nodiscard]] uint32_t depth() const override { return 2; }
    [[nodiscard]] bool isHost() const override { return false; }
    [[nodiscard]] Result<std::unique_ptr<stream::ViewSource>> makeView() override {
        return std::unique_ptr<stream::ViewSource>(std::make_unique<HangingView>(wait_));
    }

  private:
    const std::chrono::milliseconds wait_;
};

int serve(std::chrono::milliseconds wait, std::chrono::milliseconds watchdog) {
    net::StopSignal stop;
    LatestSlot<Error> failure;
    app::ServeRunOptions options;
    options.server.admin = {"127.0.0.1", 0};
    options.server.lobby.sessions_max = 4;
    options.open = [&](const auto& /*report*/) {
        session::SessionContext context;
        context.scene.name = "fake";
        context.scene.cameras = {{"front", settings::lookAt({0, 0, 5}, {0, 0, 0}, {0, 1, 0})}};
        context.defaults.settings.size = {64, 48};
        return app::OpenedScene{std::make_unique<HangingSource>(wait), context,
                                [] { return std::vector<MemoryUse>{}; }, Seconds(watchdog)};
    };
    options.on_failure = [&](const Error& error) {
        failure.put(error);
        stop.request();
    };
    std::optional<app::ServeRun> run;
    run.emplace(std::move(options));
    std::printf("http://127.0.0.1:%u/\n", run->port());
    std::fflush(stdout);
    return app::serveUntilEnd(run, stop, failure, std::chrono::seconds(1));
}

} // namespace
} // namespace froxel::test

int main(int count, char** arguments) {
    if (count != 3) {
        return EXIT_FAILURE;
    }
    const auto at = [&](int index) {
        return std::chrono::milliseconds(std::atoi(arguments[index]));
    };
    froxel::app::startLog(froxel::app::LogLevel::kInfo, froxel::app::LogFormat::kText);
    return froxel::test::serve(at(1), at(2));
}
