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
#include <ranges>
#include <utility>

namespace froxel::cluster {
namespace {

// Waking another thread costs about as much as this many lights.
constexpr size_t kLightsPerMember = 256;

// Looking at a line, which the light may miss, takes about a quarter of what an entry does.
constexpr uint64_t kLinesPerEntry = 4;

// Buffers of lists up to these are kept for the next ones: 5 MB.
constexpr uint64_t kEntriesKept = uint64_t{1} << 18U;

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

// Returns how many lines it looked at.
size_t appendLight(const ClusterGrid& grid,
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
    size_t looked_at = 0;
    if (std::isinf(range)) {
        appendAll(grid, spans);
    } else {
        looked_at =
            sweep.sweep(dilated(spot ? spot->bound() : Ball{apex.x, apex.y, apex.z, range}), spans);
    }
    if (spot) {
        cutSpans(grid, *spot, begin, spans);
    }
    return looked_at;
}

// Makes one frame's lists, a part at a time. Its buffers are reused.
class ListMaker {
  public:
    ListMaker(Crew& crew, uint64_t max_entries)
        : crew_(crew), max_entries_(max_entries), chunks_(crew.members()) {}

    void begin(const ClusterGrid& grid, const light::FrameLights& lights, LightLists& out);
    // Goes through about so many more lights and entries: whether all is done.
    bool advance(uint64_t work);
    // That were found so far; what it holds grows with it.
    [[nodiscard]] uint64_t entryCount() const { return entries_; }

  private:
    // What one of the crew does.
    struct Share {
        size_t next = 0; // light
        size_t end = 0;
        bool sorted = false; // the spans of all of them
        ListTally tally;
    };
    // Finds the spans of the next of the member's lights.
    void sweepLights(unsigned member, uint64_t work);
    // Where each line's lists begin.
    void placeLines();
    // Makes the lists of the member's share of the lines from `first` to `end`.
    void fillLines(uint32_t first, uint32_t end, unsigned member);
    [[nodiscard]] uint32_t lineCount() const {
        return static_cast<uint32_t>(line_offsets_.size() - 1);
    }
    // Entries and clusters before the line.
    [[nodiscard]] uint64_t workBefore(uint32_t line) const {
        return uint64_t{line_offsets_[line]} + uint64_t{line} * grid_->size.x;
    }
    // The first line with so much before it.
    [[nodiscard]] uint32_t lineAfter(uint64_t work) const;
    void finish();
    void nameAllLights();

    Crew& crew_;
    const uint64_t max_entries_;
    const ClusterGrid* grid_ = nullptr;
    const light::FrameLights* lights_ = nullptr;
    LightLists* out_ = nullptr;
    std::vector<Share> shares_;     // of each member that works on it
    std::vector<SpanChunk> chunks_; // of each member
    BallSweep sweep_;
    std::atomic<uint64_t> entries_{0};   // that all members have found
    std::vector<uint32_t> line_offsets_; // lines + 1; none: not all lights are swept
    uint32_t next_line_ = 0;
};

void ListMaker::begin(const ClusterGrid& grid, const light::FrameLights& lights, LightLists& out) {
    const size_t light_count = lights.lights.size();
    FROXEL_ASSERT(lights.radii_m.size() == light_count, "a radius for each light");
    grid_ = &grid;
    lights_ = &lights;
    out_ = &out;
    out.all_lights = false;
    out.stats = {};
    out.stats.light_count = static_cast<uint32_t>(light_count);
    out.stats.cluster_count = grid.clusterCount();
    out.clusters.resize(grid.clusterCount());
    sweep_.prepare(grid);
    entries_ = 0;
    line_offsets_.clear();
    next_line_ = 0;
    const size_t wanted = light_count / kLightsPerMember + 1;
    const auto members = std::min<size_t>(wanted, crew_.members());
    shares_.clear();
    for (size_t member = 0; member < members; ++member) {
        const size_t first = light_count * member / members;
        shares_.push_back(
            {.next = first, .end = light_count * (member + 1) / members, .tally = {}});
        chunks_[member].begin(first, size_t{grid.size.y} * grid.size.z);
    }
}

bool ListMaker::advance(uint64_t work) {
    const auto members = static_cast<unsigned>(shares_.size());
    if (line_offsets_.empty()) {
        const uint64_t part = std::max<uint64_t>(work / members, 1);
        crew_.run(members, [&](unsigned member) { sweepLights(member, part); });
        if (entries_ > max_entries_) {
            nameAllLights();
            return true;
        }
        if (std::ranges::all_of(shares_, &Share::sorted)) {
            placeLines();
        }
        return false;
    }
    const uint32_t first = next_line_;
    const uint64_t left = workBefore(lineCount()) - workBefore(first);
    next_line_ =
        work < left ? lineAfter(workBefore(first) + std::max<uint64_t>(work, 1)) : lineCount();
    crew_.run(members, [&](unsigned member) { fillLines(first, next_line_, member); });
    if (next_line_ < lineCount()) {
        return false;
    }
    finish();
    return true;
}

void ListMaker::sweepLights(unsigned member, uint64_t work) {
    Share& share = shares_[member];
    if (share.sorted) {
        return;
    }
    SpanChunk& chunk = chunks_[member];
    const size_t first = share.next;
    const uint64_t before = chunk.entryCount();
    uint64_t told = before;
    const auto tooMany = [&] { // and so will the others see: it only grows
        const uint64_t found = chunk.entryCount() - std::exchange(told, chunk.entryCount());
        return entries_.fetch_add(found, std::memory_order_relaxed) + found > max_entries_;
    };
    uint64_t looked_at = 0;
    while (share.next < share.end &&
           share.next - first + chunk.entryCount() - before + looked_at / kLinesPerEntry < work) {
        looked_at += appendLight(*grid_, sweep_, *lights_, share.next++, chunk.spans());
        chunk.endLight();
        if (chunk.entryCount() - told >= kEntriesAtOnce && tooMany()) {
            return;
        }
    }
    if (!tooMany() && share.next == share.end) {
        chunk.sortByLine();
        share.sorted = true;
    }
}

void ListMaker::placeLines() {
    line_offsets_.resize(size_t{grid_->size.y} * grid_->size.z + 1U);
    uint32_t offset = 0;
    for (uint32_t line = 0; line < lineCount(); ++line) {
        line_offsets_[line] = offset;
        for (size_t member = 0; member < shares_.size(); ++member) {
            offset += chunks_[member].entryCount(line);
        }
    }
    line_offsets_.back() = offset;
    out_->indices.resize(offset + shares_.size()); // with a spare place for each
}

uint32_t ListMaker::lineAfter(uint64_t work) const {
    return *std::ranges::lower_bound(std::views::iota(0U, lineCount() + 1U), work, {},
                                     [this](uint32_t line) { return workBefore(line); });
}

void ListMaker::fillLines(uint32_t first, uint32_t end, unsigned member) {
    ListTally tally;
    // For each about the same number of entries and clusters.
    const uint64_t work = workBefore(end) - workBefore(first);
    const auto boundary = [&](uint64_t share) {
        return lineAfter(workBefore(first) + work * share / shares_.size());
    };
    const uint32_t stop = boundary(member + 1U);
    for (uint32_t line = boundary(member); line < stop; ++line) {
        fillLine({chunks_.data(), shares_.size()}, line, line_offsets_[line],
                 {&out_->clusters[size_t{line} * grid_->size.x], grid_->size.x}, out_->indices,
                 line_offsets_.back() + member, tally);
    }
    shares_[member].tally.add(tally);
}

void ListMaker::finish() {
    out_->indices.resize(line_offsets_.back());
    ListTally tally;
    for (const Share& share : shares_) {
        tally.add(share.tally);
    }
    out_->stats.entry_count = line_offsets_.back();
    out_->stats.empty_count = tally.empty_count;
    out_->stats.largest = tally.largest;
    out_->stats.p95 = tally.lengths.p95(tally.largest);
    out_->finishStats();
}

void ListMaker::nameAllLights() {
    const uint32_t count = out_->stats.light_count;
    out_->all_lights = true;
    out_->clusters.assign(grid_->clusterCount(), {0, count});
    out_->indices.resize(count);
    std::iota(out_->indices.begin(), out_->indices.end(), 0U);
    out_->stats.entry_count = uint64_t{count} * grid_->clusterCount();
    out_->stats.largest = count;
    out_->stats.p95 = count;
    out_->stats.overflowed = true;
    out_->finishStats();
}

} // namespace

void LightLists::finishStats() {
    const uint32_t filled = stats.cluster_count - stats.empty_count;
    stats.mean = filled > 0 ? static_cast<double>(stats.entry_count) / filled : 0.0;
    stats.bytes = clusters.size() * sizeof(io::ClusterList) + indices.size() * sizeof(uint32_t);
}

struct LightAssigner::Impl {
    Impl(unsigned threads, uint64_t max_entries_)
        : crew(threads), max_entries(max_entries_), at_once(crew, max_entries_) {}

    Crew crew;
    const uint64_t max_entries;
    ListMaker at_once;
    std::unique_ptr<ListMaker> in_parts; // null: nothing is under way, or was since long lists
    LightAssignment* under_way = nullptr;
};

LightAssigner::LightAssigner(unsigned threads, uint64_t max_entries)
    : impl_(std::make_unique<Impl>(threads, max_entries)) {
    FROXEL_ASSERT(max_entries <= UINT32_MAX, "offsets are 32 bits");
}

LightAssigner::~LightAssigner() = default;

Crew& LightAssigner::crew() {
    return impl_->crew;
}

void LightAssigner::assign(const ClusterGrid& grid,
                           const light::FrameLights& lights,
                           LightLists& out) {
    impl_->at_once.begin(grid, lights, out);
    while (!impl_->at_once.advance(UINT64_MAX)) {
    }
}

LightAssignment::~LightAssignment() {
    auto& assigner = *assigner_.impl_;
    if (assigner.under_way == this) {
        assigner.under_way = nullptr;
        assigner.in_parts.reset();
    }
}

bool LightAssignment::advance(uint64_t work) {
    auto& assigner = *assigner_.impl_;
    if (done_) {
        return true;
    }
    if (assigner.under_way == nullptr) {
        assigner.under_way = this;
        if (!assigner.in_parts) {
            assigner.in_parts = std::make_unique<ListMaker>(assigner.crew, assigner.max_entries);
        }
        assigner.in_parts->begin(grid_, lights_, out_);
    }
    if (assigner.in_parts->advance(work)) {
        std::exchange(assigner.under_way, nullptr)->done_ = true;
        if (assigner.in_parts->entryCount() > kEntriesKept) {
            assigner.in_parts.reset();
        }
    }
    return done_;
}

} // namespace froxel::cluster
