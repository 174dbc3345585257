#include "support/visible_exact.h"

#include <gtest/gtest.h>

namespace froxel::test {

using settings::Renderer;

Picture expectVisibleExact(render::ViewRenderer& view, const render::FrameInputs& inputs) {
    auto forward = inputs;
    forward.settings.light_loop = settings::LightLoop::kLists;
    forward.settings.renderer = Renderer::kNaive;
    forward.settings.lighting = settings::LightingStage::kCompute;
    const Picture naive = draw(view, forward);
    forward.settings.renderer = Renderer::kForwardPlus;
    const Picture plus = draw(view, forward);
    EXPECT_EQ(differingFloats(naive, plus), 0U);
    forward.cull_meshlets = false;
    EXPECT_EQ(differingFloats(plus, draw(view, forward)), 0U);

    auto deferred = inputs;
    deferred.settings.light_loop = settings::LightLoop::kLists;
    deferred.settings.renderer = Renderer::kClusteredDeferred;
    deferred.settings.lighting = settings::LightingStage::kAuto;
    const Picture clustered = draw(view, deferred);
    deferred.settings.light_loop = settings::LightLoop::kAllLights;
    EXPECT_EQ(differingFloats(clustered, draw(view, deferred)), 0U);
    deferred.settings.light_loop = settings::LightLoop::kLists;
    deferred.cull_meshlets = false;
    EXPECT_EQ(differingFloats(clustered, draw(view, deferred)), 0U);
    return clustered;
}

} // namespace froxel::test
