// Several stills of one scene, of its named views: as one picture, or as facts about them. Any
// thread.
#pragma once

#include "net/http_site.h"
#include "net/long_work.h"
#include "still/named_views.h"
#include "still/still_desk.h"

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <variant>
#include <vector>

namespace froxel::net {

class StillSeries : public std::enable_shared_from_this<StillSeries> {
  public:
    struct Plan {
        std::vector<const still::NamedView*> views; // at least one
        still::StillRequest request;                // of each, but for the view
        std::optional<settings::Codec> sheet;       // none: facts, as JSON
    };
    // The sheet, or the JSON's text.
    using Made = std::variant<SharedBytes, std::string, still::StillRefusal>;

    // `done` is called once, on any thread and maybe within start().
    StillSeries(Plan plan,
                std::shared_ptr<still::StillDesk> desk,
                LongWork& long_work,
                std::optional<session::Account> account,
                std::function<void(Made)> done);
    // What comes back calls it off.
    [[nodiscard]] HttpSite::CallOff start(const still::StillSource& source, TimePoint now);

  private:
    // How many pictures are drawn.
    [[nodiscard]] size_t count() const;
    [[nodiscard]] still::StillRequest requestOf(size_t place) const;
    void put(size_t place, still::StillOutcome outcome);
    void callOff();
    // Of all pictures. They are let go before `done` is called.
    void make();
    [[nodiscard]] Made sheet(std::span<const still::StillPicture> pictures) const;
    [[nodiscard]] Made facts(std::span<const still::StillPicture> pictures) const;

    const Plan plan_;
    const std::shared_ptr<still::StillDesk> desk_;
    LongWork& long_work_;
    const std::optional<session::Account> account_;
    const std::function<void(Made)> done_;
    std::mutex mutex_;
    // By view; behind them, for facts, the instances that each shows. Without bytes: not drawn yet.
    std::vector<still::StillPicture> pictures_;
    std::vector<still::StillDesk::Ticket> tickets_;
    size_t missing_;
    bool over_ = false; // done, or called off
};

} // namespace froxel::net
