// A small server for the session's tests: one scene with two cameras, CPU defaults.
#pragma once

#include "session/session_context.h"
#include "session/session_state.h"

namespace froxel::session {

inline SessionContext makeContext() {
    scene::NamedCamera nave;
    nave.name = "nave";
    nave.camera = settings::lookAt({-7, 2, 0}, {0, 2, 0}, {0, 1, 0});
    scene::NamedCamera plan;
    plan.name = "plan";
    plan.camera = settings::lookAt({0, 30, 0}, {0, 0, 0}, {0, 0, -1});
    plan.camera.projection = settings::Projection::kOrthographic;
    plan.camera.half_height_m = 12;

    SessionContext context;
    context.scene.name = "hall";
    context.scene.triangle_count = 120;
    context.scene.cameras = {nave, plan};
    context.first_view.scene_camera = 0;
    context.first_view.camera = nave.camera;
    context.scene.bounds_world.add(glm::dvec3(-20, 0, -8));
    context.scene.bounds_world.add(glm::dvec3(20, 12, 8));
    context.defaults = defaultsFor(DeviceKind::kCpu);
    context.server_version = "0.1.0";
    context.device_name = "llvmpipe";
    return context;
}

} // namespace froxel::session
