#include "net/guest_bodies.h"

#include <gtest/gtest.h>

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace froxel::net {
namespace {

namespace http = boost::beast::http;
using session::Account;

constexpr uint64_t kMost = 1000;

class GuestBodiesTest : public testing::Test {
  protected:
    HttpSite::Received receive(const std::optional<Account>& account,
                               uint64_t size_bytes,
                               std::string_view content_type = "") {
        const auto then = [this](auto scene, const auto& /*done*/) {
            const auto found = shelf_->find(scene->id());
            names_.push_back(found->files.front().name + found->form_boundary);
            held_ = std::move(scene);
            return [] {};
        };
        return bodies_->receive(account, content_type, size_bytes, then);
    }
    static http::status statusOf(const HttpSite::Received& received) {
        const auto* refused = std::get_if<Response>(&received);
        return refused != nullptr ? refused->result() : http::status::ok;
    }
    // What the body is refused with; ok: it is taken to its end.
    http::status send(std::string_view text, std::string_view content_type = "") {
        const http::status outcome = sendIn(text, text.size(), content_type);
        EXPECT_EQ(sendIn(text, 1, content_type), outcome) << "byte by byte: " << text;
        if (!names_.empty() && outcome == http::status::ok) {
            names_.pop_back(); // of the second
        }
        return outcome;
    }
    http::status sendIn(std::string_view text, size_t part_bytes, std::string_view content_type) {
        auto received = receive({}, text.size(), content_type);
        auto& body = std::get<std::unique_ptr<RequestBody>>(received);
        const auto told = [](const Response& refused) {
            EXPECT_NE(refused.body().find("expected a GLB, glTF, OBJ, PLY, STL or 3MF file"),
                      std::string::npos);
            return refused.result();
        };
        for (size_t at = 0; at < text.size(); at += part_bytes) {
            if (const auto refused =
                    body->take(std::as_bytes(std::span(text.substr(at, part_bytes))))) {
                return told(*refused);
            }
        }
        http::status outcome = http::status::ok;
        const auto call_off =
            body->complete([&](const LateAnswer& answer) { outcome = told(answer.response); });
        return outcome;
    }

    std::shared_ptr<guest::GuestShelf> shelf_ = std::make_shared<guest::GuestShelf>();
    std::shared_ptr<GuestBodies> bodies_ = std::make_shared<GuestBodies>(shelf_, kMost);
    std::vector<std::string> names_;
    guest::GuestShelf::SharedHold held_;
};

TEST_F(GuestBodiesTest, Kind_IsByTheFirstBytes) {
    EXPECT_EQ(send("glTF and more"), http::status::ok);
    EXPECT_EQ(send("{}"), http::status::ok);
    EXPECT_EQ(send("\xEF\xBB\xBF \n{\"asset\":{}}"), http::status::ok);
    EXPECT_EQ(send("PK\x03\x04 and more"), http::status::ok);
    EXPECT_EQ(send("ply\nformat ascii 1.0\n"), http::status::ok);
    EXPECT_EQ(send("solid cube\n facet"), http::status::ok);
    EXPECT_EQ(send("\r\n# of a modeller\nv 0 0 0\n"), http::status::ok);
    EXPECT_EQ(send(std::string(80, 'x') + std::string("\1\0\0\0", 4) + std::string(50, 'x')),
              http::status::ok);
    EXPECT_EQ(names_,
              (std::vector<std::string>{"scene.glb", "scene.gltf", "scene.gltf", "scene.3mf",
                                        "scene.ply", "scene.stl", "scene.obj", "scene.stl"}));
    EXPECT_EQ(send(std::string(80, 'x') + std::string("\2\0\0\0", 4) + std::string(50, 'x')),
              http::status::unsupported_media_type);
    for (const char* other : {"PK\x05\x06", "<html>", "glT", "  ", "solidity ", "\x89PNG"}) {
        EXPECT_EQ(send(other), http::status::unsupported_media_type) << other;
    }
}

TEST_F(GuestBodiesTest, Form_IsTakenWithItsBoundary) {
    EXPECT_EQ(send("--a b\r\n", "multipart/form-data; boundary=\"a b\""), http::status::ok);
    EXPECT_EQ(send("--x", "Multipart/Form-Data;charset=utf-8;Boundary=x"), http::status::ok);
    EXPECT_EQ(send("glTF", "application/x-www-form-urlencoded"), http::status::ok);
    EXPECT_EQ(names_, (std::vector<std::string>{"forma b", "formx", "scene.glb"}));
    for (const std::string& without :
         {std::string("multipart/form-data"), std::string("multipart/form-data; boundary="),
          "multipart/form-data; boundary=" + std::string(71, 'x')}) {
        EXPECT_EQ(statusOf(receive({}, 1, without)), http::status::bad_request) << without;
    }
}

TEST_F(GuestBodiesTest, Size_IsJudgedBeforeAByteCame) {
    EXPECT_EQ(statusOf(receive({}, 0)), http::status::length_required);
    EXPECT_EQ(statusOf(receive({}, 1)), http::status::ok);
    EXPECT_EQ(statusOf(receive({}, kMost)), http::status::ok);
    EXPECT_EQ(statusOf(receive({}, kMost + 1)), http::status::payload_too_large);
    EXPECT_EQ(statusOf(receive({}, UINT64_MAX)), http::status::payload_too_large);
    bodies_ = std::make_shared<GuestBodies>(shelf_, 0);
    EXPECT_EQ(statusOf(receive({}, 1)), http::status::forbidden);
}

// Counted as they come, so that nobody is kept out by who sends nothing.
TEST_F(GuestBodiesTest, Room_IsSharedByAccounts_AndComesBack) {
    std::vector<HttpSite::Received> received;
    const std::string text = "glTF" + std::string(kMost - 4, '.');
    const auto add = [&](const std::optional<Account>& account) {
        received.push_back(receive(account, kMost));
        if (auto* body = std::get_if<std::unique_ptr<RequestBody>>(&received.back())) {
            EXPECT_FALSE((*body)->take(std::as_bytes(std::span(text))));
        }
        return statusOf(received.back());
    };
    const Account a{"192.0.2.1"};
    std::vector<HttpSite::Received> silent;
    for (int i = 0; i < 10; ++i) {
        silent.push_back(receive(a, kMost));
        EXPECT_EQ(statusOf(silent.back()), http::status::ok);
    }
    EXPECT_EQ(add(a), http::status::ok);
    EXPECT_EQ(add(a), http::status::ok);
    EXPECT_EQ(add(a), http::status::too_many_requests);
    EXPECT_EQ(add(Account{"192.0.2.2"}), http::status::ok);
    EXPECT_EQ(add({}), http::status::ok);
    EXPECT_EQ(add({}), http::status::service_unavailable);
    // Those that were let in come too late.
    auto& late = std::get<std::unique_ptr<RequestBody>>(silent.front());
    const auto refused = late->take(std::as_bytes(std::span(text)));
    ASSERT_TRUE(refused);
    EXPECT_EQ(refused->result(), http::status::too_many_requests);
    received.clear();
    EXPECT_EQ(add(a), http::status::ok);
}

// As long as the scene is there, and not as long as the body is read.
TEST_F(GuestBodiesTest, Room_IsTheScenes) {
    const std::string text = "glTF" + std::string(kMost - 4, '.');
    EXPECT_EQ(send(text), http::status::ok);
    const auto begin = [&] { return receive({}, kMost); };
    std::vector<HttpSite::Received> received;
    for (uint64_t i = 1; i < GuestBodies::kAtOnce; ++i) {
        received.push_back(begin());
        auto& body = std::get<std::unique_ptr<RequestBody>>(received.back());
        EXPECT_FALSE(body->take(std::as_bytes(std::span(text))));
    }
    EXPECT_EQ(statusOf(begin()), http::status::service_unavailable);
    held_.reset();
    EXPECT_EQ(statusOf(begin()), http::status::ok);
}

} // namespace
} // namespace froxel::net
