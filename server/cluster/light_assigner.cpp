#include "cluster/light_assigner.h"

#include "cluster/ball_sweep.h"
#include "cluster/crew.h"
#include "cluster/span.h"
#include "cluster/spot_cut.h"
#include "core/assert.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

namespace froxel::cluster {
namespace {

// Waking another thread costs about as much as this many lights.
constexpr size_t kLightsPerMember = 256;

Ball dilated(Ball ball) {
    ball.radius = io::dilatedRadius(ball);
    return ball;
}

// A run of consecutive lights, swept and filled in by one thread.
struct Chunk {
    size_t first_light = 0;
    size_t last_light = 0; // one past
    std::vector<Span> spans;
    std::vector<uint32_t> span_counts; // of each light
    // A line is a row of a slice, with one element more than it has clusters. First how many spans
    // begin here less how many ended before: its running sum counts a cluster's entries in two
    // additions a span. Then where the cluster's next entry goes.
    std::vector<uint32_t> lines;
    uint64_t entry_count = 0;

    [[nodiscard]] uint32_t* line(const ClusterGrid& grid, uint32_t index) {
        return &lines[size_t{index} * (grid.size.x + 1U)];
    }
};

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

struct LightAssigner::Impl {
    Impl(unsigned threads, uint64_t max_entries_)
        : crew(threads), chunks(threads), max_entries(max_entries_) {}

    void sweepChunk(const ClusterGrid& grid, const light::FrameLights& lights, Chunk& chunk);
    void placeLists(const ClusterGrid& grid, unsigned members, LightLists& out);
    // Makes the lists of one line, from `offset` on; returns where the next list goes.
    uint32_t placeLine(
        const ClusterGrid& grid, unsigned members, uint32_t line, uint32_t offset, LightLists& out);
    static void fillChunk(const ClusterGrid& grid, Chunk& chunk, std::vector<uint32_t>& indices);
    static void nameAllLights(const ClusterGrid& grid, size_t light_count, LightLists& out);

    Crew crew;
    std::vector<Chunk> chunks;
    uint64_t max_entries;
    BallSweep sweep;
    std::atomic<bool> overflow{false};
};

LightAssigner::LightAssigner(unsigned threads, uint64_t max_entries)
    : impl_(std::make_unique<Impl>(threads, max_entries)) {
    FROXEL_ASSERT(max_entries <= UINT32_MAX, "offsets are 32 bits");
}

LightAssigner::~LightAssigner() = default;

// Finds the chunk's spans and counts its entries for each cluster.
void LightAssigner::Impl::sweepChunk(const ClusterGrid& grid,
                                     const light::FrameLights& lights,
                                     Chunk& chunk) {
    chunk.spans.clear();
    chunk.span_counts.clear();
    chunk.lines.assign(size_t{grid.size.x + 1U} * grid.size.y * grid.size.z, 0);
    chunk.entry_count = 0;
    for (size_t light = chunk.first_light; light < chunk.last_light; ++light) {
        const size_t begin = chunk.spans.size();
        appendLight(grid, sweep, lights, light, chunk.spans);
        chunk.span_counts.push_back(static_cast<uint32_t>(chunk.spans.size() - begin));
        for (size_t i = begin; i < chunk.spans.size(); ++i) {
            const Span span = chunk.spans[i];
            uint32_t* line = chunk.line(grid, span.line());
            ++line[span.first()];
            --line[span.last() + 1U];
            chunk.entry_count += span.count();
        }
        if (chunk.entry_count > max_entries || overflow.load(std::memory_order_relaxed)) {
            overflow.store(true, std::memory_order_relaxed);
            return;
        }
    }
}

// Turns counts into offsets: within a cluster's list the chunks follow each other.
uint32_t LightAssigner::Impl::placeLine(
    const ClusterGrid& grid, unsigned members, uint32_t line, uint32_t offset, LightLists& out) {
    const size_t first_cluster = size_t{line} * grid.size.x;
    for (unsigned member = 0; member < members; ++member) {
        uint32_t* counts = chunks[member].line(grid, line);
        std::partial_sum(counts, counts + grid.size.x, counts);
    }
    for (uint32_t x = 0; x < grid.size.x; ++x) {
        const uint32_t begin = offset;
        for (unsigned member = 0; member < members; ++member) {
            uint32_t& cursor = chunks[member].line(grid, line)[x];
            offset += std::exchange(cursor, offset);
        }
        out.clusters[first_cluster + x] = {begin, offset - begin};
    }
    return offset;
}

void LightAssigner::Impl::placeLists(const ClusterGrid& grid, unsigned members, LightLists& out) {
    uint32_t offset = 0;
    for (uint32_t line = 0; line < grid.size.y * grid.size.z; ++line) {
        offset = placeLine(grid, members, line, offset, out);
    }
    for (const io::ClusterList& list : out.clusters) {
        out.stats.empty_count += list.count == 0 ? 1U : 0U;
        out.stats.largest = std::max(out.stats.largest, list.count);
    }
    out.stats.entry_count = offset;
    out.indices.resize(offset);
}

void LightAssigner::Impl::fillChunk(const ClusterGrid& grid,
                                    Chunk& chunk,
                                    std::vector<uint32_t>& indices) {
    auto span = chunk.spans.begin();
    auto light = static_cast<uint32_t>(chunk.first_light);
    for (const uint32_t span_count : chunk.span_counts) {
        for (const auto end = span + span_count; span != end; ++span) {
            uint32_t* line = chunk.line(grid, span->line());
            for (uint32_t x = span->first(); x <= span->last(); ++x) {
                indices[line[x]++] = light;
            }
        }
        ++light;
    }
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
    impl.overflow = false;
    const size_t wanted = light_count / kLightsPerMember + 1;
    const auto members = static_cast<unsigned>(std::min<size_t>(wanted, impl.crew.members()));
    for (unsigned member = 0; member < members; ++member) {
        impl.chunks[member].first_light = light_count * member / members;
        impl.chunks[member].last_light = light_count * (member + 1) / members;
    }
    impl.crew.run(members,
                  [&](unsigned member) { impl.sweepChunk(grid, lights, impl.chunks[member]); });
    uint64_t entry_count = 0;
    for (unsigned member = 0; member < members; ++member) {
        entry_count += impl.chunks[member].entry_count;
    }
    if (impl.overflow || entry_count > impl.max_entries) {
        Impl::nameAllLights(grid, light_count, out);
    } else {
        impl.placeLists(grid, members, out);
        impl.crew.run(members, [&](unsigned member) {
            Impl::fillChunk(grid, impl.chunks[member], out.indices);
        });
    }
    const uint32_t filled = out.stats.cluster_count - out.stats.empty_count;
    out.stats.mean = filled > 0 ? static_cast<double>(out.stats.entry_count) / filled : 0.0;
}

} // namespace froxel::cluster
