#include "render/view/refusals.h"

#include "render/frame/frame_plan.h"
#include "render/lists/list_limits.h"
#include "render/pipelines/gbuffer_layout.h"
#include "render/scene/scene_resources.h"
#include "render/steps/order.h"

#include <spdlog/fmt/fmt.h>
#include <spdlog/fmt/ranges.h>

#include <string>
#include <utility>
#include <vector>

namespace froxel::render {

namespace {

// "a, b or c".
std::string deferredRenderers() {
    std::vector<std::string> names;
    for (size_t i = 0; i < settings::kRendererNames.size(); ++i) {
        if (!isForward(static_cast<settings::Renderer>(i))) {
            names.emplace_back(settings::kRendererNames[i]);
        }
    }
    const std::string last = std::move(names.back());
    names.pop_back();
    return fmt::format("{} or {}", fmt::join(names, ", "), last);
}

std::string rendererName(const FrameInputs& inputs) {
    return std::string(settings::kRendererNames[static_cast<size_t>(inputs.settings.renderer)]);
}

// Whether there is no other way to draw what is asked for.
bool needsVisibility(const FrameInputs& inputs) {
    return inputs.geometry == GeometryPath::kVisibility ||
           inputs.geometry == GeometryPath::kComputeRaster ||
           (isForward(inputs.settings.renderer) &&
            inputs.settings.lighting == settings::LightingStage::kCompute);
}

// Whether the debug view can show what was asked for. Errors: kUnsupported.
Result<void> showable(const FrameInputs& inputs, bool specular) {
    const auto& settings = inputs.settings;
    const settings::DebugView debug = settings.debug.view;
    const std::string name = "debug_view: " + std::string(settings::nameOf(debug));
    if (!inputs.outputs.none() && settings::replacesPicture(debug)) {
        return Error{ErrorCode::kUnsupported, name + " has no linear picture; use .png or .jpg"};
    }
    if (settings::showsGbuffer(debug) && isForward(settings.renderer)) {
        return Error{ErrorCode::kUnsupported,
                     name + " is not available for renderer " + rendererName(inputs) +
                         ", which has no G-buffer; use " + deferredRenderers()};
    }
    if (debug == settings::DebugView::kGbufferExtra &&
        extraFormat(settings.gbuffer, specular) == vk::Format::eUndefined) {
        return Error{ErrorCode::kUnsupported,
                     name + " is not available for this G-buffer layout, which has one target; use "
                            "normal xyz16 or a position other than depth"};
    }
    return {};
}

// Whether the G-buffer has room for what the scene's materials ask for. Errors: kUnsupported.
Result<void> storable(const FrameInputs& inputs, bool specular) {
    if (specular && !holdsSpecular(inputs.settings.gbuffer)) {
        return Error{
            ErrorCode::kUnsupported,
            "gbuffer: normal xyz16 with position fp32 leaves no room for the ior, specular "
            "or glossiness of this scene's materials; use another normal, another "
            "position, or a forward renderer"};
    }
    return {};
}

// Peeling tells triangles apart and counts what it leaves out. Errors: kUnsupported.
Result<void>
peelable(const FrameInputs& inputs, const SceneResources& scene, const MaterialSet& material_set) {
    const auto& traits = scene.shared.device.traits();
    if (inputs.settings.transparency != settings::Transparency::kPeeled ||
        !material_set.needs.blended) {
        return {};
    }
    const std::string lacks = !traits.visibility_lacks.empty() ? traits.visibility_lacks
                              : !traits.counts_samples         ? "occlusionQueryPrecise"
                                                               : "";
    if (!lacks.empty()) {
        return Error{ErrorCode::kUnsupported,
                     "transparency: peeled is not available, because the device lacks " + lacks +
                         "; use sorted or weighted"};
    }
    return {};
}

} // namespace

Result<void>
canDraw(const FrameInputs& inputs, const SceneResources& scene, MaterialSet& material_set) {
    const Detail detail = scene.detailOf(inputs.settings.geometry_error_px);
    if (const auto& why = material_set.visibilityUnusable(detail);
        !why.empty() && needsVisibility(inputs)) {
        return Error{ErrorCode::kUnsupported, "lighting: compute is not available for renderer " +
                                                  rendererName(inputs) + ", since " + why +
                                                  "; use auto or fragment"};
    }
    const bool specular = storesSpecular(inputs.settings, material_set.needs.specular);
    if (auto shown = showable(inputs, specular); !shown) {
        return shown;
    }
    if (auto stored = storable(inputs, specular); !stored) {
        return stored;
    }
    if (auto peeled = peelable(inputs, scene, material_set); !peeled) {
        return peeled;
    }
    for (const StepRow* row : kOrder) {
        if (row->able != nullptr) {
            if (auto able = row->able(inputs.settings, scene.shared.device); !able) {
                return able;
            }
        }
    }
    if (inputs.geometry == GeometryPath::kComputeRaster &&
        !material_set.visibility(detail).compute_unusable.empty()) {
        return Error{ErrorCode::kUnsupported, "ids cannot be rasterised in compute, because " +
                                                  material_set.visibility(detail).compute_unusable};
    }
    return {};
}

std::string pictureWords(const settings::ViewSettings& settings) {
    std::string what = "a picture of " + std::to_string(settings.size.width_px) + "x" +
                       std::to_string(settings.size.height_px);
    std::vector<std::string> more;
    if (settings::samplesAcross(settings.antialiasing) > 1) {
        more.emplace_back("four samples a pixel");
    }
    for (const StepRow* row : kOrder) {
        if (row->memory_words != nullptr) {
            if (auto words = row->memory_words(settings)) {
                more.push_back(std::move(*words));
            }
        }
    }
    if (settings.lights.count > 10'000) { // fewer take next to nothing
        more.push_back(std::to_string(settings.lights.count) + " lights");
    }
    for (size_t i = 0; i < more.size(); ++i) {
        what += (i == 0 ? " with " : i + 1 == more.size() ? " and " : ", ") + more[i];
    }
    return what;
}

Error tooLongInPieces(const settings::Size& size, const FramePieces& pieces, Seconds limit) {
    return {ErrorCode::kTooLong,
            fmt::format("a picture of {}x{} in {} pieces, each of which processes all triangles, "
                        "takes about {:.3g} s of this device; a frame may take {:.3g} s. "
                        "Use fewer lights, fewer effects, or a smaller picture",
                        size.width_px, size.height_px, pieces.count(), pieces.estimate().count(),
                        limit.count()),
            pieces.estimate() / limit};
}

Error tooManyToCap(uint32_t light_count) {
    return {ErrorCode::kCapacity,
            fmt::format("list_cap: the lists of {} lights have more than {} entries before "
                        "capping; use fewer or smaller lights, or fewer clusters",
                        light_count, kHostListEntries)};
}

Error noMemoryFor(const settings::ViewSettings& settings) {
    return {ErrorCode::kCapacity, "the device has no memory for " + pictureWords(settings)};
}

} // namespace froxel::render
