// Random and mutated messages: whatever comes in, decoding answers, and what it accepts is valid.
#include "support/command_promises.h"
#include "unit/session/messages.h"

#include <random>

namespace froxel::session {
namespace {

void expectSane(const CommandResult<CommandMessage>& result) {
    EXPECT_EQ(test::faultOf(result), "");
}

std::vector<v1::ClientMessage> seeds() {
    std::vector<v1::ClientMessage> all(8, clientMessage());
    all[0].mutable_hello()->set_client_name("fuzz");
    all[6].mutable_set_debug_view()->set_view(v1::DEBUG_VIEW_DEPTH);
    all[6].mutable_set_debug_view()->set_scale_max(10);
    all[7].mutable_set_placed_lights()->add_remove(3);
    all[7].mutable_set_placed_lights()->add_lights()->set_id(4);
    all[7].mutable_set_placed_lights()->mutable_lights(0)->mutable_position()->set_x(1);
    all[7].mutable_set_placed_lights()->mutable_lights(0)->set_kind(v1::LIGHT_KIND_SPOT);
    all[1].mutable_set_camera()->mutable_eye()->set_x(1);
    all[1].mutable_set_camera()->mutable_target()->set_y(1);
    all[1].mutable_set_camera()->set_fov_deg(45);
    all[2].mutable_set_lights()->set_count(10);
    all[2].mutable_set_lights()->mutable_box()->mutable_min()->set_x(-1);
    all[2].mutable_set_lights()->mutable_box()->mutable_max()->set_x(1);
    all[3].mutable_set_renderer()->set_renderer(v1::RENDERER_NAIVE);
    all[3].mutable_set_renderer()->set_lighting(v1::LIGHTING_STAGE_COMPUTE);
    all[4].mutable_set_toon()->mutable_compute()->add_points();
    all[4].mutable_set_toon()->mutable_compute()->add_points()->set_x(1);
    all[5].mutable_set_size()->set_width(64);
    all[5].mutable_set_size()->set_height(64);
    all.push_back(clientMessage());
    all.back().mutable_set_fog()->mutable_fog()->set_density(0.5);
    all.back().mutable_set_fog()->mutable_fog()->mutable_albedo()->set_y(0.5);
    all.back().mutable_set_fog()->mutable_fog()->set_tile(8);
    all.back().mutable_set_fog()->mutable_fog()->set_slices(32);
    all[6].mutable_set_post()->set_bloom(v1::BLOOM_KIND_A_TROUS);
    all[6].mutable_set_post()->set_bloom_radius(0.01);
    all[6].mutable_set_post()->set_antialiasing(v1::ANTIALIASING_SSAA4);
    all.push_back(clientMessage());
    all.back().mutable_set_environment()->set_light(v1::ENVIRONMENT_LIGHT_STUDIO);
    all.back().mutable_set_environment()->set_rotation_deg(30);
    all.push_back(clientMessage());
    all.back().mutable_pick_light()->set_id(5);
    all.back().mutable_pick_light()->set_x(0.25);
    return all;
}

using Random = std::mt19937;

size_t below(Random& random, size_t bound) {
    return std::uniform_int_distribution<size_t>(0, bound - 1)(random);
}

std::string mutate(std::string bytes, Random& random) {
    const size_t edits = 1 + below(random, 4);
    for (size_t i = 0; i < edits; ++i) {
        const auto value = static_cast<char>(below(random, 256));
        switch (below(random, 4)) {
        case 0:
            bytes.insert(below(random, bytes.size() + 1), 1, value);
            break;
        case 1:
            bytes = bytes.substr(0, below(random, bytes.size() + 1));
            break;
        case 2:
            bytes += bytes.substr(below(random, bytes.size() + 1));
            break;
        default:
            if (!bytes.empty()) {
                bytes[below(random, bytes.size())] = value;
            }
        }
    }
    return bytes;
}

TEST(CommandFuzz, RandomBytes_AreAnswered) {
    Random random(1);
    for (int i = 0; i < 20'000; ++i) {
        std::string bytes(below(random, 64), '\0');
        for (char& byte : bytes) {
            byte = static_cast<char>(below(random, 256));
        }
        expectSane(decodeBinary(bytes));
        expectSane(decodeText(bytes));
    }
}

TEST(CommandFuzz, MutatedMessages_AreAnsweredAndStayValid) {
    Random random(2);
    const auto all = seeds();
    ::testing::internal::CaptureStderr();
    for (int i = 0; i < 20'000; ++i) {
        const v1::ClientMessage& seed = all[below(random, all.size())];
        expectSane(decodeBinary(mutate(seed.SerializeAsString(), random)));
        const auto text = protocol::encodeClientMessage(seed, protocol::WireFormat::kText);
        expectSane(decodeText(mutate(text, random)));
    }
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), ""); // no client can fill our log
}

} // namespace
} // namespace froxel::session
