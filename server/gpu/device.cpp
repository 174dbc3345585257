#include "gpu/device.h"

#include "core/error.h"
#include "core/thread_name.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <future>
#include <optional>
#include <span>
#include <unistd.h>
#include <vector>

namespace froxel::gpu {

namespace {

// One row for each feature that the renderer stands on.
struct RequiredFeature {
    const char* name;
    bool present;
};

using Features = vk::StructureChain<vk::PhysicalDeviceFeatures2,
                                    vk::PhysicalDeviceVulkan11Features,
                                    vk::PhysicalDeviceVulkan12Features,
                                    vk::PhysicalDeviceVulkan13Features,
                                    vk::PhysicalDeviceRobustness2FeaturesEXT>;

std::vector<RequiredFeature> requiredFeatures(const Features& features) {
    const auto& core = features.get<vk::PhysicalDeviceFeatures2>().features;
    const auto& v12 = features.get<vk::PhysicalDeviceVulkan12Features>();
    const auto& v13 = features.get<vk::PhysicalDeviceVulkan13Features>();
    const auto& robustness = features.get<vk::PhysicalDeviceRobustness2FeaturesEXT>();
    return {{"independentBlend", core.independentBlend == VK_TRUE},
            {"multiDrawIndirect", core.multiDrawIndirect == VK_TRUE},
            {"drawIndirectFirstInstance", core.drawIndirectFirstInstance == VK_TRUE},
            {"samplerAnisotropy", core.samplerAnisotropy == VK_TRUE},
            {"scalarBlockLayout", v12.scalarBlockLayout == VK_TRUE},
            {"timelineSemaphore", v12.timelineSemaphore == VK_TRUE},
            {"synchronization2", v13.synchronization2 == VK_TRUE},
            {"dynamicRendering", v13.dynamicRendering == VK_TRUE},
            {"maintenance4", v13.maintenance4 == VK_TRUE},
            {"nullDescriptor", robustness.nullDescriptor == VK_TRUE}};
}

// What the visibility passes stand on; a device without them draws in other ways.
std::vector<RequiredFeature> visibilityFeatures(const Features& features) {
    const auto& core = features.get<vk::PhysicalDeviceFeatures2>().features;
    return {
        {"geometryShader (for gl_PrimitiveID)", core.geometryShader == VK_TRUE},
        {"shaderStorageImageExtendedFormats", core.shaderStorageImageExtendedFormats == VK_TRUE},
        {"shaderStorageImageWriteWithoutFormat",
         core.shaderStorageImageWriteWithoutFormat == VK_TRUE}};
}

bool hasDescriptorIndexing(const Features& features) {
    const auto& v12 = features.get<vk::PhysicalDeviceVulkan12Features>();
    return v12.descriptorIndexing == VK_TRUE && v12.runtimeDescriptorArray == VK_TRUE &&
           v12.shaderSampledImageArrayNonUniformIndexing == VK_TRUE;
}

Features queryFeatures(const vk::raii::PhysicalDevice& physical) {
    return physical
        .getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan11Features,
                      vk::PhysicalDeviceVulkan12Features, vk::PhysicalDeviceVulkan13Features,
                      vk::PhysicalDeviceRobustness2FeaturesEXT>();
}

std::optional<uint32_t> findQueueFamily(const vk::raii::PhysicalDevice& physical) {
    const auto families = physical.getQueueFamilyProperties();
    for (uint32_t i = 0; i < families.size(); ++i) {
        const auto wanted = vk::QueueFlagBits::eGraphics | vk::QueueFlagBits::eCompute;
        if ((families[i].queueFlags & wanted) == wanted && families[i].timestampValidBits == 64) {
            return i;
        }
    }
    return std::nullopt;
}

// For copies alone: what it is given runs on hardware of its own.
std::optional<uint32_t> findCopyFamily(const vk::raii::PhysicalDevice& physical) {
    const auto families = physical.getQueueFamilyProperties();
    for (uint32_t i = 0; i < families.size(); ++i) {
        const auto others = vk::QueueFlagBits::eGraphics | vk::QueueFlagBits::eCompute;
        if (families[i].queueFlags & vk::QueueFlagBits::eTransfer &&
            !(families[i].queueFlags & others)) {
            return i;
        }
    }
    return std::nullopt;
}

// Empty when the device can be used, else why not.
std::string unusable(const vk::raii::PhysicalDevice& physical) {
    if (physical.getProperties().apiVersion < VK_API_VERSION_1_3) {
        return "is older than Vulkan 1.3";
    }
    if (!findQueueFamily(physical)) {
        return "has no graphics and compute queue with 64-bit timestamps";
    }
    for (const auto& feature : requiredFeatures(queryFeatures(physical))) {
        if (!feature.present) {
            return std::string("lacks ") + feature.name;
        }
    }
    return {};
}

int rank(vk::PhysicalDeviceType type) {
    switch (type) {
    case vk::PhysicalDeviceType::eDiscreteGpu:
        return 0;
    case vk::PhysicalDeviceType::eIntegratedGpu:
        return 1;
    case vk::PhysicalDeviceType::eVirtualGpu:
        return 2;
    case vk::PhysicalDeviceType::eCpu:
        return 3;
    default:
        return 4;
    }
}

bool isCpu(const vk::raii::PhysicalDevice& physical) {
    return physical.getProperties().deviceType == vk::PhysicalDeviceType::eCpu;
}

vk::raii::PhysicalDevice choose(const vk::raii::Instance& instance, DeviceChoice choice) {
    vk::raii::PhysicalDevices all(instance);
    std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
        return rank(a.getProperties().deviceType) < rank(b.getProperties().deviceType);
    });
    std::string reasons;
    for (auto& physical : all) {
        const auto properties = physical.getProperties();
        const bool is_cpu = isCpu(physical);
        if ((choice == DeviceChoice::kGpu && is_cpu) || (choice == DeviceChoice::kCpu && !is_cpu)) {
            continue;
        }
        const std::string reason = unusable(physical);
        if (reason.empty()) {
            return std::move(physical);
        }
        reasons += std::string("; ") + properties.deviceName.data() + " " + reason;
    }
    const char* wanted = choice == DeviceChoice::kGpu
                             ? "no usable GPU (--device auto also accepts a CPU device)"
                         : choice == DeviceChoice::kCpu ? "no usable CPU device (Debian: "
                                                          "mesa-vulkan-drivers)"
                                                        : "no usable Vulkan device";
    throw StartupError({ErrorCode::kDevice, wanted + reasons});
}

bool findsCpuDevice(DeviceChoice choice) {
    if (choice != DeviceChoice::kAuto) {
        return choice == DeviceChoice::kCpu;
    }
    const Instance instance(false);
    return isCpu(choose(instance.handle(), choice));
}

DeviceTraits readTraits(const vk::raii::PhysicalDevice& physical, bool use_subgroups) {
    const auto chain =
        physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceVulkan11Properties,
                                vk::PhysicalDeviceVulkan12Properties>();
    const auto& core = chain.get<vk::PhysicalDeviceProperties2>().properties;
    const auto& v11 = chain.get<vk::PhysicalDeviceVulkan11Properties>();
    const auto& v12 = chain.get<vk::PhysicalDeviceVulkan12Properties>();
    const auto wanted = vk::SubgroupFeatureFlagBits::eVote | vk::SubgroupFeatureFlagBits::eBallot |
                        vk::SubgroupFeatureFlagBits::eArithmetic |
                        vk::SubgroupFeatureFlagBits::eShuffle;
    const bool subgroups = use_subgroups && (v11.subgroupSupportedOperations & wanted) == wanted &&
                           (v11.subgroupSupportedStages & vk::ShaderStageFlagBits::eCompute);
    DeviceTraits traits;
    traits.name = core.deviceName.data();
    traits.driver = std::string(v12.driverName.data()) + " " + v12.driverInfo.data();
    traits.api_version = core.apiVersion;
    traits.is_cpu = core.deviceType == vk::PhysicalDeviceType::eCpu;
    traits.subgroup_size = subgroups ? v11.subgroupSize : 0;
    traits.fragment_subgroups =
        subgroups && (v11.subgroupSupportedStages & vk::ShaderStageFlagBits::eFragment);
    traits.timestamp_period_ns = static_cast<double>(core.limits.timestampPeriod);
    traits.max_anisotropy = core.limits.maxSamplerAnisotropy;
    traits.most_textures =
        std::min(core.limits.maxPerStageDescriptorSampledImages, core.limits.maxPerStageResources);
    traits.most_samplers = core.limits.maxPerStageDescriptorSamplers;
    return traits;
}

// What is turned on: what all need, and what these say.
Features featuresFor(const DeviceTraits& traits) {
    Features enabled;
    auto& core = enabled.get<vk::PhysicalDeviceFeatures2>().features;
    core.setShaderFloat64(traits.float64 ? VK_TRUE : VK_FALSE);
    core.setShaderInt64(traits.int64_atomics ? VK_TRUE : VK_FALSE);
    core.setOcclusionQueryPrecise(traits.counts_samples ? VK_TRUE : VK_FALSE);
    core.setIndependentBlend(VK_TRUE)
        .setMultiDrawIndirect(VK_TRUE)
        .setDrawIndirectFirstInstance(VK_TRUE)
        .setSamplerAnisotropy(VK_TRUE);
    enabled.get<vk::PhysicalDeviceVulkan12Features>()
        .setScalarBlockLayout(VK_TRUE)
        .setTimelineSemaphore(VK_TRUE)
        .setHostQueryReset(VK_TRUE)
        .setShaderBufferInt64Atomics(traits.int64_atomics ? VK_TRUE : VK_FALSE);
    if (traits.visibility_lacks.empty()) {
        core.setGeometryShader(VK_TRUE)
            .setShaderStorageImageExtendedFormats(VK_TRUE)
            .setShaderStorageImageWriteWithoutFormat(VK_TRUE);
    }
    enabled.get<vk::PhysicalDeviceVulkan12Features>().setDrawIndirectCount(
        traits.draw_indirect_count);
    if (traits.descriptor_indexing) {
        enabled.get<vk::PhysicalDeviceVulkan12Features>()
            .setDescriptorIndexing(VK_TRUE)
            .setRuntimeDescriptorArray(VK_TRUE)
            .setShaderSampledImageArrayNonUniformIndexing(VK_TRUE);
    }
    enabled.get<vk::PhysicalDeviceVulkan13Features>()
        .setSynchronization2(VK_TRUE)
        .setDynamicRendering(VK_TRUE)
        .setMaintenance4(VK_TRUE);
    // What a frame lacks is described by nothing, rather than by a stand-in.
    enabled.get<vk::PhysicalDeviceRobustness2FeaturesEXT>().setNullDescriptor(VK_TRUE);
    return enabled;
}

} // namespace

Device::Device(const DeviceOptions& options) try : instance_(options.validation) {
    physical_ = choose(instance_.handle(), options.choice);
    queue_.family = *findQueueFamily(physical_);
    traits_ = readTraits(physical_, options.subgroups);
    limits_ = physical_.getProperties().limits;
    memory_ = physical_.getMemoryProperties();
    const Features present = queryFeatures(physical_);
    traits_.most_textures = std::min(traits_.most_textures, options.most_textures);
    traits_.descriptor_indexing = options.descriptor_indexing && hasDescriptorIndexing(present);
    for (const auto& feature : visibilityFeatures(present)) {
        if (!feature.present || !options.visibility) {
            traits_.visibility_lacks += (traits_.visibility_lacks.empty() ? "" : ", ");
            traits_.visibility_lacks += feature.name;
        }
    }

    traits_.float64 = present.get<vk::PhysicalDeviceFeatures2>().features.shaderFloat64 == VK_TRUE;
    traits_.int64_atomics =
        options.int64_atomics &&
        present.get<vk::PhysicalDeviceFeatures2>().features.shaderInt64 == VK_TRUE &&
        present.get<vk::PhysicalDeviceVulkan12Features>().shaderBufferInt64Atomics == VK_TRUE;
    traits_.counts_samples =
        present.get<vk::PhysicalDeviceFeatures2>().features.occlusionQueryPrecise == VK_TRUE;
    // lavapipe 22.3 takes the counts of such a draw for all later indirect draws.
    traits_.draw_indirect_count =
        !traits_.is_cpu &&
        present.get<vk::PhysicalDeviceVulkan12Features>().drawIndirectCount == VK_TRUE;

    const Features enabled = featuresFor(traits_);
    const std::array extensions = {VK_EXT_ROBUSTNESS_2_EXTENSION_NAME};

    const float priority = 1.0F;
    std::vector queues = {vk::DeviceQueueCreateInfo{
        .queueFamilyIndex = queue_.family, .queueCount = 1, .pQueuePriorities = &priority}};
    const auto copy_family =
        options.copy_queue == CopyQueue::kOwn ? findCopyFamily(physical_) : std::nullopt;
    if (copy_family) {
        queues.push_back(queues.front());
        queues.back().queueFamilyIndex = *copy_family;
    }
    device_ = vk::raii::Device(
        physical_,
        vk::DeviceCreateInfo{.pNext = &enabled.get<vk::PhysicalDeviceFeatures2>(),
                             .queueCreateInfoCount = static_cast<uint32_t>(queues.size()),
                             .pQueueCreateInfos = queues.data(),
                             .enabledExtensionCount = static_cast<uint32_t>(extensions.size()),
                             .ppEnabledExtensionNames = extensions.data()});
    queue_.handle = device_.getQueue(queue_.family, 0);
    if (copy_family || options.copy_queue == CopyQueue::kSame) {
        const uint32_t family = copy_family.value_or(queue_.family);
        copy_queue_ = Queue{device_.getQueue(family, 0), family};
    }
    loadPipelineCache(options.pipeline_cache);
    spdlog::info("device name=\"{}\" driver=\"{}\" kind={} subgroup={}", traits_.name,
                 traits_.driver, traits_.is_cpu ? "cpu" : "gpu", traits_.subgroup_size);
} catch (const vk::SystemError& error) {
    throw StartupError({ErrorCode::kDevice, std::string("Vulkan: ") + error.what()});
}

Device::~Device() {
    if (*device_) {
        try {
            device_.waitIdle();
            savePipelineCache();
        } catch (const vk::SystemError& error) {
            spdlog::warn("device: waiting at the end failed: {}", error.what());
        }
    }
}

void Device::loadPipelineCache(const PipelineCacheOptions& options) {
    std::vector<std::byte> bytes;
    if (!options.folder.empty()) {
        const auto properties = physical_.getProperties();
        cache_key_ = {.vendor = properties.vendorID,
                      .device = properties.deviceID,
                      .driver_version = properties.driverVersion,
                      .build = options.build,
                      .uuid = properties.pipelineCacheUUID};
        cache_file_ = pipelineCacheFile(options.folder, cache_key_);
        auto content = readPipelineCache(cache_file_, cache_key_);
        if (!content.refused.empty()) {
            spdlog::warn("pipeline cache '{}' {}: ignored", cache_file_.string(), content.refused);
        }
        bytes = std::move(content.bytes);
        cache_hash_ = bytes.empty() ? 0 : hashBytes(bytes);
        spdlog::debug("pipeline cache '{}' bytes={}", cache_file_.string(), bytes.size());
    }
    cache_ = device_.createPipelineCache(
        {.initialDataSize = bytes.size(), .pInitialData = bytes.data()});
}

void Device::savePipelineCache() {
    if (cache_file_.empty()) {
        return;
    }
    const auto data = cache_.getData();
    const auto bytes = std::as_bytes(std::span(data));
    const uint64_t hash = hashBytes(bytes);
    if (hash == cache_hash_) {
        return;
    }
    const auto written = writePipelineCache(cache_file_, cache_key_, bytes);
    if (!written) {
        spdlog::info("pipeline cache not kept: {}", written.error().message);
        return;
    }
    cache_hash_ = hash;
    spdlog::debug("pipeline cache '{}' written bytes={}", cache_file_.string(), bytes.size());
}

void Device::nameObject(vk::ObjectType type, uint64_t handle, std::string_view name) const {
    if (!instance_.validating()) {
        return;
    }
    const std::string text(name);
    device_.setDebugUtilsObjectNameEXT(vk::DebugUtilsObjectNameInfoEXT{
        .objectType = type, .objectHandle = handle, .pObjectName = text.c_str()});
}

std::unique_ptr<Device> openForServing(const DeviceOptions& options, int cpu_niceness) {
    if (!findsCpuDevice(options.choice)) {
        return std::make_unique<Device>(options);
    }
    // Its threads inherit what the one has that opens it, which could not take it back.
    return std::async(std::launch::async,
                      [&] {
                          nameThread("device");
                          (void)nice(cpu_niceness); // of this thread alone, on Linux
                          return std::make_unique<Device>(options);
                      })
        .get();
}

} // namespace froxel::gpu
