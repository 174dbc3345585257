// A camera that moves through key frames. Pure; any thread.
//
// The eye follows a centripetal Catmull-Rom spline (Yuksel, Schaefer and Keyser, "Parameterization
// and applications of Catmull-Rom curves", CAD 43(7), 2011), which has no cusps and no loops within
// a segment. How far it is along it is a smooth function of time: monotone cubics through the keys'
// times (Steffen, "A simple method for monotonic interpolation in one dimension", A&A 239, 1990),
// or a constant speed. Directions turn by the shortest way (slerp), field of view and focus change
// in proportion to the way between two keys.
#pragma once

#include "core/error.h"
#include "settings/camera.h"

#include <array>
#include <cstddef>
#include <vector>

namespace froxel::path {

struct Key {
    double at_s = 0;
    settings::Camera camera; // in perspective
};

struct PathKeys {
    std::vector<Key> keys;
    double seconds = 0;          // of all; at least the last key's time
    bool constant_speed = false; // of the eye; the keys' times count for nothing
    bool loop = false;           // goes on to the first key, where it is after `seconds`
};

inline constexpr size_t kMaxKeys = 1000;
inline constexpr double kLeastStep_s = 1e-6; // from one key to the next

// What is wrong with keys that no file was read for; none: they make a path. kInvalidArgument: no
// key, or more than kMaxKeys; times that do not grow by kLeastStep_s, begin before 0 or end after
// `seconds`; a loop without time for the way back; a constant speed where two neighbours are at one
// place.
[[nodiscard]] Result<void> check(const PathKeys& keys);

class CameraPath {
  public:
    // Of keys that check() accepts (FROXEL_ASSERT).
    explicit CameraPath(PathKeys keys);

    [[nodiscard]] double seconds() const { return keys_.seconds; }
    [[nodiscard]] const PathKeys& keys() const { return keys_; }
    // Before the first key's time, and after the last one's, the camera rests there, but a loop
    // goes round.
    [[nodiscard]] settings::Camera at(double time_s) const;

  private:
    static constexpr size_t kSteps = 64; // of a segment's length

    struct Segment {
        std::array<glm::dvec3, 4> terms;            // of 1, u, u^2 and u^3, u from 0 to 1
        std::array<double, kSteps + 1> lengths_m{}; // from its begin, at even steps of u
        [[nodiscard]] double length() const { return lengths_m.back(); }
        [[nodiscard]] glm::dvec3 at(double u) const;
        [[nodiscard]] double speedAt(double u) const;        // metres for each u
        [[nodiscard]] double placeOf(double length_m) const; // u
    };
    // Between the second and the third of these points.
    [[nodiscard]] static Segment segmentOf(const std::array<glm::dvec3, 4>& points);
    [[nodiscard]] const Key& key(size_t index) const {
        return keys_.keys[index % keys_.keys.size()];
    }
    [[nodiscard]] double timeOf(size_t index) const; // of a key, and of a loop's end
    [[nodiscard]] double wayAt(double time_s) const; // metres since the first key
    [[nodiscard]] settings::Camera between(size_t segment, double u, double way_share) const;

    PathKeys keys_;
    std::vector<Segment> segments_;
    std::vector<double> ways_m_;     // from the first key to each, and to a loop's end
    std::vector<double> speeds_m_s_; // there
};

} // namespace froxel::path
