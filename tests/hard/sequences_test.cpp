// Many frames: the same again, by any number of threads; without jumps; with nothing left over.
#include "support/exact.h"
#include "support/gpu_fixture.h"
#include "support/oracle.h"
#include "support/shapes.h"
#include "support/test_scenes.h"
#include "support/tier.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string>
#include <unistd.h>

namespace froxel::test {

namespace {

using glm::dvec3;
using settings::Renderer;

class HardSequences : public SharedGpuTest {};

constexpr const char* kHashMark = "hash of 300 frames: ";
constexpr const char* kOnlyHash = "FROXEL_TEST_ONLY_HASH";

// FNV-1a, 64 bits.
void mix(uint64_t& hash, const void* data, size_t bytes) {
    const auto* p = static_cast<const unsigned char*>(data);
    for (size_t i = 0; i < bytes; ++i) {
        hash = (hash ^ p[i]) * 0x100000001b3U;
    }
}

// Of 300 frames of moving lights by every renderer in turn, linear and 8 bits.
uint64_t hashOfFrames(gpu::Device& device) {
    const auto scene = makeRoom();
    render::Renderer renderer(device, scene);
    render::ViewRenderer view(renderer);
    uint64_t hash = 0xcbf29ce484222325U;
    const uint32_t frames = wholeGrids() ? 300 : 90;
    for (uint32_t i = 0; i < frames; ++i) {
        auto inputs = hardInputs();
        inputs.settings.camera = scene.cameras[i % 2].camera;
        inputs.settings.size = {48, 27};
        inputs.settings.renderer = static_cast<Renderer>(i / 2 % settings::kRendererNames.size());
        inputs.settings.lights.count = 200;
        inputs.assignment =
            i % 3 == 0 ? render::AssignmentPlace::kDevice : render::AssignmentPlace::kAuto;
        inputs.time_s = i / 30.0;
        const Picture picture = draw(view, inputs);
        mix(hash, picture.radiance.data(), picture.radiance.size() * sizeof(float));
        mix(hash, picture.rgba8.data(), picture.rgba8.size());
    }
    return hash;
}

// What another process of this test says, whose software rasteriser has `threads` threads.
std::string hashOfProcess(const char* threads) {
    std::ostringstream words;
    words << "env -u GTEST_TOTAL_SHARDS -u GTEST_SHARD_INDEX " << kOnlyHash
          << "=1 LP_NUM_THREADS=" << threads << " /proc/" << getpid()
          << "/exe --gtest_filter=HardSequences.ManyFrames*";
    const std::string command = words.str();
    FILE* pipe = popen(command.c_str(), "r"); // NOLINT(cert-env33-c): a fixed command
    std::string found;
    std::array<char, 512> line{};
    while (pipe != nullptr && fgets(line.data(), line.size(), pipe) != nullptr) {
        const std::string text(line.data());
        if (text.rfind(kHashMark, 0) == 0) {
            found = text.substr(std::string(kHashMark).size());
        }
    }
    if (pipe == nullptr || pclose(pipe) != 0) {
        ADD_FAILURE() << command << " failed";
    }
    return found;
}

} // namespace

// Case 36. In this process, and in others whose software rasteriser has one thread and two; those
// are this test again, which then only says what it found.
TEST_F(HardSequences, ManyFrames_AreTheSameByAnyNumberOfThreads) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%llx\n",
                  static_cast<unsigned long long>(hashOfFrames(device())));
    if (std::getenv(kOnlyHash) != nullptr) {
        std::printf("\n%s%s", kHashMark, text.data());
        return;
    }
    for (const char* threads : {"1", "2"}) {
        EXPECT_EQ(hashOfProcess(threads), text.data()) << threads << " threads";
    }
}

// Case 37. A light that creeps over borders of tiles and slices, a ten-thousandth of a cluster a
// frame: by lists it never moves the picture otherwise than by all lights.
TEST_F(HardSequences, CreepingLight_NeverPops) {
    const auto maker = wallAhead(4);
    render::Renderer renderer(device(), maker.scene);
    render::ViewRenderer view(renderer);
    auto inputs = hardInputs();
    inputs.settings.lights.count = 1;
    inputs.settings.lights.radius_m = 1;
    const double tile = 2 * std::tan(glm::radians(30.0)) * 4 * 64 / 36 / 16;
    Picture naive_before;
    Picture lists_before;
    for (const double border : {0.0, 1.0, 2.0}) { // the light's rim comes to a border there
        for (int i = -10; i <= 10; ++i) {
            const dvec3 p(border * tile - 1 + i * 1e-4 * tile, 0.1, -3.99 + i * 1e-5);
            inputs.settings.lights.box = BoundsD3{p, p};
            inputs.settings.renderer = Renderer::kNaive;
            Picture naive = draw(view, inputs);
            inputs.settings.renderer = Renderer::kForwardPlus;
            Picture lists = draw(view, inputs);
            ASSERT_EQ(differingFloats(naive, lists), 0U);
            if (i > -10) {
                double most = 0;
                double most_naive = 0;
                for (size_t k = 0; k < lists.radiance.size(); ++k) {
                    most = std::max(most, std::abs(static_cast<double>(lists.radiance[k]) -
                                                   static_cast<double>(lists_before.radiance[k])));
                    most_naive = std::max(most_naive,
                                          std::abs(static_cast<double>(naive.radiance[k]) -
                                                   static_cast<double>(naive_before.radiance[k])));
                }
                EXPECT_GT(most, 0);
                EXPECT_LE(most, most_naive);
            }
            naive_before = std::move(naive);
            lists_before = std::move(lists);
        }
    }
}

// Case 38. Lights that come and go in one view, by the host's lists and by the device's.
TEST_F(HardSequences, CountsThatShrinkAndGrow_LeaveNothingBehind) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    for (const auto place : {render::AssignmentPlace::kHost, render::AssignmentPlace::kDevice}) {
        render::ViewRenderer view(renderer);
        auto inputs = hardInputs();
        inputs.settings.size = {32, 18};
        inputs.settings.camera = scene.cameras[0].camera;
        inputs.assignment = place;
        for (const uint32_t count : {5000U, 10U, 0U, 5000U, 1U, 300U}) {
            SCOPED_TRACE(count);
            inputs.settings.lights.count = count;
            (void)expectExact(view, inputs, Toon::kNo);
        }
    }
}

// Case 19. Sizes that change while frames are under way: each is what it would be by itself.
TEST_F(HardSequences, ResizeWithFramesInFlight_DrawsEachAtItsSize) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    const settings::Size sizes[] = {{64, 36}, {17, 45}, {90, 20}};
    for (const auto kind :
         {Renderer::kForwardPlus, Renderer::kClusteredDeferred, Renderer::kToonCompute}) {
        for (uint32_t round = 0; round < 3; ++round) {
            std::vector<render::FrameInputs> frames;
            for (uint32_t i = 0; i < render::ViewRenderer::kReadbackSlots; ++i) {
                auto inputs = hardInputs();
                inputs.settings.camera = scene.cameras[0].camera;
                inputs.settings.renderer = kind;
                inputs.settings.size = sizes[(i + round) % 3];
                inputs.settings.lights.count = 40 + 60 * i;
                inputs.time_s = i;
                frames.push_back(inputs);
                ASSERT_TRUE(view.submit(inputs));
            }
            for (const auto& inputs : frames) {
                const auto frame = view.collect();
                ASSERT_TRUE(frame);
                const PixelView& pixels = frame->pixels.view();
                ASSERT_EQ(pixels.width_px, inputs.settings.size.width_px);
                const std::vector<std::byte> bytes(pixels.data, pixels.data + pixels.stride_bytes *
                                                                                  pixels.height_px);
                EXPECT_TRUE(bytes == draw(renderer, inputs).rgba8);
            }
        }
    }
}

// A billion seconds on, lights still move as their formula says, and lists still hold them all.
TEST_F(HardSequences, LatestTime_IsExact) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    auto inputs = hardInputs();
    inputs.settings.camera = scene.cameras[0].camera;
    inputs.settings.lights.count = 200;
    inputs.time_s = 1e9;
    const auto pictures = expectExact(renderer, inputs, Toon::kNo);
    EXPECT_GT(litPixels(pictures.naive), 100U);
    inputs.time_s = 1e9 - 0.5;
    EXPECT_GT(differingFloats(pictures.naive, draw(renderer, inputs)), 0U);
}

} // namespace froxel::test
