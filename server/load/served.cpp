#include "load/served.h"

#include "core/text.h"
#include "session/proto_enums.h"

#include <array>
#include <filesystem>
#include <string_view>

namespace froxel::load {
namespace {

constexpr size_t kMostBytes = 200;

template <class Table, class Proto, size_t N>
std::string nameOf(const Table& table, const std::array<std::string_view, N>& names, Proto value) {
    const auto ours = session::fromProto(table, value);
    return ours ? std::string(names[static_cast<size_t>(*ours)]) : "unknown";
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
            nameOf(session::kRendererTable, view::kRendererNames, state.renderer()),
            nameOf(session::kCodecTable, view::kCodecNames, state.codec()),
            state.quality(),
            state.video_kbps()};
}

} // namespace froxel::load
