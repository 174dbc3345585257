#include "render/frame/plan_words.h"

#include "interface/constants.h"
#include "interface/gbuffer_io.h"
#include "render/pipelines/gbuffer_layout.h"

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
    if (!facts.local_lights) {
        return facts.directional ? "no point or spot light: no assignment, no lists"
                                 : "no lights: no assignment, no lists, no light loop";
    }
    if (plan.lists) {
        return "light lists: a pixel loops over its cluster's lights";
    }
    return naive ? "naive: no lists, every fragment loops over all lights"
                 : "no light lists: every pixel loops over all lights";
}

void addWords(Lines& lines, const PlannedEffect& effect, const settings::ViewSettings& settings) {
    if (auto words = effect.row->words(settings, effect.plan); !words.empty()) {
        lines.push_back(std::move(words));
    }
}

void addWordsAt(Lines& lines,
                const settings::ViewSettings& settings,
                const FramePlan& plan,
                EffectPlace place) {
    for (const PlannedEffect& effect : plan.effects) {
        if (effect.row->place == place) {
            addWords(lines, effect, settings);
        }
    }
}

void addLightWords(Lines& lines,
                   const settings::ViewSettings& settings,
                   const FrameFacts& facts,
                   const FramePlan& plan) {
    lines.push_back(lightWords(facts, plan, settings.renderer == settings::Renderer::kNaive));
    const uint32_t flags = plan.gbuffer || plan.visibility_shade ? plan.lighting_light_flags
                                                                 : plan.forward_light_flags;
    if (facts.local_lights) {
        lines.emplace_back(facts.spots ? "spot lights: cones are fetched and cut"
                                       : "no spot light: no cone data");
        if (facts.areas) {
            lines.emplace_back(
                settings.shading == settings::ShadingModel::kLambert
                    ? "area lights: rectangles are fetched and integrated"
                    : "area lights: rectangles and the highlight's table are fetched");
        }
        lines.emplace_back(facts.equal_radii ? "all radii equal: radius is a constant"
                                             : "radii differ: each light has its own");
        if ((flags & io::kLightCulled) != 0) {
            lines.emplace_back(
                "subgroups fetch lights together and skip lights that reach none of their pixels");
        } else if ((flags & io::kLightBatched) != 0) {
            lines.emplace_back("subgroups fetch lights together");
        }
    }
    addWordsAt(lines, settings, plan, EffectPlace::kLights);
    if ((flags & io::kLightEdges) != 0) {
        lines.emplace_back("specular strength below 1: one more sum for light scattered at edges");
    }
    if (!facts.directional) {
        lines.emplace_back("no directional light: no loop over them");
    }
    if ((flags & io::kLightBands) != 0 || plan.toon_bands) {
        lines.push_back(std::to_string(settings.toon.bands) + " toon bands " +
                        (plan.toon_bands ? "of the lit colour" : "of each light"));
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

void addSolidWords(Lines& lines,
                   const settings::ViewSettings& settings,
                   const FrameFacts& facts,
                   const FramePlan& plan) {
    if (plan.pose) {
        lines.emplace_back("skins or morph targets: vertices are posed in compute");
    }
    if (plan.visibility) {
        lines.push_back(std::string("visibility: the device ") +
                        (plan.cull_meshlets ? "culls meshlets and rasterises triangle ids"
                                            : "rasterises triangle ids") +
                        (plan.compute_raster ? " in compute" : "") +
                        (plan.cull_meshlets ? "" : ", nothing culled"));
    }
    if (plan.gbuffer) {
        const bool specular = (plan.gbuffer_output_flags & io::kOutputSpecular) != 0;
        const auto bytes =
            std::to_string(gbufferBytesPerPixel(settings.gbuffer, facts.wide_gbuffer, specular));
        lines.push_back((facts.wide_gbuffer
                             ? "metalness, occlusion, emission or unlit surfaces: G-buffer of "
                             : "no metalness, occlusion, emission or unlit: G-buffer of ") +
                        bytes + " bytes a pixel");
        if (specular) {
            lines.emplace_back("ior, specular or glossiness: one more word in the G-buffer's "
                               "second target, which only the rasteriser writes");
        }
    } else {
        lines.emplace_back(settings::replacesPicture(plan.debug)
                               ? "no G-buffer: depth alone"
                               : "no G-buffer: surfaces are shaded at once");
    }
    if (plan.layers) {
        lines.emplace_back(plan.visibility
                               ? "layers: a compute pass shades materials with layers again over "
                                 "the lit picture, because the G-buffer has no room for them"
                               : "layers: the forward shader draws materials with layers again "
                                 "over the lit picture, because the G-buffer has no room for them");
    }
    if (plan.depth_prepass) {
        lines.emplace_back("depth prepass: each pixel is shaded once");
    } else if (!plan.visibility) {
        lines.emplace_back(
            settings.renderer == settings::Renderer::kNaive ? "naive: no depth prepass"
            : facts.overdraw_unknown ? "no depth prepass: overdraw is being measured"
                                     : "no depth prepass: it would cost more than it saves");
    }
}

// Of what is done to the picture once it is lit.
void addEffectWords(Lines& lines, const settings::ViewSettings& settings, const FramePlan& plan) {
    if (plan.outline) {
        lines.emplace_back("outline: a separate pass darkens edges of depth and normals");
    }
    addWordsAt(lines, settings, plan, EffectPlace::kSolid);
    addWordsAt(lines, settings, plan, EffectPlace::kPicture);
    if (plan.samples) {
        lines.emplace_back("ssaa4: four samples for each pixel, tone-mapped one by one");
    }
    addWordsAt(lines, settings, plan, EffectPlace::kPixels);
}

std::string transparentWords(const FramePlan& plan) {
    if (!plan.transparent) {
        return "no transparent surface in view: no sort, no blend pass";
    }
    const std::string over =
        plan.over_unlit ? "; a separate pass blends them over unlit surfaces in display colours"
                        : "";
    switch (plan.transparency) {
    case settings::Transparency::kWeighted:
        return "transparent surfaces in view: summed at once, weighted by distance, approximate" +
               over;
    case settings::Transparency::kPeeled:
        return "transparent surfaces in view: up to " + std::to_string(plan.peel_layers) +
               " layers peeled from the eye, one layer of each pixel at a time" + over;
    case settings::Transparency::kSorted:
        break;
    }
    return "transparent surfaces in view: sorted and blended" + over;
}

std::string toneMapWords(const FrameFacts& facts, const FramePlan& plan) {
    if (!plan.tonemap) {
        return plan.toon_pass ? "tone mapping in the toon pass: no separate pass"
                              : "tone mapping in the lighting pass: no separate pass";
    }
    if (facts.transparent_visible) {
        return "tone mapping in a separate pass, after blending";
    }
    if (settings::isOverlay(plan.debug)) {
        return "tone mapping in a separate pass, after the debug view's lines";
    }
    if (plan.samples || plan.outline || plan.layers || plan.hasEffect(EffectPlace::kSolid) ||
        plan.hasEffect(EffectPlace::kPicture)) {
        return "tone mapping in a separate pass, after the passes over the lit picture";
    }
    return "tone mapping in a separate pass, after a fragment stage";
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

std::vector<std::string>
frameWords(const settings::ViewSettings& settings, const FrameFacts& facts, const FramePlan& plan) {
    if (settings::replacesPicture(plan.debug)) {
        Lines lines = {"debug view " + std::string(settings::nameOf(plan.debug)) +
                       " replaces the picture: opaque surfaces only, no lighting"};
        if (plan.debug != settings::DebugView::kOverdraw) {
            addSolidWords(lines, settings, facts, plan);
        }
        return lines;
    }
    const bool compute = plan.lighting_compute || plan.visibility_shade;
    Lines lines = {nameOf(settings::kRendererNames, settings.renderer) + ", " +
                   nameOf(settings::kShadingModelNames, settings.shading) + ", lighting in " +
                   (compute ? "compute" : "the fragment stage")};
    addSolidWords(lines, settings, facts, plan);
    addLightWords(lines, settings, facts, plan);
    lines.push_back(transparentWords(plan));
    addEffectWords(lines, settings, plan);
    lines.push_back(toneMapWords(facts, plan));
    if (plan.count_pairs) {
        lines.emplace_back("a separate pass counts (light, pixel) pairs");
    }
    if (settings::isOverlay(plan.debug)) {
        lines.push_back("debug view " + std::string(settings::nameOf(plan.debug)) +
                        ": a separate pass draws lines over the picture");
    }
    if (!plan.radiance) {
        lines.emplace_back("no pass reads linear radiance: no target for it");
    }
    return lines;
}

std::vector<std::string> effectWords(const settings::ViewSettings& settings,
                                     const FramePlan& plan) {
    Lines lines;
    for (const PlannedEffect& effect : plan.effects) {
        addWords(lines, effect, settings);
    }
    return lines;
}

} // namespace froxel::render
