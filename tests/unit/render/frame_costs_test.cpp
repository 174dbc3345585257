#include "render/frame_costs.h"
#include <gtest/gtest.h>
