#include "path/camera_path.h"

#include "core/assert.h"
#include "core/text.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace froxel::path {
namespace {

Error wrong(const std::string& what) {
    return {ErrorCode::kInvalidArgument, what};
}

// With its ends' slopes a cubic's way from x = 0 to 1, where it is 0 and `end`.
double hermite(double x, double slope_0, double slope_1, double end) {
    return x *
           (slope_0 + x * (3 * end - 2 * slope_0 - slope_1 + x * (slope_0 + slope_1 - 2 * end)));
}

// Where a path ends, or rests, it goes on as if it were mirrored.
glm::dvec3 mirrored(const glm::dvec3& end, const glm::dvec3& before) {
    return end + (end - before);
}

// What is nearer has no length in doubles.
bool apart(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::distance(a, b) > 0;
}

} // namespace

Result<void> check(const PathKeys& path) {
    const auto& keys = path.keys;
    if (keys.empty() || keys.size() > kMaxKeys) {
        return wrong("keys has " + numberText(keys.size()) + "; it must have 1 to " +
                     numberText(kMaxKeys));
    }
    if (!(keys.front().at_s >= 0)) {
        return wrong("keys[0].at_s is " + numberText(keys.front().at_s) +
                     "; it must be at least 0");
    }
    for (size_t i = 1; i < keys.size(); ++i) {
        const std::string name = "keys[" + numberText(i) + "]";
        if (!(keys[i].at_s - keys[i - 1].at_s >= kLeastStep_s)) {
            return wrong(name + ".at_s is " + numberText(keys[i].at_s) + "; it must be more than " +
                         numberText(keys[i - 1].at_s) +
                         ", that of the key before it, by a microsecond or more");
        }
        if (path.constant_speed && keys[i].camera.eye_world == keys[i - 1].camera.eye_world) {
            return wrong(name + ".eye is that of the key before it; with constant_speed each key "
                                "must be somewhere else");
        }
    }
    const double last_s = keys.back().at_s;
    const bool fits = path.loop && keys.size() > 1 ? path.seconds - last_s >= kLeastStep_s
                                                   : path.seconds >= last_s;
    if (!fits || !(path.seconds >= 0)) {
        return wrong("seconds is " + numberText(path.seconds) + "; it must be " +
                     (path.loop ? "more than " : "at least ") + numberText(last_s) +
                     ", the time of the last key");
    }
    if (path.constant_speed && path.loop &&
        keys.front().camera.eye_world == keys.back().camera.eye_world) {
        return wrong("the last key is where the first one is; a loop goes there by itself");
    }
    return {};
}

CameraPath::Segment CameraPath::segmentOf(const std::array<glm::dvec3, 4>& points) {
    const auto& [before, begin, end, after] = points;
    Segment segment;
    segment.terms = {begin};
    if (!apart(begin, end)) {
        return segment;
    }
    // Knots are the square roots of the distances apart; the slopes are of u.
    const double k0 = std::sqrt(glm::distance(before, begin));
    const double k1 = std::sqrt(glm::distance(begin, end));
    const double k2 = std::sqrt(glm::distance(end, after));
    const glm::dvec3 way = end - begin;
    const glm::dvec3 slope_0 = k1 * ((begin - before) / k0 - (end - before) / (k0 + k1) + way / k1);
    const glm::dvec3 slope_1 = k1 * (way / k1 - (after - begin) / (k1 + k2) + (after - end) / k2);
    segment.terms = {begin, slope_0, 3.0 * way - 2.0 * slope_0 - slope_1,
                     slope_0 + slope_1 - 2.0 * way};
    constexpr double kStep = 1 / double{kSteps};
    for (size_t step = 0; step < kSteps; ++step) {
        const double u = static_cast<double>(step) * kStep;
        const double simpson =
            segment.speedAt(u) + 4 * segment.speedAt(u + kStep / 2) + segment.speedAt(u + kStep);
        segment.lengths_m[step + 1] = segment.lengths_m[step] + simpson * kStep / 6;
    }
    return segment;
}

glm::dvec3 CameraPath::Segment::at(double u) const {
    return terms[0] + u * (terms[1] + u * (terms[2] + u * terms[3]));
}

double CameraPath::Segment::speedAt(double u) const {
    return glm::length(terms[1] + u * (2.0 * terms[2] + u * 3.0 * terms[3]));
}

double CameraPath::Segment::placeOf(double length_m) const {
    if (length() == 0) {
        return 0;
    }
    const auto* const next = std::upper_bound(lengths_m.begin() + 1, lengths_m.end() - 1, length_m);
    const auto step = static_cast<size_t>(next - lengths_m.begin()) - 1;
    const double part_m = lengths_m[step + 1] - lengths_m[step];
    const double u = static_cast<double>(step) / double{kSteps};
    constexpr double kStep = 1 / double{kSteps};
    const double x = part_m > 0 ? std::clamp((length_m - lengths_m[step]) / part_m, 0.0, 1.0) : 0;
    // Where the eye all but stops, no steeper than a cubic that does not turn back.
    const auto slope = [&](double at) { return std::min(3 * kStep, part_m / speedAt(at)); };
    return u + std::clamp(hermite(x, slope(u), slope(u + kStep), kStep), 0.0, kStep);
}

CameraPath::CameraPath(PathKeys keys) : keys_(std::move(keys)) {
    FROXEL_ASSERT(check(keys_), "keys that make a path");
    const size_t count = keys_.keys.size();
    const bool round = keys_.loop && count > 1;
    const size_t segments = round ? count : count - 1;
    ways_m_.push_back(0);
    for (size_t i = 0; i < segments; ++i) {
        const auto eye = [this](size_t index) { return key(index).camera.eye_world; };
        const glm::dvec3 begin = eye(i);
        const glm::dvec3 end = eye(i + 1);
        const bool has_before = (round || i > 0) && apart(eye(i + count - 1), begin);
        const bool has_after = (round || i + 2 < count) && apart(eye(i + 2), end);
        segments_.push_back(segmentOf({has_before ? eye(i + count - 1) : mirrored(begin, end),
                                       begin, end, has_after ? eye(i + 2) : mirrored(end, begin)}));
        ways_m_.push_back(ways_m_.back() + segments_.back().length());
    }
    // Steffen's slopes: of the parabola through three neighbours, but never so steep that a cubic
    // turns back; at the ends of a path that does not go round, of the segment beside it.
    const auto slope = [this](size_t segment) {
        return segments_[segment].length() / (timeOf(segment + 1) - timeOf(segment));
    };
    for (size_t i = 0; i <= segments && segments > 0; ++i) {
        const bool at_end = i == 0 || i == segments;
        if (at_end && !round) {
            speeds_m_s_.push_back(slope(i == 0 ? 0 : segments - 1));
            continue;
        }
        const size_t before = at_end ? segments - 1 : i - 1;
        const size_t after = at_end ? 0 : i;
        const double dt_before = timeOf(before + 1) - timeOf(before);
        const double dt_after = timeOf(after + 1) - timeOf(after);
        const double s0 = slope(before);
        const double s1 = slope(after);
        const double parabola = (s0 * dt_after + s1 * dt_before) / (dt_before + dt_after);
        speeds_m_s_.push_back(std::min({parabola, 2 * s0, 2 * s1}));
    }
}

double CameraPath::timeOf(size_t index) const {
    return index < keys_.keys.size() ? keys_.keys[index].at_s
                                     : keys_.seconds + keys_.keys.front().at_s;
}

double CameraPath::wayAt(double time_s) const {
    size_t i = 0;
    while (i + 1 < segments_.size() && time_s >= timeOf(i + 1)) {
        ++i;
    }
    const double dt = timeOf(i + 1) - timeOf(i);
    const double x = std::clamp((time_s - timeOf(i)) / dt, 0.0, 1.0);
    const double way = segments_[i].length();
    const double since = hermite(x, speeds_m_s_[i] * dt, speeds_m_s_[i + 1] * dt, way);
    return ways_m_[i] + std::clamp(since, 0.0, way);
}

settings::Camera CameraPath::between(size_t segment, double u, double way_share) const {
    const settings::Camera& a = key(segment).camera;
    const settings::Camera& b = key(segment + 1).camera;
    settings::Camera camera = a;
    camera.eye_world = segments_[segment].at(u);
    const glm::dquat turned =
        glm::slerp(glm::normalize(glm::quat_cast(a.world_from_view)),
                   glm::normalize(glm::quat_cast(b.world_from_view)), way_share);
    camera.world_from_view = glm::mat3_cast(glm::normalize(turned));
    camera.yfov_rad = glm::mix(a.yfov_rad, b.yfov_rad, way_share);
    camera.focus_m = glm::mix(a.focus_m, b.focus_m, way_share);
    camera.near_m = std::min(a.near_m, b.near_m);
    return camera;
}

settings::Camera CameraPath::at(double time_s) const {
    if (segments_.empty()) {
        return keys_.keys.front().camera;
    }
    const bool even = keys_.constant_speed;
    const double first_s = timeOf(0);
    if (keys_.loop) {
        const double since = std::fmod(time_s - first_s, keys_.seconds);
        time_s = first_s + (since < 0 ? since + keys_.seconds : since);
    } else {
        time_s = even ? std::clamp(time_s, 0.0, keys_.seconds)
                      : std::clamp(time_s, first_s, timeOf(segments_.size()));
    }
    const double even_s = keys_.loop ? time_s - first_s : time_s;
    const double way = even ? ways_m_.back() * even_s / keys_.seconds : wayAt(time_s);
    size_t i = 0;
    while (i + 1 < segments_.size() && (even ? way >= ways_m_[i + 1] : time_s >= timeOf(i + 1))) {
        ++i;
    }
    const double length = segments_[i].length();
    const double along = std::clamp(way - ways_m_[i], 0.0, length);
    const double way_share =
        length > 0 ? along / length : (time_s - timeOf(i)) / (timeOf(i + 1) - timeOf(i));
    return between(i, segments_[i].placeOf(along), way_share);
}

} // namespace froxel::path
