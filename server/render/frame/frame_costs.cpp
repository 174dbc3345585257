#include "render/frame/frame_costs.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

namespace froxel::render {
namespace {

vk::Extent2D extentOf(const settings::Size& size) {
    return {size.width_px, size.height_px};
}

} // namespace

Seconds timeOf(const std::vector<PassEstimate>& passes) {
    Seconds sum{0};
    for (const auto& pass : passes) {
        sum += pass.time;
    }
    return sum;
}

vk::Rect2D common(const vk::Rect2D& a, const vk::Rect2D& b) {
    const auto end = [](int32_t at, uint32_t side) { return at + static_cast<int32_t>(side); };
    const int32_t left = std::max(a.offset.x, b.offset.x);
    const int32_t top = std::max(a.offset.y, b.offset.y);
    const int32_t right =
        std::min(end(a.offset.x, a.extent.width), end(b.offset.x, b.extent.width));
    const int32_t bottom =
        std::min(end(a.offset.y, a.extent.height), end(b.offset.y, b.extent.height));
    if (right <= left || bottom <= top) {
        return {};
    }
    return {{left, top},
            {static_cast<uint32_t>(right - left), static_cast<uint32_t>(bottom - top)}};
}

RegionCost within(const RegionCost& cost, const vk::Rect2D& region) {
    return {cost.each,
            [cost, region](const vk::Rect2D& part) { return cost.of(common(part, region)); },
            cost.least};
}

Seconds timeOver(const RegionCost& cost, const settings::Size& size) {
    return cost.each + std::max(cost.of({{0, 0}, extentOf(size)}), cost.least);
}

Result<void>
checkAllLights(const UnitCosts& unit, const settings::ViewSettings& settings, Seconds limit) {
    const bool all = settings.renderer == settings::Renderer::kNaive ||
                     settings.light_loop == settings::LightLoop::kAllLights;
    if (!all || settings::replacesPicture(settings.debug.view)) {
        return {};
    }
    const double pixels = static_cast<double>(settings.size.width_px) * settings.size.height_px;
    const Seconds least(pixels * settings.lights.count * unit.compute.pair);
    if (least <= limit) {
        return {};
    }
    return Error{ErrorCode::kTooLong,
                 fmt::format("a picture of {}x{} whose pixels loop over all {} lights takes at "
                             "least {:.3g} s of this device; a frame may take {:.3g} s. "
                             "Use fewer lights, light lists, or a smaller picture",
                             settings.size.width_px, settings.size.height_px, settings.lights.count,
                             least.count(), limit.count()),
                 least / limit};
}

double FrameCosts::lit(const vk::Rect2D& region, const PairCost& unit) const {
    const uint64_t longest = inputs_.pairs.longest();
    double each = unit_.lit_pixel + inputs_.lit_pixel + inputs_.directional_count * unit.pair;
    for (const auto& [count, pair] : inputs_.costly_lights) {
        each += static_cast<double>(std::min<uint64_t>(count, longest)) * pair;
    }
    return inputs_.pairs.pairs(region) * unit.pair + areaOf(region) * each;
}

Seconds FrameCosts::loop(const PairCost& unit) const {
    return Seconds(static_cast<double>(inputs_.longest_loop) * unit.loop);
}

RegionCost FrameCosts::shading(const PairCost& unit) const {
    return {Seconds(0), [this, &unit](const auto& region) { return Seconds(lit(region, unit)); },
            loop(unit)};
}

RegionCost FrameCosts::depth() const {
    return {Seconds(inputs_.draws.triangle_count * unit_.triangle / 2),
            [this](const auto& region) { return Seconds(areaOf(region) * unit_.depth_pixel); }};
}

RegionCost FrameCosts::shadedSurfaces(double each) const {
    return {Seconds(inputs_.draws.triangle_count * unit_.triangle),
            [this, each](const auto& region) {
                return Seconds(each * (areaOf(region) * unit_.surface_pixel +
                                       inputs_.lit_surfaces * lit(region, unit_.fragment)));
            },
            inputs_.lit_surfaces * loop(unit_.fragment)};
}

RegionCost FrameCosts::surfaces() const {
    return {Seconds(inputs_.draws.triangle_count * unit_.triangle),
            [this](const auto& region) { return Seconds(areaOf(region) * unit_.surface_pixel); }};
}

RegionCost FrameCosts::resolved(bool shades) const {
    return {Seconds(0),
            [this, shades](const auto& region) {
                const double surface =
                    areaOf(region) *
                    (unit_.surface_pixel + inputs_.resolve_count * unit_.resolve_pixel);
                return Seconds(surface +
                               (shades ? inputs_.lit_surfaces * lit(region, unit_.compute) : 0.0));
            },
            shades ? inputs_.lit_surfaces * loop(unit_.compute) : Seconds(0)};
}

RegionCost FrameCosts::layered(const LayeredDraws& draws) const {
    return {Seconds(draws.triangle_count * unit_.triangle),
            [this, &draws](const vk::Rect2D& region) {
                double sum = 0;
                for (const vk::Rect2D& part : draws.parts) {
                    const vk::Rect2D both = common(part, region);
                    if (both.extent.width > 0) {
                        sum += areaOf(both) * unit_.surface_pixel +
                               inputs_.lit_surfaces * lit(both, unit_.fragment);
                    }
                }
                return Seconds(sum + areaOf(region) * unit_.depth_pixel);
            },
            inputs_.lit_surfaces * loop(unit_.fragment)};
}

RegionCost FrameCosts::screen() const {
    return {Seconds(0),
            [this](const auto& region) { return Seconds(areaOf(region) * unit_.screen_pixel); }};
}

std::vector<PassEstimate> FrameCosts::passes() const {
    std::vector<PassEstimate> passes;
    for (const ActiveStep& active : inputs_.steps) {
        if (!active.reused) {
            active.step->addCosts(*this, passes);
        }
    }
    return passes;
}

Seconds FrameCosts::total() const {
    return timeOf(passes());
}

Result<void> FrameCosts::check(Seconds limit, Seconds loop_limit) const {
    const Seconds loop(static_cast<double>(inputs_.longest_loop) * slowestLoop());
    if (loop > loop_limit) {
        return Error{ErrorCode::kTooLong,
                     fmt::format("a pixel that loops over {} lights takes about {:.3g} s of this "
                                 "device, and such a loop may take {:.3g} s. "
                                 "Use fewer or smaller lights, or light lists",
                                 inputs_.longest_loop, loop.count(), loop_limit.count())};
    }
    const Seconds sum = total();
    if (sum <= limit) {
        return {};
    }
    const auto all = passes();
    const auto dearest = std::max_element(
        all.begin(), all.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
    return Error{
        ErrorCode::kTooLong,
        fmt::format("a picture of {}x{} with up to {} lights a pixel takes about {:.3g} s of this "
                    "device, {:.3g} s of it for {}; a frame may take {:.3g} s. Use fewer or "
                    "smaller lights, light lists, fewer effects, or a smaller picture",
                    inputs_.size.shown.width_px, inputs_.size.shown.height_px,
                    inputs_.pairs.longest(), sum.count(), dearest->time.count(), dearest->pass,
                    limit.count()),
        sum / limit};
}

double FrameCosts::slowestLoop() const {
    double slowest = 0;
    for (const ActiveStep& active : inputs_.steps) {
        slowest = std::max(slowest, active.step->loopCost(*this));
    }
    return slowest;
}

uint64_t FrameCosts::lightsWithin(Seconds limit) const {
    constexpr double kAny = 1e9;
    return static_cast<uint64_t>(limit.count() / std::max(slowestLoop(), limit.count() / kAny));
}

double FrameCosts::pairsWithin(Seconds limit) const {
    const auto totalWith = [this](uint64_t lights_each) {
        CostInputs load = inputs_;
        load.pairs = PairBound::uniform(lights_each);
        load.longest_loop = 0;
        return FrameCosts(unit_, std::move(load)).total();
    };
    constexpr uint64_t kEach = 1000;
    constexpr double kAny = 1e9;
    const Seconds rest = totalWith(0);
    const Seconds room = std::max(limit - rest, limit / 2);
    const double pairs = areaOf({{0, 0}, extentOf(inputs_.size.drawn)}) * kEach;
    const Seconds taken = totalWith(kEach) - rest;
    return pairs * (room.count() / std::max(taken.count(), room.count() / kAny));
}

} // namespace froxel::render
