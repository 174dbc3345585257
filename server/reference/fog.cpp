#include "reference/fog.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace froxel::reference {
namespace {

constexpr double kFarthest_m = 1e9; // stands for infinity

double squared(double x) {
    return x * x;
}

// Integral of the density over heights from the base height on, over that at the base.
double columnTo(double height_m, double falloff) {
    if (height_m <= 0 || falloff == 0) {
        return height_m;
    }
    return -std::expm1(-falloff * height_m) / falloff;
}

// Where a polynomial's integral from -1 to 1 is taken, and how much each place weighs.
struct Place {
    double x;
    double weight;
};

// Gauss-Legendre: the roots of the polynomial of that order, by Newton's method.
std::array<Place, Medium::kPoints> gaussLegendre() {
    constexpr int kOrder = Medium::kPoints;
    std::array<Place, kOrder> rule{};
    for (int i = 0; i < kOrder; ++i) {
        double x = std::cos(std::numbers::pi * (i + 0.75) / (kOrder + 0.5));
        double slope = 0;
        for (int step = 0; step < 20; ++step) {
            double before = 1;
            double value = x;
            for (int k = 2; k <= kOrder; ++k) {
                before = std::exchange(value, ((2 * k - 1) * x * value - (k - 1) * before) / k);
            }
            slope = kOrder * (x * value - before) / (x * x - 1);
            x -= value / slope;
        }
        rule[static_cast<size_t>(i)] = {x, 2 / ((1 - x * x) * slope * slope)};
    }
    return rule;
}

const std::array<Place, Medium::kPoints> kRule = gaussLegendre();

} // namespace

double phase(double anisotropy, double cosine) {
    const double g = anisotropy;
    return (1 - g * g) / (4 * std::numbers::pi * std::pow(1 + g * g - 2 * g * cosine, 1.5));
}

Medium::Medium(const settings::Fog& fog,
               const settings::Camera& camera,
               const Lights& lights,
               const Open& open)
    : fog_(fog), lights_(lights), open_(open), density_(static_cast<double>(fog.density)),
      falloff_(static_cast<double>(fog.height_falloff)),
      eye_height_m_(camera.eye_world.y - fog.base_height_m) {}

double Medium::densityAt(const glm::dvec3& point) const {
    return density_ * std::exp(-falloff_ * std::max(0.0, eye_height_m_ + point.y));
}

double Medium::opticalDepth(const glm::dvec3& from, const glm::dvec3& to) const {
    const double length_m = glm::distance(from, to);
    const double rise_m = to.y - from.y;
    if (std::abs(rise_m) < 1e-9 * length_m || length_m == 0) {
        return length_m * densityAt((from + to) * 0.5);
    }
    const double column =
        columnTo(eye_height_m_ + to.y, falloff_) - columnTo(eye_height_m_ + from.y, falloff_);
    return density_ * length_m * column / rise_m;
}

double Medium::fromRectangle(const PointLight& light,
                             const glm::dvec3& point,
                             const glm::dvec3& away) const {
    double sum = 0;
    light.eachPart(point, [&](const glm::dvec3& part, double share) {
        const glm::dvec3 to_point = point - part;
        const double d = glm::length(to_point);
        const double facing = std::max(0.0, glm::dot(light.direction, to_point) / d);
        const double cosine = -glm::dot(to_point, away) / d;
        sum += share * facing * phase(static_cast<double>(fog_.anisotropy), cosine) / (d * d);
    });
    return sum;
}

glm::dvec3 Medium::scattered(const PointLight& light, const Ray& ray, double length_m) const {
    const glm::dvec3 away = glm::normalize(ray.direction);
    const glm::dvec3 to_light = light.position - ray.origin;
    const double along = glm::dot(to_light, away);
    const double beside = glm::length(glm::cross(to_light, away));
    const double half = std::sqrt(std::max(0.0, light.radius2 - squared(beside)));
    const double first = std::max(-along, -half);
    const double last = std::min(length_m - along, half);
    if (!(first < last)) {
        return glm::dvec3(0);
    }
    // t = scale tan(angle) past the place nearest to the light.
    const double scale = std::max(beside, light.nearest_m);
    const double from = std::atan2(first, scale);
    const double half_angle = (std::atan2(last, scale) - from) / 2;
    double sum = 0;
    for (const auto& [place, weight] : kRule) {
        const double t = scale * std::tan(from + (1 + place) * half_angle);
        const double d2 = squared(beside) + t * t;
        const double d = std::sqrt(std::max(d2, 1e-30));
        const glm::dvec3 point = ray.origin + away * (along + t);
        const double passes = light.shadowed && open_ ? open_(point, light.position) : 1;
        if (passes == 0) {
            continue;
        }
        const double window = squared(std::max(0.0, 1 - squared(d2 / light.radius2)));
        const double towards = glm::dot(light.direction, point - light.position) / d;
        const double cone =
            squared(std::clamp(towards * light.cone_scale + light.cone_offset, 0.0, 1.0));
        double reached = phase(static_cast<double>(fog_.anisotropy), -t / d) /
                         std::max(d2, squared(light.nearest_m));
        if (light.rectangle) {
            reached = fromRectangle(light, point, away);
        }
        const double lost = opticalDepth(ray.origin, point) + opticalDepth(point, light.position);
        const double spread_m = (squared(scale) + t * t) / scale * half_angle * weight;
        sum += passes * densityAt(point) * std::exp(-lost) * window * cone * reached * spread_m;
    }
    return light.color * sum;
}

glm::dvec3 Medium::seenThrough(const glm::dvec3& radiance, const Ray& ray, double distance) const {
    if (density_ == 0) {
        return radiance;
    }
    const glm::dvec3 end = ray.origin + ray.direction * std::min(distance, kFarthest_m);
    const glm::dvec3 away = glm::normalize(ray.direction);
    const double length_m = glm::distance(ray.origin, end);
    const double depth = opticalDepth(ray.origin, end);
    const auto g = static_cast<double>(fog_.anisotropy);
    glm::dvec3 source = (lights_.sky + lights_.ground) * 0.5;
    for (const auto& sun : lights_.directionals) {
        source += sun.color * phase(g, -glm::dot(sun.direction, away));
    }
    glm::dvec3 scattered_sum = source * -std::expm1(-depth);
    for (const auto& light : lights_.points) {
        scattered_sum += scattered(light, ray, length_m);
    }
    return radiance * std::exp(-depth) + glm::dvec3(fog_.albedo) * scattered_sum;
}

} // namespace froxel::reference
