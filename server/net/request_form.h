// A request as whoever answers it reads it: each list in one line, its target a path.
#pragma once

#include "core/error.h"
#include "net/http_site.h"

#include <boost/url/url_view.hpp>

namespace froxel::net {

// Joins the lines of each field that is a list (RFC 9110 section 5.3). A target in absolute form
// (RFC 9112 section 3.2.2) becomes its path and query, and its authority the Host, whatever that
// was. Errors: kInvalidArgument, for what has two meanings; kUnsupported, for a transfer coding.
// Pure.
[[nodiscard]] Result<void> settleForm(Request& request);

// Its path and query; views the request. Errors: it is malformed. Pure.
[[nodiscard]] boost::system::result<boost::urls::url_view> targetOf(const Request& request);

} // namespace froxel::net
