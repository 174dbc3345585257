#include "net/guest_bodies.h"

#include "core/text.h"
#include "guest/memory_file.h"
#include "net/body_kind.h"

#include <boost/beast/core/string.hpp>
#include <boost/beast/http/rfc7230.hpp>
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <string>
#include <utility>

namespace froxel::net {

namespace http = boost::beast::http;

namespace {

constexpr std::string_view kField = "scene";

Response refused(http::status status, const char* code, const std::string& text) {
    return apiRefusal(status, {code, std::string(kField), std::string(kField) + " " + text});
}

Response putOff(http::status status, const char* code, const std::string& text) {
    Response response = refused(status, code, text);
    response.set(http::field::retry_after, "5");
    return response;
}

// Of the parts of a form (RFC 7578); none: it is no form.
std::optional<std::string> boundaryOf(std::string_view content_type) {
    constexpr std::string_view kForm = "multipart/form-data";
    if (!boost::beast::iequals(content_type.substr(0, kForm.size()), kForm)) {
        return {};
    }
    content_type.remove_prefix(kForm.size());
    for (const auto& [name, value] : http::param_list({content_type.data(), content_type.size()})) {
        if (boost::beast::iequals(name, "boundary")) {
            return std::string(value);
        }
    }
    return std::string();
}

} // namespace

class GuestBodies::Room {
  public:
    Room(std::shared_ptr<GuestBodies> bodies, std::optional<session::Account> account)
        : bodies_(std::move(bodies)), account_(std::move(account)) {}
    ~Room() {
        const std::lock_guard lock(bodies_->mutex_);
        bodies_->taken_bytes_ -= bytes_;
        const auto own = account_ ? bodies_->taken_by_.find(*account_) : bodies_->taken_by_.end();
        if (own != bodies_->taken_by_.end() && (own->second -= bytes_) == 0) {
            bodies_->taken_by_.erase(own);
        }
    }
    Room(const Room&) = delete;
    Room& operator=(const Room&) = delete;

    // Not none: why it cannot.
    [[nodiscard]] std::optional<Response> grow(uint64_t bytes) {
        const std::lock_guard lock(bodies_->mutex_);
        auto refused = bodies_->whyNoRoom(account_, bytes);
        if (!refused) {
            bytes_ += bytes;
            bodies_->taken_bytes_ += bytes;
            if (account_ && bytes > 0) {
                bodies_->taken_by_[*account_] += bytes;
            }
        }
        return refused;
    }

  private:
    const std::shared_ptr<GuestBodies> bodies_;
    const std::optional<session::Account> account_;
    uint64_t bytes_ = 0;
};

class GuestBodies::Body final : public RequestBody {
  public:
    Body(std::shared_ptr<guest::GuestShelf> shelf,
         std::shared_ptr<Room> room,
         guest::MemoryFile file,
         std::string form_boundary,
         uint64_t size_bytes,
         Then then)
        : shelf_(std::move(shelf)), room_(std::move(room)), file_(std::move(file)),
          form_boundary_(std::move(form_boundary)), size_bytes_(size_bytes),
          then_(std::move(then)) {
        if (!form_boundary_.empty()) {
            name_ = "form";
        }
    }

    std::optional<Response> take(std::span<const std::byte> bytes) override {
        if (!name_) {
            const auto more = bytes.first(std::min(bytes.size(), kMostOfKind - begin_.size()));
            begin_.append(reinterpret_cast<const char*>(more.data()), more.size());
            name_ = sceneNameOf(begin_, size_bytes_);
            if (name_ && name_->empty()) {
                return noScene();
            }
        }
        if (auto refused = room_->grow(bytes.size())) {
            return refused;
        }
        if (const auto done = file_.append(bytes); !done) {
            return putOff(http::status::service_unavailable, "capacity", done.error().message);
        }
        return {};
    }

    HttpSite::CallOff complete(std::function<void(LateAnswer)> done) override {
        if (!name_) { // fewer bytes than were announced
            done({noScene()});
            return [] {};
        }
        auto file = std::move(file_).complete(std::string(*name_));
        if (!file) {
            done({putOff(http::status::service_unavailable, "capacity", file.error().message)});
            return [] {};
        }
        guest::GuestScene scene;
        scene.form_boundary = form_boundary_;
        scene.files.push_back(std::move(*file));
        scene.held = std::move(room_);
        return then_(shelf_->put(std::move(scene)), std::move(done));
    }

  private:
    Response noScene() const {
        return refused(http::status::unsupported_media_type, "unsupported",
                       fmt::format("begins with \"{}\"; expected a GLB, glTF, OBJ, PLY, STL or "
                                   "3MF file",
                                   printable(begin_.substr(0, 8))));
    }

    const std::shared_ptr<guest::GuestShelf> shelf_;
    std::shared_ptr<Room> room_;
    guest::MemoryFile file_;
    const std::string form_boundary_; // empty: it is no form
    const uint64_t size_bytes_;       // as announced
    const Then then_;
    std::string begin_;                    // until the name is known
    std::optional<std::string_view> name_; // as sceneNameOf() has it, or of the form
};

HttpSite::Received GuestBodies::receive(const std::optional<session::Account>& account,
                                        std::string_view content_type,
                                        uint64_t size_bytes,
                                        Then then) {
    if (most_bytes_ == 0) {
        return refused(http::status::forbidden, "unsupported",
                       "is not accepted by this server (--max-body is 0, or --sandbox is off)");
    }
    if (size_bytes == 0) {
        return refused(http::status::length_required, "malformed",
                       "is missing; expected a scene's file as the body, with Content-Length");
    }
    if (size_bytes > most_bytes_) {
        return refused(
            http::status::payload_too_large, "out_of_range",
            fmt::format("has {} bytes; expected at most {} (--max-body)", size_bytes, most_bytes_));
    }
    const auto boundary = boundaryOf(content_type);
    constexpr size_t kLongestBoundary = 70; // RFC 2046, 5.1.1
    if (boundary && (boundary->empty() || boundary->size() > kLongestBoundary)) {
        return refused(
            http::status::bad_request, "malformed",
            fmt::format("is a form without a boundary of 1 to {} characters", kLongestBoundary));
    }
    {
        const std::lock_guard lock(mutex_);
        if (auto refused = whyNoRoom(account, size_bytes)) {
            return std::move(*refused);
        }
    }
    auto file = guest::MemoryFile::make();
    if (!file) {
        return putOff(http::status::service_unavailable, "capacity", file.error().message);
    }
    return std::make_unique<Body>(shelf_, std::make_shared<Room>(shared_from_this(), account),
                                  std::move(*file), boundary.value_or(""), size_bytes,
                                  std::move(then));
}

std::optional<Response> GuestBodies::whyNoRoom(const std::optional<session::Account>& account,
                                               uint64_t bytes) const {
    const auto own = account ? taken_by_.find(*account) : taken_by_.end();
    if (own != taken_by_.end() && own->second + bytes > kAtOnceOfAccount * most_bytes_) {
        return putOff(http::status::too_many_requests, "rate_limit",
                      fmt::format("must wait: {} MiB of this address or token are in work",
                                  own->second >> 20U));
    }
    if (taken_bytes_ + bytes > kAtOnce * most_bytes_) {
        return putOff(
            http::status::service_unavailable, "capacity",
            fmt::format("must wait: {} MiB of all clients are in work", taken_bytes_ >> 20U));
    }
    return {};
}

} // namespace froxel::net
