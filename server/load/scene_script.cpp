#include "load/scene_script.h"

#include "core/text.h"
#include "load/http_probe.h"

#include <nlohmann/json.hpp>

#include <utility>

namespace froxel::load {
namespace {

constexpr std::chrono::seconds kListingTimeout{10};
// Viewers of one phase would select all at once.
constexpr Seconds kPhase{0.37};
// So long a selection stands before it is called off.
constexpr Seconds kCalledOffAfter{0.2};

Error notListed(const std::string& why) {
    return {ErrorCode::kInvalidArgument, "--script scenes: " + why};
}

} // namespace

Result<std::vector<std::string>> fetchSceneIds(const Target& target, const std::string& token) {
    if (target.tls) {
        return notListed("the list of scenes is fetched without TLS alone; name a ws:// target");
    }
    std::vector<std::string> ids;
    std::string after;
    do {
        Target listing = target;
        listing.resource = "/api/v1/scenes?limit=200" + after;
        const auto answer = probe(listing, kListingTimeout, token);
        if (!answer) {
            return answer.error();
        }
        const auto body = nlohmann::json::parse(answer->body, nullptr, false);
        if (answer->status != 200 || !body.is_object() || !body.contains("scenes")) {
            return notListed("the server answers " + numberText(answer->status) + ": " +
                             answer->line);
        }
        for (const auto& scene : body["scenes"]) {
            ids.push_back(scene.value("id", ""));
        }
        after = body.contains("next") ? "&after=" + body.value("next", "") : "";
    } while (!after.empty());
    return ids;
}

// Two and two play the same, so that scenes are shared.
SceneScript::SceneScript(std::vector<std::string> ids, std::string shown, uint32_t viewer)
    : ids_(std::move(ids)), random_((viewer + 1) / 2), at_(kPhase * (viewer % 8)),
      wanted_(std::move(shown)) {}

std::optional<Step> SceneScript::next() {
    Step step;
    step.at = std::chrono::duration_cast<Clock::duration>(at_);
    size_t pick = random_() % ids_.size();
    if (ids_[pick] == wanted_) {
        pick = (pick + 1) % ids_.size();
    }
    std::string id = ids_[pick];
    if (back_to_) {
        id = *std::exchange(back_to_, std::nullopt);
    } else if (random_() % 4 == 0) {
        back_to_ = wanted_;
    }
    step.message.mutable_select_scene()->set_scene(id);
    wanted_ = std::move(id);
    at_ += back_to_ ? kCalledOffAfter : kSceneStay;
    return step;
}

} // namespace froxel::load
