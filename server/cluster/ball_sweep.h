// Finds the clusters that a ball meets, exactly.
//
// On one row of one slice the cells met are consecutive: they cover the interval of x / depth that
// the ball spans within that row and slice. Both ends of the interval are found without iteration.
// x / depth has no maximum inside a ball, so it is reached on the ball's surface, in one of four
// places: where a plane through the eye touches the ball (free), touches the circle cut by a plane
// between two slices, touches the circle cut by a plane between two rows, or at the end of the
// chord where those two planes meet. Each place is a closed formula; those within the row and slice
// are compared. Slice 0 reaches the eye, where x / depth may be infinite. The formulas are in
// interface/assign_math.h, which the device's assignment shares.
#pragma once

#include "cluster/cluster_grid.h"
#include "cluster/span.h"
#include "interface/assign_math.h"

#include <cstdint>
#include <vector>

namespace froxel::cluster {

using Ball = io::Ball; // in the axes of Cell

// prepare() once a frame; then any number of threads may sweep at once.
class BallSweep {
  public:
    void prepare(const ClusterGrid& grid);
    // Appends one Span for each row of each slice that the ball meets; slices and rows ascend.
    // Returns how many rows of slices it looked at.
    size_t sweep(const Ball& ball, std::vector<Span>& out) const;

    // What it prepared, for the device's assignment.
    [[nodiscard]] const io::PictureAxis& columns() const { return columns_; }
    [[nodiscard]] const io::PictureAxis& rows() const { return rows_; }
    [[nodiscard]] const std::vector<double>& planeDepths() const { return plane_depths_; }
    [[nodiscard]] const std::vector<double>& inversePlaneDepths() const {
        return inv_plane_depths_;
    }
    [[nodiscard]] const std::vector<double>& rowEdges() const { return row_edges_; }
    [[nodiscard]] const std::vector<double>& rowNorms() const { return row_norms_; }

  private:
    struct PerspectiveSweep;

    size_t sweepPerspective(const Ball& ball, std::vector<Span>& out) const;
    size_t sweepOrthographic(const Ball& ball, std::vector<Span>& out) const;
    // Turns the x intervals of rows [first, last] into spans.
    void emitRows(size_t slice,
                  size_t first,
                  size_t last,
                  const double* low_x,
                  const double* high_x,
                  std::vector<Span>& out) const;
    [[nodiscard]] double nearDepth(size_t slice) const {
        return slice > 0 ? plane_depths_[slice] : io::kAssignNearest;
    }

    bool perspective_ = true;
    uint32_t grid_rows_ = 1;
    io::PictureAxis columns_{};
    io::PictureAxis rows_{};
    uint32_t used_rows_ = 1;
    std::vector<double> plane_depths_;     // slices + 1
    std::vector<double> inv_plane_depths_; // of them; 0 for the eye
    std::vector<double> row_edges_;        // used rows + 1
    std::vector<double> row_norms_;        // sqrt(1 + edge^2)
};

} // namespace froxel::cluster
