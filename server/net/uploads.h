// Scenes that clients bring and that stay for a while, over HTTP: see "Uploads" in
// protocol/README.md. Files come by tus 1.0.0 (tus.io: core, creation, termination, expiration).
// Any thread.
#pragma once

#include "guest/guest_store.h"
#include "net/http_site.h"
#include "net/long_work.h"
#include "session/account.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace froxel::net {

inline constexpr std::string_view kUploadsPath = "/api/v1/uploads";
inline constexpr std::string_view kOwnerKeyField = "Froxel-Owner-Key";

class Uploads {
  public:
    // `store`: null: this server takes none. `long_work` outlives it.
    Uploads(std::shared_ptr<guest::GuestStore> store, LongWork& long_work)
        : store_(std::move(store)), long_work_(long_work) {}

    using Done = std::function<void(LateAnswer)>;
    // No account: its limits do not hold.
    using Account = std::optional<session::Account>;

    // POST of kScenesPath, with a body that says which files come.
    [[nodiscard]] HttpSite::Received announce(const Account& account, uint64_t size_bytes) const;
    // POST of kUploadsPath: a scene of one file.
    [[nodiscard]] HttpSite::Received
    create(const Request& request, const Account& account, uint64_t size_bytes) const;
    // PATCH of an upload.
    [[nodiscard]] HttpSite::Received
    receive(const Request& request, std::string_view path, uint64_t size_bytes) const;
    // OPTIONS of both, HEAD and DELETE of an upload.
    [[nodiscard]] HttpSite::CallOff
    answer(const Request& request, std::string_view path, const Done& done) const;

    // GET and HEAD of a scene; none: it is no guest's.
    [[nodiscard]] std::optional<Response> answerScene(const std::string& id) const;
    // DELETE of one, by its owner's key.
    [[nodiscard]] HttpSite::CallOff
    removeScene(const Request& request, const std::string& id, const Done& done) const;

  private:
    class Announcement;
    class Part;

    const std::shared_ptr<guest::GuestStore> store_;
    LongWork& long_work_;
};

} // namespace froxel::net
