// Lights that viewers place, one by one or as a set from a file. Immutable and shared: copies of
// settings are made for every frame.
#pragma once

#include "core/math.h"

#include <array>
#include <compare>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace froxel::settings {

enum class LightKind : uint8_t { kPoint, kSpot, kArea };
inline constexpr std::array kLightKindNames = {std::string_view("point"), std::string_view("spot"),
                                               std::string_view("area")};

// A light that is there without viewers: of the seed, or of the scene.
struct LightRef {
    enum class Of : uint8_t { kSeed, kScene };
    Of of = Of::kSeed;
    uint32_t index = 0;
    auto operator<=>(const LightRef&) const = default;
};

struct PlacedLight {
    uint32_t id = 0; // of who placed it; not 0
    LightKind kind = LightKind::kPoint;
    glm::dvec3 position_world{0};
    glm::dvec3 direction_world{0, -1, 0}; // the way its light travels, but a point's; of any
                                          // length but 0
    glm::vec3 color{1};                   // linear, 0 to 1
    float intensity = 1;
    float radius_m = 2;         // where its contribution reaches exactly 0
    double inner_cone_deg = 30; // half angles; spots only
    double outer_cone_deg = 45;
    double width_m = 1; // of an area light's rectangle, whose radiance is intensity / area
    double height_m = 1;
    double roll_deg = 0;                             // about the direction, from a level width
    std::optional<LightRef> replaces = std::nullopt; // stands for it while it is there
    bool operator==(const PlacedLight&) const = default;
};

class PlacedLights {
  public:
    PlacedLights() = default;
    // Ids ascend, none is there twice.
    explicit PlacedLights(std::vector<PlacedLight> lights);

    [[nodiscard]] std::span<const PlacedLight> lights() const;
    // Null where there is none of that id.
    [[nodiscard]] const PlacedLight* find(uint32_t id) const;
    [[nodiscard]] bool operator==(const PlacedLights& other) const;

  private:
    std::shared_ptr<const std::vector<PlacedLight>> lights_; // null: none
};

} // namespace froxel::settings
