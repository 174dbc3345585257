#include "froxel/v1/server.pb.h"
#include "protocol/limits.h"
#include "session/state_message.h"
#include "settings/ranges.h"
#include "unit/session/context.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace froxel::session {
namespace {

using namespace std::chrono_literals;

TEST(Welcome, TellsTheServerTheSceneAndTheState) {
    const SessionContext context = makeContext();
    const SessionState state = initialState(context, TimePoint(1s));
    const v1::ServerMessage message = makeWelcome(12, context, state);
    const v1::Welcome& welcome = message.welcome();
    EXPECT_EQ(welcome.protocol_major(), protocol::kMajor);
    EXPECT_EQ(welcome.session_id(), 12U);
    EXPECT_EQ(welcome.server_version(), "0.1.0");
    EXPECT_EQ(welcome.device(), "llvmpipe");
    EXPECT_EQ(welcome.scene().name(), "hall");
    EXPECT_EQ(welcome.scene().triangles(), 120U);
    ASSERT_EQ(welcome.scene().cameras_size(), 2);
    EXPECT_EQ(welcome.scene().cameras(1), "plan");
    EXPECT_EQ(welcome.scene().bounds().max().y(), 12);
    EXPECT_EQ(welcome.state().width(), context.defaults.settings.size.width_px);
    EXPECT_NEAR(welcome.state().eye().x(), -7, 1e-12);
    EXPECT_EQ(welcome.placed_lights().lights_size(), 0);
}

TEST(Welcome, PlacedLights_AreToldWhole) {
    const SessionContext context = makeContext();
    SessionState state = initialState(context, TimePoint(1s));
    settings::PlacedLight light;
    light.id = 7;
    light.kind = settings::LightKind::kSpot;
    light.color = {0.25F, 0.5F, 1};
    state.settings.lights.placed = settings::PlacedLights({light});
    const auto message = makeWelcome(12, context, state);
    ASSERT_EQ(message.welcome().placed_lights().lights_size(), 1);
    const v1::PlacedLight& told = message.welcome().placed_lights().lights(0);
    EXPECT_EQ(told.id(), 7U);
    EXPECT_EQ(told.kind(), v1::LIGHT_KIND_SPOT);
    EXPECT_EQ(told.color().y(), 0.5);
    EXPECT_EQ(told.radius_m(), 2);
    EXPECT_NEAR(told.outer_cone_deg(), 45, 1e-9);
}

TEST(Welcome, SceneWarnings_AreToldUpToTheirLimit) {
    SessionContext context = makeContext();
    const SessionState state = initialState(context, TimePoint(1s));
    context.scene.warnings = {
        {"MODE_NOT_DRAWN", scene::Severity::kWarning, "/meshes/3", "3 primitives are lines"}};
    context.scene.warnings.resize(
        40, {"BYTE_ORDER_MARK", scene::Severity::kInformation, "", "begins with a mark"});
    context.scene.warnings_left_out = 5;
    const auto message = makeWelcome(12, context, state);
    const v1::SceneInfo& scene = message.welcome().scene();
    ASSERT_EQ(scene.warnings_size(), 32);
    EXPECT_EQ(scene.warnings_left_out(), 13U);
    EXPECT_EQ(scene.warnings(0).code(), "MODE_NOT_DRAWN");
    EXPECT_EQ(scene.warnings(0).severity(), v1::SEVERITY_WARNING);
    EXPECT_EQ(scene.warnings(0).pointer(), "/meshes/3");
    EXPECT_EQ(scene.warnings(0).message(), "3 primitives are lines");
    EXPECT_EQ(scene.warnings(31).severity(), v1::SEVERITY_INFORMATION);
}

// Every setting at an unusual value.
SessionState unusualState(const SessionContext& context) {
    SessionState state = initialState(context, TimePoint(1s));
    state.applied = {44, 5};
    state.settings.camera = context.scene.cameras[1].camera;
    state.settings.camera.lens_shift = {0.25, -0.5};
    state.settings.renderer = settings::Renderer::kToonCompute;
    state.settings.lighting = settings::LightingStage::kFragment;
    state.settings.lights = {.count = 3,
                             .radius_m = 1.5F,
                             .intensity = 2.5F,
                             .cutoff = 0.125F,
                             .cutoff_compensated = true,
                             .seed = 9,
                             .palette = settings::LightPalette::kWarm,
                             .animate = false,
                             .speed = 0.5F,
                             .box = {},
                             .ambient = 0.25F,
                             .scene_lights = false,
                             .placed = {}};
    state.settings.shading = settings::ShadingModel::kLambert;
    state.settings.gbuffer = {settings::NormalEncoding::kXy16, settings::PositionSource::kFp16};
    state.settings.light_loop = settings::LightLoop::kLists;
    state.settings.count_pairs = true;
    state.settings.list_cap = 40;
    state.settings.grid = {
        .automatic = false, .size = {1, 2, 3}, .law = settings::GridLaw::kLinear};
    state.light_clock =
        state.light_clock.withTime(TimePoint(2s), 6.5).withRate(TimePoint(2s), 1, false);
    state.settings.debug = {settings::DebugView::kOverdraw, 6, state.settings.camera};
    state.settings.exposure = 0.5F;
    state.settings.tone_map = settings::ToneMap::kClamp;
    state.settings.toon_compute.count = 2;
    state.settings.toon_outline = {0.5F, 0.0078125F};
    state.settings.bloom = {settings::BloomKind::kATrous, 2.5F, 0.25F, 0.75F, 0.03125F};
    state.settings.fog = {0.5F, 0.25F, 2, -0.5F, {0.5F, 0.25F, 1}, 8, 32, true, true};
    state.settings.antialiasing = settings::Antialiasing::kFxaa;
    state.settings.transparency = settings::Transparency::kPeeled;
    state.settings.peel_layers = 7;
    state.settings.shadows = {12, 320};
    state.delivery = {true, 12.5, settings::Refine::kHigh};
    state.encoding = {42, settings::Chroma::k444, settings::Codec::kVp9, 777};
    return state;
}

TEST(StateChanged, CarriesEverySettingOfViewAndLights) {
    const SessionContext context = makeContext();
    const auto message = makeStateChanged(context, unusualState(context), {});
    EXPECT_EQ(message.state().ref_seq(), 44U);
    const v1::ViewState& view = message.state().state();
    EXPECT_TRUE(view.orthographic());
    EXPECT_EQ(view.half_height_m(), 12);
    EXPECT_EQ(view.lens_shift().x(), 0.25);
    EXPECT_EQ(view.lens_shift().y(), -0.5);
    EXPECT_NEAR(view.up().z(), -1, 1e-12);
    EXPECT_EQ(view.renderer(), v1::RENDERER_TOON_COMPUTE);
    EXPECT_EQ(view.lighting(), v1::LIGHTING_STAGE_FRAGMENT);
    EXPECT_EQ(view.light_count(), 3U);
    EXPECT_EQ(view.light_radius_m(), 1.5);
    EXPECT_EQ(view.light_intensity(), 2.5);
    EXPECT_EQ(view.light_cutoff(), 0.125);
    EXPECT_TRUE(view.light_cutoff_compensated());
    EXPECT_EQ(view.list_cap(), 40U);
    EXPECT_EQ(view.light_seed(), 9U);
    EXPECT_FALSE(view.light_animate());
    EXPECT_EQ(view.light_speed(), 0.5);
    EXPECT_EQ(view.ambient(), 0.25);
    EXPECT_FALSE(view.scene_lights());
    EXPECT_EQ(view.grid().z(), 3U);
    EXPECT_FALSE(view.grid_automatic());
    EXPECT_EQ(view.grid_law(), v1::GRID_LAW_LINEAR);
    EXPECT_EQ(view.shading(), v1::SHADING_MODEL_LAMBERT);
    EXPECT_EQ(view.gbuffer().normal(), v1::NORMAL_ENCODING_XY16);
    EXPECT_EQ(view.gbuffer().position(), v1::POSITION_SOURCE_FP16);
    EXPECT_EQ(view.light_loop(), v1::LIGHT_LOOP_LISTS);
    EXPECT_EQ(view.light_palette(), v1::LIGHT_PALETTE_WARM);
    EXPECT_TRUE(view.count_pairs());
    EXPECT_EQ(view.light_time_s(), 6.5);
    EXPECT_EQ(view.debug_view(), v1::DEBUG_VIEW_OVERDRAW);
    EXPECT_EQ(view.debug_scale_max(), 6);
    EXPECT_TRUE(view.debug_frozen());
}

TEST(StateChanged, CarriesEverySettingOfPictureAndStream) {
    const SessionContext context = makeContext();
    const auto message = makeStateChanged(context, unusualState(context), {});
    const v1::ViewState& view = message.state().state();
    EXPECT_EQ(view.exposure(), 0.5);
    EXPECT_EQ(view.tone_map(), v1::TONE_MAP_CLAMP);
    EXPECT_EQ(view.toon_fragment().points_size(), 8);
    EXPECT_EQ(view.toon_compute().points_size(), 2);
    EXPECT_EQ(view.outline_strength(), 0.5);
    EXPECT_EQ(view.outline_width(), 0.0078125);
    EXPECT_EQ(view.bloom(), v1::BLOOM_KIND_A_TROUS);
    EXPECT_EQ(view.bloom_threshold(), 2.5);
    EXPECT_EQ(view.bloom_knee(), 0.25);
    EXPECT_EQ(view.bloom_strength(), 0.75);
    EXPECT_EQ(view.bloom_radius(), 0.03125);
    EXPECT_EQ(view.antialiasing(), v1::ANTIALIASING_FXAA);
    EXPECT_EQ(view.transparency(), v1::TRANSPARENCY_PEELED);
    EXPECT_EQ(view.peel_layers(), 7U);
    EXPECT_EQ(view.fog().density(), 0.5);
    EXPECT_EQ(view.fog().height_falloff(), 0.25);
    EXPECT_EQ(view.fog().base_height(), 2);
    EXPECT_EQ(view.fog().anisotropy(), -0.5);
    EXPECT_EQ(view.fog().albedo().y(), 0.25);
    EXPECT_EQ(view.fog().tile(), 8U);
    EXPECT_EQ(view.fog().slices(), 32U);
    EXPECT_TRUE(view.fog().half_rate());
    EXPECT_TRUE(view.fog().noise());
    EXPECT_EQ(view.shadow_lights(), 12U);
    EXPECT_EQ(view.shadow_size(), 320U);
    EXPECT_EQ(view.quality(), 42U);
    EXPECT_TRUE(view.adaptive());
    EXPECT_EQ(view.target_fps(), 12.5);
    EXPECT_EQ(view.refine(), v1::REFINE_HIGH);
    EXPECT_EQ(view.chroma(), v1::CHROMA_444);
    EXPECT_EQ(view.codec(), v1::CODEC_VP9);
    EXPECT_EQ(view.video_kbps(), 777U);
}

TEST(StateChanged, PlacedLights_OnlyWhatIsOtherThanWasTold) {
    const SessionContext context = makeContext();
    SessionState state = initialState(context, TimePoint(1s));
    EXPECT_FALSE(makeStateChanged(context, state, {}).state().has_placed_lights());
    settings::PlacedLight kept;
    kept.id = 1;
    settings::PlacedLight moved = kept;
    moved.id = 2;
    settings::PlacedLight gone = kept;
    gone.id = 3;
    const settings::PlacedLights told({kept, moved, gone});
    moved.position_world = {1, 2, 3};
    state.settings.lights.placed = settings::PlacedLights({kept, moved});
    const auto change = makeStateChanged(context, state, told).state().placed_lights();
    EXPECT_FALSE(change.clear());
    ASSERT_EQ(change.remove_size(), 1);
    EXPECT_EQ(change.remove(0), 3U);
    ASSERT_EQ(change.lights_size(), 1);
    EXPECT_EQ(change.lights(0).id(), 2U);
    EXPECT_EQ(change.lights(0).position().y(), 2);
    // Equal lights in other memory are no news.
    const settings::PlacedLights same({kept, moved});
    EXPECT_FALSE(makeStateChanged(context, state, same).state().has_placed_lights());
}

TEST(StateChanged, LightTime_IsToldOnlyWhereItStands) {
    const SessionContext context = makeContext();
    SessionState state = initialState(context, TimePoint(1s));
    EXPECT_FALSE(makeStateChanged(context, state, {}).state().state().has_light_time_s());
    state.light_clock = state.light_clock.withRate(TimePoint(3s), 0, true);
    EXPECT_EQ(makeStateChanged(context, state, {}).state().state().light_time_s(), 2);
}

TEST(StateChanged, LightBox_IsTheOneInUse) {
    SessionContext context = makeContext();
    SessionState state = initialState(context, TimePoint(1s));
    EXPECT_EQ(makeStateChanged(context, state, {}).state().state().light_box().min().x(), -20);
    state.settings.lights.box = BoundsD3{glm::dvec3(-1), glm::dvec3(1)};
    EXPECT_EQ(makeStateChanged(context, state, {}).state().state().light_box().min().x(), -1);
    state.settings.lights.box.reset();
    context.scene.bounds_world = {};
    EXPECT_FALSE(makeStateChanged(context, state, {}).state().state().has_light_box());
}

TEST(Error, EveryCode_HasItsOwn) {
    for (const RejectCode code :
         {RejectCode::kMalformed, RejectCode::kOutOfRange, RejectCode::kUnsupported,
          RejectCode::kVersion, RejectCode::kCapacity, RejectCode::kRateLimit,
          RejectCode::kDevice}) {
        const auto message = makeError({code, 3, "field", "text"});
        EXPECT_EQ(static_cast<int>(message.error().code()), static_cast<int>(code) + 1);
        EXPECT_EQ(message.error().ref_seq(), 3U);
        EXPECT_EQ(message.error().field(), "field");
        EXPECT_EQ(message.error().message(), "text");
    }
}

TEST(NameOf, Code_IsTheProtocolsWithoutItsPrefix) {
    EXPECT_EQ(nameOf(RejectCode::kOutOfRange), "out_of_range");
    EXPECT_EQ(nameOf(RejectCode::kRateLimit), "rate_limit");
}

TEST(PongAndDraining, CarryTheirNumbers) {
    EXPECT_EQ(makePong({7, 8}).pong().ref_seq(), 7U);
    EXPECT_EQ(makePong({7, 8}).pong().client_time_us(), 8U);
    EXPECT_EQ(makeDraining(1500ms, "").draining().deadline_ms(), 1500U);
}

FrameRecord record() {
    FrameRecord record;
    record.frame_id = 4;
    record.applied = {2, 99};
    record.width_px = 640;
    record.height_px = 360;
    record.encoded_bytes = 5;
    record.queue_us = 1.4;
    record.render_us = 2.5;
    record.encode_wait_us = 3;
    record.delivered = {0.75, {55, settings::Chroma::k420}, Refinement::kInteractive, 4, 0.5};
    record.queue_delay_us = 1500;
    record.link_bits_per_s = 1.7e6;
    record.encode_us = 4;
    record.send_wait_us = 5;
    record.dropped_count = 6;
    record.time_s = 7.5;
    record.stats.passes = {{"depth", 10}, {"lighting", 20.6}};
    record.stats.gpu_us = 30;
    record.stats.triangle_count = 1000;
    LightListStats& lists = record.stats.lists;
    lists.light_count = 100;
    lists.cluster_count = 50;
    lists.empty_count = 10;
    lists.entry_count = 400;
    lists.largest = 12;
    lists.mean = 10.0;
    lists.p95 = 11;
    lists.bytes = 2000;
    lists.all_lights = true;
    lists.redraw_count = 2;
    lists.why = "few lights";
    record.stats.grid = {5, 3, 10, 64, 32, 0.5, 40, true, "cheapest of 9"};
    return record;
}

TEST(FrameHeader, TimesThatAreUnknown_AreAbsent_AndNoneIsZero) {
    FrameRecord untold = record();
    untold.stats.passes = {{"depth", 0}, {"lighting", std::nullopt}};
    untold.stats.gpu_us = std::nullopt;
    const v1::FrameHeader header = makeFrameHeader(untold);
    EXPECT_FALSE(header.has_gpu_us());
    ASSERT_EQ(header.passes_size(), 2);
    EXPECT_TRUE(header.passes(0).has_gpu_us());
    EXPECT_EQ(header.passes(0).gpu_us(), 0U);
    EXPECT_EQ(header.passes(1).name(), "lighting");
    EXPECT_FALSE(header.passes(1).has_gpu_us());
}

TEST(FrameHeader, CarriesTheRecord) {
    const v1::FrameHeader header = makeFrameHeader(record());
    EXPECT_EQ(header.frame_id(), 4U);
    EXPECT_EQ(header.applied_seq(), 2U);
    EXPECT_EQ(header.applied_client_time_us(), 99U);
    ASSERT_EQ(header.parts_size(), 1);
    EXPECT_EQ(header.parts(0).offset(), 0U);
    EXPECT_EQ(header.parts(0).length(), 5U);
    EXPECT_EQ(header.parts(0).width(), 640U);
    EXPECT_EQ(header.parts(0).codec(), v1::CODEC_JPEG);
    EXPECT_EQ(header.queue_us(), 1U);
    EXPECT_EQ(header.render_us(), 3U);
    EXPECT_EQ(header.gpu_us(), 30U);
    EXPECT_EQ(header.encode_wait_us(), 3U);
    EXPECT_EQ(header.scale(), 0.75);
    EXPECT_EQ(header.geometry_error_px(), 0.5);
    EXPECT_EQ(header.quality(), 55U);
    EXPECT_EQ(header.chroma(), v1::CHROMA_420);
    EXPECT_EQ(header.refinement(), v1::REFINEMENT_INTERACTIVE);
    EXPECT_EQ(header.rung(), 4U);
    EXPECT_EQ(header.queue_delay_us(), 1500U);
    EXPECT_EQ(header.link_bits_per_s(), 1'700'000U);
    EXPECT_EQ(header.encode_us(), 4U);
    EXPECT_EQ(header.send_wait_us(), 5U);
    ASSERT_EQ(header.passes_size(), 2);
    EXPECT_EQ(header.passes(1).name(), "lighting");
    EXPECT_EQ(header.passes(1).gpu_us(), 21U);
    EXPECT_EQ(header.light_count(), 100U);
    EXPECT_EQ(header.list_entries(), 400U);
    EXPECT_EQ(header.list_mean(), 10.0);
    EXPECT_EQ(header.list_largest(), 12U);
    EXPECT_EQ(header.list_p95(), 11U);
    EXPECT_EQ(header.list_clusters(), 50U);
    EXPECT_EQ(header.list_empty(), 10U);
    EXPECT_EQ(header.list_bytes(), 2000U);
    EXPECT_TRUE(header.all_lights());
    EXPECT_EQ(header.list_redraws(), 2U);
    EXPECT_EQ(header.list_why(), "few lights");
    EXPECT_EQ(header.grid().x(), 5U);
    EXPECT_EQ(header.grid().z(), 10U);
    EXPECT_EQ(header.grid().tile_width_px(), 64U);
    EXPECT_EQ(header.grid().tile_height_px(), 32U);
    EXPECT_EQ(header.grid().near_m(), 0.5);
    EXPECT_EQ(header.grid().far_m(), 40);
    EXPECT_TRUE(header.grid().automatic());
    EXPECT_EQ(header.grid().why(), "cheapest of 9");
    EXPECT_FALSE(header.has_pairs());
    EXPECT_EQ(header.dropped_frames(), 6U);
    EXPECT_EQ(header.time_s(), 7.5);
    EXPECT_EQ(header.triangles(), 1000U);
}

TEST(FrameHeader, GridAndPairs_AreThereOnlyWhereTheFrameHasThem) {
    FrameRecord bare = record();
    bare.stats.grid = {};
    static constexpr StatRow kEvaluated{"pairs", "evaluated", "evaluated"};
    bare.stats.steps.set(kEvaluated, 5'000'000'000);
    const v1::FrameHeader header = makeFrameHeader(bare);
    EXPECT_FALSE(header.has_grid());
    EXPECT_EQ(header.pairs().evaluated(), 5'000'000'000U);
}

// Each row names its field; what no step told is absent.
TEST(FrameHeader, StepsFigures_AreInTheFieldsThatTheirRowsName) {
    FrameRecord frame = record();
    EXPECT_FALSE(makeFrameHeader(frame).has_peel() || makeFrameHeader(frame).has_shadows() ||
                 makeFrameHeader(frame).has_metered_ev());
    static constexpr StatRow kLayers{"peel", "layers", "layers"};
    static constexpr StatRow kMapsKept{"shadows", "kept", "maps_kept"};
    static constexpr StatRow kDraws{"shadows", "draws", ""};
    static constexpr StatRow kMetered{"", "metered_ev", "metered_ev", false};
    frame.stats.steps.set(kDraws, 3);
    EXPECT_FALSE(makeFrameHeader(frame).has_shadows()) << "a row without a field";
    frame.stats.steps.set(kLayers, 4);
    frame.stats.steps.set(kMapsKept, 1e12);
    frame.stats.steps.set(kMetered, 0);
    EXPECT_EQ(makeFrameHeader(frame).peel().layers(), 4U);
    EXPECT_EQ(makeFrameHeader(frame).shadows().maps_kept(), UINT32_MAX);
    EXPECT_TRUE(makeFrameHeader(frame).has_metered_ev());
    frame.stats.steps.set(kMetered, -2.5);
    EXPECT_EQ(makeFrameHeader(frame).metered_ev(), -2.5);
}

TEST(FrameHeader, SurfacesThatAreKept_AreToldSo) {
    FrameRecord frame = record();
    for (const bool kept : {true, false}) {
        frame.stats.surfaces_reused = kept;
        EXPECT_EQ(makeFrameHeader(frame).surfaces_kept(), kept);
    }
}

TEST(FrameDetails, Legend_IsThereWithADebugView) {
    FrameDetails details;
    EXPECT_FALSE(makeFrameDetails(details).details().has_legend());
    details.legend = DebugLegend{"overdraw", "Fragments", 0, 8, "fragments", {0x440154, 0xfde725}};
    const v1::ServerMessage message = makeFrameDetails(details);
    const v1::DebugLegend& legend = message.details().legend();
    EXPECT_EQ(legend.view(), v1::DEBUG_VIEW_OVERDRAW);
    EXPECT_EQ(legend.words(), "Fragments");
    EXPECT_EQ(legend.max(), 8);
    EXPECT_EQ(legend.unit(), "fragments");
    ASSERT_EQ(legend.colors_size(), 2);
    EXPECT_EQ(legend.colors(1), 0xfde725U);
}

TEST(FrameDetails, CarryTheirLinesAndRowsInOrder) {
    const FrameDetails details{
        {"no masks: no discard", "no spots"}, {{"textures", 5'000'000'000}, {"lists", 7}}, {}};
    const v1::ServerMessage message = makeFrameDetails(details);
    ASSERT_EQ(message.details().plan_size(), 2);
    EXPECT_EQ(message.details().plan(1), "no spots");
    ASSERT_EQ(message.details().memory_size(), 2);
    EXPECT_EQ(message.details().memory(0).purpose(), "textures");
    EXPECT_EQ(message.details().memory(0).bytes(), 5'000'000'000U);
}

TEST(FrameHeader, WithItsPayload_IsAFrame) {
    const std::string message = protocol::encodeFramePrefix(makeFrameHeader(record())) + "12345";
    v1::FrameHeader back;
    const auto payload = protocol::decodeFrame(protocol::bytesOf(message), back);
    ASSERT_TRUE(payload) << payload.error().message;
    EXPECT_EQ(payload->size(), 5U);
}

TEST(FrameHeader, AbsurdDurations_StopAtTheEnds) {
    FrameRecord odd = record();
    odd.queue_us = -3;
    odd.render_us = 1e300;
    odd.encode_us = std::numeric_limits<double>::quiet_NaN();
    odd.encode_wait_us = std::numeric_limits<double>::infinity();
    const v1::FrameHeader header = makeFrameHeader(odd);
    EXPECT_EQ(header.queue_us(), 0U);
    EXPECT_EQ(header.render_us(), std::numeric_limits<uint32_t>::max());
    EXPECT_EQ(header.encode_us(), 0U);
    EXPECT_EQ(header.encode_wait_us(), std::numeric_limits<uint32_t>::max());
}

} // namespace
} // namespace froxel::session
