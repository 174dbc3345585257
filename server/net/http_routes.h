// What the server answers to a plain HTTP request: the page, its health, its metrics, or an error.
// Any thread.
#pragma once

#include "net/site.h"

#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>

#include <string>

namespace froxel::net {

using Request = boost::beast::http::request<boost::beast::http::empty_body>;
using Response = boost::beast::http::response<boost::beast::http::string_body>;

inline constexpr std::string_view kSocketPath = "/ws";

// The path of a request's target, without the query.
[[nodiscard]] std::string_view pathOf(const Request& request);

// Routes that are not an upgrade. HEAD gets the headers of GET.
[[nodiscard]] Response respond(const Request& request, const Site& site);

// An error with one line of text for a person; closes the connection.
[[nodiscard]] Response refusal(boost::beast::http::status status, std::string line);

} // namespace froxel::net
