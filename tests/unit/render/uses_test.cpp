// What lies between the steps of a frame: the barriers that follow from their uses cover those that
// were once written by hand, one row each.
#include "interface/constants.h"
#include "render/frame/frame_plan.h"
#include "render/frame/uses.h"
#include "render/steps/order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

namespace froxel::render {

namespace {

using Access = vk::AccessFlagBits2;
using Stage = vk::PipelineStageFlagBits2;
using settings::DebugView;
using settings::LightingStage;
using settings::Renderer;

constexpr vk::AccessFlags2 kDepthWrite = Access::eDepthStencilAttachmentWrite;
constexpr vk::AccessFlags2 kDepthTest =
    Access::eDepthStencilAttachmentRead | Access::eDepthStencilAttachmentWrite;
constexpr vk::AccessFlags2 kDrawn = Access::eColorAttachmentWrite;
constexpr vk::AccessFlags2 kStored = Access::eShaderStorageWrite;
constexpr auto kCompute = Stage::eComputeShader;
constexpr auto kFragment = Stage::eFragmentShader;
constexpr auto kColor = Stage::eColorAttachmentOutput;

struct Frame {
    settings::ViewSettings settings;
    FrameFacts facts{.lights = io::kLightLocal};
};
using Change = std::function<void(Frame&)>;

Change renderer(Renderer kind, LightingStage stage = LightingStage::kCompute) {
    return [=](Frame& frame) {
        frame.settings.renderer = kind;
        frame.settings.lighting = stage;
    };
}
const Change kPrepass = [](Frame& frame) { frame.facts.prepass_pays = true; };
const Change kIds = [](Frame& frame) { frame.facts.geometry = SolidGeometry::kIds; };
const Change kComputeIds = [](Frame& frame) { frame.facts.geometry = SolidGeometry::kComputeIds; };
const Change kBlends = [](Frame& frame) { frame.facts.transparent_visible = true; };
const Change kFog = [](Frame& frame) { frame.settings.fog = {.density = 0.1F}; };
const Change kBloom = [](Frame& frame) {
    frame.settings.bloom.kind = settings::BloomKind::kMipChain;
};
const Change kFxaa = [](Frame& frame) {
    frame.settings.antialiasing = settings::Antialiasing::kFxaa;
};
const Change kMaps = [](Frame& frame) { frame.facts.lights |= io::kLightShadows; };
const Change kBends = [](Frame& frame) { frame.facts.bends = true; };
const Change kDeviceLists = [](Frame& frame) { frame.facts.lists = ListPlace::kDevice; };
const Change kLayered = [](Frame& frame) { frame.facts.layers_visible = true; };
const Change kOutlined = [](Frame& frame) { frame.settings.toon_outline.strength = 1; };
const Change kCounted = [](Frame& frame) { frame.settings.count_pairs = true; };
const Change kLinear = [](Frame& frame) { frame.facts.outputs = {Output::kRadiance}; };

Change shows(DebugView view) {
    return [=](Frame& frame) { frame.settings.debug.view = view; };
}

struct ByHand {
    std::vector<Change> frame;
    const StepRow* from;
    const StepRow* to;
    Dependency barrier;
};

const Change kDeferred = renderer(Renderer::kClusteredDeferred);
const Change kDeferredInFragments =
    renderer(Renderer::kClusteredDeferred, LightingStage::kFragment);
const Change kForward = renderer(Renderer::kForwardPlus, LightingStage::kFragment);
const Change kToon = renderer(Renderer::kToonCompute);

const std::vector<ByHand> kByHand = {
    // vertices that bend -> whatever draws or shades them
    {{kDeferred, kBends},
     &kPoseStep,
     &kGbufferStep,
     {Stage::eCopy | kCompute, Access::eTransferWrite | kStored, Stage::eVertexAttributeInput,
      Access::eVertexAttributeRead}},
    {{kDeferred, kBends, kIds},
     &kPoseStep,
     &kIdsStep,
     {Stage::eCopy | kCompute, Access::eTransferWrite | kStored,
      Stage::eVertexAttributeInput | kCompute,
      Access::eVertexAttributeRead | Access::eShaderStorageRead}},
    // light lists and indices -> shading
    {{kDeferred, kDeviceLists},
     &kListsStep,
     &kLightingStep,
     {kCompute, kStored, kCompute, Access::eShaderSampledRead}},
    {{kForward, kDeviceLists},
     &kListsStep,
     &kForwardStep,
     {kCompute, kStored, kFragment, Access::eShaderSampledRead}},
    // depths as lights see them -> whatever is lit
    {{kDeferred, kMaps},
     &kShadowsStep,
     &kLightingStep,
     {kDepthStages, kDepthWrite, kCompute, Access::eShaderSampledRead}},
    {{kForward, kMaps},
     &kShadowsStep,
     &kForwardStep,
     {kDepthStages, kDepthWrite, kFragment, Access::eShaderSampledRead}},
    // prepass depth -> the next pass's equality test
    {{kForward, kPrepass},
     &kDepthStep,
     &kForwardStep,
     {kDepthStages, kDepthWrite, kDepthStages, kDepthTest}},
    {{kDeferred, kPrepass},
     &kDepthStep,
     &kGbufferStep,
     {kDepthStages, kDepthWrite, kDepthStages, kDepthTest}},
    // depth and ids -> the pass that shades or fills the G-buffer
    {{kDeferred, kIds},
     &kIdsStep,
     &kGbufferStep,
     {kDepthStages | kColor, kDepthWrite | kDrawn, kCompute, Access::eShaderSampledRead}},
    {{kDeferred, kComputeIds},
     &kIdsStep,
     &kGbufferStep,
     {kCompute, kStored, kCompute, Access::eShaderSampledRead | kStored}},
    {{kForward, kIds},
     &kIdsStep,
     &kForwardStep,
     {kDepthStages | kColor, kDepthWrite | kDrawn, kCompute, Access::eShaderSampledRead}},
    // G-buffer and depth -> lighting
    {{kDeferred},
     &kGbufferStep,
     &kLightingStep,
     {kDepthStages | kColor, kDepthWrite | kDrawn, kCompute, Access::eShaderSampledRead}},
    {{kDeferredInFragments},
     &kGbufferStep,
     &kLightingStep,
     {kDepthStages | kColor, kDepthWrite | kDrawn, kFragment | kDepthStages,
      Access::eShaderSampledRead | Access::eDepthStencilAttachmentRead}},
    {{kDeferred, kIds},
     &kGbufferStep,
     &kLightingStep,
     {kCompute, kStored, kCompute, Access::eShaderSampledRead}},
    // lit radiance -> layers, bands, edges
    {{kDeferred, kLayered},
     &kLightingStep,
     &kLayersStep,
     {kCompute, kStored, kColor, Access::eColorAttachmentRead | kDrawn}},
    {{kDeferredInFragments, kLayered},
     &kLightingStep,
     &kLayersStep,
     {kColor, kDrawn, kColor, Access::eColorAttachmentRead | kDrawn}},
    {{kDeferred, kLayered, kIds},
     &kLightingStep,
     &kLayersStep,
     {kCompute, kStored, kCompute, Access::eShaderStorageRead | kStored}},
    {{kToon},
     &kLightingStep,
     &kToonStep,
     {kCompute, kStored, kCompute, Access::eShaderStorageRead}},
    {{kToon, kOutlined},
     &kToonStep,
     &kOutlineStep,
     {kCompute, kStored, kCompute, Access::eShaderStorageRead | kStored}},
    // what a debug view in the picture's place looks at
    {{kDeferred, shows(DebugView::kOverdraw)},
     &kFragmentsStep,
     &kDebugViewStep,
     {kColor, kDrawn, kCompute, Access::eShaderStorageRead}},
    {{kForward, shows(DebugView::kInstances)},
     &kFragmentsStep,
     &kDebugViewStep,
     {kColor, kDrawn, kCompute, Access::eShaderStorageRead}},
    {{kForward, shows(DebugView::kDepth)},
     &kDepthStep,
     &kDebugViewStep,
     {kDepthStages, kDepthWrite, kCompute, Access::eShaderSampledRead}},
    {{kDeferred, shows(DebugView::kNormal)},
     &kGbufferStep,
     &kDebugViewStep,
     {kDepthStages | kColor, kDepthWrite | kDrawn, kCompute, Access::eShaderSampledRead}},
    // depth -> counting
    {{kForward, kCounted},
     &kForwardStep,
     &kPairsStep,
     {kDepthStages, kDepthWrite, kCompute, Access::eShaderSampledRead}},
    // radiance and depth of solid surfaces -> what lies around them
    {{kForward, kFog},
     &kForwardStep,
     &kFogStep,
     {kDepthStages | kColor, kDepthWrite | kDrawn, kCompute,
      Access::eShaderSampledRead | Access::eShaderStorageRead | kStored}},
    // and -> blending
    {{kForward, kBlends},
     &kForwardStep,
     &kBlendedStep,
     {kDepthStages | kColor, kDepthWrite | kDrawn, kDepthStages | kColor,
      kDepthTest | Access::eColorAttachmentRead | kDrawn}},
    {{kDeferred, kBlends},
     &kLightingStep,
     &kBlendedStep,
     {kCompute, kStored, kColor, Access::eColorAttachmentRead | kDrawn}},
    {{kDeferred, kBlends, kComputeIds},
     &kGbufferStep,
     &kBlendedStep,
     {kCompute, kStored, Stage::eCopy, Access::eTransferRead}},
    // the fog's volume -> blended surfaces in front of it
    {{kForward, kFog, kBlends},
     &kFogStep,
     &kBlendedStep,
     {kCompute, kStored, kFragment, Access::eShaderSampledRead}},
    // radiance -> what is done to all of it
    {{kForward, kBlends, kBloom},
     &kBlendedStep,
     &kBloomStep,
     {kColor, kDrawn, kCompute, Access::eShaderSampledRead | Access::eShaderStorageRead | kStored}},
    {{kForward, shows(DebugView::kLightSpheres)},
     &kForwardStep,
     &kWiresStep,
     {kDepthStages | kColor, kDepthWrite | kDrawn, kColor | kFragment,
      Access::eColorAttachmentRead | kDrawn | Access::eShaderSampledRead}},
    {{kForward, shows(DebugView::kLightSpheres)},
     &kWiresStep,
     &kTonemapStep,
     {kColor, kDrawn, kCompute, Access::eShaderStorageRead}},
    {{kForward},
     &kForwardStep,
     &kTonemapStep,
     {kColor, kDrawn, kCompute, Access::eShaderStorageRead}},
    // packed pixels -> filters, the host
    {{kForward, kFxaa},
     &kTonemapStep,
     &kFxaaStep,
     {kCompute, kStored, kCompute, Access::eShaderSampledRead}},
    {{kDeferred, kFxaa},
     &kLightingStep,
     &kFxaaStep,
     {kCompute, kStored, kCompute, Access::eShaderSampledRead}},
    {{kDeferred},
     &kLightingStep,
     &kReadbackStep,
     {kCompute, kStored, Stage::eCopy, Access::eTransferRead}},
    {{kForward, kFxaa},
     &kFxaaStep,
     &kReadbackStep,
     {kCompute, kStored, Stage::eCopy, Access::eTransferRead}},
    {{kForward, kLinear},
     &kForwardStep,
     &kRadianceReadbackStep,
     {kColor, kDrawn, Stage::eCopy, Access::eTransferRead}},
};

FramePlan planOf(const ByHand& row) {
    Frame frame;
    for (const Change& change : row.frame) {
        change(frame);
    }
    return planFrame(frame.settings, frame.facts, kOrder);
}

// A piece of what lies between two steps.
struct Between {
    Dependency derived;
    size_t before; // the index of the step that it was recorded before
};

std::vector<Between> derive(const FramePlan& plan) {
    std::vector<Between> all;
    UseTracker tracker;
    for (size_t i = 0; i < plan.steps.size(); ++i) {
        if (plan.steps[i].reused) {
            continue;
        }
        if (const auto derived = tracker.before(plan.steps[i].uses)) {
            all.push_back({*derived, i});
        }
    }
    return all;
}

bool covers(const Dependency& all, const Dependency& some) {
    return (all.from & some.from) == some.from && (all.written & some.written) == some.written &&
           (all.to & some.to) == some.to && (all.used & some.used) == some.used;
}

size_t indexOf(const FramePlan& plan, const StepRow* row) {
    return static_cast<size_t>(std::ranges::find(plan.steps, row, &PlannedStep::row) -
                               plan.steps.begin());
}

} // namespace

TEST(UseTracker, BarriersWrittenByHand_AreCovered) {
    for (const ByHand& row : kByHand) {
        SCOPED_TRACE(std::string(row.from->name) + " -> " + row.to->name);
        const FramePlan plan = planOf(row);
        const size_t from = indexOf(plan, row.from);
        const size_t to = indexOf(plan, row.to);
        ASSERT_LT(from, to);
        ASSERT_LT(to, plan.steps.size());
        const auto derived = derive(plan);
        // By one barrier, or by several that each hold a part of it.
        Dependency together;
        for (const Between& between : derived) {
            const bool there = between.before > from && between.before <= to &&
                               (between.derived.from & row.barrier.from);
            if (there) {
                together.from |= between.derived.from;
                together.written |= between.derived.written;
                together.to |= between.derived.to;
                together.used |= between.derived.used;
            }
        }
        EXPECT_TRUE(covers(together, row.barrier));
    }
}

TEST(UseTracker, ReadAfterRead_NeedsNothing) {
    UseTracker tracker;
    const std::array write = {use::stored(Resource::kRadiance)};
    const std::array read = {use::sampled(Resource::kRadiance)};
    EXPECT_FALSE(tracker.before(write));
    EXPECT_EQ(tracker.before(read),
              (Dependency{kCompute, kStored, kCompute, Access::eShaderSampledRead}));
    EXPECT_FALSE(tracker.before(read)) << "the first one made it visible";
    const std::array elsewhere = {use::sampled(Resource::kRadiance, kFragment)};
    EXPECT_TRUE(tracker.before(elsewhere)) << "in another stage it is not";
}

TEST(UseTracker, WriteAfterRead_WaitsForTheReaders) {
    UseTracker tracker;
    const std::array read = {use::sampled(Resource::kDepth, kFragment)};
    const std::array write = {use::depthTested()};
    EXPECT_FALSE(tracker.before(read)) << "the frame began with a barrier";
    const auto wait = tracker.before(write);
    ASSERT_TRUE(wait);
    EXPECT_EQ(wait->from, vk::PipelineStageFlags2(kFragment));
    EXPECT_EQ(wait->written, vk::AccessFlags2());
    EXPECT_EQ(wait->to, kDepthStages);
}

TEST(UseTracker, OtherResources_DoNotWait) {
    UseTracker tracker;
    const std::array write = {use::stored(Resource::kRadiance)};
    const std::array read = {use::sampled(Resource::kDepth), use::sampled(Resource::kGbuffer)};
    EXPECT_FALSE(tracker.before(write));
    EXPECT_FALSE(tracker.before(read));
}

// Several uses of one resource in one step are one: the next step waits for all of them.
TEST(UseTracker, SeveralUsesOfAStep_AreWaitedForTogether) {
    UseTracker tracker;
    const std::array both = {use::drawn(Resource::kRadiance), use::stored(Resource::kRadiance)};
    const std::array read = {use::copied(Resource::kRadiance)};
    EXPECT_FALSE(tracker.before(both));
    const auto wait = tracker.before(read);
    ASSERT_TRUE(wait);
    EXPECT_EQ(wait->from, kColor | kCompute);
    EXPECT_EQ(wait->written, kDrawn | kStored);
}

// What was drawn by an earlier frame lies behind the barrier that a frame begins with.
TEST(UseTracker, ReusedSurfaces_AreNotWaitedFor) {
    FramePlan plan = planOf({{kDeferred}, nullptr, nullptr, {}});
    plan.reuse(kSurfaceResources);
    const auto derived = derive(plan);
    for (const Between& between : derived) {
        EXPECT_FALSE(between.derived.written & kDepthWrite);
    }
    ASSERT_FALSE(derived.empty());
    EXPECT_EQ(plan.steps[derived.front().before].row, &kReadbackStep);
}

} // namespace froxel::render
