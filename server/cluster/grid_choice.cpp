#include "cluster/grid_choice.h"

#include "core/assert.h"
#include "core/ceil_divide.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace froxel::cluster {
namespace {

constexpr std::array<uint32_t, 13> kTileEdges_px = {8,  16,  24,  32,  40,  48, 64,
                                                    96, 128, 160, 192, 256, 512};
constexpr std::array<uint32_t, 13> kSliceCounts = {1, 2, 4, 6, 8, 12, 16, 20, 24, 32, 48, 64, 96};
constexpr size_t kPixelDepths = 16;
// How much deeper than a wall seen straight on a surface is across a subgroup, typically.
constexpr double kSlant = 2;
constexpr double kPi = 3.14159265358979323846;
// Lists of this share of all lights save less than they cost.
constexpr double kLongList = 0.5;

GridShape shapeOf(const GridFacts& facts, uint32_t tile_px, uint32_t slices) {
    const settings::Size& image = facts.frustum.image;
    return {
        .size = {ceilDivide(image.width_px, tile_px), ceilDivide(image.height_px, tile_px), slices},
        .law = facts.law,
        .tile_width_px = tile_px,
        .tile_height_px = tile_px};
}

bool fits(const settings::GridSize& size) {
    return settings::kGridXRange.contains(size.x) && settings::kGridYRange.contains(size.y) &&
           uint64_t{size.x} * size.y * size.z * kClusterBytes <= kAutomaticGridBytes;
}

// A cluster's extents in metres.
struct Block {
    double width;
    double height;
    double depth;
};

struct Expected {
    double list_length = 0; // of a pixel
    double entries = 0;
    double cost_ns = 0;
};

// The slice at a depth: how wide a pixel is in its middle, and how deep it is, in metres.
struct Slice {
    double pixel;
    double depth;
};

// Of one number of slices, where the model looks.
struct Slices {
    std::vector<Slice> pixels;
    std::vector<Slice> lights; // at LightSpread::seen_depths_m
};

class CostModel {
  public:
    explicit CostModel(const GridFacts& facts)
        : facts_(facts), extent_(std::cbrt(facts.lights.volume_m3)),
          ball_(std::cbrt(4.0 / 3.0 * kPi * facts.lights.radius3_m3)) {}

    [[nodiscard]] Slices slices(uint32_t count) const;
    [[nodiscard]] Expected expect(const GridShape& shape, const Slices& slices) const;
    [[nodiscard]] Expected expect(const GridShape& shape) const {
        return expect(shape, slices(shape.size.z));
    }

  private:
    [[nodiscard]] Slice sliceAt(const SliceLaw& law, uint32_t count, double depth_m) const;
    // The volume of the block grown by a ball, averaged over the lights' radii (Steiner's formula).
    [[nodiscard]] double grown(const Block& block) const;
    [[nodiscard]] double listLength(const Block& block) const;

    const GridFacts& facts_;
    double extent_; // sides of the cubes of the lights' volume and of a mean ball's
    double ball_;
};

Slice CostModel::sliceAt(const SliceLaw& law, uint32_t count, double depth_m) const {
    const ClusterGrid& frustum = facts_.frustum;
    const uint32_t slice = std::min(law.sliceOf(static_cast<float>(depth_m)), count - 1);
    const double begin = slice > 0 ? static_cast<double>(planeDepth(law, slice)) : 0.0;
    const double end = static_cast<double>(planeDepth(law, slice + 1));
    const bool flat = frustum.projection == settings::Projection::kOrthographic;
    const double scale = flat ? 1.0 : (begin + end) / 2;
    return {2 * frustum.half_y / frustum.image.height_px * scale, end - begin};
}

Slices CostModel::slices(uint32_t count) const {
    const DepthRange& range = facts_.range;
    const SliceLaw law = makeSliceLaw(facts_.law, count, range.near_m, range.far_m);
    Slices slices;
    for (size_t i = 0; i < kPixelDepths && facts_.pixel_depths_m.empty(); ++i) {
        const double share = (static_cast<double>(i) + 0.5) / kPixelDepths;
        const double depth = range.far_m * share * share;
        slices.pixels.push_back(sliceAt(law, count, depth));
    }
    for (const double depth : facts_.pixel_depths_m) {
        slices.pixels.push_back(sliceAt(law, count, std::min(depth, range.far_m)));
    }
    for (const double depth : facts_.lights.seen_depths_m) {
        slices.lights.push_back(sliceAt(law, count, std::min(depth, range.far_m)));
    }
    return slices;
}

Block blockOf(const GridShape& shape, const Slice& slice) {
    return {slice.pixel * shape.tile_width_px, slice.pixel * shape.tile_height_px, slice.depth};
}

double CostModel::grown(const Block& b) const {
    const LightSpread& lights = facts_.lights;
    return b.width * b.height * b.depth +
           2 * lights.radius1_m * (b.width * b.height + b.height * b.depth + b.depth * b.width) +
           kPi * lights.radius2_m2 * (b.width + b.height + b.depth) +
           4.0 / 3.0 * kPi * lights.radius3_m3;
}

// How much of an extent lies within a length whose middle is anywhere in that extent, on average.
double covered(double length, double extent) {
    const double share = length / extent;
    return share < 2 ? share - share * share / 4 : 1.0;
}

double CostModel::listLength(const Block& block) const {
    const LightSpread& lights = facts_.lights;
    double share = 0;
    if (lights.volume_m3 > 0) {
        const Block reach{block.width + ball_, block.height + ball_, block.depth + ball_};
        const double rounded_off = grown(block) / (reach.width * reach.height * reach.depth);
        share = std::min(1.0, rounded_off * covered(reach.width, extent_) *
                                  covered(reach.height, extent_) * covered(reach.depth, extent_));
    }
    return lights.light_count * (lights.unlimited_share + (1 - lights.unlimited_share) * share);
}

Expected CostModel::expect(const GridShape& shape, const Slices& slices) const {
    const ClusterGrid& frustum = facts_.frustum;
    const GridCosts& costs = facts_.costs;
    const LightSpread& lights = facts_.lights;
    const double clusters = static_cast<double>(shape.size.x) * shape.size.y * shape.size.z;
    Expected expected;
    double pixel_ns = 0;
    const double share = 1.0 / static_cast<double>(slices.pixels.size());
    for (const Slice& slice : slices.pixels) {
        const Block block = blockOf(shape, slice);
        const double length = listLength(block);
        const double across = costs.subgroup_width * block.height / shape.tile_height_px;
        const double lists = std::min(1 + kSlant * across / block.depth, costs.subgroup_width);
        expected.list_length += length * share;
        pixel_ns += lists * (costs.walk_ns + costs.pair_ns * length) * share;
    }
    for (const Slice& slice : slices.lights) {
        const Block block = blockOf(shape, slice);
        const double filled = grown(block) / (block.width * block.height * block.depth);
        expected.entries += lights.lights_per_depth * std::min(filled, clusters);
    }
    expected.entries += lights.light_count * lights.unlimited_share * clusters;
    const double pixels = static_cast<double>(frustum.image.width_px) * frustum.image.height_px;
    expected.cost_ns =
        pixels * pixel_ns + costs.entry_ns * expected.entries + costs.cluster_ns * clusters;
    return expected;
}

std::string rounded(double value) {
    if (value < 9.95) {
        const auto tenths = static_cast<uint64_t>(std::lround(value * 10));
        return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10);
    }
    return std::to_string(std::llround(value));
}

std::string describe(const GridFacts& facts, const GridChoice& choice, const Expected& expected) {
    return "tiles of " + std::to_string(choice.memory.tile_px) + " pixels and " +
           std::to_string(choice.memory.slices) + " slices: the expected loop of a pixel has " +
           rounded(expected.list_length) + " of " + std::to_string(facts.lights.light_count) +
           " lights";
}

} // namespace

GridChoice chooseGrid(const GridFacts& facts, const GridMemory& previous) {
    const CostModel model(facts);
    std::array<Slices, kSliceCounts.size()> slices;
    std::transform(kSliceCounts.begin(), kSliceCounts.end(), slices.begin(),
                   [&](uint32_t count) { return model.slices(count); });
    GridChoice best;
    Expected best_expected;
    for (const uint32_t tile_px : kTileEdges_px) {
        for (size_t i = 0; i < slices.size(); ++i) {
            const GridShape shape = shapeOf(facts, tile_px, kSliceCounts[i]);
            if (!fits(shape.size)) {
                continue;
            }
            const Expected expected = model.expect(shape, slices[i]);
            if (best.memory.tile_px == 0 || expected.cost_ns < best_expected.cost_ns) {
                best = {.shape = shape, .memory = {tile_px, kSliceCounts[i]}};
                best_expected = expected;
            }
        }
    }
    FROXEL_ASSERT(best.memory.tile_px > 0, "tiles of 512 pixels cover any picture");
    std::string reason = ", the least time by the cost model";
    if (previous.tile_px > 0 && previous.slices > 0) {
        const GridShape shape = shapeOf(facts, previous.tile_px, previous.slices);
        const Expected kept = model.expect(shape);
        if (fits(shape.size) && shape != best.shape &&
            kept.cost_ns <= kGridHysteresis * best_expected.cost_ns) {
            best = {.shape = shape, .memory = {previous.tile_px, previous.slices}};
            best_expected = kept;
            reason = ", unchanged, because no other grid would save a sixth of the time";
        }
    }
    best.memory.all_lights = previous.all_lights;
    best.list_length = best_expected.list_length;
    best.why = describe(facts, best, best_expected) + reason;
    return best;
}

double expectedListLength(const GridFacts& facts, const GridShape& shape) {
    const settings::Size& image = facts.frustum.image;
    GridShape tiled = shape;
    tiled.tile_width_px = std::max(shape.tile_width_px, ceilDivide(image.width_px, shape.size.x));
    tiled.tile_height_px =
        std::max(shape.tile_height_px, ceilDivide(image.height_px, shape.size.y));
    return CostModel(facts).expect(tiled).list_length;
}

LoopChoice chooseLoop(const GridFacts& facts, double list_length, const GridMemory& previous) {
    const uint32_t count = facts.lights.light_count;
    const double hysteresis = std::sqrt(kGridHysteresis);
    const double few = facts.costs.few_lights * (previous.all_lights ? kGridHysteresis : 1.0);
    const double share = list_length / std::max(count, 1U);
    const double limit = previous.all_lights ? kLongList / hysteresis : kLongList * hysteresis;
    const std::string all = std::to_string(count);
    if (count <= few) {
        return {true,
                all + " with so few lights, a loop over all of them is as fast as an assignment"};
    }
    const std::string length =
        "a pixel's list would hold about " + rounded(list_length) + " of " + all + " lights";
    if (share >= limit) {
        return {true, length + ": too many for lists to pay, so each pixel loops over all lights"};
    }
    return {false, length};
}

} // namespace froxel::cluster
