// Pictures of floats that a frame may give besides its pixels. Whatever carries a frame from the
// device to an encoder walks the rows.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string_view>

namespace froxel {

enum class Output : uint8_t {
    kRadiance, // before exposure and tone map: linear RGBA
    kDepth,    // of solid surfaces, metres along the view axis; infinity: there is none
    // Of the vertices of core/depth_mesh.h, row by row: 1/m along the view axis; 0: there is none.
    kDepthMesh,
};

struct OutputRow {
    std::string_view name;
    uint32_t floats;      // of a sample
    uint32_t file_floats; // that a file has of a pixel; 0: none has it
};

inline constexpr std::array kOutputRows = {OutputRow{"radiance", 4, 3}, OutputRow{"depth", 1, 1},
                                           OutputRow{"depth mesh", 1, 0}};
inline constexpr size_t kOutputCount = kOutputRows.size();

// A set of them.
class Outputs {
  public:
    constexpr Outputs() = default;
    constexpr Outputs(std::initializer_list<Output> some) {
        for (const Output output : some) {
            add(output);
        }
    }
    constexpr void add(Output output) { bits_ |= 1U << static_cast<uint32_t>(output); }
    [[nodiscard]] constexpr bool has(Output output) const {
        return (bits_ >> static_cast<uint32_t>(output) & 1U) != 0;
    }
    [[nodiscard]] constexpr bool none() const { return bits_ == 0; }
    bool operator==(const Outputs&) const = default;

  private:
    uint32_t bits_ = 0;
};

} // namespace froxel
