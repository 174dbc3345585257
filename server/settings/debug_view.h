// What a frame shows instead of the lit picture, or over it; none of it costs a frame that does
// not.
#pragma once

#include "settings/camera.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace froxel::settings {

enum class DebugView : uint8_t {
    kNone,
    // Of solid surfaces, one value a pixel:
    kPosition, // x, y, z as red, green, blue over the scene's box
    kDepth,    // metres along the view axis
    kNormal,   // in world space, -1..1 as 0..1
    kBaseColor,
    kRoughness,          // occlusion, roughness, metalness as red, green, blue, as glTF packs them
    kGbuffer,            // bytes of the G-buffer, a mosaic: a row a word, a column a byte
    kGbufferExtra,       // of its second target
    kClusterSlices,      // the slice of each pixel
    kClusterTiles,       // column and row as red and green
    kListedLights,       // in the pixel's list, also where the renderer loops over all lights
    kEvaluatedLights,    // that the pixel loops over
    kContributingLights, // of which within radius and cone
    kFalsePositives,     // share of the evaluated that do not contribute
    kOverdraw,           // fragments that pass the depth test as they are drawn
    // Over the lit picture, as lines:
    kLightSpheres, // where lights end; of spots their cones
    kClusterWires, // the cluster grid, of the view's camera or of a frozen one
    // Of solid and blended surfaces:
    kInstances, // which placed mesh is nearest, each in a colour of its own
};
inline constexpr std::array kDebugViewNames = {std::string_view("none"),
                                               std::string_view("position"),
                                               std::string_view("depth"),
                                               std::string_view("normal"),
                                               std::string_view("base_color"),
                                               std::string_view("roughness"),
                                               std::string_view("gbuffer"),
                                               std::string_view("gbuffer_extra"),
                                               std::string_view("cluster_slices"),
                                               std::string_view("cluster_tiles"),
                                               std::string_view("listed_lights"),
                                               std::string_view("evaluated_lights"),
                                               std::string_view("contributing_lights"),
                                               std::string_view("false_positives"),
                                               std::string_view("overdraw"),
                                               std::string_view("light_spheres"),
                                               std::string_view("cluster_wires"),
                                               std::string_view("instances")};

[[nodiscard]] constexpr std::string_view nameOf(DebugView view) {
    return kDebugViewNames[static_cast<size_t>(view)];
}

// Lines over the lit picture; the others take its place.
[[nodiscard]] constexpr bool isOverlay(DebugView view) {
    return view == DebugView::kLightSpheres || view == DebugView::kClusterWires;
}
[[nodiscard]] constexpr bool replacesPicture(DebugView view) {
    return view != DebugView::kNone && !isOverlay(view);
}
// Needs a G-buffer, which forward renderers then draw for it.
[[nodiscard]] constexpr bool showsMaterial(DebugView view) {
    return view == DebugView::kNormal || view == DebugView::kBaseColor ||
           view == DebugView::kRoughness;
}
[[nodiscard]] constexpr bool showsGbuffer(DebugView view) {
    return view == DebugView::kGbuffer || view == DebugView::kGbufferExtra;
}
// Has a pass that rasters a value of each fragment.
[[nodiscard]] constexpr bool showsFragments(DebugView view) {
    return view == DebugView::kOverdraw || view == DebugView::kInstances;
}
// Needs clusters, whatever the renderer loops over.
[[nodiscard]] constexpr bool showsClusters(DebugView view) {
    return view == DebugView::kClusterSlices || view == DebugView::kClusterTiles ||
           view == DebugView::kListedLights;
}
// Each pixel tests all lights that it is handed.
[[nodiscard]] constexpr bool testsLights(DebugView view) {
    return view == DebugView::kContributingLights || view == DebugView::kFalsePositives;
}
[[nodiscard]] constexpr bool countsLights(DebugView view) {
    return view == DebugView::kListedLights || view == DebugView::kEvaluatedLights ||
           testsLights(view);
}

struct Debug {
    DebugView view = DebugView::kNone;
    double scale_max = 0; // where a heat map ends; 0: chosen by the renderer
    // Of cluster_wires: whose grid; none: the view's own.
    std::optional<Camera> grid_camera;
    bool operator==(const Debug&) const = default;
};

} // namespace froxel::settings
