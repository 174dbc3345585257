#include "net/still_series.h"

#include "net/scene_facts.h"
#include "still/picture_facts.h"
#include "still/sheet.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <utility>

namespace froxel::net {

namespace {

still::StillRefusal refusalOf(const Error& error) {
    const bool capacity = error.code == ErrorCode::kCapacity;
    return {{capacity ? session::RejectCode::kCapacity : session::RejectCode::kUnsupported, 0,
             capacity ? "size" : "", error.message}};
}

constexpr const char* kDebugView = "debug_view";
constexpr const char* kSurveyView = "instances"; // settings::kDebugViewNames

bool isDebugView(const still::Entry& entry) {
    return entry.name == kDebugView;
}

} // namespace

StillSeries::StillSeries(Plan plan,
                         std::shared_ptr<still::StillDesk> desk,
                         LongWork& long_work,
                         std::optional<session::Account> account,
                         std::function<void(Made)> done)
    : plan_(std::move(plan)), desk_(std::move(desk)), long_work_(long_work),
      account_(std::move(account)), done_(std::move(done)), pictures_(count()),
      missing_(pictures_.size()) {}

size_t StillSeries::count() const {
    const bool surveyed = !plan_.sheet && std::ranges::none_of(plan_.request.view, isDebugView);
    return plan_.views.size() * (surveyed ? 2 : 1);
}

still::StillRequest StillSeries::requestOf(size_t place) const {
    still::StillRequest request = plan_.request;
    const std::string name(plan_.views[place % plan_.views.size()]->name);
    request.view.push_back({"view", name});
    request.tag += "\nview=" + name;
    if (place >= plan_.views.size()) {
        request.view.push_back({kDebugView, kSurveyView});
        request.tag += "\n" + std::string(kSurveyView);
    }
    request.codec = settings::Codec::kPng;
    request.kept = false; // each is drawn, and so it is known of what
    return request;
}

HttpSite::CallOff StillSeries::start(const still::StillSource& source, TimePoint now) {
    const size_t all = count();
    for (size_t place = 0; place < all; ++place) {
        const auto ticket = desk_->ask(
            source, requestOf(place), account_,
            [self = shared_from_this(), place](still::StillOutcome outcome) {
                self->put(place, std::move(outcome));
            },
            now);
        const std::lock_guard lock(mutex_);
        if (over_) {
            break;
        }
        tickets_.push_back(ticket);
    }
    return [self = shared_from_this()] { self->callOff(); };
}

void StillSeries::put(size_t place, still::StillOutcome outcome) {
    auto* refusal = std::get_if<still::StillRefusal>(&outcome);
    {
        const std::lock_guard lock(mutex_);
        if (over_) {
            return;
        }
        if (refusal == nullptr) {
            pictures_[place] = std::move(std::get<still::StillPicture>(outcome));
            if (--missing_ > 0) {
                return;
            }
        }
    }
    if (refusal != nullptr) {
        callOff();
        done_(std::move(*refusal));
        return;
    }
    long_work_.post([self = shared_from_this()] { self->make(); });
}

void StillSeries::callOff() {
    std::vector<still::StillDesk::Ticket> tickets;
    {
        const std::lock_guard lock(mutex_);
        over_ = true;
        tickets.swap(tickets_);
    }
    for (const auto ticket : tickets) { // those that were answered are nobody's any more
        desk_->cancel(ticket);
    }
}

void StillSeries::make() {
    std::vector<still::StillPicture> pictures;
    {
        const std::lock_guard lock(mutex_);
        if (std::exchange(over_, true)) {
            return;
        }
        pictures.swap(pictures_);
    }
    Made made = plan_.sheet ? sheet(pictures) : facts(pictures);
    pictures.clear();
    done_(std::move(made));
}

StillSeries::Made StillSeries::sheet(std::span<const still::StillPicture> pictures) const {
    std::vector<still::SheetPart> parts;
    for (size_t place = 0; place < pictures.size(); ++place) {
        parts.push_back({std::string(plan_.views[place]->name), pictures[place].bytes});
    }
    settings::Encoding encoding = pictures.front().encoding;
    encoding.codec = *plan_.sheet;
    const auto bytes = still::makeSheet(parts, encoding);
    if (!bytes) {
        return refusalOf(bytes.error());
    }
    auto held = desk_->hold(*bytes, account_, Clock::now());
    if (auto* refusal = std::get_if<still::StillRefusal>(&held)) {
        return std::move(*refusal);
    }
    return std::get<still::StillPicture>(held).bytes;
}

StillSeries::Made StillSeries::facts(std::span<const still::StillPicture> pictures) const {
    nlohmann::ordered_json json = factsOf(pictures.front().scene->scene);
    const size_t views = plan_.views.size();
    for (size_t place = 0; place < views; ++place) {
        const auto facts = still::factsOf(pictures[place].bytes);
        if (!facts) {
            return refusalOf(facts.error());
        }
        nlohmann::ordered_json view{{"view", plan_.views[place]->name}};
        if (pictures.size() > views) {
            const auto covered = still::coveredPixels(pictures[views + place].bytes);
            if (!covered) {
                return refusalOf(covered.error());
            }
            view.update(coverageOf(pictures.front().scene->scene, *covered));
        }
        view["near_black"] = facts->near_black;
        view["near_white"] = facts->near_white;
        json["views"].push_back(std::move(view));
    }
    return textOf(json);
}

} // namespace froxel::net
