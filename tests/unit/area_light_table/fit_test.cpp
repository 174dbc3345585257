#include "area_light_table/fit.h"
#include "area_light_table/table.h"
#include "interface/area_io.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace froxel::area_light_table {

namespace {

constexpr uint32_t kSize = io::kLtcSize;
constexpr size_t kEntryFloats = 4 * io::kLtcTexels;

Entry entryAt(Lobe lobe, uint32_t row, uint32_t column) {
    const size_t index = (static_cast<size_t>(lobe) * kSize + row) * kSize + column;
    const auto values = table().subspan(index * kEntryFloats, kEntryFloats);
    return {.a = values[0],
            .b = values[1],
            .c = values[2],
            .d = values[3],
            .albedo = values[4],
            .grazing = values[5]};
}

double roughnessOf(uint32_t row) {
    const auto least = static_cast<double>(io::kLtcLeastRoughness);
    return least + (1 - least) * row / (kSize - 1);
}

double cosineOf(uint32_t column) {
    const double x = static_cast<double>(column) / (kSize - 1);
    return std::max(1 - x * x, 1e-3);
}

// The fitted density in a direction, 1/sr.
double density(const Entry& e, const glm::dvec3& v) {
    const auto a = static_cast<double>(e.a);
    const auto b = static_cast<double>(e.b);
    const auto c = static_cast<double>(e.c);
    const auto d = static_cast<double>(e.d);
    const glm::dvec3 plain(a * v.x + b * v.z, v.y, c * v.x + d * v.z);
    const double length = glm::length(plain);
    const double determinant = std::abs(a * d - b * c);
    return std::max(0.0, plain.z / length) * std::numbers::inv_pi * determinant /
           (length * length * length);
}

// Over the hemisphere, midpoints of equal solid angles.
template <class Visit>
void eachDirection(int count, const Visit& visit) {
    for (int i = 0; i < count; ++i) {
        for (int k = 0; k < 2 * count; ++k) {
            const double z = (i + 0.5) / count;
            const double phi = std::numbers::pi * (k + 0.5) / count;
            const double r = std::sqrt(1 - z * z);
            visit(glm::dvec3(r * std::cos(phi), r * std::sin(phi), z),
                  std::numbers::pi / (static_cast<double>(count) * count));
        }
    }
}

} // namespace

TEST(LtcTable, HasEveryEntry) {
    EXPECT_EQ(table().size(), 2 * kSize * kSize * kEntryFloats);
    for (const float value : table()) {
        ASSERT_TRUE(std::isfinite(value));
    }
}

// The albedo is that of the lobe, summed anew without drawing from it.
TEST(LtcTable, Albedo_IsTheLobesIntegral) {
    for (const auto lobe : {Lobe::kGgx, Lobe::kBlinnPhong}) {
        for (const uint32_t row : {12U, 20U, 31U}) {
            for (const uint32_t column : {0U, 10U, 25U, 30U}) {
                const double cosine = cosineOf(column);
                const glm::dvec3 to_eye(std::sqrt(1 - cosine * cosine), 0, cosine);
                const double alpha = roughnessOf(row) * roughnessOf(row);
                double albedo = 0;
                eachDirection(400, [&](const glm::dvec3& v, double weight) {
                    albedo += evaluate(lobe, to_eye, v, alpha).value * weight;
                });
                const Entry entry = entryAt(lobe, row, column);
                EXPECT_NEAR(static_cast<double>(entry.albedo), albedo, 0.02 * albedo)
                    << static_cast<int>(lobe) << ' ' << row << ' ' << column;
                EXPECT_LE(entry.grazing, entry.albedo);
                EXPECT_GE(entry.grazing, 0);
            }
        }
    }
}

// How much of the lobe's light a fit puts elsewhere: half the integral of the difference.
TEST(LtcTable, Fit_PutsLittleLightElsewhere) {
    for (const auto lobe : {Lobe::kGgx, Lobe::kBlinnPhong}) {
        double most = 0;
        for (const uint32_t row : {8U, 12U, 16U, 24U, 31U}) {
            for (const uint32_t column : {0U, 8U, 16U, 24U, 28U}) {
                const double cosine = cosineOf(column);
                const glm::dvec3 to_eye(std::sqrt(1 - cosine * cosine), 0, cosine);
                const double alpha = roughnessOf(row) * roughnessOf(row);
                const Entry entry = entryAt(lobe, row, column);
                double misplaced = 0;
                eachDirection(300, [&](const glm::dvec3& v, double weight) {
                    const double wanted =
                        evaluate(lobe, to_eye, v, alpha).value / static_cast<double>(entry.albedo);
                    misplaced += 0.5 * std::abs(wanted - density(entry, v)) * weight;
                });
                most = std::max(most, misplaced);
            }
        }
        RecordProperty("most", std::to_string(most));
        EXPECT_LT(most, 0.2) << static_cast<int>(lobe);
    }
}

} // namespace froxel::area_light_table
