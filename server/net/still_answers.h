// Stills over HTTP: see "Stills" in protocol/README.md. Any thread.
#pragma once

#include "catalogue/catalogue.h"
#include "net/caller.h"
#include "net/http_site.h"
#include "net/service.h"
#include "still/still_desk.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace froxel::net {

inline constexpr std::string_view kStillPath = "/render";

class StillAnswers {
  public:
    static constexpr settings::Size kThumbnailSize{320, 180};

    // `catalogue` may be null: there is one scene.
    StillAnswers(std::shared_ptr<still::StillDesk> desk,
                 std::shared_ptr<const catalogue::Catalogue> catalogue,
                 std::shared_ptr<const Service> service);

    // Whether it is asked for something of this.
    [[nodiscard]] static bool has(std::string_view path);
    // As HttpSite::answerLater. `shared`: whether caches between may keep it.
    [[nodiscard]] HttpSite::CallOff answer(const Request& request,
                                           std::string_view path,
                                           const Caller& caller,
                                           bool shared,
                                           const std::function<void(LateAnswer)>& done) const;

  private:
    [[nodiscard]] std::optional<Response>
    read(const Request& request, std::string_view path, still::StillRequest& still) const;
    [[nodiscard]] std::string sceneTag(const std::string& scene) const;
    // Whether the address itself goes by the scene's version, as the listing has it.
    [[nodiscard]] bool lasts(const Request& request, const still::StillRequest& still) const;

    const std::shared_ptr<still::StillDesk> desk_;
    const std::shared_ptr<const catalogue::Catalogue> catalogue_;
    const std::shared_ptr<const Service> service_;
    const std::string run_; // another one each time that a server starts
};

} // namespace froxel::net
