// The split sum's second factor (glossy.h): what a lobe reflects in all.
#pragma once

#include <cstdint>
#include <span>

namespace froxel::environment {

// A surface of reflectance f0 reflects f0 (all - grazing) + grazing of a
// constant environment at the first bounce from its microfacets.
struct Albedo {
    double all = 0;     // the lobe's integral times cosine over the hemisphere
    double grazing = 0; // that times (1 - v.h)^5
};
// n_dot_v: 0 to 1, roughness: above 0 to 1. Within 1e-4, below n_dot_v = 0.01 within 1e-3.
[[nodiscard]] Albedo albedo(double n_dot_v, double roughness);

// What a surface reflects in all, with the light that leaves its microfacets at a later bounce
// (Turquin 2019, "Practical multiple scattering compensation for microfacet models"): exactly 1 of
// f0 = 1, at every roughness.
[[nodiscard]] double reflectedShare(double f0, const Albedo& albedo);

// The device's table: rows by roughness, in each kAlbedoTableSize entries by n.v, of all and
// grazing. Least at 0, most at kAlbedoTableSize - 1; between entries it is linear, and off by up to
// 0.003 (below n_dot_v = 0.01 by up to 0.01).
inline constexpr uint32_t kAlbedoTableSize = 32;
inline constexpr double kLeastRoughness = 0.045;   // of a surface
[[nodiscard]] double albedoColumn(double n_dot_v); // the cube root: lobes change most at the edge
[[nodiscard]] double albedoRow(double roughness);  // the root, from the least on
[[nodiscard]] double cosineOfColumn(uint32_t column);
[[nodiscard]] double roughnessOfRow(uint32_t row);

// Made at build time by make_albedo_table.cpp.
[[nodiscard]] std::span<const float> albedoTable();

// As the device finds it.
[[nodiscard]] Albedo albedoFromTable(double n_dot_v, double roughness);

} // namespace froxel::environment
