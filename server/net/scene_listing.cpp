#include "net/scene_listing.h"

#include "core/text.h"
#include "net/request_form.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <optional>
#include <string>
#include <utility>

namespace froxel::net {

namespace http = boost::beast::http;
using Json = nlohmann::ordered_json;

namespace {

Response refused(http::status status, const char* code, const char* field, std::string message) {
    return apiRefusal(status, {code, field, std::move(message)});
}

const char* wordOf(session::SceneStanding standing) {
    switch (standing) {
    case session::SceneStanding::kUnknown: // it has just gone
    case session::SceneStanding::kOffered:
        return "offered";
    case session::SceneStanding::kLoading:
        return "loading";
    case session::SceneStanding::kReady:
        break;
    }
    return "ready";
}

Json jsonOf(const session::SceneContents& contents) {
    return {{"file_bytes", contents.file_bytes}, {"triangles", contents.triangles},
            {"materials", contents.materials},   {"textures", contents.textures},
            {"lights", contents.lights},         {"cameras", contents.cameras},
            {"animations", contents.animations}};
}

Json jsonOf(const catalogue::Offered& scene, const session::SceneReport& report) {
    const std::filesystem::path source(scene.source);
    std::string kind = scene.source == "builtin" ? "builtin" : source.extension().string();
    if (kind.starts_with('.')) {
        kind.erase(0, 1);
    }
    Json row{
        {"id", scene.id},
        {"name", scene.name},
        {"path", scene.path},
        {"kind", std::move(kind)},
        {"bytes", scene.bytes},
        {"thumb", fmt::format("{}/{}{}?v={:x}", kScenesPath, scene.id, kThumbnail, scene.version)},
        {"state", wordOf(report.standing)}};
    if (scene.modified_s > 0) {
        row["modified"] = scene.modified_s;
    }
    if (report.standing == session::SceneStanding::kLoading) {
        row["stage"] = report.progress.stage;
        row["fraction"] = report.progress.fraction;
    }
    if (report.contents) {
        row["holds"] = jsonOf(*report.contents);
    }
    return row;
}

// What a listing is asked for.
struct Page {
    size_t begin = 0;
    size_t limit = SceneListing::kUsualLimit;
};

std::optional<size_t> limitIn(const std::string& text) {
    size_t limit = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), limit);
    const bool whole = problem == std::errc() && end == text.data() + text.size();
    return whole && limit >= 1 && limit <= SceneListing::kMostLimit ? std::optional(limit)
                                                                    : std::nullopt;
}

// An error is the answer.
std::variant<Page, Response> pageIn(const Request& request, const catalogue::Listing& listing) {
    Page page;
    const auto target = targetOf(request);
    if (!target) {
        return page;
    }
    for (const auto& said : target->params()) {
        if (said.key == "limit") {
            const auto limit = limitIn(said.value);
            if (!limit) {
                return refused(http::status::bad_request, "out_of_range", "limit",
                               "limit is \"" + printable(said.value) + "\"; it must be from 1 to " +
                                   numberText(SceneListing::kMostLimit));
            }
            page.limit = *limit;
        } else if (said.key == "after") {
            const auto begin = listing.placeAfter(said.value);
            if (!begin) {
                return refused(http::status::bad_request, "out_of_range", "after",
                               "after is \"" + printable(said.value) +
                                   "\", which is not a scene of this server");
            }
            page.begin = *begin;
        }
    }
    return page;
}

Response withTag(const Request& request, const std::string& body) {
    Response response = taggedResponse(request, "application/json", body, etagOf(body));
    response.set(http::field::cache_control, "no-cache");
    return response;
}

} // namespace

bool SceneListing::has(std::string_view path) {
    return path == kScenesPath ||
           (path.starts_with(kScenesPath) && path.substr(kScenesPath.size()).starts_with('/'));
}

Response SceneListing::answer(const Request& request, std::string_view path) const {
    if (!catalogue_) {
        return refused(http::status::not_found, "unsupported", "",
                       "this server has one scene (froxel serve --scenes)");
    }
    const auto serving = service_->status().serving;
    const session::ScenePort* port = serving ? serving->scenes : nullptr;
    const auto listing = catalogue_->listing();
    if (path != kScenesPath) {
        const std::string id(path.substr(kScenesPath.size() + 1));
        const auto place = listing->placeOf(id);
        if (!place) {
            return refused(http::status::not_found, "out_of_range", "scene",
                           "\"" + printable(id) + "\" is not a scene of this server");
        }
        const std::lock_guard lock(mutex_);
        return withTag(request, rowOf(*listing, *place, port));
    }
    auto asked = pageIn(request, *listing);
    if (auto* error = std::get_if<Response>(&asked)) {
        return std::move(*error);
    }
    const auto& [begin, limit] = std::get<Page>(asked);
    const auto& scenes = listing->scenes();
    const size_t end = std::min(scenes.size(), begin + limit);
    std::string body = R"({"scenes":[)"; // and JSON texts one after another
    {
        const std::lock_guard lock(mutex_);
        for (size_t i = begin; i < end; ++i) {
            body += i > begin ? "," : "";
            body += rowOf(*listing, i, port);
        }
    }
    body += end < scenes.size() // as `after`
                ? R"(],"next":)" + textOf(Json(scenes[end - 1].id)) + "}"
                : "]}";
    return withTag(request, body);
}

const std::string& SceneListing::rowOf(const catalogue::Listing& listing,
                                       size_t place,
                                       const session::ScenePort* port) const {
    if (generation_ != listing.generation()) {
        generation_ = listing.generation();
        rows_.assign(listing.scenes().size(), {});
    }
    const catalogue::Offered& scene = listing.scenes()[place];
    const auto report = port != nullptr ? port->reportOf(scene.id) : session::SceneReport();
    Row& row = rows_[place];
    const bool same = row.standing == report.standing && row.contents == report.contents &&
                      report.standing != session::SceneStanding::kLoading;
    if (row.text.empty() || !same) {
        row = {report.standing, report.contents, textOf(jsonOf(scene, report))};
    }
    return row.text;
}

} // namespace froxel::net
