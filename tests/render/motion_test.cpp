// Scenes that move, on the device.
#include "gltf/gltf_loader.h"
#include "motion/playback.h"
#include "motion/posed_scene.h"
#include "render/frame/scene_pose.h"
#include "render/pipelines/barrier.h"
#include "render/pipelines/host_copies.h"
#include "render/scene/scene_resources.h"
#include "scene/enclosing_sphere.h"
#include "scene/first_view.h"
#include "scene/motion.h"
#include "support/draw.h"
#include "support/gpu_fixture.h"
#include "support/places.h"
#include "support/shapes.h"
#include "support/test_scenes.h"

#include <cmath>
#include <filesystem>

namespace froxel::test {

namespace {

using render::GeometryPath;
using scene::ChannelPath;
using scene::Interpolation;
using scene::Motion;
using settings::Renderer;

class Moving : public SharedGpuTest {};

// From one value at 0 s to another at 2 s.
scene::Track line(uint32_t width, std::vector<float> from, const std::vector<float>& to) {
    scene::Track track{Interpolation::kLinear, width, {0, 2}, std::move(from)};
    track.values.insert(track.values.end(), to.begin(), to.end());
    return track;
}

// What is above follows joint 1, what is below joint 0; one target flattens it.
scene::Deformation bending(const scene::Primitive& primitive) {
    scene::Deformation deformation;
    deformation.first_influence = {0};
    deformation.first_delta = {0};
    for (const glm::vec3& p : primitive.positions) {
        const float upper = glm::clamp(p.y + 0.5F, 0.0F, 1.0F);
        if (upper < 1) {
            deformation.influences.push_back({0, 1 - upper});
        }
        if (upper > 0) {
            deformation.influences.push_back({1, upper});
        }
        deformation.deltas.push_back({0, {0, 0, -0.5F * p.z}, {0.1F, 0, 0}, {0, 0.1F, 0}});
        deformation.first_influence.push_back(static_cast<uint32_t>(deformation.influences.size()));
        deformation.first_delta.push_back(static_cast<uint32_t>(deformation.deltas.size()));
    }
    return deformation;
}

// With tangents and the normal map of the room's first material.
scene::Primitive texturedBall() {
    scene::Primitive ball = sphere(0.5F, 12, 0);
    for (const glm::vec3& n : ball.normals) {
        const glm::vec3 side = glm::cross(glm::vec3(0.3F, 1, 0.2F), n);
        ball.tangents.emplace_back(glm::normalize(side), n.x < 0 ? -1 : 1);
        ball.uv0.emplace_back(3 * n.x, 3 * n.y);
    }
    return ball;
}

// Each triangle of a ball with corners of its own.
scene::Primitive facets() {
    const scene::Primitive ball = sphere(0.3F, 5, 3);
    scene::Primitive flat;
    flat.material = 3;
    for (size_t i = 0; i < ball.indices.size(); i += 3) {
        const uint32_t* corners = &ball.indices[i];
        const glm::vec3 a = ball.positions[corners[0]];
        const glm::vec3 across =
            glm::cross(ball.positions[corners[1]] - a, ball.positions[corners[2]] - a);
        for (size_t k = 0; k < 3 && glm::length(across) > 1e-4F; ++k) { // not those of the poles
            flat.indices.push_back(static_cast<uint32_t>(flat.indices.size()));
            flat.positions.push_back(ball.positions[corners[k]] + glm::vec3(0.9F, 0, 0));
            flat.normals.push_back(ball.normals[corners[k]]);
            flat.bounds.add(flat.positions.back());
        }
    }
    return flat;
}

// A mesh of both that bends, and a ball in a mesh of its own that is only flattened.
void addBending(scene::Scene& scene, Motion& motion) {
    scene::Primitive ball = texturedBall();
    scene::Primitive flat = facets();
    scene::Deformation flat_bending = bending(flat);
    flat_bending.flat_normals = true;
    scene::Primitive plain = sphere(0.4F, 9, 3);
    scene::Deformation flattened = bending(plain);
    flattened.first_influence.clear();
    flattened.influences.clear();
    const auto mesh = static_cast<uint32_t>(scene.meshes.size());
    motion.nodes[1].weight_count = 1;
    motion.rest_weights = {0};
    motion.nodes[2].rest.translation = {0.4, 2.2, 2};
    motion.skins = {{"", {2, 3}, {glm::mat4(1), glm::mat4(1)}}};
    motion.deformed = {{mesh, 1, 0, {bending(ball), flat_bending}},
                       {mesh + 1, 1, scene::kNone, {flattened}}};
    scene.meshes.push_back({"bent", {std::move(ball), std::move(flat)}});
    scene.meshes.push_back({"flattened", {std::move(plain)}});
    glm::dmat4 aside(1);
    aside[3] = {-1.5, 2, 1, 1};
    const auto first = static_cast<uint32_t>(scene.instances.size());
    scene.instances.push_back({mesh, glm::dmat4(1), "bent"});
    scene.instances.push_back({mesh + 1, aside, "flattened"});
    motion.instances.push_back({first, 1, glm::dmat4(1), 0});
    motion.clips[0].channels.push_back({1, 3, ChannelPath::kRotation});
    motion.clips[0].channels.push_back({2, 1, ChannelPath::kWeights});
}

// The room; its last instance and a lamp ride on node 0.
scene::Scene movingRoom(bool bends) {
    scene::Scene scene = makeRoom();
    scene::PunctualLight& lamp = scene.lights.emplace_back();
    lamp.position_world = {1, 2, 2};
    lamp.color = {1, 0.8F, 0.6F};
    lamp.intensity = 20;
    lamp.range_m = 6;
    Motion motion;
    motion.nodes.resize(4);
    motion.nodes[3].parent = 2;
    const auto ridden = static_cast<uint32_t>(scene.instances.size() - 1);
    motion.instances = {{ridden, 0, scene.instances[ridden].world_from_object, scene::kNone}};
    motion.lights = {{0, 0}};
    motion.clips = {{"all",
                     2,
                     {line(3, {0, 0, 0}, {-1.4F, 0.3F, 3}),
                      line(4, {0, 0, 0, 1}, {0, 0, 0.6F, 0.8F}), line(1, {0}, {1})},
                     {{0, 0, ChannelPath::kTranslation}}}};
    if (bends) {
        addBending(scene, motion);
    }
    scene.motion = std::make_shared<const Motion>(std::move(motion));
    return scene;
}

scene::Scene posedAt(const scene::Scene& scene, double time_s) {
    return motion::posedScene(scene, motion::usualClips(*scene.motion), time_s);
}

render::FrameInputs inputsFor(const scene::Scene& scene, Renderer renderer, double time_s) {
    render::FrameInputs inputs;
    inputs.settings.camera =
        scene::firstViewOf(scene, scene::enclosingSphere(scene)).cameraFor({160, 90});
    inputs.settings.size = {160, 90};
    inputs.settings.renderer = renderer;
    inputs.settings.light_loop = settings::LightLoop::kLists;
    inputs.settings.lights.count = 60;
    inputs.settings.lights.speed = 0;
    inputs.settings.lights.box = scene.bounds_world;
    inputs.time_s = time_s;
    return inputs;
}

// Share of the numbers that are apart by more than some roundings.
double differingShare(const Picture& a, const Picture& b) {
    size_t count = 0;
    for (size_t i = 0; i < a.radiance.size(); ++i) {
        const auto x = static_cast<double>(a.radiance[i]);
        const auto y = static_cast<double>(b.radiance[i]);
        count += std::abs(x - y) > 1e-6 + 1e-3 * std::max(x, y) ? 1U : 0U;
    }
    return static_cast<double>(count) / static_cast<double>(a.radiance.size());
}

struct Way {
    const char* name;
    Renderer renderer;
    GeometryPath geometry = GeometryPath::kAuto;
    settings::LightingStage lighting = settings::LightingStage::kAuto;
};
constexpr Way kWays[] = {
    {"forward", Renderer::kForwardPlus},
    {"deferred", Renderer::kClusteredDeferred},
    {"ids", Renderer::kClusteredDeferred, GeometryPath::kVisibility},
    {"ids in compute", Renderer::kClusteredDeferred, GeometryPath::kComputeRaster},
    {"ids shaded", Renderer::kForwardPlus, GeometryPath::kAuto, settings::LightingStage::kCompute}};

render::FrameInputs inputsOf(const Way& way, const scene::Scene& scene, double time_s) {
    auto inputs = inputsFor(scene, way.renderer, time_s);
    inputs.geometry = way.geometry;
    inputs.settings.lighting = way.lighting;
    return inputs;
}

} // namespace

TEST_F(Moving, Lists_EqualAllLightsBitForBit) {
    const auto scene = movingRoom(true);
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    for (const double time_s : {0.0, 0.7, 1.9}) {
        const Picture naive = draw(view, inputsFor(scene, Renderer::kNaive, time_s));
        EXPECT_EQ(
            differingFloats(naive, draw(view, inputsFor(scene, Renderer::kForwardPlus, time_s))),
            0U);
        auto inputs = inputsFor(scene, Renderer::kClusteredDeferred, time_s);
        const Picture lists = draw(view, inputs);
        inputs.settings.light_loop = settings::LightLoop::kAllLights;
        EXPECT_EQ(differingFloats(lists, draw(view, inputs)), 0U);
    }
}

// A pose that stands keeps what was drawn of it while lights move; another one is drawn.
TEST_F(Moving, SurfacesKept_OfAPoseThatStands_AreAFreshViews) {
    const auto scene = movingRoom(true);
    render::Renderer renderer(device(), scene);
    for (const Way& way : kWays) {
        SCOPED_TRACE(way.name);
        render::ViewRenderer view(renderer);
        double time_s = 3;
        double stood_s = -1;
        bool last_kept = false;
        for (const double stands_s : {0.2, 0.2, 0.2, 0.9, 0.9, 0.2, 1.5, 1.5}) {
            auto inputs = inputsOf(way, scene, time_s += 0.25);
            inputs.depth_prepass = true;
            inputs.settings.lights.speed = 1;
            inputs.playing = motion::Playing{motion::usualClips(*scene.motion), stands_s};
            const Picture expected = draw(renderer, inputs);
            inputs.keep_surfaces = true;
            const Picture kept = draw(view, inputs);
            EXPECT_EQ(kept.rgba8, expected.rgba8);
            EXPECT_EQ(differingFloats(kept, expected), 0U);
            EXPECT_TRUE(stands_s == stood_s || !kept.stats.surfaces_reused);
            EXPECT_EQ(hasPass(kept, "pose"), stands_s != stood_s);
            stood_s = stands_s;
            last_kept = kept.stats.surfaces_reused;
        }
        EXPECT_TRUE(last_kept);
    }
}

// Half way from one clip to another.
TEST_F(Moving, CrossFade_ListsEqualAllLights_AndItIsTheSceneThatStandsSo) {
    for (const bool bends : {false, true}) {
        auto scene = movingRoom(bends);
        Motion motion = *scene.motion;
        motion.clips.push_back(
            {"other",
             2,
             {line(3, {-1, 0, 0.5F}, {-0.2F, 0.8F, 2}), line(4, {0, 0, 0, 1}, {0.6F, 0, 0, 0.8F})},
             {{0, 0, ChannelPath::kTranslation}, {1, 3, ChannelPath::kRotation}}});
        scene.motion = std::make_shared<const Motion>(std::move(motion));
        motion::Playback playback(scene.motion, {.number = 1}, 0.25);
        playback.follow({.number = 2, .fade_s = 1.5F}, 1);
        render::Renderer renderer(device(), scene);
        render::ViewRenderer view(renderer);
        auto inputs = inputsFor(scene, Renderer::kNaive, 0.4);
        inputs.playing = playback.at(1.75);
        const Picture naive = draw(view, inputs);
        inputs.settings.renderer = Renderer::kForwardPlus;
        EXPECT_EQ(differingFloats(naive, draw(view, inputs)), 0U);
        if (!bends) {
            const auto& [clips, now_s] = *inputs.playing;
            render::Renderer resting(device(), motion::posedScene(scene, clips, now_s));
            EXPECT_EQ(differingFloats(naive, draw(resting, inputs)), 0U);
        }
        inputs.playing = playback.at(2.5);
        EXPECT_GT(differingFloats(naive, draw(view, inputs)), 1000U);
    }
}

TEST_F(Moving, RiddenThings_AreTheSceneThatStandsSo) {
    const auto scene = movingRoom(false);
    render::Renderer moving(device(), scene);
    render::Renderer resting(device(), posedAt(scene, 1.25));
    for (const Way& way : kWays) {
        SCOPED_TRACE(way.name);
        auto inputs = inputsOf(way, scene, 1.25);
        inputs.settings.lights.count = 20;
        inputs.settings.shadows = {.light_count = 21, .size_px = 32};
        inputs.settings.fog.density = 0.05F;
        const Picture stood = draw(resting, inputs);
        EXPECT_EQ(differingFloats(draw(moving, inputs), stood), 0U);
        inputs.time_s = 0;
        EXPECT_GT(differingFloats(draw(moving, inputs), stood), 1000U);
    }
}

// Packing may begin a bent triangle with another corner, and normals are rounded otherwise: last
// bits differ, where an edge crosses the middle of a pixel a whole value.
TEST_F(Moving, BentMeshes_AreTheSceneThatStandsSo) {
    const auto scene = movingRoom(true);
    render::Renderer moving(device(), scene);
    render::Renderer resting(device(), posedAt(scene, 1.25));
    for (const Way& way : kWays) {
        SCOPED_TRACE(way.name);
        auto inputs = inputsOf(way, scene, 1.25);
        inputs.settings.shadows = {.light_count = 4, .size_px = 64};
        const Picture stood = draw(resting, inputs);
        const Picture moved = draw(moving, inputs);
        EXPECT_LT(differingShare(moved, stood), 0.002);
        inputs.time_s = 0.25;
        EXPECT_GT(differingShare(draw(moving, inputs), stood), 0.02);
    }
}

TEST_F(Moving, Picture_IsAFunctionOfTheTime) {
    const auto scene = movingRoom(true);
    const auto inputs = inputsFor(scene, Renderer::kClusteredDeferred, 0.9);
    render::Renderer fresh(device(), scene);
    const Picture first = draw(fresh, inputs);
    render::Renderer used(device(), scene);
    render::ViewRenderer one(used);
    render::ViewRenderer other(used);
    for (const double time_s : {5.0, 0.3, -2.0}) {
        (void)draw(one, inputsFor(scene, Renderer::kForwardPlus, time_s));
        (void)draw(other, inputsFor(scene, Renderer::kClusteredDeferred, time_s + 0.5));
        EXPECT_EQ(differingFloats(draw(one, inputs), first), 0U);
    }
}

// Hosts' stages in turns, and then pieces.
TEST_F(Moving, ViewsAtDifferentTimes_DoNotDisturbEachOther) {
    const auto scene = movingRoom(true);
    render::Renderer renderer(device(), scene);
    for (const uint32_t seeded : {299U, 300U}) { // with the lamp 300: culling aside, and not
        auto early = inputsFor(scene, Renderer::kForwardPlus, 0.2);
        early.settings.lights.count = seeded;
        early.settings.shadows = {.light_count = 2, .size_px = 64};
        auto late = early;
        late.time_s = 1.8;
        render::ViewRenderer alone(renderer);
        const std::vector<std::byte> expected[2] = {drawPixels(alone, early).rgba8,
                                                    drawPixels(alone, late).rgba8};
        ASSERT_NE(expected[0], expected[1]);

        const render::WorkLimits limits{.piece = Seconds(onGpu() ? 4e-6 : 1e-3),
                                        .host = Seconds(0)};
        render::ViewRenderer views[2] = {render::ViewRenderer(renderer, {}, limits),
                                         render::ViewRenderer(renderer, {}, limits)};
        const render::FrameInputs* const asked[2] = {&early, &late};
        for (int round = 0; round < 3; ++round) {
            uint32_t left[2] = {0, 0};
            for (uint32_t stages = 0; left[0] == 0 || left[1] == 0; ++stages) {
                for (size_t i = 0; i < 2; ++i) {
                    if (left[i] == 0) {
                        const auto work = views[i].begin(*asked[i]);
                        ASSERT_TRUE(work) << work.error().message;
                        left[i] = work->piece_count;
                        EXPECT_TRUE(left[i] > 2 || (left[i] == 0 && work->half_built));
                    }
                }
            }
            while (left[0] + left[1] > 0) {
                for (size_t i = 0; i < 2; ++i) {
                    if (left[i] > 0) {
                        ASSERT_TRUE(views[i].submitPiece());
                        --left[i];
                    }
                }
            }
            for (size_t i = 0; i < 2; ++i) {
                const auto frame = views[i].collect();
                ASSERT_TRUE(frame) << frame.error().message;
                const PixelView& pixels = frame->pixels.view();
                EXPECT_TRUE(std::equal(expected[i].begin(), expected[i].end(), pixels.data));
            }
        }
    }
}

TEST_F(Moving, DebugViews_ShowThePose) {
    const auto scene = movingRoom(true);
    render::Renderer moving(device(), scene);
    render::Renderer resting(device(), posedAt(scene, 1.25));
    for (const auto debug : {settings::DebugView::kDepth, settings::DebugView::kOverdraw,
                             settings::DebugView::kNormal, settings::DebugView::kInstances}) {
        auto inputs = inputsFor(scene, Renderer::kClusteredDeferred, 1.25);
        inputs.settings.debug.view = debug;
        const auto differing = [&](const render::FrameInputs& asked) {
            render::ViewRenderer moved(moving);
            render::ViewRenderer stood(resting);
            const auto a = drawPixels(moved, asked).rgba8;
            const auto b = drawPixels(stood, inputs).rgba8;
            size_t count = 0;
            for (size_t i = 0; i < a.size(); i += 4) {
                count += std::equal(&a[i], &a[i] + 4, &b[i]) ? 0U : 1U;
            }
            return count;
        };
        const size_t same = differing(inputs);
        EXPECT_LT(same, 160U * 90 / 1000);
        auto start = inputs;
        start.time_s = 0;
        EXPECT_GT(differing(start), 10 * same + 15);
    }
}

TEST_F(Moving, VerticesArePosed_OnlyWhereMeshesBend) {
    const auto poses = [&](const scene::Scene& scene) {
        render::Renderer renderer(device(), scene);
        render::ViewRenderer view(renderer);
        const bool passes =
            hasPass(draw(view, inputsFor(scene, Renderer::kForwardPlus, 0.5)), "pose");
        const auto memory = device().memoryLedger()->byPurpose();
        EXPECT_EQ(memory.contains("posed vertices"), passes);
        EXPECT_EQ(memory.contains("pose ranges"), passes);
        return passes;
    };
    EXPECT_TRUE(poses(movingRoom(true)));
    EXPECT_FALSE(poses(movingRoom(false)));
    EXPECT_FALSE(poses(makeRoom()));
}

TEST_F(Moving, PosedVertices_AreOfTheMemoryThatAViewTakes) {
    const auto scene = movingRoom(true);
    render::Renderer renderer(device(), scene);
    const auto inputs = inputsFor(scene, Renderer::kForwardPlus, 0.5);
    const auto fill = [&](render::ViewRenderer& view) {
        std::vector<render::RenderedFrame> kept; // all slots have their buffers
        while (view.canSubmit()) {
            ASSERT_TRUE(view.submit(inputs));
            auto frame = view.collect();
            ASSERT_TRUE(frame) << frame.error().message;
            kept.push_back(std::move(*frame));
        }
    };
    {
        render::ViewRenderer warm(renderer); // what the scene makes at first use
        fill(warm);
    }
    const uint64_t shared = device().memoryLedger()->totalBytes();
    const uint64_t taken_before = renderer.resources().shared.memory.takenBytes();
    render::ViewRenderer view(renderer);
    fill(view);
    const auto real = static_cast<double>(device().memoryLedger()->totalBytes() - shared);
    const auto said =
        static_cast<double>(renderer.resources().shared.memory.takenBytes() - taken_before);
    EXPECT_GE(said, real);
    EXPECT_LE(said, 1.1 * real);
}

namespace {

// A view's own vertices, as the device poses them.
struct Posed {
    std::vector<glm::vec3> positions;
    std::vector<render::SurfaceVertex> surfaces;
    std::vector<render::ExtendedVertex> extended;
};

template <class T>
gpu::Buffer hostBuffer(gpu::MemoryArena& arena, std::span<const T> data, gpu::MemoryUse use) {
    using Usage = vk::BufferUsageFlagBits;
    auto buffer =
        arena.makeBuffer(std::max<size_t>(data.size_bytes(), 16),
                         Usage::eStorageBuffer | Usage::eTransferDst, use, "pose of a test");
    if (use == gpu::MemoryUse::kUpload) {
        std::memcpy(buffer.mapped, data.data(), data.size_bytes());
    }
    return buffer;
}

Posed posedOnDevice(render::SceneResources& scene, double time_s, size_t vertex_count) {
    using Access = vk::AccessFlagBits2;
    using Stage = vk::PipelineStageFlagBits2;
    render::ScenePose pose(scene);
    pose.standAt(time_s);
    gpu::MemoryArena arena(scene.shared.device);
    const auto joints = hostBuffer(arena, pose.joints(), gpu::MemoryUse::kUpload);
    const auto weights = hostBuffer(arena, pose.weights(), gpu::MemoryUse::kUpload);
    const render::PosedVertices posed(scene);
    const render::PoseSet set(scene.shared.device, *scene.poser());
    set.write(scene, *scene.poser(), posed, {*joints.handle, 0, VK_WHOLE_SIZE},
              {*weights.handle, 0, VK_WHOLE_SIZE});
    Posed out{std::vector<glm::vec3>(vertex_count),
              std::vector<render::SurfaceVertex>(vertex_count),
              std::vector<render::ExtendedVertex>(scene.extended_buffer.size_bytes /
                                                  sizeof(render::ExtendedVertex))};
    const auto read = [&](const auto& data) {
        return hostBuffer(arena, std::span(std::as_const(data)), gpu::MemoryUse::kReadback);
    };
    const gpu::Buffer buffers[] = {read(out.positions), read(out.surfaces), read(out.extended)};
    scene.shared.timeline.runNow([&](const vk::raii::CommandBuffer& cmd) {
        const auto after = [&](vk::PipelineStageFlags2 from, vk::AccessFlags2 written,
                               vk::PipelineStageFlags2 to) {
            render::barrier(cmd, from, written, to, Access::eMemoryRead | Access::eMemoryWrite);
        };
        posed.recordRest(cmd, scene);
        after(Stage::eCopy, Access::eTransferWrite, Stage::eComputeShader);
        scene.poser()->recordVertices(cmd, set.set());
        after(Stage::eComputeShader, Access::eShaderStorageWrite, Stage::eComputeShader);
        scene.poser()->recordFlatNormals(cmd, set.set());
        after(Stage::eComputeShader, Access::eShaderStorageWrite, Stage::eCopy);
        const auto moved = posed.buffers();
        const vk::Buffer from[] = {moved.positions, moved.surfaces, moved.extended};
        for (size_t i = 0; i < 3; ++i) {
            cmd.copyBuffer(from[i], *buffers[i].handle,
                           vk::BufferCopy{0, 0, buffers[i].size_bytes});
        }
        render::recordHostRead(cmd);
    });
    std::memcpy(out.positions.data(), buffers[0].mapped, buffers[0].size_bytes);
    std::memcpy(out.surfaces.data(), buffers[1].mapped, buffers[1].size_bytes);
    std::memcpy(out.extended.data(), buffers[2].mapped, buffers[2].size_bytes);
    return out;
}

void expectNear(const glm::vec3& a, const glm::vec3& b) {
    EXPECT_LT(glm::distance(glm::dvec3(a), glm::dvec3(b)), 1e-6);
}

} // namespace

TEST_F(Moving, PosedVertices_AreThoseOfTheHost) {
    const auto scene = movingRoom(true);
    render::Renderer renderer(device(), scene);
    const auto packed = render::packGeometry(scene);
    for (const double time_s : {0.0, 0.4, 1.99}) {
        const auto resting = render::packGeometry(posedAt(scene, time_s));
        const Posed posed = posedOnDevice(renderer.resources(), time_s, packed.positions.size());
        EXPECT_EQ(posed.positions, resting.positions); // bit for bit
        EXPECT_EQ(posed.positions == packed.positions, time_s == 0);
        for (size_t v = 0; v < posed.surfaces.size(); ++v) {
            expectNear(posed.surfaces[v].normal, resting.surfaces[v].normal);
            EXPECT_EQ(posed.surfaces[v].uv0, resting.surfaces[v].uv0);
        }
        for (size_t v = 0; v < posed.extended.size(); ++v) {
            expectNear(glm::vec3(posed.extended[v].tangent),
                       glm::vec3(resting.extended[v].tangent));
            EXPECT_EQ(posed.extended[v].tangent.w, resting.extended[v].tangent.w);
            EXPECT_EQ(posed.extended[v].color, resting.extended[v].color);
        }
    }
}

TEST_F(Moving, Fox_LooksAround) {
    const auto path = test::repositoryPath("../shared/scenes/models/fox/Fox.glb");
    if (!std::filesystem::exists(path)) {
        GTEST_SKIP() << "no fox at " << path;
    }
    const auto fox = gltf::load(path);
    ASSERT_TRUE(fox) << fox.error().message;
    ASSERT_TRUE(fox->motion);
    const auto inputsAt = [&](Renderer renderer, double time_s) {
        auto inputs = inputsFor(*fox, renderer, time_s);
        inputs.settings.lights.radius_m = 100; // it is 150 m long
        inputs.settings.lights.intensity = 1000;
        return inputs;
    };
    render::Renderer moving(device(), *fox);
    render::ViewRenderer view(moving);
    for (const double time_s : {0.0, 1.3}) {
        render::Renderer resting(device(), posedAt(*fox, time_s));
        const auto inputs = inputsAt(Renderer::kNaive, time_s);
        const Picture naive = draw(view, inputs);
        const Picture lists = draw(view, inputsAt(Renderer::kForwardPlus, time_s));
        EXPECT_EQ(differingFloats(naive, lists), 0U);
        EXPECT_LT(differingShare(naive, draw(resting, inputs)), 0.002);
        auto later = inputs;
        later.time_s += 0.4;
        EXPECT_GT(differingShare(draw(view, later), naive), 0.01);
    }
}

} // namespace froxel::test
