#include "net/uploads.h"

#include "core/text.h"
#include "net/scene_listing.h"

#include <boost/beast/core/string.hpp>
#include <nlohmann/json.hpp>
#include <spdlog/fmt/chrono.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <openssl/evp.h>
#include <span>
#include <utility>
#include <vector>

namespace froxel::net {

namespace http = boost::beast::http;
using guest::GuestStore;
using guest::StoreRefusal;
using guest::StoreResult;
using Json = nlohmann::ordered_json;
using Why = StoreRefusal::Why;

namespace {

constexpr std::string_view kTusVersion = "1.0.0";
constexpr uint64_t kMostAnnouncementBytes = uint64_t{256} * 1024;

GuestStore::Time now() {
    return std::chrono::system_clock::now();
}

void set(Response& response, const char* field, std::string_view value) {
    response.set(field, boost::beast::string_view(value.data(), value.size()));
}

// RFC 9110, 5.6.7, and RFC 3339.
std::string httpDateOf(GuestStore::Time time) {
    return fmt::format("{:%a, %d %b %Y %H:%M:%S GMT}",
                       fmt::gmtime(std::chrono::system_clock::to_time_t(time)));
}
std::string jsonDateOf(GuestStore::Time time) {
    return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}",
                       fmt::gmtime(std::chrono::system_clock::to_time_t(time)));
}

struct Told {
    http::status status;
    const char* code;
};

Told toldOf(Why why) {
    switch (why) {
    case Why::kMalformed:
        return {http::status::bad_request, "malformed"};
    case Why::kTooLarge:
        return {http::status::payload_too_large, "out_of_range"};
    case Why::kAccount:
        return {http::status::too_many_requests, "rate_limit"};
    case Why::kFull:
        return {http::status::insufficient_storage, "capacity"};
    case Why::kUnknown:
        return {http::status::not_found, "out_of_range"};
    case Why::kBusy:
        return {http::status::locked, "capacity"};
    case Why::kOffset:
        return {http::status::conflict, "out_of_range"};
    case Why::kDisk:
        break;
    }
    return {http::status::internal_server_error, "capacity"};
}

Response withTus(Response response) {
    set(response, "Tus-Resumable", kTusVersion);
    return response;
}

Response refused(const StoreRefusal& refusal) {
    const auto [status, code] = toldOf(refusal.why);
    Response response = withTus(apiRefusal(status, {code, refusal.field, refusal.message}));
    if (refusal.why == Why::kAccount) {
        response.set(http::field::retry_after, "60");
    }
    return response;
}

Response refused(Why why, std::string field, std::string message) {
    return refused(StoreRefusal{why, std::move(field), std::move(message)});
}

Response uploadsAreOff() {
    return apiRefusal(http::status::forbidden,
                      {"unsupported", "", "this server takes no uploads (froxel serve --uploads)"});
}

// Why a request is none of tus 1.0.0; none: it is.
std::optional<Response> refuseVersion(const Request& request) {
    if (request["Tus-Resumable"] ==
        boost::beast::string_view(kTusVersion.data(), kTusVersion.size())) {
        return {};
    }
    Response response = withTus(
        apiRefusal(http::status::precondition_failed,
                   {"version", "Tus-Resumable",
                    "Tus-Resumable is \"" + printable(std::string(request["Tus-Resumable"])) +
                        "\"; expected 1.0.0"}));
    set(response, "Tus-Version", kTusVersion);
    return response;
}

std::optional<uint64_t> numberIn(const Request& request, const char* field) {
    const std::string_view text = viewOf(request[field]);
    uint64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size() && !text.empty()
               ? std::optional(number)
               : std::nullopt;
}

// RFC 4648, 4; none: it is no such text.
std::optional<std::string> fromBase64(std::string_view text) {
    std::string bytes(text.size() / 4 * 3, '\0');
    const int size = EVP_DecodeBlock(reinterpret_cast<unsigned char*>(bytes.data()),
                                     reinterpret_cast<const unsigned char*>(text.data()),
                                     static_cast<int>(text.size()));
    if (size < 0 || text.size() % 4 != 0) {
        return {};
    }
    const size_t padding = text.ends_with("==") ? 2 : text.ends_with('=') ? 1 : 0;
    bytes.resize(static_cast<size_t>(size) - padding);
    return bytes;
}

// Of "filename c2NlbmUuZ2xi,other dGV4dA=="; none: it names no file.
std::optional<std::string> filenameIn(const Request& request) {
    constexpr std::string_view kKey = "filename ";
    std::string_view metadata = viewOf(request["Upload-Metadata"]);
    while (!metadata.empty()) {
        const std::string_view entry = metadata.substr(0, metadata.find(','));
        metadata.remove_prefix(std::min(metadata.size(), entry.size() + 1));
        const std::string_view pair =
            entry.substr(std::min(entry.find_first_not_of(' '), entry.size()));
        if (pair.starts_with(kKey)) {
            return fromBase64(pair.substr(kKey.size()));
        }
    }
    return {};
}

std::string placeOf(const std::string& upload) {
    return std::string(kUploadsPath) + "/" + upload;
}

std::string uploadIn(std::string_view path) {
    return path.size() > kUploadsPath.size() ? std::string(path.substr(kUploadsPath.size() + 1))
                                             : std::string();
}

Response announced(const GuestStore::Announced& files, const GuestStore::Begun& begun) {
    Json body{{"id", begun.id}, {"owner_key", begun.owner_key}, {"files", Json::array()}};
    for (size_t place = 0; place < files.files.size(); ++place) {
        body["files"].push_back({{"path", files.files[place].name},
                                 {"bytes", files.files[place].size_bytes},
                                 {"upload", placeOf(begun.uploads[place])}});
    }
    Response response = makeResponse(http::status::created, "application/json", textOf(body));
    set(response, "Location", std::string(kScenesPath) + "/" + begun.id);
    return response;
}

// {"files": [{"path": "a.glb", "bytes": 4}]}
std::variant<GuestStore::Announced, Response> readAnnouncement(std::string_view text) {
    const Json json = Json::parse(text, nullptr, false);
    const auto files = json.is_object() ? json.find("files") : json.end();
    if (json.is_discarded() || !json.is_object() || files == json.end() || !files->is_array()) {
        return refused(
            Why::kMalformed, "files",
            R"(the body is no announcement; expected {"files": [{"path": …, "bytes": …}]})");
    }
    GuestStore::Announced announced;
    for (const Json& entry : *files) {
        const bool whole = entry.is_object() && entry.contains("path") && entry.contains("bytes") &&
                           entry["path"].is_string() && entry["bytes"].is_number_unsigned();
        if (!whole) {
            const std::string field = fmt::format("files[{}]", announced.files.size());
            return refused(Why::kMalformed, field, field + " needs a path and a number of bytes");
        }
        announced.files.push_back({entry["path"], entry["bytes"]});
    }
    return announced;
}

} // namespace

class Uploads::Announcement final : public RequestBody {
  public:
    Announcement(std::shared_ptr<GuestStore> store, std::string account)
        : store_(std::move(store)), account_(std::move(account)) {}

    std::optional<Response> take(std::span<const std::byte> bytes) override {
        text_.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        return {};
    }
    std::function<void()> complete(std::function<void(LateAnswer)> done) override {
        auto read = readAnnouncement(text_);
        if (auto* refusal = std::get_if<Response>(&read)) {
            done({std::move(*refusal)});
            return [] {};
        }
        const auto& files = std::get<GuestStore::Announced>(read);
        const auto begun = store_->begin(files, account_, now());
        done({begun ? announced(files, *begun) : refused(begun.error())});
        return [] {};
    }
    bool waits() const override { return true; }

  private:
    const std::shared_ptr<GuestStore> store_;
    const std::string account_;
    std::string text_;
};

class Uploads::Part final : public RequestBody {
  public:
    explicit Part(std::unique_ptr<GuestStore::Upload> upload) : upload_(std::move(upload)) {}

    std::optional<Response> take(std::span<const std::byte> bytes) override {
        const auto taken = upload_->append(bytes, now());
        return taken ? std::nullopt : std::optional(refused(taken.error()));
    }
    std::function<void()> complete(std::function<void(LateAnswer)> done) override {
        const auto ended = upload_->end(now());
        upload_.reset(); // the next part may come with the answer
        if (!ended) {
            done({refused(ended.error())});
            return [] {};
        }
        Response response = withTus(makeResponse(http::status::no_content, "text/plain", {}));
        set(response, "Upload-Offset", numberText(ended->offset));
        set(response, "Upload-Expires", httpDateOf(ended->expires));
        done({std::move(response)});
        return [] {};
    }
    bool waits() const override { return true; }

  private:
    std::unique_ptr<GuestStore::Upload> upload_;
};

HttpSite::Received Uploads::announce(const Account& account, uint64_t size_bytes) const {
    if (!store_) {
        return uploadsAreOff();
    }
    if (size_bytes == 0 || size_bytes > kMostAnnouncementBytes) {
        return refused(size_bytes == 0 ? Why::kMalformed : Why::kTooLarge, "",
                       fmt::format("the body has {} bytes; expected 1 to {}", size_bytes,
                                   kMostAnnouncementBytes));
    }
    return std::make_unique<Announcement>(store_, account ? account->key : "");
}

HttpSite::Received
Uploads::create(const Request& request, const Account& account, uint64_t size_bytes) const {
    if (!store_) {
        return uploadsAreOff();
    }
    if (auto refusal = refuseVersion(request)) {
        return std::move(*refusal);
    }
    const auto length = numberIn(request, "Upload-Length");
    const auto filename = filenameIn(request);
    if (!length || !filename || size_bytes != 0) {
        const char* const field = !length ? "Upload-Length" : !filename ? "Upload-Metadata" : "";
        return refused(
            Why::kMalformed, field,
            "a creation needs Upload-Length, a filename in Upload-Metadata, and no body");
    }
    class Creation final : public RequestBody {
      public:
        Creation(std::shared_ptr<GuestStore> store, std::string account, GuestStore::Announced file)
            : store_(std::move(store)), account_(std::move(account)), file_(std::move(file)) {}
        std::optional<Response> take(std::span<const std::byte> /*none*/) override { return {}; }
        std::function<void()> complete(std::function<void(LateAnswer)> done) override {
            const auto begun = store_->begin(file_, account_, now());
            if (!begun) {
                done({refused(begun.error())});
                return [] {};
            }
            Response response = withTus(makeResponse(http::status::created, "text/plain", {}));
            set(response, "Location", placeOf(begun->uploads.front()));
            set(response, "Upload-Expires", httpDateOf(begun->expires));
            set(response, "Froxel-Scene", begun->id);
            response.set(boost::beast::string_view(kOwnerKeyField.data(), kOwnerKeyField.size()),
                         begun->owner_key);
            done({std::move(response)});
            return [] {};
        }
        bool waits() const override { return true; }

      private:
        const std::shared_ptr<GuestStore> store_;
        const std::string account_;
        const GuestStore::Announced file_;
    };
    return std::make_unique<Creation>(store_, account ? account->key : "",
                                      GuestStore::Announced{{{*filename, *length}}});
}

HttpSite::Received
Uploads::receive(const Request& request, std::string_view path, uint64_t size_bytes) const {
    if (!store_) {
        return uploadsAreOff();
    }
    if (auto refusal = refuseVersion(request)) {
        return std::move(*refusal);
    }
    if (request[http::field::content_type] != "application/offset+octet-stream") {
        return withTus(apiRefusal(http::status::unsupported_media_type,
                                  {"unsupported", "Content-Type",
                                   "Content-Type must be application/offset+octet-stream"}));
    }
    const auto offset = numberIn(request, "Upload-Offset");
    if (!offset) {
        return refused(Why::kMalformed, "Upload-Offset", "Upload-Offset must be a number");
    }
    const std::string upload = uploadIn(path);
    const auto standing = store_->standingOf(upload);
    if (standing && *offset == standing->offset &&
        size_bytes > standing->size_bytes - standing->offset) {
        return refused(Why::kTooLarge, "",
                       fmt::format("the body has {} bytes; {} are missing", size_bytes,
                                   standing->size_bytes - standing->offset));
    }
    auto opened = store_->open(upload, *offset, now());
    if (!opened) {
        return refused(opened.error());
    }
    return std::make_unique<Part>(std::move(*opened));
}

HttpSite::CallOff
Uploads::answer(const Request& request, std::string_view path, const Done& done) const {
    const auto nothing = [] {};
    const bool asks = request.method() == http::verb::options;
    if (!store_) { // who asks whether there are some has made no mistake
        done({asks ? makeResponse(http::status::no_content, "text/plain", {}) : uploadsAreOff()});
        return nothing;
    }
    Response response = withTus(makeResponse(http::status::no_content, "text/plain", {}));
    if (asks) {
        set(response, "Tus-Version", kTusVersion);
        set(response, "Tus-Extension", "creation,termination,expiration");
        set(response, "Tus-Max-Size", numberText(store_->limits().file_bytes));
        done({std::move(response)});
        return nothing;
    }
    if (auto refusal = refuseVersion(request)) {
        done({std::move(*refusal)});
        return nothing;
    }
    const std::string upload = uploadIn(path);
    if (request.method() == http::verb::delete_) {
        long_work_.post([store = store_, upload, response, done] {
            const auto gone = store->terminate(upload);
            done({gone ? response : refused(gone.error())});
        });
        return nothing;
    }
    const auto standing = store_->standingOf(upload);
    if (!standing) {
        done({refused(standing.error())});
        return nothing;
    }
    response.result(http::status::ok);
    set(response, "Upload-Offset", numberText(standing->offset));
    set(response, "Upload-Length", numberText(standing->size_bytes));
    set(response, "Upload-Expires", httpDateOf(standing->expires));
    done({std::move(response)});
    return nothing;
}

std::optional<Response> Uploads::answerScene(const std::string& id) const {
    const auto facts = store_ ? store_->factsOf(id) : std::nullopt;
    if (!facts) {
        return {};
    }
    const bool ready = facts->state == GuestStore::State::kReady;
    return makeResponse(http::status::ok, "application/json",
                        textOf(Json{{"id", id},
                                    {"name", facts->name},
                                    {"kind", "upload"},
                                    {"bytes", facts->size_bytes},
                                    {"received", facts->received_bytes},
                                    {"state", ready ? "ready" : "receiving"},
                                    {"expires", jsonDateOf(facts->expires)}}));
}

HttpSite::CallOff
Uploads::removeScene(const Request& request, const std::string& id, const Done& done) const {
    const auto key =
        request[boost::beast::string_view(kOwnerKeyField.data(), kOwnerKeyField.size())];
    if (!store_) {
        done({uploadsAreOff()});
        return [] {};
    }
    long_work_.post([store = store_, id, key = std::string(key), done] {
        // One answer to who has a wrong key and to who guesses an id.
        done({store->remove(id, key)
                  ? makeResponse(http::status::no_content, "text/plain", {})
                  : refused(Why::kUnknown, "scene",
                            "scene is none that this " + std::string(kOwnerKeyField) + " owns")});
    });
    return [] {};
}

} // namespace froxel::net
