#include "gpu/instance.h"

#include "core/error.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace froxel::gpu {

namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

// Its parameters have C's types in Vulkan-Hpp 1.3, and Vulkan-Hpp's own in 1.4.
constexpr auto kOnMessage = [](auto /*severity*/, auto /*types*/, const auto* data, void* log) {
    spdlog::error("validation: {}", data->pMessage);
    static_cast<ValidationLog*>(log)->add(data->pMessage);
    return VkBool32{VK_FALSE};
};

} // namespace

void ValidationLog::add(std::string message) {
    const std::lock_guard lock(mutex_);
    messages_.push_back(std::move(message));
}

std::vector<std::string> ValidationLog::messages() const {
    const std::lock_guard lock(mutex_);
    return messages_;
}

Instance::Instance(bool validation)
    : log_(std::make_unique<ValidationLog>()), validating_(validation) {
    if (context_.enumerateInstanceVersion() < VK_API_VERSION_1_3) {
        throw StartupError({ErrorCode::kDevice, "the Vulkan loader is older than 1.3"});
    }
    const vk::ApplicationInfo application{.pApplicationName = "froxel",
                                          .apiVersion = VK_API_VERSION_1_3};
    std::vector<const char*> layers;
    std::vector<const char*> extensions;
    if (validation) {
        const auto available = context_.enumerateInstanceLayerProperties();
        const bool present = std::any_of(available.begin(), available.end(), [](const auto& layer) {
            return std::strcmp(layer.layerName, kValidationLayer) == 0;
        });
        if (!present) {
            throw StartupError(
                {ErrorCode::kDevice, std::string(kValidationLayer) +
                                         " is not installed (Debian: vulkan-validationlayers)"});
        }
        layers.push_back(kValidationLayer);
        extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
        extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
    }
    // Missing barriers, too.
    const std::array looks = {vk::ValidationFeatureEnableEXT::eSynchronizationValidation};
    const vk::ValidationFeaturesEXT features{.enabledValidationFeatureCount = looks.size(),
                                             .pEnabledValidationFeatures = looks.data()};
    const vk::InstanceCreateInfo info{.pNext = validation ? &features : nullptr,
                                      .pApplicationInfo = &application,
                                      .enabledLayerCount = static_cast<uint32_t>(layers.size()),
                                      .ppEnabledLayerNames = layers.data(),
                                      .enabledExtensionCount =
                                          static_cast<uint32_t>(extensions.size()),
                                      .ppEnabledExtensionNames = extensions.data()};
    try {
        instance_ = vk::raii::Instance(context_, info);
    } catch (const vk::IncompatibleDriverError&) { // the loader's word for none at all
        throw StartupError({ErrorCode::kDevice,
                            "no Vulkan driver was found; install the GPU's driver, or "
                            "lavapipe for the CPU (Debian: mesa-vulkan-drivers)"});
    }
    if (validation) {
        using Severity = vk::DebugUtilsMessageSeverityFlagBitsEXT;
        using Type = vk::DebugUtilsMessageTypeFlagBitsEXT;
        messenger_ = vk::raii::DebugUtilsMessengerEXT(
            instance_, vk::DebugUtilsMessengerCreateInfoEXT{
                           .messageSeverity = Severity::eWarning | Severity::eError,
                           .messageType = Type::eValidation | Type::eGeneral,
                           .pfnUserCallback = kOnMessage,
                           .pUserData = log_.get()});
    }
}

} // namespace froxel::gpu
