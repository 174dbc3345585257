// What a debug view stores of a fragment, in the radiance target.
layout(location = 0) out vec4 stored;

#ifdef FROXEL_INSTANCE
#include "interface/debug_io.h"
layout(push_constant, scalar) uniform InstanceBlock { InstanceDraw instance_draw; };

vec4 fragmentValue() { return vec4(float(instance_draw.number)); } // exact below 2^24
#else
vec4 fragmentValue() { return vec4(1.0); } // they are added up
#endif
