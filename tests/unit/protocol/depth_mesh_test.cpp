#include "protocol/depth_mesh.h"
#include "unit/protocol/hex.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <limits>
#include <random>

namespace froxel::protocol {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr DepthMeshSize kSmall(17, 9); // 3 x 2 vertices

std::string hexOf(const std::vector<std::byte>& bytes) {
    return toHex({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

std::vector<uint16_t> decoded(const CodedDepthMesh& mesh) {
    auto steps = decodeDepthMesh(mesh.bytes, mesh.size, mesh.bits);
    EXPECT_TRUE(steps) << steps.error().message;
    return steps ? *steps : std::vector<uint16_t>();
}

std::string refusal(const std::string& hex, DepthMeshSize size = kSmall, uint32_t bits = 8) {
    const std::string bytes = fromHex(hex);
    const auto steps = decodeDepthMesh(bytesOf(bytes), size, bits);
    return steps ? "accepted" : steps.error().message;
}

// The example of protocol/README.md.
TEST(DepthMesh, Example_HasTheBytesOfTheReadme) {
    const std::vector<float> inverse = {0.25F, 0.25F, 0.25F, 0.5F, 0.5F, 0};
    const auto coded = encodeDepthMesh(inverse, kSmall, 8);
    EXPECT_EQ(coded.nearest_per_m, 0.5);
    EXPECT_THAT(decoded(coded), ElementsAre(128, 128, 128, 255, 255, 0));
    EXPECT_EQ(hexOf(coded.bytes), "108824e13f11fd07");
}

TEST(DepthMesh, Plane_IsAFewBytes) {
    const DepthMeshSize size(1280, 720);
    std::vector<float> inverse(size.vertexCount());
    for (uint32_t i = 0; i < inverse.size(); ++i) { // whole steps across and down
        inverse[i] = static_cast<float>(i % size.columns + i / size.columns);
    }
    inverse.back() = 1023;
    const auto coded = encodeDepthMesh(inverse, size, 10);
    EXPECT_LT(coded.bytes.size(), size.columns + 3 * size.rows); // the first of each are news
    EXPECT_EQ(decoded(coded)[size.columns * 3 + 5], 8);
}

TEST(DepthMesh, AnyDepths_ComeBackWithinHalfAStep) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> any(0, 3);
    for (const auto& size : {DepthMeshSize(1, 1), DepthMeshSize(9, 1), DepthMeshSize(1, 33),
                             DepthMeshSize(333, 77), DepthMeshSize(4096, 64)}) {
        for (uint32_t bits = kMinDepthBits; bits <= kMaxDepthBits; ++bits) {
            std::vector<float> inverse(size.vertexCount());
            std::ranges::generate(inverse, [&] { return std::max(0.0F, any(random) - 1); });
            const auto coded = encodeDepthMesh(inverse, size, bits);
            const auto steps = decoded(coded);
            ASSERT_EQ(steps.size(), inverse.size());
            const double step = coded.nearest_per_m / ((1U << bits) - 1);
            for (size_t i = 0; i < steps.size(); ++i) {
                ASSERT_NEAR(steps[i] * step, inverse[i], 0.501 * step); // and floats round
            }
        }
    }
}

TEST(DepthMesh, WhatIsNotADistance_IsNowhere) {
    constexpr float kInf = std::numeric_limits<float>::infinity();
    const std::vector<float> inverse = {std::nanf(""), kInf, -1, 0.5F, 1, -kInf};
    const auto coded = encodeDepthMesh(inverse, kSmall, 8);
    EXPECT_EQ(coded.nearest_per_m, 1);
    EXPECT_THAT(decoded(coded), ElementsAre(0, 0, 0, 128, 255, 0));
    const auto empty = encodeDepthMesh(std::vector<float>(6, kInf), kSmall, 8);
    EXPECT_EQ(empty.nearest_per_m, 0);
    EXPECT_EQ(hexOf(empty.bytes), "06");
    const std::vector<float> tiny(6, std::numeric_limits<float>::denorm_min());
    EXPECT_THAT(decoded(encodeDepthMesh(tiny, kSmall, 8)),
                ElementsAre(255, 255, 255, 255, 255, 255));
}

TEST(DepthMesh, BrokenBytes_AreRefusedByWhatIsWrong) {
    EXPECT_EQ(refusal("06"), "accepted");
    EXPECT_THAT(refusal("06", kSmall, 5), HasSubstr("3x2 vertices: it has 5 bits; expected 6"));
    EXPECT_THAT(refusal("06", kSmall, 13), HasSubstr("13 bits"));
    EXPECT_THAT(refusal(""), HasSubstr("a run at vertex 0 ends beyond the last one"));
    EXPECT_THAT(refusal("07"), HasSubstr("a run at vertex 0"));   // seven of six
    EXPECT_THAT(refusal("00"), HasSubstr("a run at vertex 0"));   // of nothing
    EXPECT_THAT(refusal("05"), HasSubstr("a run at vertex 5"));   // no run for the last
    EXPECT_THAT(refusal("1501"), HasSubstr("at step -1 of 255")); // below the first
    EXPECT_THAT(refusal("15"), HasSubstr("its bytes end at vertex 5"));
    EXPECT_THAT(refusal("8888888888"), HasSubstr("a run at vertex 0")); // a number without end
    EXPECT_THAT(refusal("0600"), HasSubstr("bytes follow its last vertex"));
    EXPECT_THAT(refusal("1502f0"), HasSubstr("bytes follow its last vertex"));
}

} // namespace
} // namespace froxel::protocol
