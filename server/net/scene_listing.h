// What a server tells of its scenes over HTTP: see "Scenes over HTTP" in protocol/README.md. Any
// thread.
#pragma once

#include "catalogue/catalogue.h"
#include "net/http_site.h"
#include "net/service.h"

#include <memory>
#include <string_view>

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
    const std::shared_ptr<const catalogue::Catalogue> catalogue_;
    const std::shared_ptr<const Service> service_;
};

} // namespace froxel::net
