// How many parts of a size cover a whole.
#pragma once

namespace froxel {

// Rounded up; both not negative, `each` not 0, and their sum fits.
template <class Integer>
[[nodiscard]] constexpr Integer ceilDivide(Integer count, Integer each) {
    return (count + each - 1) / each;
}

} // namespace froxel
