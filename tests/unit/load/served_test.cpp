#include "load/served.h"

#include <gtest/gtest.h>

namespace froxel::load {
namespace {

TEST(Served, Welcome_AndState_AreTakenOver) {
    v1::Welcome welcome;
    welcome.set_server_version("1.2.3");
    welcome.set_device("NVIDIA H200");
    welcome.mutable_scene()->set_name("Sponza");
    welcome.mutable_scene()->set_triangles(262'267);
    v1::ViewState state;
    state.set_width(1280);
    state.set_height(720);
    state.set_light_count(1000);
    state.set_renderer(v1::RENDERER_FORWARD_PLUS);
    state.set_codec(v1::CODEC_VP9);
    state.set_quality(85);
    state.set_video_kbps(4000);
    const Served expected{"1.2.3", "NVIDIA H200", "Sponza",       262'267, 1280, 720,
                          1000,    true,          "forward_plus", "vp9",   85,   4000};
    EXPECT_EQ(servedOf(welcome, state), expected);
    state.set_light_time_s(0);
    EXPECT_FALSE(servedOf(welcome, state).lights_move);
}

TEST(Served, Texts_FromOutside_LoseFoldersAndWhatIsNotPrintable) {
    v1::Welcome welcome;
    welcome.set_device("a\nb");
    welcome.mutable_scene()->set_name("/home/someone/scenes/Sponza");
    const Served served = servedOf(welcome, {});
    EXPECT_EQ(served.scene, "Sponza");
    EXPECT_EQ(served.device, "a\\x0ab");
    EXPECT_EQ(served.codec, "unknown");
}

} // namespace
} // namespace froxel::load
