#include "scene/looks.h"

#include <algorithm>
#include <array>

namespace froxel::scene {

namespace {

using settings::ViewSettings;

constexpr uint32_t kManyLights = 1000;

void glow(ViewSettings& to, float strength, bool software) {
    to.bloom.kind = software ? settings::BloomKind::kNone : settings::BloomKind::kMipChain;
    to.bloom.strength = strength;
}

void sharpen(ViewSettings& to, bool software) {
    to.antialiasing = software ? settings::Antialiasing::kNone : settings::Antialiasing::kFxaa;
}

void studio(ViewSettings& to, float strength) {
    to.environment.light = settings::EnvironmentLight::kStudio;
    to.environment.strength = strength;
}

void lampsAtSurfaces(ViewSettings& to, settings::LightPalette palette) {
    to.lights.count = kManyLights;
    to.lights.places = settings::LightPlaces::kSurfaces;
    to.lights.palette = palette;
}

void evening(ViewSettings& to, bool software) {
    lampsAtSurfaces(to, settings::LightPalette::kWarm);
    to.lights.radius_m *= 1.3F;
    to.lights.intensity *= 0.8F;
    studio(to, 0.2F);
    to.exposure = 1.2F;
    glow(to, 0.12F, software);
    sharpen(to, software);
}

void noon(ViewSettings& to, bool software) {
    lampsAtSurfaces(to, settings::LightPalette::kWhite);
    to.lights.intensity *= 0.3F;
    studio(to, 1);
    to.exposure = 0.8F;
    sharpen(to, software);
}

void mist(ViewSettings& to, bool software) {
    to.lights.count = kManyLights;
    to.lights.places = settings::LightPlaces::kVolume;
    to.lights.palette = settings::LightPalette::kCool;
    to.lights.radius_m *= 1.5F;
    studio(to, 0.05F);
    to.fog.density = 0.1F / to.lights.radius_m;
    to.exposure = 1.5F;
    sharpen(to, software);
}

void toon(ViewSettings& to, bool software) {
    to.lights.count = kManyLights;
    to.lights.places = settings::LightPlaces::kVolume;
    to.lights.palette = settings::LightPalette::kRainbow;
    to.lights.intensity *= 2;
    to.renderer = settings::Renderer::kToonFragment;
    to.shading = settings::ShadingModel::kLambert;
    to.lights.radius_m *= 1.3F;
    studio(to, 0.15F);
    to.toon_outline.strength = 0.8F;
    sharpen(to, software);
}

// Every hue, all over the room, and nothing else: what the lists and the loops are measured with.
void rainbow(ViewSettings& to, bool /*software*/) {
    to.lights.count = kManyLights;
    to.lights.places = settings::LightPlaces::kVolume;
    to.lights.palette = settings::LightPalette::kRainbow;
    to.environment.light = settings::EnvironmentLight::kOff;
    to.exposure_mode = settings::ExposureMode::kFixed;
}

// The ramp over n.l alone.
void ramp(ViewSettings& to, bool software) {
    rainbow(to, software);
    to.renderer = settings::Renderer::kToonFragment;
    to.shading = settings::ShadingModel::kLambert;
    to.toon = {.bands = 0, .rim = 0};
}

// A kernel of eleven pixels each way in a picture of 720 rows.
void spreading(ViewSettings& to, bool software) {
    rainbow(to, software);
    to.shading = settings::ShadingModel::kLambert;
    to.bloom.kind = settings::BloomKind::kSinglePass;
    to.bloom.strength = 0.3F;
    to.bloom.radius = 0.0025F;
}

void matt(ViewSettings& to, bool software) {
    rainbow(to, software);
    to.shading = settings::ShadingModel::kLambert;
}

void gloss(ViewSettings& to, bool software) {
    rainbow(to, software);
    to.shading = settings::ShadingModel::kBlinnPhong;
    to.gbuffer.normal = settings::NormalEncoding::kSpheremap16;
}

void blinn(ViewSettings& to, bool software) {
    rainbow(to, software);
    to.shading = settings::ShadingModel::kBlinnPhong;
    to.gbuffer.normal = settings::NormalEncoding::kXy16;
}

void clusters(ViewSettings& to, bool software) {
    rainbow(to, software);
    to.debug.view = settings::DebugView::kListedLights;
}

constexpr std::array kLooks = {
    Look{"evening", "Evening", "Warm lamps close to walls and floors, dusk in the windows",
         evening},
    Look{"noon", "Noon", "Bright studio light, and faint lamps", noon},
    Look{"mist", "Mist", "Cool lights in thin fog", mist},
    Look{"toon", "Toon", "Pools of light in steps, dark outlines", toon},
    Look{"rainbow", "Rainbow", "A thousand lights of every hue all over the scene", rainbow},
    Look{"clusters", "Clusters", "Number of lights in the list of each pixel's cluster", clusters},
    Look{"ramp", "Ramp", "Toon with a ramp over the angle of each light", ramp},
    Look{"glow", "Glow", "Diffuse surfaces with a small bloom kernel", spreading},
    Look{"matt", "Matt", "Only diffuse light", matt},
    Look{"gloss", "Gloss", "Blinn-Phong highlights; normals are stored as a sphere map", gloss},
    Look{"blinn", "Blinn", "Blinn-Phong highlights; normals are stored by two components", blinn},
};

constexpr auto kNames = [] {
    std::array<std::string_view, kLooks.size()> names;
    std::transform(kLooks.begin(), kLooks.end(), names.begin(),
                   [](const Look& look) { return look.name; });
    return names;
}();

} // namespace

std::span<const Look> looks() {
    return kLooks;
}

std::span<const std::string_view> lookNames() {
    return kNames;
}

const Look* findLook(std::string_view name) {
    const auto found = std::find(kNames.begin(), kNames.end(), name);
    return found == kNames.end() ? nullptr : &kLooks[static_cast<size_t>(found - kNames.begin())];
}

} // namespace froxel::scene
