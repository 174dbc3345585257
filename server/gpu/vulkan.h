// The one place that includes Vulkan; precompiled for gpu and render.
#pragma once

#include <vulkan/vulkan_raii.hpp>
