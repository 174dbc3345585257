#include "render/frame/host_copy.h"

#include "core/assert.h"
#include "render/pipelines/barrier.h"

namespace froxel::render {

HostCopy::HostCopy(gpu::Timeline* copies) : copies_(copies) {
    if (copies_ != nullptr) {
        cmd_ = copies_->makeCommandBuffer();
    }
}

void HostCopy::clear() {
    recorded_ = false;
    submitted_ = 0;
}

void HostCopy::record(const gpu::Buffer& from, const gpu::Buffer& to) {
    FROXEL_ASSERT(isBeside() && !recorded_, "one copy a frame, on a queue for it");
    cmd_->reset();
    cmd_->begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    cmd_->copyBuffer(*from.handle, *to.handle, vk::BufferCopy{.size = from.size_bytes});
    barrier(*cmd_, vk::PipelineStageFlagBits2::eCopy, vk::AccessFlagBits2::eTransferWrite,
            vk::PipelineStageFlagBits2::eHost, vk::AccessFlagBits2::eHostRead);
    cmd_->end();
    recorded_ = true;
}

gpu::TimelineMoment HostCopy::submit(const gpu::TimelineMoment& frame) {
    submitted_ = copies_->submit(*cmd_, frame);
    return {copies_, submitted_};
}

Result<void> HostCopy::wait() const {
    return submitted_ > 0 ? copies_->wait(submitted_) : Result<void>();
}

} // namespace froxel::render
