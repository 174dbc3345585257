// Of sums over workgroups (lib/group_scan.glsl).
#ifndef FROXEL_INTERFACE_SCAN_IO_H
#define FROXEL_INTERFACE_SCAN_IO_H

#include "compat.h"

FROXEL_IO_NAMESPACE_BEGIN

FROXEL_CONST uint kScanSaturated = 0x7fffffffU; // no sum becomes larger

FROXEL_IO_NAMESPACE_END

#endif
