// Turns spans into lists. A line is one row of one slice. Spans arrive by light; sorted by line,
// a line's lists are a few kilobytes that stay in the first-level cache while they are filled:
// three times faster than scattering every light over the whole grid. Lines do not need each other.
#pragma once

#include "cluster/cluster_grid.h"
#include "cluster/list_histogram.h"
#include "cluster/span.h"
#include "interface/light_io.h"

#include <cstdint>
#include <span>
#include <vector>

namespace froxel::cluster {

// The spans of a run of consecutive lights, found by one thread. Memory: 4 bytes a light, 12 a span
// and 8 a line, kept from frame to frame.
class SpanChunk {
  public:
    // Empties the chunk; its lights are numbered from first_light on.
    void begin(size_t first_light, size_t line_count);
    // Append a light's spans here, in any order of lines, ...
    [[nodiscard]] std::vector<Span>& spans() { return spans_; }
    // ... then call this.
    void endLight();
    // After the last light: sorts by line; within a line lights ascend.
    void sortByLine();

    struct LineSpan {
        uint32_t light;
        uint16_t first; // columns, inclusive
        uint16_t last;
    };
    [[nodiscard]] uint64_t entryCount() const { return entry_count_; }
    [[nodiscard]] uint32_t entryCount(uint32_t line) const {
        return static_cast<uint32_t>(totals_[line] >> 32U);
    }
    [[nodiscard]] std::span<const LineSpan> lineSpans(uint32_t line) const; // once sorted

  private:
    size_t first_light_ = 0;
    size_t counted_ = 0; // spans of lights that have ended
    uint64_t entry_count_ = 0;
    std::vector<Span> spans_;
    std::vector<uint32_t> span_counts_; // of each light
    std::vector<uint64_t> totals_;      // of each line: entries in the upper half, spans below
    std::vector<uint32_t> line_ends_;   // of each line, in sorted_
    std::vector<LineSpan> sorted_;
};

// Of some of a grid's lists; adding up in any order gives the same.
struct ListTally {
    uint32_t empty_count = 0;
    uint32_t largest = 0;
    ListHistogram lengths;

    void add(uint32_t length);
    void add(const ListTally& other);
};

// Makes the lists of one line from the chunks' spans, whose lights ascend from chunk to chunk.
// `lists`: the line's, x ascending; the first begins at `offset` of `indices`. `spare`: a place in
// `indices` that belongs to no list; it is overwritten.
void fillLine(std::span<const SpanChunk> chunks,
              uint32_t line,
              uint32_t offset,
              std::span<io::ClusterList> lists,
              std::span<uint32_t> indices,
              uint32_t spare,
              ListTally& tally);

} // namespace froxel::cluster
