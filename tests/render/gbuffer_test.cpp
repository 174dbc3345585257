// G-buffer layouts: how far each encoding turns a normal, and that a layout only changes what it
// rounds.
#include "gpu/command_context.h"
#include "gpu/memory.h"
#include "gpu/pipeline.h"
#include "render/pipelines/gbuffer_layout.h"
#include "support/draw.h"
#include "support/gpu_fixture.h"
#include "support/test_scenes.h"
#include "support/tier.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <span>

namespace froxel::test {

namespace {

#include "normal_codec.spv.h"

using settings::NormalEncoding;
using settings::PositionSource;

class Gbuffer : public GpuTest {};

// A spiral over the sphere with the axes, the octahedron's folds and their neighbours among it.
std::vector<glm::vec3> sphere() {
    std::vector<glm::vec3> normals;
    for (const float x : {-1.0F, 0.0F, 1.0F}) {
        for (const float y : {-1.0F, 0.0F, 1.0F}) {
            for (const float z : {-1.0F, -1e-7F, 0.0F, 1e-7F, 1.0F}) {
                if (glm::length(glm::vec3(x, y, z)) > 0.5F) {
                    normals.push_back(glm::normalize(glm::vec3(x, y, z)));
                }
            }
        }
    }
    constexpr size_t kCount = 200'000;
    for (size_t i = 0; i < kCount; ++i) {
        const double z = 1 - (2 * static_cast<double>(i) + 1) / kCount;
        const double turn = static_cast<double>(i) * std::numbers::pi * (3 - std::sqrt(5.0));
        const double r = std::sqrt(1 - z * z);
        normals.emplace_back(r * std::cos(turn), r * std::sin(turn), z);
    }
    return normals;
}

// The normals after a round trip through the shaders.
std::vector<glm::vec3>
roundTrip(const gpu::Device& device, std::vector<glm::vec3> normals, NormalEncoding encoding) {
    gpu::Timeline timeline(device);
    gpu::MemoryArena arena(device);
    const auto bytes = normals.size() * sizeof(glm::vec3);
    const auto buffer = arena.makeBuffer(bytes, vk::BufferUsageFlagBits::eStorageBuffer,
                                         gpu::MemoryUse::kReadback, "normals");
    std::memcpy(buffer.mapped, normals.data(), bytes);
    const vk::DescriptorSetLayoutBinding binding{0, vk::DescriptorType::eStorageBuffer, 1,
                                                 vk::ShaderStageFlagBits::eCompute};
    const auto empty = gpu::makeSetLayout(device, {});
    const auto layout = gpu::makeSetLayout(device, std::span(&binding, 1));
    const std::array layouts = {*empty, *layout};
    const auto pipeline_layout =
        device.handle().createPipelineLayout({.setLayoutCount = 2, .pSetLayouts = layouts.data()});
    const uint32_t flags = render::layoutFlags({.normal = encoding, .position = {}});
    const auto pipeline = gpu::makeComputePipeline(device, normal_codec_words, {0, 0, flags, 8},
                                                   *pipeline_layout, "normal codec");
    const vk::DescriptorPoolSize pool_size{vk::DescriptorType::eStorageBuffer, 1};
    const auto pool = device.handle().createDescriptorPool(
        {.flags = vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet,
         .maxSets = 1,
         .poolSizeCount = 1,
         .pPoolSizes = &pool_size});
    const auto sets = device.handle().allocateDescriptorSets(
        {.descriptorPool = *pool, .descriptorSetCount = 1, .pSetLayouts = &layouts[1]});
    const vk::DescriptorBufferInfo info{*buffer.handle, 0, VK_WHOLE_SIZE};
    device.handle().updateDescriptorSets(
        vk::WriteDescriptorSet{.dstSet = *sets[0],
                               .descriptorCount = 1,
                               .descriptorType = vk::DescriptorType::eStorageBuffer,
                               .pBufferInfo = &info},
        {});
    timeline.runNow([&](const auto& cmd) {
        cmd.bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline);
        cmd.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *pipeline_layout, 1, *sets[0], {});
        cmd.dispatch(static_cast<uint32_t>(normals.size() / 64 + 1), 1, 1);
    });
    std::memcpy(normals.data(), buffer.mapped, bytes);
    return normals;
}

struct AngleError {
    double max_deg = 0;
    double mean_deg = 0;
};

AngleError angleError(std::span<const glm::vec3> before, std::span<const glm::vec3> after) {
    AngleError error;
    for (size_t i = 0; i < before.size(); ++i) {
        const glm::dvec3 a(before[i]);
        const glm::dvec3 b(after[i]);
        const double angle =
            std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180 / std::numbers::pi;
        error.max_deg = std::max(error.max_deg, angle);
        error.mean_deg += angle / static_cast<double>(before.size());
    }
    return error;
}

render::FrameInputs inputsFor(const scene::Scene& scene, settings::Renderer renderer) {
    render::FrameInputs inputs;
    inputs.settings.camera = scene.cameras[0].camera;
    inputs.settings.size = {120, 68};
    inputs.settings.renderer = renderer;
    inputs.settings.lights.count = 200;
    inputs.time_s = 3.25;
    return inputs;
}

double worstDifference(const Picture& a, const Picture& b) {
    double worst = a.radiance.size() == b.radiance.size() ? 0 : 1e30;
    for (size_t i = 0; i < std::min(a.radiance.size(), b.radiance.size()); ++i) {
        worst = std::max(worst, std::abs(double{a.radiance[i]} - b.radiance[i]));
    }
    return worst;
}

} // namespace

TEST_F(Gbuffer, Normals_OverTheSphere_TurnByNoMoreThanTheirEncodingAllows) {
    struct Case {
        NormalEncoding encoding;
        double max_deg;
        double mean_deg;
    };
    const auto normals = sphere();
    for (const Case& c : {Case{NormalEncoding::kOct16, 0.0037, 0.0014},
                          {NormalEncoding::kOct12, 0.059, 0.022},
                          {NormalEncoding::kOct10, 0.24, 0.085},
                          {NormalEncoding::kOct8, 0.96, 0.35},
                          {NormalEncoding::kXyz16, 0.023, 0.007}}) {
        const auto error = angleError(normals, roundTrip(device(), normals, c.encoding));
        const auto name = settings::kNormalEncodingNames[static_cast<size_t>(c.encoding)];
        std::printf("%s: max %.4f, mean %.4f degrees\n", std::string(name).c_str(), error.max_deg,
                    error.mean_deg);
        EXPECT_LT(error.max_deg, c.max_deg) << name;
        EXPECT_LT(error.mean_deg, c.mean_deg) << name;
    }
}

TEST_F(Gbuffer, XyNormals_TowardsTheEye_KeepTheirSideAndLoseTheOther) {
    auto normals = sphere();
    std::erase_if(normals, [](const glm::vec3& n) { return n.z < 0; });
    const auto error = angleError(normals, roundTrip(device(), normals, NormalEncoding::kXy16));
    std::printf("xy16 (z >= 0): max %.4f, mean %.4f degrees\n", error.max_deg, error.mean_deg);
    EXPECT_LT(error.max_deg, 1.8);
    EXPECT_LT(error.mean_deg, 0.04);
    const std::vector<glm::vec3> away = {{0.6F, 0, -0.8F}};
    EXPECT_GT(roundTrip(device(), away, NormalEncoding::kXy16)[0].z, 0.79F);
}

TEST_F(Gbuffer, Spheremap_AwayFromItsPole_IsFine) {
    auto normals = sphere();
    const auto whole =
        angleError(normals, roundTrip(device(), normals, NormalEncoding::kSpheremap16));
    std::erase_if(normals, [](const glm::vec3& n) { return n.z < -0.99F; });
    const auto error =
        angleError(normals, roundTrip(device(), normals, NormalEncoding::kSpheremap16));
    std::printf("spheremap16: max %.4f, mean %.4f degrees; z > -0.99: max %.4f, mean %.4f\n",
                whole.max_deg, whole.mean_deg, error.max_deg, error.mean_deg);
    EXPECT_LT(error.max_deg, 0.55);
    EXPECT_LT(error.mean_deg, 0.03);
}

// What is stored with all its bits changes nothing. By one rasteriser: hardware interpolates depths
// that the visibility passes meet planes for.
TEST_F(Gbuffer, StoredDepthAndFp32Position_AnyRenderer_GiveTheSameBits) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    for (const auto kind : {settings::Renderer::kClusteredDeferred,
                            settings::Renderer::kToonFragment, settings::Renderer::kToonCompute}) {
        auto inputs = inputsFor(scene, kind);
        inputs.geometry = render::GeometryPath::kRaster;
        const Picture reference = draw(renderer, inputs);
        for (const auto stage :
             {settings::LightingStage::kCompute, settings::LightingStage::kFragment}) {
            inputs.settings.lighting = stage;
            for (const auto position : {PositionSource::kStoredDepth, PositionSource::kFp32}) {
                inputs.settings.gbuffer.position = position;
                EXPECT_EQ(differingFloats(reference, draw(renderer, inputs)), 0U)
                    << settings::kPositionSourceNames[static_cast<size_t>(position)];
            }
        }
    }
}

TEST_F(Gbuffer, EveryLayout_AnyRenderer_StaysNearTheDefault) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    for (const auto kind :
         {settings::Renderer::kClusteredDeferred, settings::Renderer::kToonCompute}) {
        auto inputs = inputsFor(scene, kind);
        const Picture reference = draw(view, inputs);
        std::vector<settings::GbufferLayout> layouts;
        for (size_t n = 0; n < settings::kNormalEncodingNames.size(); ++n) {
            layouts.push_back({static_cast<NormalEncoding>(n), PositionSource::kDepth});
        }
        for (size_t p = 0; p < settings::kPositionSourceNames.size(); ++p) {
            layouts.push_back({NormalEncoding::kXyz16, static_cast<PositionSource>(p)});
        }
        for (const auto& layout : layouts) {
            SCOPED_TRACE(
                std::string(settings::kNormalEncodingNames[static_cast<size_t>(layout.normal)]) +
                ", " +
                std::string(settings::kPositionSourceNames[static_cast<size_t>(layout.position)]));
            inputs.settings.gbuffer = layout;
            const Picture picture = draw(view, inputs);
            // Highlights on gold magnify what turns a normal by a degree.
            EXPECT_LT(worstDifference(reference, picture), 2.0);
            EXPECT_TRUE(std::any_of(picture.radiance.begin(), picture.radiance.end(),
                                    [](float v) { return v > 0; }));
        }
    }
}

// What dielectrics reflect has its place in every layout, or is refused: normals of three halves
// and positions of three words fill the second target.
TEST_F(Gbuffer, Specular_EveryLayout_IsStoredOrRefused) {
    auto scene = makeRoom();
    scene.materials[0].ior = 2.4F;
    scene.materials[0].specular = 0.5F;
    scene.materials[3].specular_color = {0.5F, 4, 1};
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    auto inputs = inputsFor(scene, settings::Renderer::kClusteredDeferred);
    const Picture reference = draw(view, inputs);
    for (const auto normal : {NormalEncoding::kOct16, NormalEncoding::kXyz16}) {
        for (size_t p = 0; p < settings::kPositionSourceNames.size(); ++p) {
            SCOPED_TRACE(settings::kPositionSourceNames[p]);
            inputs.settings.gbuffer = {normal, static_cast<PositionSource>(p)};
            if (inputs.settings.gbuffer ==
                settings::GbufferLayout{NormalEncoding::kXyz16, PositionSource::kFp32}) {
                const auto refused = view.submit(inputs);
                ASSERT_TRUE(refused.has_error());
                EXPECT_NE(refused.error().message.find("xyz16"), std::string::npos);
                continue;
            }
            EXPECT_LT(worstDifference(reference, draw(view, inputs)), 2.0);
            for (const auto stage :
                 {settings::LightingStage::kCompute, settings::LightingStage::kFragment}) {
                const bool fragment = stage == settings::LightingStage::kFragment;
                if (!wholeGrids() && fragment != (normal == NormalEncoding::kOct16)) {
                    continue;
                }
                inputs.settings.lighting = stage;
                inputs.settings.light_loop = settings::LightLoop::kLists;
                const Picture lists = draw(view, inputs);
                inputs.settings.light_loop = settings::LightLoop::kAllLights;
                EXPECT_EQ(differingFloats(lists, draw(view, inputs)), 0U);
            }
        }
    }
}

// Lists hold what reaches the position as it is stored.
TEST_F(Gbuffer, Lists_EveryLayout_EqualAllLightsBitForBit) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    auto inputs = inputsFor(scene, settings::Renderer::kClusteredDeferred);
    inputs.settings.lights.radius_m = 0.7F;
    for (const auto position :
         {PositionSource::kStoredDepth, PositionSource::kFp32, PositionSource::kFp16}) {
        inputs.settings.gbuffer = {NormalEncoding::kXyz16, position};
        inputs.settings.light_loop = settings::LightLoop::kLists;
        const Picture lists = draw(view, inputs);
        inputs.settings.light_loop = settings::LightLoop::kAllLights;
        EXPECT_EQ(differingFloats(lists, draw(view, inputs)), 0U)
            << settings::kPositionSourceNames[static_cast<size_t>(position)];
    }
}

TEST_F(Gbuffer, Layouts_InTurn_KeepTargetsApart) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    auto inputs = inputsFor(scene, settings::Renderer::kClusteredDeferred);
    const Picture first = draw(view, inputs);
    inputs.settings.gbuffer = {NormalEncoding::kXyz16, PositionSource::kFp16};
    (void)draw(view, inputs);
    inputs.settings.gbuffer = {};
    EXPECT_EQ(differingFloats(first, draw(view, inputs)), 0U);
}

} // namespace froxel::test
