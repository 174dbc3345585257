// Stills over HTTP: see "Stills" in protocol/README.md. Any thread.
#pragma once

#include "catalogue/catalogue.h"
#include "core/clock.h"
#include "guest/guest_shelf.h"
#include "net/caller.h"
#include "net/http_site.h"
#include "net/long_work.h"
#include "net/service.h"
#include "net/still_address.h"
#include "still/still_desk.h"

#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace froxel::net {

inline constexpr std::string_view kStillPath = "/render";

// Who asks while the server's first scene is loaded waits for it, as long as for a picture.
class StillAnswers final : public ServiceListener,
                           public std::enable_shared_from_this<StillAnswers> {
  public:
    static constexpr settings::Size kThumbnailSize{320, 180};

    // `catalogue` may be null: the server has one scene of its own. `long_work` outlives it.
    StillAnswers(std::shared_ptr<still::StillDesk> desk,
                 std::shared_ptr<const catalogue::Catalogue> catalogue,
                 std::shared_ptr<const Service> service,
                 LongWork& long_work);

    // Told when expire() is due next; any thread, must not block. Set before the first request.
    void setAlarm(std::function<void(TimePoint)> alarm) { alarm_ = std::move(alarm); }
    // Ends what has waited too long for the first scene; sets off the alarm for when more is due.
    void expire(TimePoint now);
    void onServiceChanged() override;
    // Lets go of whoever waits for the first scene, unanswered.
    void close();

    // Whether it is asked for something of this.
    [[nodiscard]] static bool has(std::string_view path);
    struct Asked {
        Request request;
        std::string path;
        Caller caller;
        bool shared = false; // whether caches between may keep it
        guest::GuestShelf::SharedHold
            guest{}; // the scene that came with it; null: one of the server's
    };
    // As HttpSite::answerLater.
    [[nodiscard]] HttpSite::CallOff answer(const Asked& asked,
                                           const std::function<void(LateAnswer)>& done);

  private:
    using Done = std::function<void(LateAnswer)>;
    // Of one who asked while the first scene was loaded.
    struct Early {
        std::string account;
        TimePoint due{};
        Done done;
        std::function<HttpSite::CallOff()> ask; // again, when it is there
        std::mutex mutex;
        bool called_off = false;
        HttpSite::CallOff call_off; // of what was asked again
    };

    // None where too many wait.
    [[nodiscard]] std::optional<HttpSite::CallOff> waitForScene(std::shared_ptr<Early> early);
    [[nodiscard]] HttpSite::CallOff
    draw(const Serving& serving, const Asked& asked, const Done& done) const;
    [[nodiscard]] std::variant<WantedStill, Response> read(const Asked& asked) const;
    [[nodiscard]] std::string
    tagOf(const Serving& serving, const Asked& asked, const WantedStill& wanted) const;
    // How what was asked of the desk is answered, with these headers.
    using Tagged = std::function<Response(Response)>;
    [[nodiscard]] HttpSite::CallOff drawOne(const Serving& serving,
                                            const Asked& asked,
                                            WantedStill wanted,
                                            const Tagged& tagged,
                                            const Done& done) const;
    [[nodiscard]] HttpSite::CallOff drawSeries(const Serving& serving,
                                               const Asked& asked,
                                               WantedStill wanted,
                                               const Tagged& tagged,
                                               const Done& done) const;
    [[nodiscard]] std::string sceneTag(const std::string& scene) const;
    // Whether the address itself goes by the scene's version, as the listing has it.
    [[nodiscard]] bool lasts(const Request& request, const still::StillRequest& still) const;

    const std::shared_ptr<still::StillDesk> desk_;
    const std::shared_ptr<const catalogue::Catalogue> catalogue_;
    const std::shared_ptr<const Service> service_;
    LongWork& long_work_;
    const std::string run_; // another one each time that a server starts
    std::function<void(TimePoint)> alarm_ = [](TimePoint /*due*/) {};
    std::mutex mutex_;
    std::list<std::shared_ptr<Early>> early_; // the oldest first
};

} // namespace froxel::net
