#include "cluster/ball_sweep.h"

#include "core/assert.h"
#include "settings/ranges.h"

#include <algorithm>
#include <array>
#include <cmath>

// A second copy of a function, and of all it calls, for CPUs with AVX2: a fifth off the time of
// assignment. Nothing contracts or reorders, so both find the same to the last bit. The choice at
// load time runs too early for sanitizers.
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define FROXEL_WIDE_CLONES [[gnu::flatten, gnu::target_clones("avx2", "default")]]
#else
#define FROXEL_WIDE_CLONES
#endif

namespace froxel::cluster {
namespace {

constexpr size_t kMaxRowEdges = settings::kGridYRange.max + 1U;
constexpr size_t kMaxPlanes = settings::kGridZRange.max + 1U;

using io::Interval;
using io::Touches;

using RowArray = std::array<double, kMaxRowEdges>;

struct RowIntervals {
    RowArray low;
    RowArray high;
};

struct RowTouches {
    RowArray low_depth, low_ratio;
    RowArray high_depth, high_ratio;
};

io::PictureAxis
axisOf(uint32_t image_px, uint32_t tile_px, double half, double middle, uint32_t tiles) {
    io::PictureAxis axis{};
    axis.end = static_cast<double>(image_px) / tile_px;
    axis.scale = axis.end / (2 * half);
    axis.offset = axis.end / 2 - axis.scale * middle;
    axis.last_tile = tiles - 1.0;
    axis.low_edge = middle - half;
    axis.high_edge = middle + half;
    axis.inv_low_normal = 1 / std::sqrt(1 + axis.low_edge * axis.low_edge);
    axis.inv_high_normal = 1 / std::sqrt(1 + axis.high_edge * axis.high_edge);
    return axis;
}

} // namespace

void BallSweep::prepare(const ClusterGrid& grid) {
    FROXEL_ASSERT(grid.size.x <= settings::kGridXRange.max &&
                      grid.size.y <= settings::kGridYRange.max &&
                      grid.size.z <= settings::kGridZRange.max,
                  "a grid within the accepted range");
    perspective_ = grid.projection == settings::Projection::kPerspective;
    grid_rows_ = grid.size.y;
    columns_ = axisOf(grid.image.width_px, grid.tile_width_px, grid.half_x, grid.middle_x,
                      grid.usedColumns());
    rows_ = axisOf(grid.image.height_px, grid.tile_height_px, grid.half_y, grid.middle_y,
                   grid.usedRows());
    used_rows_ = grid.usedRows();
    plane_depths_.assign(grid.plane_depths_m.begin(), grid.plane_depths_m.end());
    inv_plane_depths_.assign(plane_depths_.size(), 0.0);
    for (size_t k = 1; k < plane_depths_.size(); ++k) {
        inv_plane_depths_[k] = 1 / plane_depths_[k];
    }
    row_edges_.clear();
    row_norms_.clear();
    for (uint32_t j = 0; j <= used_rows_; ++j) {
        const double edge = grid.rowEdge(j);
        row_edges_.push_back(edge);
        row_norms_.push_back(std::sqrt(1 + edge * edge));
    }
}

// One ball's sweep: what is shared between its slices, computed once.
struct BallSweep::PerspectiveSweep {
    const BallSweep& grid;
    const Ball& ball;
    // Slices and rows that the ball may meet, inclusive.
    size_t first_slice, last_slice;
    size_t first_row, last_row;
    std::array<double, kMaxPlanes> disc2; // of plane first_slice + i: discOfPlane
    // Of slice first_slice + i: rows met, inclusive; first > last: none.
    std::array<uint16_t, kMaxPlanes> slice_first_row, slice_last_row;
    Touches x_touches;
    RowTouches row_touches;

    PerspectiveSweep(const BallSweep& grid_, const Ball& ball_) : grid(grid_), ball(ball_) {}

    void findSlices();
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
        return io::touchedWithin(depth, grid.nearDepth(slice), grid.plane_depths_[slice + 1]);
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
        disc2[k - first_slice] = io::discOfPlane(ball, grid.plane_depths_[k]);
    }
}

bool BallSweep::PerspectiveSweep::findRows() {
    const Touches y_touches = io::touchCircle(ball.y, ball.z, ball.radius);
    const io::PictureAxis& rows = grid.rows_;
    const auto cut = [&](size_t k) {
        return io::planeInterval(ball.y, disc2[k - first_slice], grid.plane_depths_[k],
                                 grid.inv_plane_depths_[k]);
    };
    first_row = grid.used_rows_;
    last_row = 0;
    Interval near_cut = cut(first_slice);
    for (size_t slice = first_slice; slice <= last_slice; ++slice) {
        const Interval far_cut = cut(slice + 1);
        const Interval y =
            io::touchedInterval(y_touches, grid.nearDepth(slice), grid.plane_depths_[slice + 1],
                                io::joined(near_cut, far_cut));
        near_cut = far_cut;
        const double low = io::tileAt(rows, y.low);
        const double high = io::tileAt(rows, y.high);
        const size_t i = slice - first_slice;
        if (!(low <= rows.end && high >= 0 && low <= high)) {
            slice_first_row[i] = 1;
            slice_last_row[i] = 0;
            continue;
        }
        slice_first_row[i] = static_cast<uint16_t>(std::clamp(low, 0.0, rows.last_tile));
        slice_last_row[i] = static_cast<uint16_t>(std::clamp(high, 0.0, rows.last_tile));
        first_row = std::min<size_t>(first_row, slice_first_row[i]);
        last_row = std::max<size_t>(last_row, slice_last_row[i]);
    }
    return first_row <= last_row;
}

void BallSweep::PerspectiveSweep::touchRowEdges() {
    const double tangent = io::ballTangent(ball);
    for (size_t j = first_row; j <= last_row + 1; ++j) {
        const Touches t = io::touchRowEdge(ball, tangent, grid.row_edges_[j], grid.row_norms_[j]);
        row_touches.low_depth[j] = t.low_depth;
        row_touches.low_ratio[j] = t.low_ratio;
        row_touches.high_depth[j] = t.high_depth;
        row_touches.high_ratio[j] = t.high_ratio;
    }
}

void BallSweep::PerspectiveSweep::cutPlane(size_t k, RowIntervals& out) const {
    const double disc = disc2[k - first_slice];
    const double depth = grid.plane_depths_[k];
    const double inv_depth = grid.inv_plane_depths_[k];
    if (k == 0) {
        // All edges meet in the eye's own line along x; only its point at the eye has a direction.
        const Interval x = io::eyeInterval(ball.x, io::chordOfEdge(ball, disc, 0, 0));
        std::fill(&out.low[first_row], &out.low[last_row + 1] + 1, x.low);
        std::fill(&out.high[first_row], &out.high[last_row + 1] + 1, x.high);
        return;
    }
    for (size_t j = first_row; j <= last_row + 1; ++j) {
        const double chord2 = io::chordOfEdge(ball, disc, depth, grid.row_edges_[j]);
        const Interval x = io::cutInterval(ball.x, chord2, inv_depth);
        out.low[j] = x.low;
        out.high[j] = x.high;
    }
}

void BallSweep::PerspectiveSweep::include(size_t slice,
                                          double inv_depth,
                                          const Interval& x,
                                          RowIntervals& out) const {
    const double row = io::tileAt(grid.rows_, ball.y * inv_depth);
    const size_t i = slice - first_slice;
    // The last row may end with the picture, before its tile does.
    if (row >= slice_first_row[i] && row < slice_last_row[i] + 1.0 && row <= grid.rows_.end) {
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
    const double near_depth = grid.nearDepth(slice);
    const double far_depth = grid.plane_depths_[slice + 1];
    const RowTouches& touch = row_touches;
    RowIntervals x;
    for (size_t j = first; j <= last + 1; ++j) {
        const Touches t{touch.low_depth[j], touch.low_ratio[j], touch.high_depth[j],
                        touch.high_ratio[j]};
        const Interval cut =
            io::joined({near_cut.low[j], near_cut.high[j]}, {far_cut.low[j], far_cut.high[j]});
        const Interval held = io::touchedInterval(t, near_depth, far_depth, cut);
        x.low[j] = held.low;
        x.high[j] = held.high;
    }
    for (size_t j = first; j <= last; ++j) {
        x.low[j] = std::min(x.low[j], x.low[j + 1]);
        x.high[j] = std::max(x.high[j], x.high[j + 1]);
    }
    if (inSlice(x_touches.low_depth, slice)) {
        include(slice, 1 / x_touches.low_depth, {x_touches.low_ratio, -io::kAssignFar}, x);
    }
    if (inSlice(x_touches.high_depth, slice)) {
        include(slice, 1 / x_touches.high_depth, {io::kAssignFar, x_touches.high_ratio}, x);
    }
    for (size_t k = std::max<size_t>(slice, 1); k <= slice + 1; ++k) {
        const double inv_depth = grid.inv_plane_depths_[k];
        include(slice, inv_depth, io::cutInterval(ball.x, disc2[k - first_slice], inv_depth), x);
    }
    grid.emitRows(slice, first, last, x.low.data(), x.high.data(), out);
}

void BallSweep::emitRows(size_t slice,
                         size_t first,
                         size_t last,
                         const double* low_x,
                         const double* high_x,
                         std::vector<Span>& out) const {
    const double last_tile = columns_.last_tile;
    for (size_t j = first; j <= last; ++j) {
        const double low = io::tileAt(columns_, low_x[j]);
        const double high = io::tileAt(columns_, high_x[j]);
        if (low <= high && low <= columns_.end && high >= 0) {
            // Clamped before the conversion: these may be beyond any integer.
            out.emplace_back(
                static_cast<uint32_t>(slice * grid_rows_ + j),
                static_cast<uint32_t>(static_cast<int>(std::clamp(low, 0.0, last_tile))),
                static_cast<uint32_t>(static_cast<int>(std::clamp(high, 0.0, last_tile))));
        }
    }
}

FROXEL_WIDE_CLONES
size_t BallSweep::sweepPerspective(const Ball& ball, std::vector<Span>& out) const {
    if (io::outsidePicture(ball, columns_, rows_)) {
        return 0;
    }
    PerspectiveSweep sweep(*this, ball);
    sweep.findSlices();
    const size_t slices = sweep.last_slice - sweep.first_slice + 1;
    if (!sweep.findRows()) {
        return slices;
    }
    sweep.touchRowEdges();
    sweep.x_touches = io::touchCircle(ball.x, ball.z, ball.radius);
    std::array<RowIntervals, 2> cuts;
    sweep.cutPlane(sweep.first_slice, cuts[sweep.first_slice % 2]);
    for (size_t slice = sweep.first_slice; slice <= sweep.last_slice; ++slice) {
        sweep.cutPlane(slice + 1, cuts[(slice + 1) % 2]);
        sweep.emitSlice(slice, cuts[slice % 2], cuts[(slice + 1) % 2], out);
    }
    return slices * (sweep.last_row - sweep.first_row + 2);
}

size_t BallSweep::sweepOrthographic(const Ball& ball, std::vector<Span>& out) const {
    RowIntervals x;
    size_t looked_at = plane_depths_.size();
    for (size_t slice = 0; slice + 1 < plane_depths_.size(); ++slice) {
        const double near_depth = plane_depths_[slice];
        const double far_depth = plane_depths_[slice + 1];
        if (std::abs(io::boxOffset(ball.z, near_depth, far_depth)) > ball.radius) {
            continue;
        }
        looked_at += used_rows_;
        for (size_t j = 0; j < used_rows_; ++j) {
            const double half =
                io::boxChord(ball, near_depth, far_depth, row_edges_[j], row_edges_[j + 1]);
            x.low[j] = ball.x - half;
            x.high[j] = ball.x + half;
        }
        emitRows(slice, 0, used_rows_ - 1, x.low.data(), x.high.data(), out);
    }
    return looked_at;
}

size_t BallSweep::sweep(const Ball& ball, std::vector<Span>& out) const {
    if (!(ball.z + ball.radius >= 0 && ball.z - ball.radius <= plane_depths_.back())) {
        return 0;
    }
    return perspective_ ? sweepPerspective(ball, out) : sweepOrthographic(ball, out);
}

} // namespace froxel::cluster
