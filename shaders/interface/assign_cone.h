// Cutting a spot's cone out of cells, shared by host and device: as assign_math.h, one formula
// each.
#ifndef FROXEL_INTERFACE_ASSIGN_CONE_H
#define FROXEL_INTERFACE_ASSIGN_CONE_H

#include "assign_math.h"

FROXEL_IO_NAMESPACE_BEGIN

#ifdef __cplusplus
using dvec3 = glm::dvec3;
#endif

// In the axes of cluster::Cell.
struct Cone {
    dvec3 apex;
    dvec3 axis; // unit
    double cos_half;
    double sin_half;
    double range; // kAssignFar: no limit
};

// cluster::Cell. Perspective: x and y are tangents, which depth scales.
struct ConeCell {
    double x0;
    double x1;
    double y0;
    double y1;
    double z0;
    double z1;
    bool perspective;
};

FROXEL_CONST int kConeRounds = 3;

FROXEL_FUNCTION double coneDot(dvec3 a, dvec3 b) {
    FROXEL_PRECISE double sum = a.x * b.x + a.y * b.y + a.z * b.z;
    return sum;
}

FROXEL_FUNCTION double coneLength(dvec3 a) { return assignSqrt(coneDot(a, a)); }

FROXEL_FUNCTION dvec3 coneScaled(dvec3 a, double scale) {
    FROXEL_PRECISE dvec3 scaled = a * scale;
    return scaled;
}

FROXEL_FUNCTION dvec3 coneLess(dvec3 a, dvec3 b) {
    FROXEL_PRECISE dvec3 difference = a - b;
    return difference;
}

// The corner of a cell that lies least along a direction; y and x vary on their own at one depth.
FROXEL_FUNCTION dvec3 leastCorner(ConeCell cell, dvec3 along) {
    double x = along.x > 0.0 ? cell.x0 : cell.x1;
    double y = along.y > 0.0 ? cell.y0 : cell.y1;
    FROXEL_PRECISE double per_depth = along.x * x + along.y * y + along.z;
    double slope = cell.perspective ? per_depth : along.z;
    double z = slope > 0.0 ? cell.z0 : cell.z1;
    FROXEL_PRECISE double wide_x = x * z;
    FROXEL_PRECISE double wide_y = y * z;
    return dvec3(cell.perspective ? wide_x : x, cell.perspective ? wide_y : y, z);
}

FROXEL_FUNCTION dvec3 cellMiddle(ConeCell cell) {
    FROXEL_PRECISE double z = (cell.z0 + cell.z1) * 0.5;
    double scale = cell.perspective ? z : 1.0;
    FROXEL_PRECISE double x = (cell.x0 + cell.x1) * 0.5 * scale;
    FROXEL_PRECISE double y = (cell.y0 + cell.y1) * 0.5 * scale;
    return dvec3(x, y, z);
}

// How far rounding may move what is compared, in metres.
FROXEL_FUNCTION double coneSlack(Cone cone, ConeCell cell) {
    double x = max(abs(cell.x0), abs(cell.x1));
    double y = max(abs(cell.y0), abs(cell.y1));
    FROXEL_PRECISE double wide = cell.z1 * coneLength(dvec3(x, y, 1.0));
    FROXEL_PRECISE double box = cell.z1 + x + y;
    double reach = cell.perspective ? wide : box;
    FROXEL_PRECISE double slack = kAssignSlack * (reach + coneLength(cone.apex));
    return slack;
}

// Looks for a plane with the cone on one side and the cell on the other, one that touches the cone:
// first on the side of the cell's middle, then on that of the corner which crossed it.
FROXEL_FUNCTION bool sideMisses(Cone cone, ConeCell cell, double slack) {
    dvec3 toward = coneLess(cellMiddle(cell), cone.apex);
    for (int i = 0; i < kConeRounds; ++i) {
        double along = coneDot(toward, cone.axis);
        dvec3 aside = coneLess(toward, coneScaled(cone.axis, along));
        double away = coneLength(aside);
        FROXEL_PRECISE double across = away * cone.cos_half;
        FROXEL_PRECISE double inside = along * cone.sin_half;
        if (!(across > inside) || !(away > 0.0)) {
            return false; // this point is within the cone
        }
        dvec3 normal = coneLess(coneScaled(aside, assignDivide(cone.cos_half, away)),
                                coneScaled(cone.axis, cone.sin_half));
        toward = coneLess(leastCorner(cell, normal), cone.apex);
        if (coneDot(toward, normal) > slack) {
            return true;
        }
    }
    return false;
}

// The same with planes that touch the ball of the cone's range.
FROXEL_FUNCTION bool capMisses(Cone cone, ConeCell cell, double slack) {
    dvec3 toward = coneLess(cellMiddle(cell), cone.apex);
    for (int i = 0; i < kConeRounds; ++i) {
        double away = coneLength(toward);
        if (!(away > cone.range)) {
            return false;
        }
        dvec3 normal = dvec3(assignDivide(toward.x, away), assignDivide(toward.y, away),
                             assignDivide(toward.z, away));
        toward = coneLess(leastCorner(cell, normal), cone.apex);
        FROXEL_PRECISE double limit = cone.range + slack;
        if (coneDot(toward, normal) > limit) {
            return true;
        }
    }
    return false;
}

// Whether the spot cannot light a point within the cell. False is not proof that it does.
FROXEL_FUNCTION bool coneMisses(Cone cone, ConeCell cell) {
    double slack = coneSlack(cone, cell);
    return sideMisses(cone, cell, slack) || capMisses(cone, cell, slack);
}

FROXEL_IO_NAMESPACE_END

#endif
