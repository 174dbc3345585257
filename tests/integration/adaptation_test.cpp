// A slow link between a viewer and a server, and a view that rests.
#include "integration/test_server.h"
#include "integration/ws_client.h"
#include "relay/relay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace froxel::test {
namespace {

using namespace std::chrono_literals;

struct Seen {
    Seconds age; // from the start of drawing to the last byte, against the freshest frame of all
    size_t bytes;
    v1::FrameHeader header;
};

// A viewer that tells frames' ages by the lights' clock, which runs as the test's does.
class Watcher {
  public:
    explicit Watcher(uint16_t port) : client_(port) { client_.join(); }

    std::vector<Seen> watch(Seconds time) {
        std::vector<Seen> seen;
        for (const TimePoint end = after(time); Clock::now() < end;) {
            seen.push_back(next());
        }
        for (Seen& frame : seen) {
            frame.age -= freshest_;
        }
        return seen;
    }
    // Until a frame is what was asked for; whether it came in time.
    bool wholeAgainWithin(Seconds time) {
        for (const TimePoint end = after(time); Clock::now() < end;) {
            const v1::FrameHeader header = next().header;
            if (header.rung() == 0 && header.scale() == 1 && header.quality() == 80) {
                return true;
            }
        }
        return false;
    }

  private:
    static TimePoint after(Seconds time) {
        return Clock::now() + std::chrono::duration_cast<Clock::duration>(time);
    }
    Seen next() {
        Frame frame = client_.expectFrame();
        const Seconds age = Clock::now() - began_ - Seconds(frame.header.time_s());
        freshest_ = std::min(freshest_, age);
        return {age, frame.jpeg.size(), std::move(frame.header)};
    }

    WsClient client_;
    TimePoint began_ = Clock::now();
    Seconds freshest_{1e9};
};

TEST(SlowLink, HalfOfWhatFullQualityNeeds_StaysFreshAndComesBack) {
    TestServer server({.size = {320, 180}});
    server.device().noisy = true;
    RelayOptions options{.port = server.port()};
    options.down = {TokenBucket::kUnlimited, 5ms, 32 * 1024};
    options.up.delay = 5ms;
    Relay relay(options);
    Watcher watcher(relay.port());

    const auto fast = watcher.watch(2s);
    ASSERT_GT(fast.size(), 30U);
    EXPECT_EQ(fast.back().header.rung(), 0U);
    EXPECT_EQ(fast.back().header.refinement(), v1::REFINEMENT_INTERACTIVE);
    double bytes = 0;
    for (const Seen& frame : fast) {
        bytes += static_cast<double>(frame.bytes) / static_cast<double>(fast.size());
    }

    // Of the thirty frames a second that a link has to carry.
    relay.setRate(TokenBucket::kUnlimited, bytes * 30 / 2);
    watcher.watch(4s);
    auto slow = watcher.watch(5s);
    EXPECT_GT(slow.back().header.rung(), 0U);
    EXPECT_LT(slow.back().header.quality(), 80U);
    EXPECT_GT(slow.back().header.link_bits_per_s(), 0U);
    EXPECT_GT(slow.size(), 75U) << "the rate is the last to give";
    std::sort(slow.begin(), slow.end(), [](auto& a, auto& b) { return a.age < b.age; });
    const Seconds p99 = slow[slow.size() * 99 / 100].age;
    RecordProperty("age_p99_ms", static_cast<int>(p99.count() * 1000));
    EXPECT_LT(p99, 250ms);

    relay.setRate(TokenBucket::kUnlimited, TokenBucket::kUnlimited);
    EXPECT_TRUE(watcher.wholeAgainWithin(3s));
}

TEST(Rest, LosslessAskedFor_ComesLastAndThenNothing) {
    TestServer server({.size = {160, 90}, .still = true});
    WsClient client(server.port());
    client.join();
    v1::ClientMessage message;
    message.mutable_set_delivery()->set_refine(v1::REFINE_LOSSLESS);
    const uint64_t seq = client.send(message);
    EXPECT_EQ(client.expectState(seq).refine(), v1::REFINE_LOSSLESS);
    const Frame high = client.expectFrame(
        [](const v1::FrameHeader& header) { return header.refinement() == v1::REFINEMENT_HIGH; });
    EXPECT_EQ(high.header.quality(), 92U);
    EXPECT_EQ(high.header.chroma(), v1::CHROMA_444);
    const Frame last = client.expectFrame();
    EXPECT_EQ(last.header.refinement(), v1::REFINEMENT_LOSSLESS);
    EXPECT_EQ(last.header.quality(), 0U);
    EXPECT_EQ(last.header.parts(0).codec(), v1::CODEC_PNG);
    EXPECT_EQ(last.jpeg[1], std::byte{'P'});
    const uint64_t bytes = client.receivedBytes();
    EXPECT_TRUE(client.quietFor(1s));
    EXPECT_EQ(client.receivedBytes(), bytes);

    // Input begins anew, with what moves.
    v1::ClientMessage exposure;
    exposure.mutable_set_exposure()->set_exposure(2);
    const uint64_t changed = client.send(exposure);
    const Frame first = client.expectFrame(
        [&](const v1::FrameHeader& header) { return header.applied_seq() == changed; });
    EXPECT_EQ(first.header.refinement(), v1::REFINEMENT_INTERACTIVE);
}

TEST(Rest, NotAskedFor_IsAsItWas) {
    TestServer server({.size = {160, 90}, .still = true});
    WsClient client(server.port());
    client.join();
    client.expectFrame();
    EXPECT_TRUE(client.quietFor(700ms));
}

} // namespace
} // namespace froxel::test
