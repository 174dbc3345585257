// Finds the clusters that a ball meets, exactly.
//
// On one row of one slice the cells met are consecutive: they cover the interval of x / depth that
// the ball spans within that row and slice. Both ends of the interval are found without iteration.
// x / depth has no maximum inside a ball, so it is reached on the ball's surface, in one of four
// places: where a plane through the eye touches the ball (free), touches the circle cut by a plane
// between two slices, touches the circle cut by a plane between two rows, or at the end of the
// chord where those two planes meet. Each place is a closed formula; those within the row and slice
// are compared. Slice 0 reaches the eye, where x / depth may be infinite.
#pragma once

#include "cluster/cluster_grid.h"
#include "cluster/span.h"

#include <cstdint>
#include <vector>

namespace froxel::cluster {

// In the axes of Cell: x right, y down, z the depth ahead of the eye. Finite.
struct Ball {
    double x, y, z;
    double radius;
};

// prepare() once a frame; then any number of threads may sweep at once.
class BallSweep {
  public:
    void prepare(const ClusterGrid& grid);
    // Appends one Span for each row of each slice that the ball meets; slices and rows ascend.
    void sweep(const Ball& ball, std::vector<Span>& out) const;

  private:
    struct PerspectiveSweep;

    void sweepPerspective(const Ball& ball, std::vector<Span>& out) const;
    void sweepOrthographic(const Ball& ball, std::vector<Span>& out) const;
    // Turns the x intervals of rows [first, last] into spans.
    void emitRows(size_t slice,
                  size_t first,
                  size_t last,
                  const double* low_x,
                  const double* high_x,
                  std::vector<Span>& out) const;
    [[nodiscard]] bool outsidePicture(const Ball& ball) const;

    // A picture axis: tile = offset + scale * coordinate; tiles run over [0, end], the last one
    // possibly partial.
    struct Axis {
        double offset = 0;
        double scale = 1;
        double end = 1;
        uint32_t tiles = 1;
        double half = 1;
        double inv_normal = 1; // 1 / length of the picture edge's plane normal (half, 1)
    };
    static Axis axisOf(uint32_t image_px, uint32_t tile_px, double half, uint32_t tiles);

    bool perspective_ = true;
    uint32_t grid_rows_ = 1;
    Axis columns_;
    Axis rows_;
    std::vector<double> plane_depths_;     // slices + 1
    std::vector<double> inv_plane_depths_; // of them; 0 for the eye
    std::vector<double> row_edges_;        // used rows + 1
    std::vector<double> row_norms_;        // sqrt(1 + edge^2)
};

} // namespace froxel::cluster
