// A request's header as HttpSession reads it, answered by both addresses: routes, files, origins.
#include "core/assert.h"
#include "fuzz/target.h"
#include "net/admin_site.h"
#include "net/http_session.h"
#include "net/public_site.h"
#include "support/temp_folder.h"

#include <boost/beast/websocket/rfc6455.hpp>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cctype>
#include <fstream>

namespace froxel::fuzz {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;

// Of several lines: no request can carry it into a refusal, which quotes an origin.
constexpr std::string_view kOutside = "a file beside\nthe page's folder";
constexpr std::string_view kListedOrigin = "https://listed.example";

std::string_view viewOf(beast::string_view text) {
    return {text.data(), text.size()};
}

net::StaticFiles makePage() {
    const test::TempFolder folder("froxel_fuzz_http");
    const auto root = folder.path() / "page";
    std::filesystem::create_directories(root / "assets");
    std::ofstream(root / "index.html") << "<!doctype html>";
    std::ofstream(root / "assets" / "app-1.js") << "let a;";
    std::ofstream(folder.path() / "secret.html") << kOutside;
    std::filesystem::create_symlink(folder.path() / "secret.html", root / "link.html");
    return net::StaticFiles::load(root).value();
}

struct Sites {
    Sites() {
        spdlog::set_level(spdlog::level::off);
        auto parts = std::make_shared<net::Site>();
        parts->files = makePage();
        parts->allowed_origins = {std::string(kListedOrigin)};
        parts->service = std::make_shared<net::Service>();
        parts->metrics = std::make_shared<net::Metrics>();
        parts->content_policy = net::contentPolicy({});
        FROXEL_ASSERT(parts->files.count() == 2, "links are left out");
        admin = std::make_unique<net::AdminSite>(parts->metrics, parts->service,
                                                 net::AdminHooks{[] { return true; }, [] {}});
        open = std::make_unique<net::PublicSite>(parts);
    }
    std::unique_ptr<net::PublicSite> open;
    std::unique_ptr<net::AdminSite> admin;
};

void expectSound(const net::Response& response) {
    for (const auto& field : response) {
        FROXEL_ASSERT(viewOf(field.value()).find_first_of("\r\n") == std::string_view::npos,
                      "a header is one line");
    }
    FROXEL_ASSERT(response.count("Content-Security-Policy") == 1 &&
                      response.count("X-Content-Type-Options") == 1,
                  "every answer has the security headers");
    FROXEL_ASSERT(response.body().find(kOutside) == std::string::npos, "a file from outside");
    if (response.result_int() >= 400 && !response.body().empty() &&
        response[http::field::content_type].starts_with("text/plain")) {
        const std::string_view body = response.body();
        FROXEL_ASSERT(body.back() == '\n' && isOneLine(body.substr(0, body.size() - 1)),
                      "a refusal is one line");
    }
}

void answer(const net::Request& request, const net::HttpSite& site) {
    const net::Response response = net::respond(request, site, {});
    expectSound(response);
    const bool page = response[http::field::content_type].starts_with("text/html");
    if (page && response.result() == http::status::ok) {
        const std::string_view path = net::pathOf(request);
        FROXEL_ASSERT(path == "/" || path == "/index.html", "the page at another path");
    }
    FROXEL_ASSERT(request.method() != http::verb::head || response.body().empty(),
                  "HEAD has no body");
}

std::string lowered(std::string_view text) {
    std::string out(text);
    std::transform(out.begin(), out.end(), out.begin(), [](unsigned char c) {
        return static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
    });
    return out;
}

// What origin.h says, in other words.
void expectOwnOrigin(const net::Request& request) {
    FROXEL_ASSERT(net::pathOf(request) == net::kSocketPath, "a WebSocket at another path");
    const auto found = request.find(http::field::origin);
    if (found == request.end()) {
        return;
    }
    const std::string origin = lowered(viewOf(found->value()));
    const std::string host = lowered(viewOf(request[http::field::host]));
    const bool own = !host.empty() && (origin == "http://" + host || origin == "https://" + host);
    FROXEL_ASSERT(own || origin == kListedOrigin, "another site's page was let in");
}

void ask(const net::Request& request, const Sites& sites) {
    if (!beast::websocket::is_upgrade(request)) {
        answer(request, *sites.open);
        answer(request, *sites.admin);
        return;
    }
    FROXEL_ASSERT(sites.admin->refuseUpgrade(request, {}), "the admin address has no WebSocket");
    if (const auto refused = sites.open->refuseUpgrade(request, {})) {
        expectSound(*refused);
    } else {
        expectOwnOrigin(request);
    }
}

} // namespace
} // namespace froxel::fuzz

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace froxel;
    static const fuzz::Sites sites;
    fuzz::http::request_parser<fuzz::http::empty_body> parser;
    parser.header_limit(net::HttpSession::kMaxHeaderBytes);
    parser.body_limit(boost::none);
    boost::beast::error_code error;
    parser.put(boost::asio::buffer(data, size), error);
    if (!error && parser.is_header_done() && parser.is_done()) {
        fuzz::ask(parser.release(), sites);
    }
    return 0;
}
