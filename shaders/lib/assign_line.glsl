// Which columns of a line (a row of a slice) a ball meets: cluster::BallSweep, one line at a time,
// by the same operations.

// First past last: none.
struct Columns {
    int first;
    int last;
};

const Columns kNoColumns = Columns(1, 0);

bool meetsAxis(double low, double high, double end) {
    return low <= high && low <= end && high >= 0.0;
}

int tileClamped(double tile, double last_tile) { return int(min(max(tile, 0.0), last_tile)); }

Columns columnsWithin(Interval x) {
    double low = tileAt(frame.columns, x.low);
    double high = tileAt(frame.columns, x.high);
    if (!meetsAxis(low, high, frame.columns.end)) {
        return kNoColumns;
    }
    return Columns(tileClamped(low, frame.columns.last_tile),
                   tileClamped(high, frame.columns.last_tile));
}

double nearDepth(uint slice) { return slice > 0u ? planeDepth(slice) : kAssignNearest; }

// y / depth over the ball between planes k0 and k1.
Interval rowsBetween(Ball ball, Touches y_touches, uint k0, uint k1) {
    double z0 = planeDepth(k0);
    double z1 = planeDepth(k1);
    Interval near_cut = planeInterval(ball.y, discOfPlane(ball, z0), z0, planeInverse(k0));
    Interval far_cut = planeInterval(ball.y, discOfPlane(ball, z1), z1, planeInverse(k1));
    return touchedInterval(y_touches, nearDepth(k0), z1, joined(near_cut, far_cut));
}

// Widens `x` if the point (ball's y, 1 / inv_depth) is in the row, which the slice's rows hold.
void widen(Ball ball, uint row, double inv_depth, Interval point, inout Interval x) {
    precise double ratio = ball.y * inv_depth;
    double tile = tileAt(frame.rows, ratio);
    // The last row may end with the picture, before its tile does.
    if (tile >= double(row) && tile < double(row) + 1.0 && tile <= frame.rows.end) {
        x = joined(x, point);
    }
}

Columns perspectiveColumns(Ball ball, uint slice, uint row) {
    Interval y = rowsBetween(ball, touchCircle(ball.y, ball.z, ball.radius), slice, slice + 1u);
    double low = tileAt(frame.rows, y.low);
    double high = tileAt(frame.rows, y.high);
    if (!meetsAxis(low, high, frame.rows.end) ||
        int(row) < tileClamped(low, frame.rows.last_tile) ||
        int(row) > tileClamped(high, frame.rows.last_tile)) {
        return kNoColumns;
    }
    double tangent = ballTangent(ball);
    double near_depth = nearDepth(slice);
    double z0 = planeDepth(slice);
    double z1 = planeDepth(slice + 1u);
    double inv0 = planeInverse(slice);
    double inv1 = planeInverse(slice + 1u);
    double disc0 = discOfPlane(ball, z0);
    double disc1 = discOfPlane(ball, z1);
    Interval x = Interval(kAssignFar, -kAssignFar);
    for (uint j = row; j <= row + 1u; ++j) {
        double edge = rowEdge(j);
        Interval near_cut = planeInterval(ball.x, chordOfEdge(ball, disc0, z0, edge), z0, inv0);
        Interval far_cut = planeInterval(ball.x, chordOfEdge(ball, disc1, z1, edge), z1, inv1);
        Touches t = touchRowEdge(ball, tangent, edge, rowNorm(j));
        x = joined(x, touchedInterval(t, near_depth, z1, joined(near_cut, far_cut)));
    }
    Touches t = touchCircle(ball.x, ball.z, ball.radius);
    if (touchedWithin(t.low_depth, near_depth, z1)) {
        widen(ball, row, assignDivide(1.0, t.low_depth), Interval(t.low_ratio, -kAssignFar), x);
    }
    if (touchedWithin(t.high_depth, near_depth, z1)) {
        widen(ball, row, assignDivide(1.0, t.high_depth), Interval(kAssignFar, t.high_ratio), x);
    }
    if (slice > 0u) {
        widen(ball, row, inv0, cutInterval(ball.x, disc0, inv0), x);
    }
    widen(ball, row, inv1, cutInterval(ball.x, disc1, inv1), x);
    return columnsWithin(x);
}

// Orthographic lines decide for themselves.
bool inSlice(LightVolume volume, uint slice) {
    Ball ball = volume.ball;
    if (volume.unlimited || frame.perspective == 0u) {
        return true;
    }
    precise double nearest = ball.z - ball.radius;
    precise double farthest = ball.z + ball.radius;
    return farthest >= 0.0 && nearest <= planeDepth(frame.grid_z) &&
           (slice + 1u == frame.grid_z || planeDepth(slice + 1u) > nearest) &&
           (slice == 0u || planeDepth(slice) <= farthest) &&
           !outsidePicture(ball, frame.columns, frame.rows);
}

Columns orthographicColumns(Ball ball, uint slice, uint row) {
    double half_width =
        boxChord(ball, planeDepth(slice), planeDepth(slice + 1u), rowEdge(row), rowEdge(row + 1u));
    precise double low = ball.x - half_width;
    precise double high = ball.x + half_width;
    return columnsWithin(Interval(low, high));
}

bool spotMisses(uint spot, uint column, uint row, uint slice) {
    return coneMisses(spots[spot].cone, ConeCell(columnEdge(column), columnEdge(column + 1u),
                                                 rowEdge(row), rowEdge(row + 1u), planeDepth(slice),
                                                 planeDepth(slice + 1u), frame.perspective != 0u));
}

Columns columnsOf(LightVolume volume, uint slice, uint row) {
    Columns columns = Columns(0, int(frame.used_columns) - 1);
    if (!volume.unlimited) {
        columns = frame.perspective != 0u ? perspectiveColumns(volume.ball, slice, row)
                                          : orthographicColumns(volume.ball, slice, row);
    }
    if (volume.cut) {
        // Spot and row are convex: it is enough to cut from both ends.
        while (columns.first <= columns.last &&
               spotMisses(volume.spot, uint(columns.first), row, slice)) {
            ++columns.first;
        }
        while (columns.last > columns.first &&
               spotMisses(volume.spot, uint(columns.last), row, slice)) {
            --columns.last;
        }
    }
    return columns;
}
