// What a server tells of its scenes over HTTP: see "Scenes over HTTP" in protocol/README.md. Any
// thread.
#pragma once

#include "catalogue/catalogue.h"
#include "net/http_site.h"
#include "net/service.h"

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace froxel::net {

inline constexpr std::string_view kScenesPath = "/api/v1/scenes";
inline constexpr std::string_view kThumbnail = "/thumb"; // behind a scene's path

class SceneListing {
  public:
    static constexpr size_t kUsualLimit = 50; // of scenes in an answer
    static constexpr size_t kMostLimit = 200;

    // Null: there is one scene, and nothing to tell.
    SceneListing(std::shared_ptr<const catalogue::Catalogue> catalogue,
                 std::shared_ptr<const Service> service)
        : catalogue_(std::move(catalogue)), service_(std::move(service)) {}

    // Whether it is asked for something of this.
    [[nodiscard]] static bool has(std::string_view path);
    [[nodiscard]] Response answer(const Request& request, std::string_view path) const;

  private:
    // A scene's row as it was told last: making it takes as long as a hundred of sending it.
    struct Row {
        session::SceneStanding standing = session::SceneStanding::kUnknown;
        std::optional<session::SceneContents> contents;
        std::string text; // JSON; empty: not told yet
    };
    // Under the lock.
    [[nodiscard]] const std::string&
    rowOf(const catalogue::Listing& listing, size_t place, const session::ScenePort* port) const;

    const std::shared_ptr<const catalogue::Catalogue> catalogue_;
    const std::shared_ptr<const Service> service_;
    mutable std::mutex mutex_;
    mutable uint64_t generation_ = 0; // of the listing that the rows are of
    mutable std::vector<Row> rows_;
};

} // namespace froxel::net
