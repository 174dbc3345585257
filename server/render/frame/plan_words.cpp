#include "render/frame/plan_words.h"

#include "interface/constants.h"
#include "interface/gbuffer_io.h"

#include <algorithm>

namespace froxel::render {

namespace {

using Lines = std::vector<std::string>;

template <class Names, class Enum>
std::string nameOf(const Names& names, Enum value) {
    return std::string(names[static_cast<size_t>(value)]);
}

size_t with(const SceneNeeds& needs, MaterialFlags flag) {
    const auto& all = needs.material_flags;
    return static_cast<size_t>(
        std::count_if(all.begin(), all.end(), [&](MaterialFlags f) { return (f & flag) != 0; }));
}

// "normal maps on 18 of 25 materials", or what their absence saves.
std::string share(const char* what, size_t count, size_t total, const char* of, const char* none) {
    if (count == 0) {
        return none;
    }
    return std::string(what) + " on " + std::to_string(count) + " of " + std::to_string(total) +
           " " + of;
}

std::string counted(size_t count, const char* one, const char* many) {
    return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::string lightWords(const FrameFacts& facts, const FramePlan& plan, bool naive) {
    if (!facts.hasLight(io::kLightLocal)) {
        return facts.hasLight(io::kLightDirectional)
                   ? "no point or spot light: no assignment, no lists"
                   : "no lights: no assignment, no lists, no light loop";
    }
    if (plan.lists) {
        return "light lists: a pixel loops over its cluster's lights";
    }
    return naive ? "naive: no lists, every fragment loops over all lights"
                 : "no light lists: every pixel loops over all lights";
}

void addLightWords(Lines& lines,
                   const settings::ViewSettings& settings,
                   const FrameFacts& facts,
                   const FramePlan& plan) {
    lines.push_back(lightWords(facts, plan, settings.renderer == settings::Renderer::kNaive));
    const uint32_t flags = plan.lighting_light_flags;
    if (facts.hasLight(io::kLightLocal)) {
        lines.emplace_back(facts.hasLight(io::kLightSpots)
                               ? "spot lights: cones are fetched and cut"
                               : "no spot light: no cone data");
        if (facts.hasLight(io::kLightAreas)) {
            lines.emplace_back(
                settings.shading == settings::ShadingModel::kLambert
                    ? "area lights: rectangles are fetched and integrated"
                    : "area lights: rectangles and the highlight's table are fetched");
        }
        lines.emplace_back(facts.hasLight(io::kLightEqualRadii)
                               ? "all radii equal: radius is a constant"
                               : "radii differ: each light has its own");
        if ((flags & io::kLightCulled) != 0) {
            lines.emplace_back(
                "subgroups fetch lights together and skip lights that reach none of their pixels");
        } else if ((flags & io::kLightBatched) != 0) {
            lines.emplace_back("subgroups fetch lights together");
        }
    }
    if ((flags & io::kLightEdges) != 0) {
        lines.emplace_back("specular strength below 1: one more sum for light scattered at edges");
    }
    if (!facts.hasLight(io::kLightDirectional)) {
        lines.emplace_back("no directional light: no loop over them");
    }
    if ((flags & io::kLightBands) != 0) {
        lines.push_back(std::to_string(settings.toon.bands) + " toon bands of each light");
    }
    if ((flags & io::kLightRim) != 0) {
        lines.emplace_back("toon rim: surfaces that turn away from the eye scatter more light");
    }
    if (settings.shading == settings::ShadingModel::kLambert) {
        lines.emplace_back("lambert: no specular part, no roughness textures");
    } else if (settings.shading == settings::ShadingModel::kBlinnPhong) {
        lines.emplace_back("blinn_phong: highlights by a power of the half vector's cosine");
    }
}

// Of the steps, in their order, those that `accepts`.
template <class Accepts>
void addStepWords(Lines& lines,
                  const PlanInputs& inputs,
                  std::span<const StepRow* const> rows,
                  Accepts accepts) {
    for (const StepRow* row : rows) {
        if (row->words != nullptr && accepts(*row)) {
            if (auto words = row->words(inputs, inputs.plan.find(*row)); !words.empty()) {
                lines.push_back(std::move(words));
            }
        }
    }
}

} // namespace

std::vector<std::string> sceneWords(const SceneNeeds& needs) {
    const size_t total = needs.material_flags.size();
    const auto materials = [&](const char* what, MaterialFlags flag, const char* none) {
        return share(what, with(needs, flag), total, "materials", none);
    };
    const auto& lights = needs.lights;
    return {
        materials("textures", kAnyTexture, "no textures: nothing is sampled"),
        materials("normal maps", textureFlag(io::normal_slot), "no normal maps: no tangent frames"),
        materials("metallic-roughness textures", textureFlag(io::metallic_roughness_slot),
                  "no metallic-roughness textures"),
        materials("alpha masks", io::kMaterialMask, "no alpha masks: no discard"),
        materials("blending", io::kMaterialBlend, "no blended materials: no sort, no blend pass"),
        materials("unlit shading", io::kMaterialUnlit, "no unlit materials"),
        materials("ior, specular or glossiness", io::kMaterialSpecular,
                  "no ior, specular or glossiness: dielectrics reflect 4 % head-on"),
        materials("clear coats", io::kMaterialCoat, "no clear coats: lights are added up once"),
        materials("sheen", io::kMaterialSheen, "no sheen: no sum for fibres"),
        materials("anisotropy", io::kMaterialAnisotropy, "no anisotropy: highlights are round"),
        materials("iridescence", io::kMaterialFilm, "no iridescence: no thin films"),
        materials("diffuse transmission", io::kMaterialDiffuseTransmission,
                  "no diffuse transmission: no light from behind"),
        materials("transmission", io::kMaterialTransmission,
                  "no transmission: nothing is seen through surfaces"),
        materials("both sides drawn", io::kMaterialDoubleSided,
                  "no double-sided materials: back faces are culled"),
        materials("texture transforms or a second set", io::kMaterialUvTransform,
                  "no texture transforms: coordinates are used as they are"),
        needs.wide_gbuffer ? "metalness, occlusion, emission or unlit surfaces: wide G-buffer"
                           : "no metalness, occlusion, emission or unlit surfaces: thin G-buffer",
        share("second coordinates, colours or tangents", needs.extended_count,
              needs.primitive_count, "primitives",
              "no second coordinates, colours or tangents: no vertex stream for them"),
        lights.points + lights.spots + lights.directionals == 0
            ? std::string("no lights of the scene's own")
            : counted(lights.points, "point light", "point lights") + ", " +
                  counted(lights.spots, "spot light", "spot lights") + ", " +
                  counted(lights.directionals, "directional light", "directional lights")};
}

std::vector<std::string> frameWords(const settings::ViewSettings& settings,
                                    const FrameFacts& facts,
                                    const FramePlan& plan,
                                    std::span<const StepRow* const> rows) {
    const PlanInputs inputs{settings, facts, plan};
    if (settings::replacesPicture(plan.debug)) {
        Lines lines = {"debug view " + std::string(settings::nameOf(plan.debug)) +
                       " replaces the picture: opaque surfaces only, no lighting"};
        addStepWords(lines, inputs, rows,
                     [](const StepRow& row) { return row.part != StepPart::kPicture; });
        return lines;
    }
    Lines lines = {nameOf(settings::kRendererNames, settings.renderer) + ", " +
                   nameOf(settings::kShadingModelNames, settings.shading) + ", lighting in " +
                   (plan.lights_in_compute ? "compute" : "the fragment stage")};
    addLightWords(lines, settings, facts, plan);
    if ((plan.gbuffer_output_flags & io::kOutputSpecular) != 0) {
        lines.emplace_back("ior, specular or glossiness: one more word in the G-buffer's second "
                           "target, which only the rasteriser writes");
    }
    addStepWords(lines, inputs, rows, [](const StepRow&) { return true; });
    if (settings::samplesAcross(settings.antialiasing) > 1) {
        lines.emplace_back("ssaa4: four samples for each pixel, tone-mapped one by one");
    }
    if (!plan.uses(Resource::kRadiance)) {
        lines.emplace_back("no pass reads linear radiance: no target for it");
    }
    return lines;
}

} // namespace froxel::render
