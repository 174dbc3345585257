#include "motion/sample.h"

#include "core/math.h"

#include <algorithm>
#include <cmath>

namespace froxel::motion {

namespace {

using Values = std::span<const float>;

// What a key holds, in the order of a spline's.
enum Part : size_t { kInTangent, kValue, kOutTangent };

Values partOf(const scene::Track& track, size_t key, Part part) {
    const size_t width = track.width;
    const bool spline = track.interpolation == scene::Interpolation::kCubicSpline;
    return Values(track.values).subspan((spline ? key * 3 + part : key) * width, width);
}

glm::dvec4 unit(const glm::dvec4& quaternion) {
    const double length = glm::length(quaternion);
    return length > 0 ? quaternion / length : glm::dvec4(0, 0, 0, 1);
}

glm::dvec4 quaternionOf(Values values) {
    return {values[0], values[1], values[2], values[3]};
}

// The angle by two lengths: acos would lose half of the digits near 0.
glm::dvec4 slerp(const glm::dvec4& from, const glm::dvec4& end, double t) {
    const glm::dvec4 to = glm::dot(from, end) < 0 ? -end : end;
    const double angle = 2 * std::atan2(glm::length(from - to), glm::length(from + to));
    if (!(std::sin(angle) > 0)) {
        return from;
    }
    return unit((std::sin(angle * (1 - t)) * from + std::sin(angle * t) * to) / std::sin(angle));
}

void copyOf(Values values, std::span<double> out) {
    std::copy(values.begin(), values.end(), out.begin());
}

void spline(const scene::Track& track, size_t key, double span_s, double t, std::span<double> out) {
    const Values value = partOf(track, key, kValue);
    const Values leaving = partOf(track, key, kOutTangent);
    const Values next = partOf(track, key + 1, kValue);
    const Values arriving = partOf(track, key + 1, kInTangent);
    const double t2 = t * t;
    const double t3 = t2 * t;
    for (size_t i = 0; i < out.size(); ++i) {
        out[i] = (2 * t3 - 3 * t2 + 1) * value[i] + span_s * (t3 - 2 * t2 + t) * leaving[i] +
                 (3 * t2 - 2 * t3) * next[i] + span_s * (t3 - t2) * arriving[i];
    }
}

void line(const scene::Track& track, size_t key, double t, bool rotations, std::span<double> out) {
    const Values from = partOf(track, key, kValue);
    const Values to = partOf(track, key + 1, kValue);
    if (rotations) {
        const glm::dvec4 turned = slerp(unit(quaternionOf(from)), unit(quaternionOf(to)), t);
        std::copy(&turned.x, &turned.x + 4, out.begin());
        return;
    }
    for (size_t i = 0; i < out.size(); ++i) {
        out[i] = (1 - t) * from[i] + t * to[i];
    }
}

// Between two keys: key is not the last, and the next one's time is later.
void between(
    const scene::Track& track, size_t key, double time_s, bool rotations, std::span<double> out) {
    const double start_s = track.times_s[key];
    const double span_s = track.times_s[key + 1] - start_s;
    const double t = (time_s - start_s) / span_s;
    switch (track.interpolation) {
    case scene::Interpolation::kStep:
        return copyOf(partOf(track, key, kValue), out);
    case scene::Interpolation::kLinear:
        return line(track, key, t, rotations, out);
    case scene::Interpolation::kCubicSpline:
        return spline(track, key, span_s, t, out);
    }
}

} // namespace

void sample(const scene::Track& track, double time_s, bool rotations, std::span<double> out) {
    const auto& times = track.times_s;
    const auto later =
        std::upper_bound(times.begin(), times.end(), time_s,
                         [](double time, float key) { return time < static_cast<double>(key); });
    const auto passed = static_cast<size_t>(later - times.begin());
    const size_t key = passed == 0 ? 0 : passed - 1;
    const bool exact = passed == 0 || passed == times.size() || times[key] == time_s;
    if (exact) {
        copyOf(partOf(track, key, kValue), out);
    } else {
        between(track, key, time_s, rotations, out);
    }
    if (rotations) {
        const glm::dvec4 turned = unit({out[0], out[1], out[2], out[3]});
        std::copy(&turned.x, &turned.x + 4, out.begin());
    }
}

} // namespace froxel::motion
