#include "gpu/command_context.h"

namespace froxel::gpu {

namespace {

// A frame that takes longer than this means a device that hangs.
constexpr uint64_t kWaitLimit_ns = 120'000'000'000ULL;

vk::raii::Semaphore makeTimeline(const Device& device) {
    const vk::SemaphoreTypeCreateInfo type{.semaphoreType = vk::SemaphoreType::eTimeline};
    return device.handle().createSemaphore({.pNext = &type});
}

} // namespace

Timeline::Timeline(const Device& device, const Queue& queue)
    : device_(device), queue_(queue),
      pool_(device.handle().createCommandPool(
          {.flags = vk::CommandPoolCreateFlagBits::eResetCommandBuffer,
           .queueFamilyIndex = queue.family})),
      semaphore_(makeTimeline(device)) {
    device.setName(*semaphore_, "timeline");
}

uint64_t Timeline::submit(const vk::raii::CommandBuffer& cmd, const TimelineMoment& after) {
    const vk::CommandBufferSubmitInfo buffer{.commandBuffer = *cmd};
    const vk::SemaphoreSubmitInfo signal{.semaphore = *semaphore_,
                                         .value = last_ + 1,
                                         .stageMask = vk::PipelineStageFlagBits2::eAllCommands};
    vk::SemaphoreSubmitInfo wait{.value = after.value,
                                 .stageMask = vk::PipelineStageFlagBits2::eAllCommands};
    vk::SubmitInfo2 submission{.commandBufferInfoCount = 1,
                               .pCommandBufferInfos = &buffer,
                               .signalSemaphoreInfoCount = 1,
                               .pSignalSemaphoreInfos = &signal};
    if (after.timeline != nullptr) {
        wait.semaphore = *after.timeline->semaphore_;
        submission.waitSemaphoreInfoCount = 1;
        submission.pWaitSemaphoreInfos = &wait;
    }
    queue_.handle.submit2(submission);
    return ++last_;
}

Result<void> Timeline::wait(uint64_t value) const {
    const vk::Semaphore semaphore = *semaphore_;
    try {
        const auto result = device_.handle().waitSemaphores(
            {.semaphoreCount = 1, .pSemaphores = &semaphore, .pValues = &value}, kWaitLimit_ns);
        if (result == vk::Result::eTimeout) {
            return Error{ErrorCode::kDevice, "the device did not finish a frame within 120 s"};
        }
    } catch (const vk::SystemError& error) {
        return Error{ErrorCode::kDevice, std::string("the device was lost: ") + error.what()};
    }
    return {};
}

uint64_t Timeline::completed() const {
    return semaphore_.getCounterValue();
}

void Timeline::runNow(const std::function<void(const vk::raii::CommandBuffer&)>& record) {
    const auto cmd = makeCommandBuffer();
    cmd.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    record(cmd);
    cmd.end();
    const auto done = wait(submit(cmd));
    if (!done) {
        throw StartupError(done.error());
    }
}

vk::raii::CommandBuffer Timeline::makeCommandBuffer() const {
    auto buffers =
        device_.handle().allocateCommandBuffers({.commandPool = *pool_,
                                                 .level = vk::CommandBufferLevel::ePrimary,
                                                 .commandBufferCount = 1});
    return std::move(buffers.front());
}

} // namespace froxel::gpu
