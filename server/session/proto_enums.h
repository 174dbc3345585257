// The schema's enums beside ours: one table each, read in both directions.
#pragma once

#include "froxel/v1/common.pb.h"
#include "session/delivery.h"
#include "view/settings.h"

#include <array>
#include <optional>
#include <utility>

namespace froxel::session {

inline constexpr std::array kRendererTable = {
    std::pair{v1::RENDERER_NAIVE, view::Renderer::kNaive},
    std::pair{v1::RENDERER_FORWARD_PLUS, view::Renderer::kForwardPlus},
    std::pair{v1::RENDERER_CLUSTERED_DEFERRED, view::Renderer::kClusteredDeferred},
    std::pair{v1::RENDERER_TOON_FRAGMENT, view::Renderer::kToonFragment},
    std::pair{v1::RENDERER_TOON_COMPUTE, view::Renderer::kToonCompute},
};
inline constexpr std::array kLightKindTable = {
    std::pair{v1::LIGHT_KIND_POINT, view::LightKind::kPoint},
    std::pair{v1::LIGHT_KIND_SPOT, view::LightKind::kSpot},
    std::pair{v1::LIGHT_KIND_AREA, view::LightKind::kArea},
};
inline constexpr std::array kLightingStageTable = {
    std::pair{v1::LIGHTING_STAGE_AUTO, view::LightingStage::kAuto},
    std::pair{v1::LIGHTING_STAGE_COMPUTE, view::LightingStage::kCompute},
    std::pair{v1::LIGHTING_STAGE_FRAGMENT, view::LightingStage::kFragment},
};
inline constexpr std::array kShadingModelTable = {
    std::pair{v1::SHADING_MODEL_PBR, view::ShadingModel::kPbr},
    std::pair{v1::SHADING_MODEL_LAMBERT, view::ShadingModel::kLambert},
    std::pair{v1::SHADING_MODEL_BLINN_PHONG, view::ShadingModel::kBlinnPhong},
};
inline constexpr std::array kGridLawTable = {
    std::pair{v1::GRID_LAW_LOGARITHMIC, view::GridLaw::kLogarithmic},
    std::pair{v1::GRID_LAW_LINEAR, view::GridLaw::kLinear},
    std::pair{v1::GRID_LAW_HYPERBOLIC, view::GridLaw::kHyperbolic},
};
inline constexpr std::array kLightLoopTable = {
    std::pair{v1::LIGHT_LOOP_AUTO, view::LightLoop::kAuto},
    std::pair{v1::LIGHT_LOOP_LISTS, view::LightLoop::kLists},
    std::pair{v1::LIGHT_LOOP_ALL_LIGHTS, view::LightLoop::kAllLights},
};
inline constexpr std::array kNormalEncodingTable = {
    std::pair{v1::NORMAL_ENCODING_OCT16, view::NormalEncoding::kOct16},
    std::pair{v1::NORMAL_ENCODING_OCT12, view::NormalEncoding::kOct12},
    std::pair{v1::NORMAL_ENCODING_OCT10, view::NormalEncoding::kOct10},
    std::pair{v1::NORMAL_ENCODING_OCT8, view::NormalEncoding::kOct8},
    std::pair{v1::NORMAL_ENCODING_XYZ16, view::NormalEncoding::kXyz16},
    std::pair{v1::NORMAL_ENCODING_XY16, view::NormalEncoding::kXy16},
    std::pair{v1::NORMAL_ENCODING_SPHEREMAP16, view::NormalEncoding::kSpheremap16},
};
inline constexpr std::array kPositionSourceTable = {
    std::pair{v1::POSITION_SOURCE_DEPTH, view::PositionSource::kDepth},
    std::pair{v1::POSITION_SOURCE_STORED_DEPTH, view::PositionSource::kStoredDepth},
    std::pair{v1::POSITION_SOURCE_FP32, view::PositionSource::kFp32},
    std::pair{v1::POSITION_SOURCE_FP16, view::PositionSource::kFp16},
};
inline constexpr std::array kDebugViewTable = {
    std::pair{v1::DEBUG_VIEW_NONE, view::DebugView::kNone},
    std::pair{v1::DEBUG_VIEW_POSITION, view::DebugView::kPosition},
    std::pair{v1::DEBUG_VIEW_DEPTH, view::DebugView::kDepth},
    std::pair{v1::DEBUG_VIEW_NORMAL, view::DebugView::kNormal},
    std::pair{v1::DEBUG_VIEW_BASE_COLOR, view::DebugView::kBaseColor},
    std::pair{v1::DEBUG_VIEW_ROUGHNESS, view::DebugView::kRoughness},
    std::pair{v1::DEBUG_VIEW_GBUFFER, view::DebugView::kGbuffer},
    std::pair{v1::DEBUG_VIEW_GBUFFER_EXTRA, view::DebugView::kGbufferExtra},
    std::pair{v1::DEBUG_VIEW_CLUSTER_SLICES, view::DebugView::kClusterSlices},
    std::pair{v1::DEBUG_VIEW_CLUSTER_TILES, view::DebugView::kClusterTiles},
    std::pair{v1::DEBUG_VIEW_LISTED_LIGHTS, view::DebugView::kListedLights},
    std::pair{v1::DEBUG_VIEW_EVALUATED_LIGHTS, view::DebugView::kEvaluatedLights},
    std::pair{v1::DEBUG_VIEW_CONTRIBUTING_LIGHTS, view::DebugView::kContributingLights},
    std::pair{v1::DEBUG_VIEW_FALSE_POSITIVES, view::DebugView::kFalsePositives},
    std::pair{v1::DEBUG_VIEW_OVERDRAW, view::DebugView::kOverdraw},
    std::pair{v1::DEBUG_VIEW_LIGHT_SPHERES, view::DebugView::kLightSpheres},
    std::pair{v1::DEBUG_VIEW_CLUSTER_WIRES, view::DebugView::kClusterWires},
};
inline constexpr std::array kToneMapTable = {
    std::pair{v1::TONE_MAP_PBR_NEUTRAL, view::ToneMap::kPbrNeutral},
    std::pair{v1::TONE_MAP_CLAMP, view::ToneMap::kClamp},
};
inline constexpr std::array kBloomKindTable = {
    std::pair{v1::BLOOM_KIND_NONE, view::BloomKind::kNone},
    std::pair{v1::BLOOM_KIND_SINGLE_PASS, view::BloomKind::kSinglePass},
    std::pair{v1::BLOOM_KIND_SEPARABLE, view::BloomKind::kSeparable},
    std::pair{v1::BLOOM_KIND_A_TROUS, view::BloomKind::kATrous},
    std::pair{v1::BLOOM_KIND_MIP_CHAIN, view::BloomKind::kMipChain},
};
inline constexpr std::array kAntialiasingTable = {
    std::pair{v1::ANTIALIASING_NONE, view::Antialiasing::kNone},
    std::pair{v1::ANTIALIASING_FXAA, view::Antialiasing::kFxaa},
    std::pair{v1::ANTIALIASING_SSAA4, view::Antialiasing::kSsaa4},
};
inline constexpr std::array kTransparencyTable = {
    std::pair{v1::TRANSPARENCY_SORTED, view::Transparency::kSorted},
    std::pair{v1::TRANSPARENCY_WEIGHTED, view::Transparency::kWeighted},
    std::pair{v1::TRANSPARENCY_PEELED, view::Transparency::kPeeled},
};
inline constexpr std::array kChromaTable = {
    std::pair{v1::CHROMA_420, view::Chroma::k420},
    std::pair{v1::CHROMA_444, view::Chroma::k444},
};
inline constexpr std::array kRefineTable = {
    std::pair{v1::REFINE_NONE, view::Refine::kNone},
    std::pair{v1::REFINE_HIGH, view::Refine::kHigh},
    std::pair{v1::REFINE_LOSSLESS, view::Refine::kLossless},
};
inline constexpr std::array kRefinementTable = {
    std::pair{v1::REFINEMENT_INTERACTIVE, Refinement::kInteractive},
    std::pair{v1::REFINEMENT_SETTLED, Refinement::kSettled},
    std::pair{v1::REFINEMENT_HIGH, Refinement::kHigh},
    std::pair{v1::REFINEMENT_LOSSLESS, Refinement::kLossless},
};
inline constexpr std::array kCodecTable = {
    std::pair{v1::CODEC_JPEG, view::Codec::kJpeg},
    std::pair{v1::CODEC_VP9, view::Codec::kVp9},
};

static_assert(kRefineTable.size() == view::kRefineNames.size());
static_assert(kRendererTable.size() == view::kRendererNames.size());
static_assert(kLightingStageTable.size() == view::kLightingStageNames.size());
static_assert(kShadingModelTable.size() == view::kShadingModelNames.size());
static_assert(kGridLawTable.size() == view::kGridLawNames.size());
static_assert(kLightLoopTable.size() == view::kLightLoopNames.size());
static_assert(kNormalEncodingTable.size() == view::kNormalEncodingNames.size());
static_assert(kPositionSourceTable.size() == view::kPositionSourceNames.size());
static_assert(kToneMapTable.size() == view::kToneMapNames.size());
static_assert(kBloomKindTable.size() == view::kBloomKindNames.size());
static_assert(kAntialiasingTable.size() == view::kAntialiasingNames.size());
static_assert(kTransparencyTable.size() == view::kTransparencyNames.size());
static_assert(kChromaTable.size() == view::kChromaNames.size());
static_assert(kDebugViewTable.size() == view::kDebugViewNames.size());
static_assert(kCodecTable.size() == view::kCodecNames.size());

// None for a value that this server does not know, UNSPECIFIED among them.
template <class Proto, class Ours, size_t N>
[[nodiscard]] constexpr std::optional<Ours>
fromProto(const std::array<std::pair<Proto, Ours>, N>& table, Proto value) {
    for (const auto& [proto, ours] : table) {
        if (proto == value) {
            return ours;
        }
    }
    return std::nullopt;
}

// Every value of ours is in its table; UNSPECIFIED (0) would mean that one is missing.
template <class Proto, class Ours, size_t N>
[[nodiscard]] constexpr Proto toProto(const std::array<std::pair<Proto, Ours>, N>& table,
                                      Ours value) {
    for (const auto& [proto, ours] : table) {
        if (ours == value) {
            return proto;
        }
    }
    return Proto{};
}

} // namespace froxel::session
