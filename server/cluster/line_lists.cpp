#include "cluster/line_lists.h"

#include "settings/ranges.h"

#include <algorithm>
#include <array>
#include <utility>

namespace froxel::cluster {
namespace {

constexpr uint32_t kColumnsAtOnce = 4;
constexpr size_t kCacheLine = 16; // in light indices

} // namespace

void SpanChunk::begin(size_t first_light, size_t line_count) {
    first_light_ = first_light;
    counted_ = 0;
    entry_count_ = 0;
    spans_.clear();
    span_counts_.clear();
    totals_.assign(line_count, 0);
}

void SpanChunk::endLight() {
    uint64_t entries = 0;
    for (size_t i = counted_; i < spans_.size(); ++i) {
        const uint64_t count = spans_[i].count();
        totals_[spans_[i].line()] += (count << 32U) | 1U;
        entries += count;
    }
    entry_count_ += entries;
    span_counts_.push_back(static_cast<uint32_t>(spans_.size() - counted_));
    counted_ = spans_.size();
}

void SpanChunk::sortByLine() {
    line_ends_.resize(totals_.size());
    uint32_t next = 0;
    for (size_t line = 0; line < totals_.size(); ++line) {
        line_ends_[line] = next; // moves to the end as the line is filled
        next += static_cast<uint32_t>(totals_[line]);
    }
    sorted_.resize(spans_.size());
    auto span = spans_.begin();
    auto light = static_cast<uint32_t>(first_light_);
    for (const uint32_t span_count : span_counts_) {
        for (const auto end = span + span_count; span != end; ++span) {
            sorted_[line_ends_[span->line()]++] = {light, static_cast<uint16_t>(span->first()),
                                                   static_cast<uint16_t>(span->last())};
        }
        ++light;
    }
}

std::span<const SpanChunk::LineSpan> SpanChunk::lineSpans(uint32_t line) const {
    const auto count = static_cast<uint32_t>(totals_[line]);
    return {sorted_.data() + (line_ends_[line] - count), count};
}

void ListTally::add(uint32_t length) {
    empty_count += length == 0 ? 1U : 0U;
    largest = std::max(largest, length);
    lengths.add(length);
}

void ListTally::add(const ListTally& other) {
    empty_count += other.empty_count;
    largest = std::max(largest, other.largest);
    lengths.add(other.lengths);
}

void fillLine(std::span<const SpanChunk> chunks,
              uint32_t line,
              uint32_t offset,
              std::span<io::ClusterList> lists,
              std::span<uint32_t> indices,
              uint32_t spare,
              ListTally& tally) {
    // How many spans begin here less how many ended before: the running sum counts a cluster's
    // entries in two additions a span.
    std::array<uint32_t, settings::kGridXRange.max + kColumnsAtOnce> cursors{};
    for (const SpanChunk& chunk : chunks) {
        for (const auto& span : chunk.lineSpans(line)) {
            ++cursors[span.first];
            --cursors[span.last + 1U];
        }
    }
    uint32_t count = 0;
    for (size_t x = 0; x < lists.size(); ++x) {
        count += std::exchange(cursors[x], offset);
        lists[x] = {offset, count};
        tally.add(count);
        offset += count;
    }
    // The line's share of `indices` is written in no order that the processor foresees.
    const uint32_t line_end = offset;
    for (size_t i = lists.front().offset; i < line_end; i += kCacheLine) {
        __builtin_prefetch(&indices[i], 1);
    }
    // Four columns at a time, those past the span into the spare place: a loop of one to sixteen
    // rounds would cost a mispredicted branch for each span, more than all else here.
    for (const SpanChunk& chunk : chunks) {
        for (const auto& span : chunk.lineSpans(line)) {
            const uint32_t light = span.light;
            const uint32_t last = span.last;
            for (uint32_t x = span.first; x <= last; x += kColumnsAtOnce) {
#pragma GCC unroll 4
                for (uint32_t k = 0; k < kColumnsAtOnce; ++k) {
                    const bool within = x + k <= last;
                    const uint32_t next = cursors[x + k];
                    indices[within ? next : spare] = light;
                    cursors[x + k] = next + static_cast<uint32_t>(within);
                }
            }
        }
    }
}

} // namespace froxel::cluster
