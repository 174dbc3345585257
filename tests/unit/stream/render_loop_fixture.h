#pragma once

#include "stream/render_loop.h"
#include "support/fake_frame_source.h"
#include "support/recording_sink.h"

#include <gtest/gtest.h>

#include <future>
#include <memory>

namespace froxel::stream {

using test::RecordingSink;

inline constexpr uint64_t kPlenty = 1000;

// A render loop over a fake device.
class RenderLoopTest : public testing::Test {
  protected:
    void start(Seconds min_frame_interval = Seconds(0)) {
        RenderLoopOptions options;
        options.min_frame_interval = min_frame_interval;
        options.fates = fates_;
        options.means_bytes = means_bytes_;
        options.make_source = [this] { return test::makeFakeSource(device_); };
        options.on_failure = [this](const Error& error) { failure_.set_value(error); };
        loop_ = std::make_unique<RenderLoop>(pool_, std::move(options));
    }
    session::SessionState still() {
        auto state = session::initialState(context_, Clock::now());
        state.settings.size = {32, 16};
        state.light_clock = state.light_clock.withRate(Clock::now(), 1, false);
        return state;
    }
    session::SessionState moving() {
        auto state = still();
        state.light_clock = state.light_clock.withRate(Clock::now(), 1, true);
        return state;
    }
    session::SessionId join(const std::shared_ptr<RecordingSink>& sink,
                            const session::SessionState& state,
                            uint64_t credits) {
        const auto id = loop_->join(sink, state, {"a"}, Clock::now()).value();
        loop_->grant(id, credits);
        return id;
    }
    static std::shared_ptr<RecordingSink> makeSink() { return std::make_shared<RecordingSink>(); }

    // Everything that was said before has been heard: a viewer that joins now gets its picture.
    void settle() {
        const auto sink = makeSink();
        const auto id = join(sink, still(), 1);
        ASSERT_TRUE(sink->waitForFrames(1));
        loop_->leave(id);
    }

    session::SessionContext context_;
    std::shared_ptr<test::FakeDevice> device_ = std::make_shared<test::FakeDevice>();
    std::shared_ptr<FrameFates> fates_ = std::make_shared<FrameFates>();
    std::promise<Error> failure_;
    encode::EncodePool pool_{2, 8};
    uint64_t means_bytes_ = RenderLoopOptions{}.means_bytes;
    std::unique_ptr<RenderLoop> loop_;
};

} // namespace froxel::stream
