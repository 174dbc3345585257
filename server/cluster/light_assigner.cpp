#include "cluster/light_assigner.h"

#include "cluster/ball_sweep.h"
#include "cluster/crew.h"
#include "cluster/line_lists.h"
#include "cluster/span.h"
#include "cluster/spot_cut.h"
#include "core/assert.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <optional>

namespace froxel::cluster {
namespace {

// Waking another thread costs about as much as this many lights.
constexpr size_t kLightsPerMember = 256;

// That a member finds before it tells the others.
constexpr uint64_t kEntriesAtOnce = 4096;

Ball dilated(Ball ball) {
    ball.radius = io::dilatedRadius(ball);
    return ball;
}

void appendAll(const ClusterGrid& grid, std::vector<Span>& spans) {
    for (uint32_t z = 0; z < grid.size.z; ++z) {
        for (uint32_t y = 0; y < grid.usedRows(); ++y) {
            spans.emplace_back(z * grid.size.y + y, 0U, grid.usedColumns() - 1);
        }
    }
}

// Narrows the spans from `begin` on to the cells that the spot may reach. Spot and row are convex,
// so it is enough to cut from both ends.
void cutSpans(const ClusterGrid& grid,
              const SpotCut& spot,
              size_t begin,
              std::vector<Span>& spans) {
    size_t kept = begin;
    for (size_t i = begin; i < spans.size(); ++i) {
        const uint32_t line = spans[i].line();
        const auto misses = [&](uint32_t x) {
            return spot.misses(grid.cell(x, line % grid.size.y, line / grid.size.y),
                               grid.projection);
        };
        uint32_t first = spans[i].first();
        uint32_t last = spans[i].last();
        while (first <= last && misses(first)) {
            ++first;
        }
        while (last > first && misses(last)) {
            --last;
        }
        if (first <= last) {
            spans[kept++] = Span(line, first, last);
        }
    }
    spans.erase(spans.begin() + static_cast<std::ptrdiff_t>(kept), spans.end());
}

void appendLight(const ClusterGrid& grid,
                 const BallSweep& sweep,
                 const light::FrameLights& lights,
                 size_t index,
                 std::vector<Span>& spans) {
    const io::Light& light = lights.lights[index];
    const glm::dvec3 apex(light.position_view.x, -light.position_view.y, -light.position_view.z);
    const auto range = static_cast<double>(lights.radii_m[index]);
    std::optional<SpotCut> spot;
    if (light.spot != io::kNoSpot) {
        spot = SpotCut::make(apex, glm::dvec3(lights.spots[light.spot].direction_view),
                             lights.cones[light.spot], range);
    }
    const size_t begin = spans.size();
    if (std::isinf(range)) {
        appendAll(grid, spans);
    } else {
        sweep.sweep(dilated(spot ? spot->bound() : Ball{apex.x, apex.y, apex.z, range}), spans);
    }
    if (spot) {
        cutSpans(grid, *spot, begin, spans);
    }
}

} // namespace

void LightLists::finishStats() {
    const uint32_t filled = stats.cluster_count - stats.empty_count;
    stats.mean = filled > 0 ? static_cast<double>(stats.entry_count) / filled : 0.0;
    stats.bytes = clusters.size() * sizeof(io::ClusterList) + indices.size() * sizeof(uint32_t);
}

struct LightAssigner::Impl {
    Impl(unsigned threads, uint64_t max_entries_)
        : crew(threads), chunks(threads), tallies(threads), max_entries(max_entries_) {}

    // Finds the spans of the member's share of the lights.
    void sweepLights(const ClusterGrid& grid,
                     const light::FrameLights& lights,
                     unsigned member,
                     unsigned members);
    // Where each line's lists begin.
    void placeLines(unsigned members);
    // Makes the lists of the member's share of the lines.
    void fillLines(const ClusterGrid& grid, unsigned member, unsigned members, LightLists& out);
    static void nameAllLights(const ClusterGrid& grid, size_t light_count, LightLists& out);

    Crew crew;
    std::vector<SpanChunk> chunks; // of each member
    std::vector<ListTally> tallies;
    std::vector<uint32_t> line_offsets; // lines + 1
    uint64_t max_entries;
    BallSweep sweep;
    std::atomic<uint64_t> entries{0}; // that all members have found
};

LightAssigner::LightAssigner(unsigned threads, uint64_t max_entries)
    : impl_(std::make_unique<Impl>(threads, max_entries)) {
    FROXEL_ASSERT(max_entries <= UINT32_MAX, "offsets are 32 bits");
}

LightAssigner::~LightAssigner() = default;

Crew& LightAssigner::crew() {
    return impl_->crew;
}

void LightAssigner::Impl::sweepLights(const ClusterGrid& grid,
                                      const light::FrameLights& lights,
                                      unsigned member,
                                      unsigned members) {
    const size_t light_count = lights.lights.size();
    const size_t first = light_count * member / members;
    const size_t end = light_count * (member + 1U) / members;
    SpanChunk& chunk = chunks[member];
    chunk.begin(first, size_t{grid.size.y} * grid.size.z);
    uint64_t counted = 0; // in `entries`
    for (size_t light = first; light < end; ++light) {
        appendLight(grid, sweep, lights, light, chunk.spans());
        chunk.endLight();
        const uint64_t found = chunk.entryCount() - counted;
        if (found >= kEntriesAtOnce || light + 1 == end) {
            counted += found;
            if (entries.fetch_add(found, std::memory_order_relaxed) + found > max_entries) {
                return; // and so do the others: it only grows
            }
        }
    }
    chunk.sortByLine();
}

void LightAssigner::Impl::placeLines(unsigned members) {
    uint32_t offset = 0;
    for (uint32_t line = 0; line + 1 < line_offsets.size(); ++line) {
        line_offsets[line] = offset;
        for (unsigned member = 0; member < members; ++member) {
            offset += chunks[member].entryCount(line);
        }
    }
    line_offsets.back() = offset;
}

void LightAssigner::Impl::fillLines(const ClusterGrid& grid,
                                    unsigned member,
                                    unsigned members,
                                    LightLists& out) {
    ListTally tally;
    // For each about the same number of entries and clusters.
    const auto work = [&](uint32_t line) {
        return uint64_t{line_offsets[line]} + uint64_t{line} * grid.size.x;
    };
    const auto line_count = static_cast<uint32_t>(line_offsets.size() - 1);
    const auto boundary = [&](unsigned share) {
        uint32_t line = 0;
        while (line < line_count && work(line) * members < work(line_count) * share) {
            ++line;
        }
        return line;
    };
    const uint32_t end = boundary(member + 1U);
    for (uint32_t line = boundary(member); line < end; ++line) {
        fillLine({chunks.data(), members}, line, line_offsets[line],
                 {&out.clusters[size_t{line} * grid.size.x], grid.size.x}, out.indices,
                 line_offsets.back() + member, tally);
    }
    tallies[member] = tally;
}

void LightAssigner::Impl::nameAllLights(const ClusterGrid& grid,
                                        size_t light_count,
                                        LightLists& out) {
    const auto count = static_cast<uint32_t>(light_count);
    out.all_lights = true;
    out.clusters.assign(grid.clusterCount(), {0, count});
    out.indices.resize(count);
    std::iota(out.indices.begin(), out.indices.end(), 0U);
    out.stats.entry_count = uint64_t{count} * grid.clusterCount();
    out.stats.largest = count;
    out.stats.p95 = count;
    out.stats.overflowed = true;
}

void LightAssigner::assign(const ClusterGrid& grid,
                           const light::FrameLights& lights,
                           LightLists& out) {
    Impl& impl = *impl_;
    const size_t light_count = lights.lights.size();
    FROXEL_ASSERT(lights.radii_m.size() == light_count, "a radius for each light");
    out.all_lights = false;
    out.stats = {};
    out.stats.light_count = static_cast<uint32_t>(light_count);
    out.stats.cluster_count = grid.clusterCount();
    out.clusters.resize(grid.clusterCount());

    impl.sweep.prepare(grid);
    impl.entries = 0;
    impl.line_offsets.resize(size_t{grid.size.y} * grid.size.z + 1U);
    const size_t wanted = light_count / kLightsPerMember + 1;
    const auto members = static_cast<unsigned>(std::min<size_t>(wanted, impl.crew.members()));
    impl.crew.run(members,
                  [&](unsigned member) { impl.sweepLights(grid, lights, member, members); });
    const uint64_t entry_count = impl.entries;
    if (entry_count > impl.max_entries) {
        Impl::nameAllLights(grid, light_count, out);
    } else {
        impl.placeLines(members);
        out.indices.resize(entry_count + members); // with a spare place for each
        impl.crew.run(members,
                      [&](unsigned member) { impl.fillLines(grid, member, members, out); });
        out.indices.resize(entry_count);
        ListTally tally;
        for (unsigned member = 0; member < members; ++member) {
            tally.add(impl.tallies[member]);
        }
        out.stats.entry_count = entry_count;
        out.stats.empty_count = tally.empty_count;
        out.stats.largest = tally.largest;
        out.stats.p95 = tally.lengths.p95(tally.largest);
    }
    out.finishStats();
}

} // namespace froxel::cluster
