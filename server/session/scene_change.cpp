#include "session/scene_change.h"

namespace froxel::session {
namespace {

// How bright a scene is and what lights it go by the scene; whether lights move is the viewer's.
bool isTheScenes(const settings::Setting& setting) {
    return (setting.path.starts_with("lights.") && setting.path != "lights.animate") ||
           setting.path.starts_with("exposure");
}

} // namespace

SessionState beginOn(const SharedContext& scene, TimePoint now) {
    SessionState state = initialState(*scene, now);
    state.scene = scene;
    return state;
}

SessionState withScene(const SessionState& before,
                       const SessionState& first,
                       const SharedContext& scene,
                       const CommandStamp& stamp,
                       TimePoint now) {
    SessionState state = beginOn(scene, now);
    for (const SessionSetting& setting : sessionSettings()) {
        const settings::SettingValue value = setting.valueIn(before);
        if (!isTheScenes(setting.facts()) && value != setting.valueIn(first)) {
            setting.set(state, value);
        }
    }
    const settings::ViewSettings& was = before.settings;
    settings::ViewSettings& is = state.settings;
    if (was.grid != first.settings.grid) {
        is.grid = was.grid;
    }
    is.toon_fragment = was.toon_fragment;
    is.toon_compute = was.toon_compute;
    is.size = was.size;
    is.camera = openingCamera(*scene, is.size);
    state.light_clock = LightClock(now, is.lights.speed, is.lights.animate);
    state.playback = {scene->scene.motion, is.animation, SessionState::secondsOf(now)};
    state.encoding = before.encoding;
    state.delivery = before.delivery;
    state.decodable = before.decodable;
    state.key_requests = before.key_requests;
    state.sends_depth = before.sends_depth;
    state.applied = stamp;
    state.version = before.version + 1;
    return state;
}

} // namespace froxel::session
