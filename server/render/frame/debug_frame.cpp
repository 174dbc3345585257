#include "render/frame/debug_frame.h"

#include "interface/heat_map.h"
#include "render/pipelines/gbuffer_layout.h"
#include "render/pipelines/pipelines.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>

namespace froxel::render {

namespace {

using settings::DebugView;

static_assert(io::kDebugPosition == static_cast<uint32_t>(DebugView::kPosition));
static_assert(io::kDebugOverdraw == static_cast<uint32_t>(DebugView::kOverdraw));
static_assert(io::kDebugInstances == static_cast<uint32_t>(DebugView::kInstances));

constexpr double kOverdrawScale = 8;
constexpr double kShortestListScale = 8;
constexpr double kMostCounted = 1 << 24U; // io::heatPosition

double powerOfTwoFrom(double value) {
    return std::exp2(std::ceil(std::log2(std::max(value, 1e-3))));
}

// From four times what is expected, since pixels are taken to be near, where lists are short.
double lightScale(DebugView view, const DebugFacts& facts) {
    if (facts.lists || view == DebugView::kListedLights) {
        return powerOfTwoFrom(std::max(4 * facts.list_length, kShortestListScale));
    }
    return std::max(1.0, static_cast<double>(facts.light_count));
}

struct Scale {
    const char* unit;
    double max; // where none was given
};

// None: no heat map.
Scale scaleOf(DebugView view, const DebugFacts& facts) {
    switch (view) {
    case DebugView::kDepth:
        return {"m", powerOfTwoFrom(facts.farthest_m)};
    case DebugView::kClusterSlices:
        return {"slice", std::max(1.0, facts.slice_count - 1.0)};
    case DebugView::kListedLights:
    case DebugView::kEvaluatedLights:
    case DebugView::kContributingLights:
        return {"lights", lightScale(view, facts)};
    case DebugView::kFalsePositives:
        return {"of the evaluated lights", 1};
    case DebugView::kOverdraw:
        return {"fragments", kOverdrawScale};
    case DebugView::kClusterWires:
        return {"slice", std::max(1.0, facts.slice_count - 1.0)};
    default:
        return {nullptr, 0};
    }
}

const char* wordsOf(DebugView view) {
    static constexpr std::array kWords = {
        "",
        "Position: x, y, z within the scene's box as red, green, blue",
        "Depth along the view axis",
        "World-space normal: -1 to 1 as 0 to 1",
        "Base colour, without light",
        "Occlusion, roughness, metalness as red, green, blue",
        "Raw G-buffer: one row for each word, one column for each byte, lowest byte first",
        "Raw second target of the G-buffer: one row for each word, one column for each byte, "
        "lowest byte first",
        "Depth slice of each pixel",
        "Tiles: column as red, row as green",
        "Lights in the list of each pixel",
        "Lights that each pixel loops over",
        "Lights that reach each pixel, by radius and cone",
        "Lights in a pixel's loop that do not reach it",
        "Fragments that passed the depth test, as drawn",
        "Spheres at the lights' radii; faint behind surfaces",
        "Clusters; faint behind surfaces",
        "Placed meshes: the nearest surface's, each in a colour of its own",
    };
    static_assert(kWords.size() == settings::kDebugViewNames.size());
    return kWords[static_cast<size_t>(view)];
}

class WireMaker {
  public:
    WireMaker(const cluster::ClusterGrid& grid,
              const settings::Camera& grid_camera,
              const settings::Camera& camera)
        : grid_(grid),
          view_from_grid_(glm::transpose(camera.world_from_view) * grid_camera.world_from_view),
          eye_(glm::transpose(camera.world_from_view) *
               (grid_camera.eye_world - camera.eye_world)) {}

    // Of cell coordinates x, y at a depth.
    void corner(double x, double y, double depth_m, uint32_t color) {
        const double spread =
            grid_.projection == settings::Projection::kPerspective ? depth_m : 1.0;
        const glm::dvec3 p(x * spread, -y * spread, -depth_m); // cells have y down
        wires.push_back({glm::vec3(view_from_grid_ * p + eye_), color});
    }

    std::vector<io::WireVertex> wires;

  private:
    const cluster::ClusterGrid& grid_;
    glm::dmat3 view_from_grid_;
    glm::dvec3 eye_;
};

} // namespace

DebugLegend makeLegend(const settings::Debug& debug, const DebugFacts& facts) {
    DebugLegend legend;
    legend.view = settings::nameOf(debug.view);
    legend.words = wordsOf(debug.view);
    const Scale scale = scaleOf(debug.view, facts);
    if (scale.unit == nullptr) {
        return legend;
    }
    legend.unit = scale.unit;
    const bool given = debug.scale_max > 0 && debug.view != DebugView::kFalsePositives &&
                       debug.view != DebugView::kClusterWires;
    legend.max = given ? debug.scale_max : scale.max;
    if (debug.view != DebugView::kDepth && debug.view != DebugView::kFalsePositives) {
        legend.max = std::clamp(std::ceil(legend.max), 1.0, kMostCounted - 1);
    }
    legend.colors.assign(std::begin(io::kHeatColors), std::end(io::kHeatColors));
    return legend;
}

uint32_t shownBytes(DebugView view, uint32_t gbuffer_output_flags) {
    if (view == DebugView::kGbuffer) {
        const auto format = Pipelines::gbufferFormat(gbuffer_output_flags);
        return format == vk::Format::eR32G32Uint ? 8 : 16;
    }
    return view == DebugView::kGbufferExtra ? extraBytes(extraFormat(gbuffer_output_flags)) : 0;
}

io::DebugFrame makeDebugValues(const settings::ViewSettings& settings,
                               const BoundsD3& scene_bounds_world,
                               const DebugLegend& legend,
                               uint32_t byte_count) {
    io::DebugFrame values{};
    const settings::Camera& camera = settings.camera;
    const BoundsD3& box = scene_bounds_world;
    const glm::dvec3 from_box = box.empty() ? glm::dvec3(0) : camera.eye_world - box.min;
    const glm::dmat3 view_from_world =
        glm::transpose(camera.world_from_view); // columns: world axes
    values.world_x = glm::vec4(glm::dvec4(view_from_world[0], from_box.x));
    values.world_y = glm::vec4(glm::dvec4(view_from_world[1], from_box.y));
    values.world_z = glm::vec4(glm::dvec4(view_from_world[2], from_box.z));
    values.inverse_box = glm::vec3(1.0 / glm::max(box.size(), glm::dvec3(1e-9)));
    values.scale_max = static_cast<float>(legend.max);
    values.count_max = static_cast<uint32_t>(std::max(1.0, legend.max));
    values.byte_count = byte_count;
    return values;
}

std::vector<io::WireVertex> clusterWires(const cluster::ClusterGrid& grid,
                                         const settings::Camera& grid_camera,
                                         const settings::Camera& camera) {
    constexpr uint32_t kWhite = 0xffffffff;
    WireMaker maker(grid, grid_camera, camera);
    const uint32_t columns = grid.usedColumns();
    const uint32_t rows = grid.usedRows();
    const auto far_m = static_cast<double>(grid.plane_depths_m.back());
    for (uint32_t y = 0; y <= rows; ++y) {
        for (uint32_t x = 0; x <= columns; ++x) {
            maker.corner(grid.columnEdge(x), grid.rowEdge(y), 0, kWhite);
            maker.corner(grid.columnEdge(x), grid.rowEdge(y), far_m, kWhite);
        }
    }
    for (uint32_t z = 0; z < grid.size.z; ++z) {
        const auto depth_m = static_cast<double>(grid.plane_depths_m[z + 1]);
        const uint32_t color = io::heatColor(io::heatPosition(z, std::max(grid.size.z - 1, 1U)));
        for (uint32_t x = 0; x <= columns; ++x) {
            maker.corner(grid.columnEdge(x), grid.rowEdge(0), depth_m, color);
            maker.corner(grid.columnEdge(x), grid.rowEdge(rows), depth_m, color);
        }
        for (uint32_t y = 0; y <= rows; ++y) {
            maker.corner(grid.columnEdge(0), grid.rowEdge(y), depth_m, color);
            maker.corner(grid.columnEdge(columns), grid.rowEdge(y), depth_m, color);
        }
    }
    return std::move(maker.wires);
}

namespace {

// Of a metre at a depth along the view axis.
double pixelsAt(const settings::Camera& camera, const settings::Size& size, double depth_m) {
    const double half_px = 0.5 * size.height_px;
    return camera.projection == settings::Projection::kPerspective
               ? half_px / (std::tan(0.5 * camera.yfov_rad) * std::max(depth_m, camera.near_m))
               : half_px / camera.half_height_m;
}

} // namespace

double wirePixels(std::span<const io::WireVertex> wires,
                  const settings::Camera& camera,
                  const settings::Size& size) {
    const glm::dvec2 half(0.5 * size.width_px, 0.5 * size.height_px);
    const auto shown = [&](const io::WireVertex& vertex) {
        const glm::dvec3 p(vertex.position_view);
        return glm::clamp(glm::dvec2(p) * pixelsAt(camera, size, -p.z), -half, half);
    };
    double sum = 0;
    for (size_t i = 0; i + 1 < wires.size(); i += 2) {
        sum += glm::distance(shown(wires[i]), shown(wires[i + 1]));
    }
    return sum;
}

double lightWirePixels(const light::FrameLights& lights,
                       const settings::Camera& camera,
                       const settings::Size& size) {
    constexpr double kCircles = 3;
    const double most = 2.0 * (size.width_px + size.height_px); // of a circle, in the picture
    double sum = 0;
    for (size_t i = 0; i < lights.lights.size(); ++i) {
        const auto radius = static_cast<double>(lights.radii_m[i]);
        if (std::isfinite(radius)) { // another has no end to show
            const double depth_m = glm::length(glm::dvec3(lights.lights[i].position_view));
            const double around = 2 * std::numbers::pi * radius * pixelsAt(camera, size, depth_m);
            sum += kCircles * std::min(around, most);
        }
    }
    return sum;
}

} // namespace froxel::render
