#include "load/served.h"

#include "core/text.h"
#include "session/proto_enums.h"
#include "session/settings.h"

#include <array>
#include <filesystem>
#include <string_view>

namespace froxel::load {
namespace {

constexpr size_t kMostBytes = 200;

template <class Proto, size_t N>
std::string nameOf(const std::array<std::string_view, N>& names, Proto value) {
    const auto ours = session::fromProto<size_t>(names, value);
    return ours ? std::string(names[*ours]) : "unknown";
}

} // namespace

Served servedOf(const v1::Welcome& welcome, const v1::ViewState& state) {
    const std::string scene = std::filesystem::path(welcome.scene().name()).filename().string();
    return {printable(welcome.server_version(), kMostBytes),
            printable(welcome.device(), kMostBytes),
            printable(scene, kMostBytes),
            welcome.scene().triangles(),
            state.width(),
            state.height(),
            state.light_count(),
            !state.has_light_time_s() && state.light_count() > 0,
            nameOf(settings::kRendererNames, state.renderer()),
            nameOf(settings::kCodecNames, state.codec()),
            state.quality(),
            state.video_kbps()};
}

} // namespace froxel::load
