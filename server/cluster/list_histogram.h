// How long the lists of a frame are, without sorting them.
#pragma once

#include "interface/histogram_io.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace froxel::cluster {

class ListHistogram {
  public:
    void add(uint32_t length) { ++counts_[io::histogramBucket(length)]; }
    void add(const ListHistogram& other) {
        for (size_t bucket = 0; bucket < counts_.size(); ++bucket) {
            counts_[bucket] += other.counts_[bucket];
        }
    }

    void addBucket(uint32_t bucket, uint32_t lists) { counts_[bucket] += lists; }

    // 95 % of the lists that are not empty are at most this long; exact to a sixteenth. 0: none.
    // `largest`: the longest of all, a tighter bound than its bucket's.
    [[nodiscard]] uint32_t p95(uint32_t largest) const {
        uint32_t filled = 0;
        for (size_t bucket = 1; bucket < counts_.size(); ++bucket) {
            filled += counts_[bucket];
        }
        uint32_t below = io::histogramRank95(filled);
        for (uint32_t bucket = 1; below > 0 && bucket < counts_.size(); ++bucket) {
            if (counts_[bucket] >= below) {
                return std::min(io::histogramUpper(bucket), largest);
            }
            below -= counts_[bucket];
        }
        return 0;
    }

  private:
    std::array<uint32_t, io::kHistogramBuckets> counts_{}; // of lists, by io::histogramBucket
};

} // namespace froxel::cluster
