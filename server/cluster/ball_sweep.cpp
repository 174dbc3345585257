#include "cluster/ball_sweep.h"

#include "core/assert.h"
#include "view/ranges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace froxel::cluster {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kSmallestDepth = std::numeric_limits<double>::min();
constexpr size_t kMaxRowEdges = view::kGridYRange.max + 1U;
constexpr size_t kMaxPlanes = view::kGridZRange.max + 1U;

// Where a line through the eye touches a circle; it does so ahead of the eye if depth > 0.
struct Touch {
    double depth = 0;
    double ratio = 0; // coordinate / depth
};

struct Touches {
    Touch low;
    Touch high;
};

// The circle is at (a, z) in a plane that holds the eye.
Touches touches(double a, double z, double radius) {
    const double squared = a * a + z * z;
    const double tangent2 = squared - radius * radius;
    if (!(tangent2 > 0)) {
        return {}; // the eye is inside
    }
    const double tangent = std::sqrt(tangent2);
    const double low = z * tangent + a * radius;
    const double high = z * tangent - a * radius;
    return {{tangent * low / squared, (a * tangent - z * radius) / low},
            {tangent * high / squared, (a * tangent + z * radius) / high}};
}

// An interval that starts empty.
struct Interval {
    double low = kInfinity;
    double high = -kInfinity;
};

using RowArray = std::array<double, kMaxRowEdges>;

struct RowIntervals {
    RowArray low;
    RowArray high;
};

struct RowTouches {
    RowArray low_depth, low_ratio;
    RowArray high_depth, high_ratio;
};

} // namespace

BallSweep::Axis
BallSweep::axisOf(uint32_t image_px, uint32_t tile_px, double half, uint32_t tiles) {
    Axis axis;
    axis.end = static_cast<double>(image_px) / tile_px;
    axis.offset = axis.end / 2;
    axis.scale = axis.end / (2 * half);
    axis.tiles = tiles;
    axis.half = half;
    axis.inv_normal = 1 / std::sqrt(1 + half * half);
    return axis;
}

void BallSweep::prepare(const ClusterGrid& grid) {
    FROXEL_ASSERT(grid.size.x <= view::kGridXRange.max && grid.size.y <= view::kGridYRange.max &&
                      grid.size.z <= view::kGridZRange.max,
                  "a grid within the accepted range");
    perspective_ = grid.projection == view::Projection::kPerspective;
    grid_rows_ = grid.size.y;
    columns_ = axisOf(grid.image.width_px, grid.tile_width_px, grid.half_x, grid.usedColumns());
    rows_ = axisOf(grid.image.height_px, grid.tile_height_px, grid.half_y, grid.usedRows());
    plane_depths_.assign(grid.plane_depths_m.begin(), grid.plane_depths_m.end());
    inv_plane_depths_.assign(plane_depths_.size(), 0.0);
    for (size_t k = 1; k < plane_depths_.size(); ++k) {
        inv_plane_depths_[k] = 1 / plane_depths_[k];
    }
    row_edges_.clear();
    row_norms_.clear();
    for (uint32_t j = 0; j <= rows_.tiles; ++j) {
        const double edge = grid.rowEdge(j);
        row_edges_.push_back(edge);
        row_norms_.push_back(std::sqrt(1 + edge * edge));
    }
}

// One ball's sweep: what is shared between its slices, computed once.
struct BallSweep::PerspectiveSweep {
    const BallSweep& grid;
    const Ball& ball;
    double radius2;
    // Slices and rows that the ball may meet, inclusive.
    size_t first_slice, last_slice;
    size_t first_row, last_row;
    // Of plane first_slice + i: the disc cut out of the ball; its radius is NaN where there is
    // none.
    std::array<double, kMaxPlanes> disc2;
    std::array<double, kMaxPlanes> disc_radius;
    // Of slice first_slice + i: rows met, inclusive; first > last: none.
    std::array<uint16_t, kMaxPlanes> slice_first_row, slice_last_row;
    Touches x_touches;
    RowTouches row_touches;

    PerspectiveSweep(const BallSweep& grid_, const Ball& ball_)
        : grid(grid_), ball(ball_), radius2(ball_.radius * ball_.radius) {}

    void findSlices();
    [[nodiscard]] Interval rowsOf(size_t slice, const Touches& y_touches) const;
    [[nodiscard]] bool findRows();
    void touchRowEdges();
    // The ends of the chords where plane `k` meets the row edges.
    void cutPlane(size_t k, RowIntervals& out) const;
    // Widens the interval of the row, if it is one of the slice's, that holds (ball's y, depth).
    void include(size_t slice, double inv_depth, const Interval& x, RowIntervals& out) const;
    void emitSlice(size_t slice,
                   const RowIntervals& near_cut,
                   const RowIntervals& far_cut,
                   std::vector<Span>& out) const;

    [[nodiscard]] bool inSlice(double depth, size_t slice) const {
        return depth > 0 && depth >= grid.plane_depths_[slice] &&
               depth <= grid.plane_depths_[slice + 1];
    }
};

void BallSweep::PerspectiveSweep::findSlices() {
    const auto begin = grid.plane_depths_.begin();
    const auto end = grid.plane_depths_.end();
    const auto slice = [&](double depth) {
        const auto next = std::upper_bound(begin + 1, end - 1, depth);
        return static_cast<size_t>(next - begin) - 1;
    };
    first_slice = slice(ball.z - ball.radius);
    last_slice = slice(ball.z + ball.radius);
    for (size_t k = first_slice; k <= last_slice + 1; ++k) {
        const double away = grid.plane_depths_[k] - ball.z;
        const double squared = radius2 - away * away;
        disc2[k - first_slice] = squared;
        disc_radius[k - first_slice] = squared >= 0 ? std::sqrt(squared) : kNone;
    }
}

// The interval of y / depth that the ball spans within a slice.
Interval BallSweep::PerspectiveSweep::rowsOf(size_t slice, const Touches& y_touches) const {
    Interval y;
    for (size_t k = slice; k <= slice + 1; ++k) {
        const double half = disc_radius[k - first_slice];
        if (std::isnan(half)) {
            continue;
        }
        if (k > 0) {
            y.low = std::min(y.low, (ball.y - half) * grid.inv_plane_depths_[k]);
            y.high = std::max(y.high, (ball.y + half) * grid.inv_plane_depths_[k]);
        } else {
            y.low = ball.y - half <= 0 ? -kInfinity : y.low;
            y.high = ball.y + half >= 0 ? kInfinity : y.high;
        }
    }
    if (inSlice(y_touches.low.depth, slice)) {
        y.low = std::min(y.low, y_touches.low.ratio);
    }
    if (inSlice(y_touches.high.depth, slice)) {
        y.high = std::max(y.high, y_touches.high.ratio);
    }
    return y;
}

bool BallSweep::PerspectiveSweep::findRows() {
    const Touches y_touches = touches(ball.y, ball.z, ball.radius);
    const Axis& rows = grid.rows_;
    const double last_tile = rows.tiles - 1;
    first_row = rows.tiles;
    last_row = 0;
    for (size_t slice = first_slice; slice <= last_slice; ++slice) {
        const Interval y = rowsOf(slice, y_touches);
        const double low = rows.offset + rows.scale * y.low;
        const double high = rows.offset + rows.scale * y.high;
        const size_t i = slice - first_slice;
        if (!(low <= rows.end && high >= 0 && low <= high)) {
            slice_first_row[i] = 1;
            slice_last_row[i] = 0;
            continue;
        }
        slice_first_row[i] = static_cast<uint16_t>(std::clamp(low, 0.0, last_tile));
        slice_last_row[i] = static_cast<uint16_t>(std::clamp(high, 0.0, last_tile));
        first_row = std::min<size_t>(first_row, slice_first_row[i]);
        last_row = std::max<size_t>(last_row, slice_last_row[i]);
    }
    return first_row <= last_row;
}

// A row edge is a plane through the eye and the x axis: within it the ball is a circle around
// (x, along), and the line from the eye to where it touches has the ball's own tangent length.
void BallSweep::PerspectiveSweep::touchRowEdges() {
    const double tangent2 = ball.x * ball.x + ball.y * ball.y + ball.z * ball.z - radius2;
    const double tangent = tangent2 > 0 ? std::sqrt(tangent2) : 0.0; // 0 makes every depth 0
    for (size_t j = first_row; j <= last_row + 1; ++j) {
        const double edge = grid.row_edges_[j];
        const double norm = grid.row_norms_[j];
        const double along = (edge * ball.y + ball.z) / norm;
        const double away = (ball.y - edge * ball.z) / norm;
        const double circle2 = radius2 - away * away;
        const double circle = std::sqrt(circle2 > 0 ? circle2 : 0.0);
        const double scale = tangent / ((ball.x * ball.x + along * along) * norm);
        const double low = along * tangent + ball.x * circle;
        const double high = along * tangent - ball.x * circle;
        row_touches.low_depth[j] = circle2 >= 0 ? scale * low : 0.0;
        row_touches.low_ratio[j] = norm * (ball.x * tangent - along * circle) / low;
        row_touches.high_depth[j] = circle2 >= 0 ? scale * high : 0.0;
        row_touches.high_ratio[j] = norm * (ball.x * tangent + along * circle) / high;
    }
}

void BallSweep::PerspectiveSweep::cutPlane(size_t k, RowIntervals& out) const {
    const double disc = disc2[k - first_slice];
    if (k == 0) {
        // All edges meet in the eye's own line along x; only its point at the eye has a direction.
        const double chord2 = disc - ball.y * ball.y;
        const double half = chord2 >= 0 ? std::sqrt(chord2) : 0.0;
        const double low = chord2 >= 0 && ball.x - half <= 0 ? -kInfinity : kInfinity;
        const double high = chord2 >= 0 && ball.x + half >= 0 ? kInfinity : -kInfinity;
        std::fill(&out.low[first_row], &out.low[last_row + 1] + 1, low);
        std::fill(&out.high[first_row], &out.high[last_row + 1] + 1, high);
        return;
    }
    const double depth = grid.plane_depths_[k];
    const double inv_depth = grid.inv_plane_depths_[k];
    for (size_t j = first_row; j <= last_row + 1; ++j) {
        const double away = grid.row_edges_[j] * depth - ball.y;
        const double chord2 = disc - away * away;
        const double half = std::sqrt(chord2 > 0 ? chord2 : 0.0);
        const double low = (ball.x - half) * inv_depth;
        const double high = (ball.x + half) * inv_depth;
        out.low[j] = chord2 >= 0 ? low : kInfinity;
        out.high[j] = chord2 >= 0 ? high : -kInfinity;
    }
}

void BallSweep::PerspectiveSweep::include(size_t slice,
                                          double inv_depth,
                                          const Interval& x,
                                          RowIntervals& out) const {
    const double row = grid.rows_.offset + grid.rows_.scale * (ball.y * inv_depth);
    const size_t i = slice - first_slice;
    if (row >= slice_first_row[i] && row < slice_last_row[i] + 1.0) {
        const auto j = static_cast<size_t>(row);
        out.low[j] = std::min(out.low[j], x.low);
        out.high[j] = std::max(out.high[j], x.high);
    }
}

void BallSweep::PerspectiveSweep::emitSlice(size_t slice,
                                            const RowIntervals& near_cut,
                                            const RowIntervals& far_cut,
                                            std::vector<Span>& out) const {
    const size_t first = slice_first_row[slice - first_slice];
    const size_t last = slice_last_row[slice - first_slice];
    if (first > last) {
        return;
    }
    // What each edge holds within the slice, then what each row holds between its edges.
    // A touch at the eye itself has no direction: plane 0 stands for it.
    const double near_depth = std::max(grid.plane_depths_[slice], kSmallestDepth);
    const double far_depth = grid.plane_depths_[slice + 1];
    const RowTouches& touch = row_touches;
    RowIntervals x;
    for (size_t j = first; j <= last + 1; ++j) {
        const bool low = touch.low_depth[j] >= near_depth && touch.low_depth[j] <= far_depth;
        const bool high = touch.high_depth[j] >= near_depth && touch.high_depth[j] <= far_depth;
        const double low_touch = low ? touch.low_ratio[j] : kInfinity;
        const double high_touch = high ? touch.high_ratio[j] : -kInfinity;
        const double low_cut = std::min(near_cut.low[j], far_cut.low[j]);
        const double high_cut = std::max(near_cut.high[j], far_cut.high[j]);
        x.low[j] = std::min(low_touch, low_cut);
        x.high[j] = std::max(high_touch, high_cut);
    }
    for (size_t j = first; j <= last; ++j) {
        x.low[j] = std::min(x.low[j], x.low[j + 1]);
        x.high[j] = std::max(x.high[j], x.high[j + 1]);
    }
    if (inSlice(x_touches.low.depth, slice)) {
        include(slice, 1 / x_touches.low.depth, {x_touches.low.ratio, -kInfinity}, x);
    }
    if (inSlice(x_touches.high.depth, slice)) {
        include(slice, 1 / x_touches.high.depth, {kInfinity, x_touches.high.ratio}, x);
    }
    for (size_t k = std::max<size_t>(slice, 1); k <= slice + 1; ++k) {
        const double half = disc_radius[k - first_slice];
        if (!std::isnan(half)) {
            const double inv_depth = grid.inv_plane_depths_[k];
            include(slice, inv_depth, {(ball.x - half) * inv_depth, (ball.x + half) * inv_depth},
                    x);
        }
    }
    grid.emitRows(slice, first, last, x.low.data(), x.high.data(), out);
}

void BallSweep::emitRows(size_t slice,
                         size_t first,
                         size_t last,
                         const double* low_x,
                         const double* high_x,
                         std::vector<Span>& out) const {
    const double last_tile = columns_.tiles - 1;
    for (size_t j = first; j <= last; ++j) {
        const double low = columns_.offset + columns_.scale * low_x[j];
        const double high = columns_.offset + columns_.scale * high_x[j];
        if (low <= high && low <= columns_.end && high >= 0) {
            // Clamped before the conversion: these may be infinite.
            out.emplace_back(
                static_cast<uint32_t>(slice * grid_rows_ + j),
                static_cast<uint32_t>(static_cast<int>(std::clamp(low, 0.0, last_tile))),
                static_cast<uint32_t>(static_cast<int>(std::clamp(high, 0.0, last_tile))));
        }
    }
}

bool BallSweep::outsidePicture(const Ball& ball) const {
    const double x = std::abs(ball.x) - columns_.half * ball.z;
    const double y = std::abs(ball.y) - rows_.half * ball.z;
    return x * columns_.inv_normal > ball.radius || y * rows_.inv_normal > ball.radius;
}

void BallSweep::sweepPerspective(const Ball& ball, std::vector<Span>& out) const {
    if (outsidePicture(ball)) {
        return;
    }
    PerspectiveSweep sweep(*this, ball);
    sweep.findSlices();
    if (!sweep.findRows()) {
        return;
    }
    sweep.touchRowEdges();
    sweep.x_touches = touches(ball.x, ball.z, ball.radius);
    std::array<RowIntervals, 2> cuts;
    sweep.cutPlane(sweep.first_slice, cuts[sweep.first_slice % 2]);
    for (size_t slice = sweep.first_slice; slice <= sweep.last_slice; ++slice) {
        sweep.cutPlane(slice + 1, cuts[(slice + 1) % 2]);
        sweep.emitSlice(slice, cuts[slice % 2], cuts[(slice + 1) % 2], out);
    }
}

// Cells are boxes: the chord at the point of the row and slice nearest to the centre is widest.
void BallSweep::sweepOrthographic(const Ball& ball, std::vector<Span>& out) const {
    const double radius2 = ball.radius * ball.radius;
    RowIntervals x;
    for (size_t slice = 0; slice + 1 < plane_depths_.size(); ++slice) {
        const double z =
            ball.z - std::clamp(ball.z, plane_depths_[slice], plane_depths_[slice + 1]);
        if (std::abs(z) > ball.radius) {
            continue;
        }
        for (size_t j = 0; j < rows_.tiles; ++j) {
            const double y = ball.y - std::clamp(ball.y, row_edges_[j], row_edges_[j + 1]);
            const double chord2 = radius2 - y * y - z * z;
            const double half = chord2 >= 0 ? std::sqrt(chord2) : -kInfinity;
            x.low[j] = ball.x - half;
            x.high[j] = ball.x + half;
        }
        emitRows(slice, 0, rows_.tiles - 1, x.low.data(), x.high.data(), out);
    }
}

void BallSweep::sweep(const Ball& ball, std::vector<Span>& out) const {
    if (!(ball.z + ball.radius >= 0 && ball.z - ball.radius <= plane_depths_.back())) {
        return;
    }
    if (perspective_) {
        sweepPerspective(ball, out);
    } else {
        sweepOrthographic(ball, out);
    }
}

} // namespace froxel::cluster
