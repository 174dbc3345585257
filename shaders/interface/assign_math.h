// The arithmetic of light assignment, compiled as C++ and as GLSL: where a ball meets the rows and
// columns of a slice. Host and device must find the same clusters to the last bit, so every formula
// stands here once, in double, with nothing but + - * / sqrt and comparisons, each rounded by
// itself. Before including it GLSL defines assignDivide() and assignSqrt(), correctly rounded.
#ifndef FROXEL_INTERFACE_ASSIGN_MATH_H
#define FROXEL_INTERFACE_ASSIGN_MATH_H

#include "compat.h"

#ifdef __cplusplus
#include <algorithm>
#include <cmath>
#define FROXEL_FUNCTION inline
#define FROXEL_PRECISE
#else
#define FROXEL_FUNCTION
#define FROXEL_PRECISE precise
#endif

FROXEL_IO_NAMESPACE_BEGIN

// kAssignFar: beyond any coordinate. Not infinity: shader compilers may assume that there is none.
// kAssignNearest: the least depth that is ahead of the eye.
// kAssignSlack: fp32 shading may find a point this share (of radius and of distance to the eye)
// nearer to a light than it is.
#ifdef __cplusplus
inline constexpr double kAssignFar = 1e300;
inline constexpr double kAssignNearest = 2.2250738585072014e-308;
inline constexpr double kAssignSlack = 1e-6;

inline double assignDivide(double a, double b) { return a / b; }
inline double assignSqrt(double a) { return std::sqrt(a); }
using std::abs;
using std::max;
using std::min;
#else
const double kAssignFar = 1e300LF;
const double kAssignNearest = 2.2250738585072014e-308LF;
const double kAssignSlack = 1e-6LF;
#endif

// In the axes of cluster::Cell: x right, y down, z the depth ahead of the eye. Finite.
struct Ball {
    double x;
    double y;
    double z;
    double radius;
};

// Starts empty: low = kAssignFar, high = -kAssignFar.
struct Interval {
    double low;
    double high;
};

// A picture axis: tile = offset + scale * coordinate; tiles run over [0, end], the last one
// possibly partial.
struct PictureAxis {
    double offset;
    double scale;
    double end;
    double low_edge; // the picture's, as tangents
    double high_edge;
    double inv_low_normal; // 1 / sqrt(1 + low_edge^2): of the normal of the plane through the eye
    double inv_high_normal;
    double last_tile; // tiles - 1
};

FROXEL_FUNCTION double dilatedRadius(Ball ball) {
    FROXEL_PRECISE double distance =
        assignSqrt(ball.x * ball.x + ball.y * ball.y + ball.z * ball.z);
    FROXEL_PRECISE double radius = ball.radius + kAssignSlack * (2.0 * ball.radius + distance);
    return radius;
}

FROXEL_FUNCTION bool outsidePicture(Ball ball, PictureAxis columns, PictureAxis rows) {
    FROXEL_PRECISE double left = (columns.low_edge * ball.z - ball.x) * columns.inv_low_normal;
    FROXEL_PRECISE double right = (ball.x - columns.high_edge * ball.z) * columns.inv_high_normal;
    FROXEL_PRECISE double above = (rows.low_edge * ball.z - ball.y) * rows.inv_low_normal;
    FROXEL_PRECISE double below = (ball.y - rows.high_edge * ball.z) * rows.inv_high_normal;
    return max(max(left, right), max(above, below)) > ball.radius;
}

// Where lines through the eye touch a circle; one does so ahead of the eye if its depth > 0.
struct Touches {
    double low_depth;
    double low_ratio; // coordinate / depth
    double high_depth;
    double high_ratio;
};

// The circle is at (a, z) in a plane that holds the eye. Depths of 0: the eye is inside.
FROXEL_FUNCTION Touches touchCircle(double a, double z, double radius) {
    FROXEL_PRECISE double squared = a * a + z * z;
    FROXEL_PRECISE double tangent2 = squared - radius * radius;
    FROXEL_PRECISE double tangent = assignSqrt(tangent2 > 0.0 ? tangent2 : 0.0);
    FROXEL_PRECISE double low = z * tangent + a * radius;
    FROXEL_PRECISE double high = z * tangent - a * radius;
    FROXEL_PRECISE double low_depth = assignDivide(tangent * low, squared);
    FROXEL_PRECISE double low_ratio = assignDivide(a * tangent - z * radius, low);
    FROXEL_PRECISE double high_depth = assignDivide(tangent * high, squared);
    FROXEL_PRECISE double high_ratio = assignDivide(a * tangent + z * radius, high);
    Touches t;
    t.low_depth = tangent2 > 0.0 ? low_depth : 0.0;
    t.low_ratio = low_ratio;
    t.high_depth = tangent2 > 0.0 ? high_depth : 0.0;
    t.high_ratio = high_ratio;
    return t;
}

// The ball's tangent length from the eye; 0 if the eye is inside, which makes every touch's depth
// 0.
FROXEL_FUNCTION double ballTangent(Ball ball) {
    FROXEL_PRECISE double tangent2 =
        ball.x * ball.x + ball.y * ball.y + ball.z * ball.z - ball.radius * ball.radius;
    return tangent2 > 0.0 ? assignSqrt(tangent2) : 0.0;
}

// A row edge is a plane through the eye and the x axis: within it the ball is a circle around
// (x, along), and the line from the eye to where it touches has the ball's own tangent length.
// norm: sqrt(1 + edge^2).
FROXEL_FUNCTION Touches touchRowEdge(Ball ball, double tangent, double edge, double norm) {
    FROXEL_PRECISE double along = assignDivide(edge * ball.y + ball.z, norm);
    FROXEL_PRECISE double away = assignDivide(ball.y - edge * ball.z, norm);
    FROXEL_PRECISE double circle2 = ball.radius * ball.radius - away * away;
    FROXEL_PRECISE double circle = assignSqrt(circle2 > 0.0 ? circle2 : 0.0);
    FROXEL_PRECISE double scale = assignDivide(tangent, (ball.x * ball.x + along * along) * norm);
    FROXEL_PRECISE double low = along * tangent + ball.x * circle;
    FROXEL_PRECISE double high = along * tangent - ball.x * circle;
    FROXEL_PRECISE double low_depth = scale * low;
    FROXEL_PRECISE double low_ratio = assignDivide(norm * (ball.x * tangent - along * circle), low);
    FROXEL_PRECISE double high_depth = scale * high;
    FROXEL_PRECISE double high_ratio =
        assignDivide(norm * (ball.x * tangent + along * circle), high);
    Touches t;
    t.low_depth = circle2 >= 0.0 ? low_depth : 0.0;
    t.low_ratio = low_ratio;
    t.high_depth = circle2 >= 0.0 ? high_depth : 0.0;
    t.high_ratio = high_ratio;
    return t;
}

// The squared radius of the disc that a plane at `depth` cuts out of the ball; negative: none.
FROXEL_FUNCTION double discOfPlane(Ball ball, double depth) {
    FROXEL_PRECISE double away = depth - ball.z;
    FROXEL_PRECISE double disc2 = ball.radius * ball.radius - away * away;
    return disc2;
}

// coordinate / depth over a circle of the plane (depth > 0) around `centre`; half2: its squared
// radius.
FROXEL_FUNCTION Interval cutInterval(double centre, double half2, double inv_depth) {
    FROXEL_PRECISE double half_width = assignSqrt(half2 > 0.0 ? half2 : 0.0);
    FROXEL_PRECISE double low = (centre - half_width) * inv_depth;
    FROXEL_PRECISE double high = (centre + half_width) * inv_depth;
    Interval i;
    i.low = half2 >= 0.0 ? low : kAssignFar;
    i.high = half2 >= 0.0 ? high : -kAssignFar;
    return i;
}

// The same in the plane of the eye, where a point has a side but no ratio.
FROXEL_FUNCTION Interval eyeInterval(double centre, double half2) {
    FROXEL_PRECISE double half_width = assignSqrt(half2 > 0.0 ? half2 : 0.0);
    FROXEL_PRECISE double low = centre - half_width;
    FROXEL_PRECISE double high = centre + half_width;
    Interval i;
    i.low = half2 >= 0.0 && low <= 0.0 ? -kAssignFar : kAssignFar;
    i.high = half2 >= 0.0 && high >= 0.0 ? kAssignFar : -kAssignFar;
    return i;
}

FROXEL_FUNCTION Interval joined(Interval a, Interval b) {
    Interval i;
    i.low = min(a.low, b.low);
    i.high = max(a.high, b.high);
    return i;
}

// What a plane between slices (depth 0: of the eye) cuts out of the ball, by coordinate / depth.
FROXEL_FUNCTION Interval planeInterval(double centre, double half2, double depth,
                                       double inv_depth) {
    Interval at_eye = eyeInterval(centre, half2);
    Interval ahead = cutInterval(centre, half2, inv_depth);
    Interval i;
    i.low = depth > 0.0 ? ahead.low : at_eye.low;
    i.high = depth > 0.0 ? ahead.high : at_eye.high;
    return i;
}

// A touch at the eye itself has no direction: the plane of the eye stands for it, and a slice that
// reaches the eye has kAssignNearest for its near depth here.
FROXEL_FUNCTION bool touchedWithin(double depth, double near_depth, double far_depth) {
    return depth >= near_depth && depth <= far_depth;
}

// `cut`, and the touches between two planes.
FROXEL_FUNCTION Interval touchedInterval(Touches t, double near_depth, double far_depth,
                                         Interval cut) {
    bool low = touchedWithin(t.low_depth, near_depth, far_depth);
    bool high = touchedWithin(t.high_depth, near_depth, far_depth);
    Interval i;
    i.low = min(low ? t.low_ratio : kAssignFar, cut.low);
    i.high = max(high ? t.high_ratio : -kAssignFar, cut.high);
    return i;
}

// The squared half chord where the plane at `depth`, of disc disc2, meets a row edge.
FROXEL_FUNCTION double chordOfEdge(Ball ball, double disc2, double depth, double edge) {
    FROXEL_PRECISE double away = edge * depth - ball.y;
    FROXEL_PRECISE double chord2 = disc2 - away * away;
    return chord2;
}

// Where along an axis a coordinate lies, in tiles.
FROXEL_FUNCTION double tileAt(PictureAxis axis, double coordinate) {
    FROXEL_PRECISE double tile = axis.offset + axis.scale * coordinate;
    return tile;
}

// Orthographic cells are boxes. How far the centre is from the nearest of [low, high], signed.
FROXEL_FUNCTION double boxOffset(double centre, double low, double high) {
    FROXEL_PRECISE double offset = centre - min(max(centre, low), high);
    return offset;
}

// How far the ball spans to either side of its centre's x within a row of a slice: its chord at the
// point nearest to the centre is widest. Negative: it misses them.
FROXEL_FUNCTION double boxChord(Ball ball, double plane0, double plane1, double edge0,
                                double edge1) {
    FROXEL_PRECISE double z = boxOffset(ball.z, plane0, plane1);
    FROXEL_PRECISE double y = boxOffset(ball.y, edge0, edge1);
    FROXEL_PRECISE double chord2 = ball.radius * ball.radius - y * y - z * z;
    FROXEL_PRECISE double half_width = assignSqrt(chord2 > 0.0 ? chord2 : 0.0);
    return abs(z) <= ball.radius && chord2 >= 0.0 ? half_width : -kAssignFar;
}

FROXEL_IO_NAMESPACE_END

#endif
