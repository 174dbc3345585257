#include "app/info_command.h"

#include "app/environment_file.h"
#include "app/exit_codes.h"
#include "app/info_report.h"
#include "app/output_file.h"
#include "app/scene_camera.h"
#include "app/scene_source.h"
#include "app/scene_table.h"
#include "app/serve_command.h"
#include "bake/isolation.h"
#include "core/text.h"
#include "gltf/image_decode.h"
#include "gpu/device.h"
#include "net/facts.h"
#include "render/view/renderer.h"
#include "report/device_summary.h"
#include "report/frame_report.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cstdio>
#include <fstream>
#include <span>
#include <string>
#include <string_view>
#include <utility>

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
            {"max_sampled_descriptors", limits.maxPerStageDescriptorSampledImages},
            {"max_anisotropy", limits.maxSamplerAnisotropy},
            {"max_memory_allocations", limits.maxMemoryAllocationCount},
            {"storage_alignment_bytes", limits.minStorageBufferOffsetAlignment},
            {"uniform_alignment_bytes", limits.minUniformBufferOffsetAlignment},
            {"buffer_image_granularity_bytes", limits.bufferImageGranularity},
            {"timestamp_period_ns", limits.timestampPeriod}};
}

// What proxies and manifests must agree with.
Json serviceReport() {
    const ServeOptions defaults;
    return {
        {"port", defaults.port},
        {"admin_port", defaults.admin.port},
        {"socket_path", net::kSocketPath},
        {"room_socket_path", net::kRoomSocketPath},
        {"metrics_path", net::kMetricsPath},
        {"live_path", net::kLivePath},
        {"ready_path", net::kReadyPath},
        {"started_path", net::kStartedPath},
        {"drain_path", net::kDrainPath},
        {"drain_seconds", defaults.drain_s},
        {"max_sessions", defaults.sessions_max},
        {"session_memory_mib", {{"cpu", kCpuSessionMemory_mib}, {"gpu", kGpuSessionMemory_mib}}},
        {"host_memory_share", kHostMemoryShare},
        {"idle_timeout_seconds", net::kIdleTimeout.count()},
        {"agones_counter", net::kAgonesCounter},
        {"agones_health_seconds", net::kAgonesHealthPeriod.count()},
        {"exit_code_device_lost", kExitDeviceLost}};
}

// One frame with default settings from the scene's first camera: what the automatic choices are
// there, what is left out and where memory goes is best told by doing it.
Json drawOnce(gpu::Device& device, const scene::Scene& scene) {
    settings::ViewSettings settings;
    settings.camera = findCamera(DefaultCamera{}, scene, settings.size).value();
    render::Renderer renderer(device, scene);
    render::ViewRenderer viewer(renderer);
    viewer.submit({.settings = settings}).value();
    const auto frame = viewer.collect();
    Json drawn = report::frameReport(frame.value().stats);
    drawn["size_px"] = {settings.size.width_px, settings.size.height_px};
    return drawn;
}

// What a file is that is a picture and no scene; null: it is none.
Json pictureReport(const std::string& file) {
    std::array<char, 64> first{};
    std::ifstream(file, std::ios::binary).read(first.data(), first.size());
    const std::string_view type = gltf::imageType(std::as_bytes(std::span(first)));
    if (type.empty()) {
        return nullptr;
    }
    const std::string bytes = readText(file).value();
    try {
        const auto size = gltf::imageSize(std::as_bytes(std::span(bytes)), "'" + file + "'");
        return {{"type", type}, {"width_px", size.width_px}, {"height_px", size.height_px}};
    } catch (const std::exception& failure) {
        throw StartupError({ErrorCode::kScene, printable(failure.what(), 300)});
    }
}

// Names are as their files have them; what of them is no UTF-8 is replaced.
std::string textOf(const Json& json) {
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace

void runInfo(const InfoOptions& options) try {
    if (!options.scenes.empty()) {
        const Json rows = scenesReport(options.scenes, options.sandbox);
        std::fputs((options.json ? textOf(rows) : sceneTable(rows)).c_str(), stdout);
        return;
    }
    Json info;
    if (Json picture = pictureReport(options.scene); !picture.is_null()) {
        info["picture"] = std::move(picture);
        std::fputs((options.json ? textOf(info) : toText(info)).c_str(), stdout);
        return;
    }
    gpu::Device device(options.device);
    if (!options.scene.empty()) {
        const auto scene = loadScene(options.scene, {}, workOn, readingBy(options.sandbox)).value();
        info["scene"] = sceneReport(scene);
        info["frame"] = drawOnce(device, scene);
    }
    if (!options.environment_file.empty()) {
        info["environment"] = environmentReport(readPanorama(options.environment_file).value());
    }
    info["device"] = report::toJson(report::summarize(device.traits()));
    info["limits"] = limitsOf(device);
    const bake::Isolation isolation = bake::isolationHere();
    info["scene_readers"] = {{"landlock", isolation.landlock}, {"seccomp", isolation.seccomp}};
    info["service"] = serviceReport();
    const std::string text = options.json ? textOf(info) : toText(info);
    std::fputs(text.c_str(), stdout);
} catch (const vk::SystemError& error) {
    throw StartupError({ErrorCode::kDevice, std::string("Vulkan: ") + error.what()});
}

} // namespace froxel::app
