// What a sweep finds: columns [first, last] of one row of one slice, in 32 bits.
#pragma once

#include "settings/ranges.h"

#include <cstdint>

namespace froxel::cluster {

class Span {
  public:
    // `line` is z * grid.y + y.
    Span(uint32_t line, uint32_t first, uint32_t last)
        : bits_((line << (2 * kColumnBits)) | (first << kColumnBits) | last) {}

    [[nodiscard]] uint32_t line() const { return bits_ >> (2 * kColumnBits); }
    [[nodiscard]] uint32_t first() const { return (bits_ >> kColumnBits) & kColumnMask; }
    [[nodiscard]] uint32_t last() const { return bits_ & kColumnMask; }
    [[nodiscard]] uint32_t count() const { return last() - first() + 1U; }

  private:
    static constexpr uint32_t kColumnBits = 7;
    static constexpr uint32_t kColumnMask = (1U << kColumnBits) - 1U;
    static_assert(settings::kGridXRange.max <= kColumnMask + 1U);
    static_assert(uint64_t{settings::kGridYRange.max} * settings::kGridZRange.max <=
                  uint64_t{1} << (32U - 2U * kColumnBits));

    uint32_t bits_;
};

} // namespace froxel::cluster
