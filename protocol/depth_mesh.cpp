#include "protocol/depth_mesh.h"

#include "core/assert.h"
#include "core/text.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace froxel::protocol {
namespace {

constexpr uint32_t kNibbleBits = 3; // and one that says whether another one follows
constexpr uint32_t kMore = 1U << kNibbleBits;
constexpr uint32_t kMostNibbles = 7; // of a number: 21 bits

// Where a plane through three neighbours has the fourth; all are within 0..top.
int32_t onPlane(int32_t left, int32_t above, int32_t above_left, int32_t top) {
    return std::clamp(left + above - above_left, 0, top);
}

// What the vertices before say of one. All are within 0..top.
int32_t predicted(std::span<const uint16_t> steps, size_t at, uint32_t columns, int32_t top) {
    const bool first_column = at % columns == 0;
    const bool first_row = at < columns;
    if (first_row) {
        return first_column ? 0 : steps[at - 1];
    }
    const int32_t above = steps[at - columns];
    return first_column ? above : onPlane(steps[at - 1], above, steps[at - columns - 1], top);
}

// 0, -1, 1, -2, ... as 0, 1, 2, 3, ...
constexpr uint32_t folded(int32_t difference) {
    return difference < 0 ? 2 * static_cast<uint32_t>(-difference) - 1
                          : 2 * static_cast<uint32_t>(difference);
}
constexpr int32_t unfolded(uint32_t number) {
    const auto half = static_cast<int32_t>((number + 1) / 2);
    return number % 2 == 0 ? half : -half;
}

// Low nibbles come first, and of a byte the low one.
class NibbleWriter {
  public:
    explicit NibbleWriter(std::vector<std::byte>& out) : out_(out) {}

    void number(uint32_t value) {
        while (value >= kMore) {
            nibble(value % kMore | kMore);
            value /= kMore;
        }
        nibble(value);
    }

  private:
    void nibble(uint32_t value) {
        if (low_) {
            out_.push_back(static_cast<std::byte>(value));
        } else {
            out_.back() |= static_cast<std::byte>(value << 4U);
        }
        low_ = !low_;
    }

    std::vector<std::byte>& out_;
    bool low_ = true;
};

class NibbleReader {
  public:
    explicit NibbleReader(ByteSpan bytes) : bytes_(bytes) {}

    // None: the bytes end within it, or it is longer than any.
    std::optional<uint32_t> number() {
        uint32_t value = 0;
        for (uint32_t i = 0; i < kMostNibbles && at_ < 2 * bytes_.size(); ++i) {
            const uint32_t next = nibble();
            value |= next % kMore << (kNibbleBits * i);
            if (next < kMore) {
                return value;
            }
        }
        return {};
    }
    // Whether no more than the nibble that fills the last byte is left.
    bool atEnd() { return at_ == 2 * bytes_.size() || (at_ % 2 == 1 && atLast() && nibble() == 0); }

  private:
    [[nodiscard]] bool atLast() const { return at_ + 1 == 2 * bytes_.size(); }
    uint32_t nibble() {
        const auto byte = std::to_integer<uint32_t>(bytes_[at_ / 2]);
        return at_++ % 2 == 0 ? byte & 15U : byte >> 4U;
    }

    ByteSpan bytes_;
    size_t at_ = 0; // nibbles
};

std::vector<uint16_t>
stepsOf(std::span<const float> inverse_distances, float nearest, uint32_t top) {
    std::vector<uint16_t> steps(inverse_distances.size(), 0);
    if (nearest > 0) {
        const auto most = static_cast<float>(top);
        const float scale = most / nearest; // infinite where all are next to nothing
        std::ranges::transform(inverse_distances, steps.begin(), [=](float inverse) {
            const bool there = inverse > 0 && inverse <= nearest;
            return there ? static_cast<uint16_t>(std::min(inverse * scale + 0.5F, most)) : 0;
        });
    }
    return steps;
}

// Of what each vertex differs by from predicted(): row by row, which takes two thirds of the time
// of asking it for each.
std::vector<uint32_t> numbersOf(std::span<const uint16_t> steps, DepthMeshSize size, int32_t top) {
    std::vector<uint32_t> numbers(steps.size());
    const auto differs = [&](size_t at, int32_t prediction) {
        numbers[at] = folded(steps[at] - prediction);
    };
    differs(0, 0);
    for (size_t x = 1; x < size.columns; ++x) {
        differs(x, steps[x - 1]);
    }
    for (size_t row = size.columns; row < steps.size(); row += size.columns) {
        const uint16_t* const here = &steps[row];
        const uint16_t* const above = &steps[row - size.columns];
        differs(row, above[0]);
        for (size_t x = 1; x < size.columns; ++x) {
            differs(row + x, onPlane(here[x - 1], above[x], above[x - 1], top));
        }
    }
    return numbers;
}

} // namespace

CodedDepthMesh
encodeDepthMesh(std::span<const float> inverse_distances, DepthMeshSize size, uint32_t bits) {
    FROXEL_ASSERT(inverse_distances.size() == size.vertexCount(), "a depth for each vertex");
    FROXEL_ASSERT(bits >= kMinDepthBits && bits <= kMaxDepthBits, "bits out of their range");
    CodedDepthMesh coded{.size = size, .bits = bits};
    float nearest = 0;
    for (const float inverse : inverse_distances) {
        nearest = inverse > nearest && inverse < std::numeric_limits<float>::infinity() ? inverse
                                                                                        : nearest;
    }
    coded.nearest_per_m = static_cast<double>(nearest);
    const uint32_t top = (1U << bits) - 1;
    const auto numbers =
        numbersOf(stepsOf(inverse_distances, nearest, top), size, static_cast<int32_t>(top));
    coded.bytes.reserve(numbers.size());
    NibbleWriter out(coded.bytes);
    const auto lengthOf = [&numbers](size_t begin, bool zeros) {
        size_t end = begin;
        while (end < numbers.size() && (numbers[end] == 0) == zeros) {
            ++end;
        }
        return end - begin;
    };
    for (size_t i = 0; i < numbers.size();) {
        const size_t zeros = lengthOf(i, true);
        const size_t others = lengthOf(i + zeros, false);
        out.number(static_cast<uint32_t>(zeros));
        out.number(static_cast<uint32_t>(others));
        for (size_t k = i + zeros; k < i + zeros + others; ++k) {
            out.number(numbers[k]);
        }
        i += zeros + others;
    }
    return coded;
}

Result<std::vector<uint16_t>> decodeDepthMesh(ByteSpan bytes, DepthMeshSize size, uint32_t bits) {
    const auto invalid = [&size](const std::string& what) {
        return Error{ErrorCode::kInvalidArgument, "depth mesh of " + numberText(size.columns) +
                                                      "x" + numberText(size.rows) +
                                                      " vertices: " + what};
    };
    if (bits < kMinDepthBits || bits > kMaxDepthBits) {
        return invalid("it has " + numberText(bits) + " bits; expected " +
                       numberText(kMinDepthBits) + " to " + numberText(kMaxDepthBits));
    }
    const auto top = static_cast<int32_t>((1U << bits) - 1);
    std::vector<uint16_t> steps(size.vertexCount());
    NibbleReader in(bytes);
    for (size_t i = 0; i < steps.size();) {
        const auto zeros = in.number();
        const auto others = zeros ? in.number() : std::nullopt;
        if (!others || *zeros + *others == 0 || *zeros + *others > steps.size() - i) {
            return invalid("a run at vertex " + numberText(i) + " ends beyond the last one");
        }
        const size_t end = i + *zeros + *others;
        for (const size_t first_other = i + *zeros; i < end; ++i) {
            const auto number = i < first_other ? std::optional(0U) : in.number();
            if (!number) {
                return invalid("its bytes end at vertex " + numberText(i));
            }
            const int32_t step = predicted(steps, i, size.columns, top) + unfolded(*number);
            if (step < 0 || step > top) {
                return invalid("vertex " + numberText(i) + " is at step " + numberText(step) +
                               " of " + numberText(top));
            }
            steps[i] = static_cast<uint16_t>(step);
        }
    }
    if (!in.atEnd()) {
        return invalid("bytes follow its last vertex");
    }
    return steps;
}

} // namespace froxel::protocol
