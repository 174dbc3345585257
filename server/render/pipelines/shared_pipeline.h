// A compute pipeline that all views share and that has no variants.
#pragma once

#include "gpu/vulkan.h"
#include "render/pipelines/variant_maker.h"

#include <utility>

namespace froxel::render {

// One thread, the timeline's.
class SharedPipeline {
  public:
    explicit SharedPipeline(vk::raii::Pipeline pipeline) : handle_(std::move(pipeline)) {}

    // Records it, and its first use.
    void bind(const vk::raii::CommandBuffer& cmd, VariantMaker& variants) {
        first_use_.note(variants);
        cmd.bindPipeline(vk::PipelineBindPoint::eCompute, *handle_);
    }

  private:
    vk::raii::Pipeline handle_;
    FirstUse first_use_;
};

} // namespace froxel::render
