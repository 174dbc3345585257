#include "encode/encode_pool.h"
#include "encode/jpeg_encoder.h"
#include "unit/encode/picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <future>
#include <memory>
#include <new>
#include <sys/resource.h>
#include <thread>
#include <unistd.h>

namespace froxel::encode {
namespace {

constexpr settings::Encoding kEncoding{80, settings::Chroma::k420};

EncodeJob job(PixelLease pixels, std::function<void(Result<EncodedFrame>)> done) {
    return {std::move(pixels), kEncoding, std::move(done)};
}

settings::Codec codecOf(bool lossless) {
    return lossless ? settings::kLosslessCodec : settings::kPlainCodec;
}

// An encoder thread that waits in a job's `done` until told to go on.
class HeldThread {
  public:
    explicit HeldThread(EncodePool& pool, bool patient = false) {
        auto entered = std::make_shared<std::promise<void>>();
        auto go = gate_.get_future().share();
        auto held = job({}, [entered, go](const Result<EncodedFrame>&) {
            entered->set_value();
            go.wait();
        });
        held.encoding.codec = codecOf(patient);
        EXPECT_TRUE(pool.submit(std::move(held)));
        entered->get_future().wait();
    }
    void release() { gate_.set_value(); }

  private:
    std::promise<void> gate_;
};

// On an encoder's thread; what it made of the pixels is encoded.
TEST(EncodePool, Prepare_MakesThePicture) {
    const Picture picture = makePicture(64, 48);
    std::promise<Result<EncodedFrame>> promise;
    EncodePool pool(2, 4);
    auto prepared = job({}, [&](Result<EncodedFrame> frame) { promise.set_value(frame); });
    const auto caller = std::this_thread::get_id();
    prepared.prepare = [&](const PixelLease& /*pixels*/) {
        EXPECT_NE(std::this_thread::get_id(), caller);
        return PixelLease(picture.view(), [] {});
    };
    ASSERT_TRUE(pool.submit(std::move(prepared)));
    const EncodedFrame frame = promise.get_future().get().value();
    EXPECT_EQ(*frame.bytes, JpegEncoder().encode(picture.view(), kEncoding).value());
}

// A viewer who compares does not keep the pictures of others waiting.
TEST(EncodePool, WhatIsPrepared_HasThreadsOfItsOwn) {
    const Picture picture = makePicture(64, 48);
    EncodePool pool(1, 4);
    std::promise<void> go;
    std::promise<void> slow_done;
    auto slow =
        job({picture.view(), [] {}}, [&](const Result<EncodedFrame>&) { slow_done.set_value(); });
    slow.prepare = [&go](PixelLease pixels) {
        go.get_future().wait();
        return pixels;
    };
    ASSERT_TRUE(pool.submit(std::move(slow)));
    std::promise<void> quick;
    ASSERT_TRUE(pool.submit(
        job({picture.view(), [] {}}, [&](const Result<EncodedFrame>&) { quick.set_value(); })));
    quick.get_future().wait();
    go.set_value();
    slow_done.get_future().wait();
}

TEST(EncodePool, PrepareWithoutMemory_FailsThatJobAlone) {
    const Picture picture = makePicture(64, 48);
    std::promise<Result<EncodedFrame>> failed;
    std::promise<Result<EncodedFrame>> next;
    EncodePool pool(1, 4);
    auto greedy =
        job({picture.view(), [] {}}, [&](Result<EncodedFrame> frame) { failed.set_value(frame); });
    greedy.prepare = [](const PixelLease& /*pixels*/) -> PixelLease { throw std::bad_alloc(); };
    ASSERT_TRUE(pool.submit(std::move(greedy)));
    ASSERT_TRUE(pool.submit(
        job({picture.view(), [] {}}, [&](Result<EncodedFrame> frame) { next.set_value(frame); })));
    EXPECT_EQ(failed.get_future().get().error().code, ErrorCode::kCapacity);
    EXPECT_TRUE(next.get_future().get());
}

TEST(EncodePool, Job_GivesTheEncodersBytes) {
    const Picture picture = makePicture(64, 48);
    std::promise<Result<EncodedFrame>> promise;
    EncodePool pool(2, 4);
    ASSERT_TRUE(pool.submit(job({picture.view(), [] {}},
                                [&](Result<EncodedFrame> frame) { promise.set_value(frame); })));
    const EncodedFrame frame = promise.get_future().get().value();
    EXPECT_EQ(frame.width_px, 64U);
    EXPECT_EQ(frame.height_px, 48U);
    EXPECT_GT(frame.encode_us, 0);
    EXPECT_GE(frame.wait_us, 0);
    EXPECT_GT(frame.busy_us, 0);
    EXPECT_EQ(*frame.bytes, JpegEncoder().encode(picture.view(), kEncoding).value());
}

TEST(EncodePool, VideoJobs_ContinueTheirEncodersStream) {
    const Picture picture = makePicture(640, 400); // enough for stripes, were it a JPEG
    settings::Encoding encoding;
    encoding.codec = settings::Codec::kVp9;
    const auto encoder = std::shared_ptr(makeEncoder(settings::Codec::kVp9, 1));
    EncodePool pool(2, 4);
    std::vector<bool> keys;
    for (int i = 0; i < 3; ++i) {
        std::promise<Result<EncodedFrame>> promise;
        EncodeJob video{{picture.view(), [] {}},
                        encoding,
                        [&](Result<EncodedFrame> frame) { promise.set_value(std::move(frame)); },
                        VideoJob{encoder, i == 2, TimePoint() + std::chrono::seconds(i)}};
        ASSERT_TRUE(pool.submit(std::move(video)));
        const EncodedFrame frame = promise.get_future().get().value();
        EXPECT_FALSE(frame.bytes->empty());
        EXPECT_EQ(frame.width_px, 640U);
        keys.push_back(frame.key);
    }
    EXPECT_EQ(keys, (std::vector<bool>{true, false, true}));
}

TEST(EncodePool, Lease_EndsBeforeDone) {
    const Picture picture = makePicture(16, 16);
    std::atomic<bool> ended = false;
    std::promise<bool> ended_at_done;
    EncodePool pool(1, 1);
    ASSERT_TRUE(
        pool.submit(job({picture.view(), [&] { ended = true; }},
                        [&](const Result<EncodedFrame>&) { ended_at_done.set_value(ended); })));
    EXPECT_TRUE(ended_at_done.get_future().get());
}

TEST(EncodePool, FullQueue_RefusesAndLeavesTheJobUntouched) {
    const Picture picture = makePicture(16, 16);
    int ended = 0;
    EncodePool pool(1, 2);
    HeldThread held(pool);
    std::atomic<int> done = 0;
    const auto count = [&](const Result<EncodedFrame>&) { ++done; };
    EXPECT_TRUE(pool.submit(job({}, count)));
    EXPECT_TRUE(pool.submit(job({}, count)));
    EncodeJob refused = job({picture.view(), [&] { ++ended; }}, count);
    EXPECT_FALSE(pool.submit(std::move(refused)));
    EXPECT_EQ(refused.pixels.view().width_px, 16U);
    EXPECT_TRUE(refused.done);
    EXPECT_EQ(ended, 0);
    held.release();
}

TEST(EncodePool, EmptyPixels_GiveAnError) {
    std::promise<Result<EncodedFrame>> promise;
    EncodePool pool(1, 1);
    ASSERT_TRUE(
        pool.submit(job({}, [&](Result<EncodedFrame> frame) { promise.set_value(frame); })));
    EXPECT_EQ(promise.get_future().get().error().code, ErrorCode::kInvalidArgument);
}

TEST(EncodePool, Stopping_EveryAcceptedJobHearsOnce) {
    const Picture picture = makePicture(320, 200);
    constexpr int kJobs = 50;
    std::atomic<int> finished = 0;
    std::atomic<int> cancelled = 0;
    std::atomic<int> ended = 0;
    {
        EncodePool pool(2, kJobs);
        for (int i = 0; i < kJobs; ++i) {
            ASSERT_TRUE(pool.submit(
                job({picture.view(), [&] { ++ended; }},
                    [&](const Result<EncodedFrame>& frame) { ++(frame ? finished : cancelled); })));
        }
    }
    EXPECT_EQ(finished + cancelled, kJobs);
    EXPECT_EQ(ended, kJobs);
}

TEST(EncodePool, OneThread_KeepsTheOrder) {
    const Picture picture = makePicture(32, 32);
    std::vector<int> order;
    std::promise<void> last;
    {
        EncodePool pool(1, 10);
        for (int i = 0; i < 10; ++i) {
            ASSERT_TRUE(pool.submit(job({picture.view(), [] {}}, [&, i](const auto&) {
                order.push_back(i);
                if (i == 9) {
                    last.set_value();
                }
            })));
        }
        last.get_future().wait();
    }
    EXPECT_TRUE(std::is_sorted(order.begin(), order.end()));
    EXPECT_EQ(order.size(), 10U);
}

TEST(EncodePool, WithdrawLossless_TakesBackTheOwnersThatWaits_AndNothingElse) {
    const Picture picture = makePicture(16, 16);
    EncodePool pool(1, 4);
    HeldThread quick(pool);
    HeldThread patient(pool, true);
    std::atomic<int> done = 0;
    std::atomic<int> leases = 0;
    const auto submit = [&](const void* owner, bool lossless) {
        EncodeJob next =
            job({picture.view(), [&] { ++leases; }}, [&](Result<EncodedFrame>) { ++done; });
        next.encoding.codec = codecOf(lossless);
        next.owner = owner;
        ASSERT_TRUE(pool.submit(std::move(next)));
    };
    submit(&done, false);
    submit(&done, true);
    submit(&leases, true);
    EXPECT_TRUE(pool.withdrawLossless(&done));
    EXPECT_EQ(leases, 1) << "its pixels are free at once";
    EXPECT_FALSE(pool.withdrawLossless(&done)) << "the JPEG stays";
    EXPECT_FALSE(pool.withdrawLossless(nullptr));
    quick.release();
    patient.release();
    while (leases < 3 || done < 2) { // the JPEG and the other's PNG
        std::this_thread::yield();
    }
    EXPECT_EQ(done, 2);
}

// The one thread of the other lane stands still meanwhile.
TEST(EncodePool, LargeAndLossless_DoNotKeepOthersWaiting) {
    EncodePool pool(1, 8);
    HeldThread held(pool, true);
    const Picture picture = makePicture(40, 30);
    const Picture large = makePicture(2100, 2000);
    std::atomic<int> patient = 0;
    std::promise<void> quick;
    const auto count = [&](const Result<EncodedFrame>& frame) { patient += frame ? 1 : 0; };
    auto lossless = job({picture.view(), nullptr}, count);
    lossless.encoding.codec = settings::kLosslessCodec;
    ASSERT_TRUE(pool.submit(std::move(lossless)));
    ASSERT_TRUE(pool.submit(job({large.view(), nullptr}, count)));
    ASSERT_TRUE(pool.submit(
        job({picture.view(), nullptr}, [&](const Result<EncodedFrame>&) { quick.set_value(); })));
    quick.get_future().wait();
    EXPECT_EQ(patient, 0);
    held.release();
    while (patient < 2) {
        std::this_thread::yield();
    }
}

TEST(EncodePool, LargeAndLossless_RunAtALowerPriority) {
    EncodePool pool(1, 8);
    const Picture picture = makePicture(40, 30);
    for (const bool lossless : {false, true}) {
        std::promise<int> niceness;
        auto next = job({picture.view(), nullptr}, [&](const Result<EncodedFrame>&) {
            niceness.set_value(getpriority(PRIO_PROCESS, static_cast<id_t>(gettid())));
        });
        next.encoding.codec = codecOf(lossless);
        ASSERT_TRUE(pool.submit(std::move(next)));
        const int own = getpriority(PRIO_PROCESS, 0);
        const int expected = lossless ? std::min(own + 10, 19) : own;
        EXPECT_EQ(niceness.get_future().get(), expected);
    }
}

TEST(EncodePool, Lossless_IsAPngBehindWhatMoves) {
    EncodePool pool(1, 8);
    const Picture small = makePicture(40, 30);
    const Picture large = makePicture(2100, 2000);
    std::vector<std::string> order;
    std::promise<void> all;
    {
        HeldThread held(pool, true);
        for (const bool lossless : {true, false, true, false}) {
            const Picture& picture = lossless ? small : large;
            auto next = job({picture.view(), nullptr}, [&, lossless](Result<EncodedFrame> frame) {
                const auto& bytes = *frame.value().bytes;
                const bool png = bytes[1] == std::byte{'P'} && bytes[2] == std::byte{'N'};
                EXPECT_EQ(png, lossless);
                order.emplace_back(png ? "png" : "jpeg");
                if (order.size() == 4) {
                    all.set_value();
                }
            });
            next.encoding.codec = codecOf(lossless);
            ASSERT_TRUE(pool.submit(std::move(next)));
        }
        held.release();
    }
    all.get_future().wait();
    EXPECT_EQ(order, (std::vector<std::string>{"jpeg", "jpeg", "png", "png"}));
}

} // namespace
} // namespace froxel::encode
