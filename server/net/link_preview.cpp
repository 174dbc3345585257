#include "net/link_preview.h"

#include "net/request_form.h"
#include "net/still_answers.h"
#include "settings/settings.h"
#include "still/still_view.h"

#include <boost/url/encode.hpp>
#include <boost/url/parse.hpp>
#include <boost/url/rfc/unreserved_chars.hpp>
#include <spdlog/fmt/fmt.h>

#include <string>

namespace froxel::net {

namespace http = boost::beast::http;

namespace {

constexpr settings::Size kSize{1200, 630}; // that previews are made for

// None of its characters means anything to HTML or to a query.
std::string escaped(const std::string& text) {
    return boost::urls::encode(text, boost::urls::unreserved_chars);
}

void append(std::string& query, const std::string& name, const std::string& text) {
    query += (query.empty() ? "" : "&amp;") + escaped(name) + "=" + escaped(text);
}

std::string pictureTags(const std::string& url) {
    return fmt::format(R"(<meta property="og:image" content="{}">
<meta property="og:image:width" content="{}">
<meta property="og:image:height" content="{}">
<meta name="twitter:card" content="summary_large_image">
)",
                       url, kSize.width_px, kSize.height_px);
}

} // namespace

Response linkPreview(const Request& request, bool secure, bool pictures) {
    const auto target = targetOf(request);
    if (!target) {
        return textResponse(http::status::bad_request, "the address is malformed");
    }
    std::string page;     // behind "?"
    std::string fragment; // behind "#"
    std::string still;
    for (const auto& said : target->params()) {
        if (said.key == "room") {
            page.clear();
            append(page, said.key, said.value);
            continue;
        }
        if (said.key.empty() && !said.has_value) { // nothing between two &
            continue;
        }
        append(fragment, said.key, said.value);
        // What others add to links (fbclid, utm_source) is the page's to tell of.
        if (said.key == "scene" || (said.key != "size" && still::isViewName(said.key))) {
            append(still, said.key, said.value);
        }
    }
    append(still, "size", fmt::format("{}x{}", kSize.width_px, kSize.height_px));
    const std::string to = "./" + (page.empty() ? "" : "?" + page) + "#" + fragment;
    // An address of HTML's has to be whole here.
    const auto field = request[http::field::host];
    const auto host = boost::urls::parse_authority({field.data(), field.size()});
    const std::string tags =
        pictures && host && !host->host().empty()
            ? pictureTags(fmt::format("{}://{}{}?{}", secure ? "https" : "http",
                                      std::string(host->encoded_host_and_port()), kStillPath,
                                      still))
            : std::string();
    Response response = makeResponse(http::status::ok, "text/html; charset=utf-8",
                                     fmt::format(R"(<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<title>Froxel</title>
<link rel="icon" href="./favicon.svg" type="image/svg+xml">
<meta property="og:type" content="website">
<meta property="og:title" content="Froxel">
<meta property="og:description" content="An interactive view of a scene">
{0}<meta http-equiv="refresh" content="0; url={1}">
<p><a href="{1}">Open this view</a></p>
</html>
)",
                                                 tags, to));
    response.set(http::field::cache_control, "no-cache");
    return response;
}

} // namespace froxel::net
