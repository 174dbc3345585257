#include "app/info_command.h"

#include "app/device_summary.h"
#include "app/info_report.h"
#include "app/scene_source.h"
#include "gpu/device.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <string>

namespace froxel::app {

namespace {

using Json = nlohmann::ordered_json;

// Those that the renderer reads, or that bound what it can draw.
Json limitsOf(const gpu::Device& device) {
    const auto& limits = device.limits();
    return {{"max_picture_side_px", limits.maxImageDimension2D},
            {"max_storage_buffer_bytes", limits.maxStorageBufferRange},
            {"max_uniform_buffer_bytes", limits.maxUniformBufferRange},
            {"max_color_attachments", limits.maxColorAttachments},
            {"max_compute_invocations", limits.maxComputeWorkGroupInvocations},
            {"max_anisotropy", limits.maxSamplerAnisotropy},
            {"max_memory_allocations", limits.maxMemoryAllocationCount},
            {"storage_alignment_bytes", limits.minStorageBufferOffsetAlignment},
            {"uniform_alignment_bytes", limits.minUniformBufferOffsetAlignment},
            {"buffer_image_granularity_bytes", limits.bufferImageGranularity},
            {"timestamp_period_ns", limits.timestampPeriod}};
}

} // namespace

void runInfo(const InfoOptions& options) {
    Json report;
    if (!options.scene.empty()) {
        report["scene"] = sceneReport(loadScene(options.scene).value());
    }
    const gpu::Device device(options.device);
    report["device"] = toJson(summarize(device.traits()));
    report["limits"] = limitsOf(device);
    const std::string text = options.json ? report.dump(2) + "\n" : toText(report);
    std::fputs(text.c_str(), stdout);
}

} // namespace froxel::app
