#include "area_light_table/fit.h"

#include "core/lobes.h"
#include "interface/area_io.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace froxel::area_light_table {
namespace {

constexpr int kFitSamples = 24; // squared, of the lobe and of its fit
constexpr int kAlbedoSamples = 96;
constexpr int kMostSteps = 100;
constexpr double kLeastCosine = 1e-3;

template <class Visit>
void eachSample(int count, const Visit& visit) {
    for (int i = 0; i < count; ++i) {
        for (int k = 0; k < count; ++k) {
            visit((i + 0.5) / count, (k + 0.5) / count);
        }
    }
}

// What is to be fitted, for one roughness and angle.
struct Target {
    struct Direction {
        glm::dvec3 to_light;
        LobeSample lobe;
    };
    Lobe lobe;
    double alpha;
    glm::dvec3 to_eye;
    double albedo = 0;
    double grazing = 0;
    glm::dvec3 mean{0};
    std::vector<Direction> directions; // drawn from the lobe

    Target(Lobe lobe_, double roughness, double cosine)
        : lobe(lobe_), alpha(roughness * roughness),
          to_eye(std::sqrt(1 - cosine * cosine), 0, cosine) {
        eachSample(kFitSamples, [&](double u, double v) {
            const glm::dvec3 to_light = sampleLobe(lobe, to_eye, alpha, u, v);
            if (const auto at = evaluate(lobe, to_eye, to_light, alpha); at.density > 0) {
                directions.push_back({to_light, at});
            }
        });
        eachSample(kAlbedoSamples, [&](double u, double v) {
            const glm::dvec3 to_light = sampleLobe(lobe, to_eye, alpha, u, v);
            const LobeSample at = evaluate(lobe, to_eye, to_light, alpha);
            if (!(at.density > 0)) {
                return;
            }
            const double weight = at.value / at.density / (kAlbedoSamples * kAlbedoSamples);
            const glm::dvec3 half = glm::normalize(to_eye + to_light);
            albedo += weight;
            grazing += weight * lobes::fifth(1 - glm::dot(half, to_eye));
            mean += to_light * weight;
        });
        mean.y = 0; // by symmetry
        mean = glm::length(mean) > 0 ? glm::normalize(mean) : glm::dvec3(0, 0, 1);
    }
};

using Parameters = std::array<double, 3>; // m11, m22, m13 in the mean direction's frame

struct Transform {
    glm::dmat3 m;
    glm::dmat3 inverse;
    double determinant;

    Transform(const Parameters& p, const glm::dvec3& mean, bool round) {
        const double m11 = std::max(p[0], 1e-7);
        const double m22 = round ? m11 : std::max(p[1], 1e-7);
        const glm::dmat3 frame(glm::dvec3(mean.z, 0, -mean.x), glm::dvec3(0, 1, 0), mean);
        m = frame * glm::dmat3(glm::dvec3(m11, 0, 0), glm::dvec3(0, m22, 0),
                               glm::dvec3(round ? 0.0 : p[2], 0, 1));
        inverse = glm::inverse(m);
        determinant = std::abs(glm::determinant(m));
    }
    [[nodiscard]] double density(const glm::dvec3& direction) const {
        const glm::dvec3 plain = inverse * direction;
        const double length = glm::length(plain);
        const double cosine = std::max(0.0, plain.z / length);
        return cosine * std::numbers::inv_pi / (determinant * length * length * length);
    }
    [[nodiscard]] glm::dvec3 sample(double u, double v) const {
        const double sine = std::sqrt(u);
        const double phi = 2 * std::numbers::pi * v;
        return glm::normalize(
            m * glm::dvec3(sine * std::cos(phi), sine * std::sin(phi), std::sqrt(1 - u)));
    }
};

// The cubed difference, whose weight is on the peak, sampled by both densities.
double misfit(const Target& target, const Transform& fit) {
    double sum = 0;
    const auto add = [&](const glm::dvec3& direction, const LobeSample& lobe) {
        const double density = fit.density(direction);
        const double difference = std::abs(lobe.value - target.albedo * density);
        const double both = lobe.density + density;
        sum += both > 0 ? difference * difference * difference / both : 0.0;
    };
    for (const auto& direction : target.directions) {
        add(direction.to_light, direction.lobe);
    }
    eachSample(kFitSamples, [&](double u, double v) {
        const glm::dvec3 direction = fit.sample(u, v);
        add(direction, evaluate(target.lobe, target.to_eye, direction, target.alpha));
    });
    return sum;
}

// Nelder and Mead (1965).
template <class Cost>
Parameters minimize(const Parameters& start, const Cost& cost) {
    struct Corner {
        Parameters at;
        double cost;
        bool operator<(const Corner& other) const { return cost < other.cost; }
    };
    std::array<Corner, 4> simplex;
    for (size_t i = 0; i < simplex.size(); ++i) {
        Parameters at = start;
        if (i > 0) {
            at[i - 1] += i < 3 ? 0.05 * start[i - 1] + 1e-4 : 0.05;
        }
        simplex[i] = {at, cost(at)};
    }
    for (int step = 0; step < kMostSteps; ++step) {
        std::sort(simplex.begin(), simplex.end());
        const double best = simplex.front().cost;
        const double worst = simplex.back().cost;
        if (worst - best <= 1e-6 * (worst + best)) {
            break;
        }
        const auto along = [&](double t) {
            Corner corner{};
            for (size_t axis = 0; axis < 3; ++axis) {
                const double middle =
                    (simplex[0].at[axis] + simplex[1].at[axis] + simplex[2].at[axis]) / 3;
                corner.at[axis] = middle + t * (simplex[3].at[axis] - middle);
            }
            corner.cost = cost(corner.at);
            return corner;
        };
        const Corner reflected = along(-1);
        if (reflected < simplex.front()) {
            simplex.back() = std::min(reflected, along(-2));
        } else if (reflected < simplex[2]) {
            simplex.back() = reflected;
        } else if (const Corner inner = reflected.cost < worst ? along(-0.5) : along(0.5);
                   inner.cost < std::min(worst, reflected.cost)) {
            simplex.back() = inner;
        } else {
            for (size_t i = 1; i < simplex.size(); ++i) {
                for (size_t axis = 0; axis < 3; ++axis) {
                    simplex[i].at[axis] = 0.5 * (simplex[i].at[axis] + simplex[0].at[axis]);
                }
                simplex[i].cost = cost(simplex[i].at);
            }
        }
    }
    return std::min_element(simplex.begin(), simplex.end())->at;
}

Entry entryOf(const Target& target, const Transform& fit) {
    const glm::dmat3 inverse = fit.inverse / fit.inverse[1][1];
    const auto at = [&](int row, int column) { return static_cast<float>(inverse[column][row]); };
    return {.a = at(0, 0),
            .b = at(0, 2),
            .c = at(2, 0),
            .d = at(2, 2),
            .albedo = static_cast<float>(target.albedo),
            .grazing = static_cast<float>(target.grazing)};
}

} // namespace

std::vector<Entry> fit(Lobe lobe) {
    const int size = static_cast<int>(io::kLtcSize);
    const auto least = static_cast<double>(io::kLtcLeastRoughness);
    std::vector<Entry> entries(size_t{io::kLtcSize} * io::kLtcSize);
    Parameters of_row{1, 1, 0}; // head-on, where the lobe is round
    // Each begins where its neighbour ended, from the roughest on.
    for (int row = size - 1; row >= 0; --row) {
        const double roughness = least + (1 - least) * row / (size - 1);
        Parameters now = of_row;
        for (int column = 0; column < size; ++column) {
            const double x = static_cast<double>(column) / (size - 1);
            const bool round = column == 0;
            Target target(lobe, roughness, std::max(1 - x * x, kLeastCosine));
            if (round) {
                target.mean = {0, 0, 1};
            }
            now = minimize(now, [&](const Parameters& p) {
                return misfit(target, Transform(p, target.mean, round));
            });
            if (round) {
                now = of_row = {now[0], now[0], 0};
            }
            entries[static_cast<size_t>(row * size + column)] =
                entryOf(target, Transform(now, target.mean, round));
        }
    }
    return entries;
}

} // namespace froxel::area_light_table
