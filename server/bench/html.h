// The report: a page that was built once, with a result put into it.
#pragma once

#include "core/error.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>

namespace froxel::bench {

// What a template holds exactly once; its "null" is replaced.
inline constexpr std::string_view kResultsPlace =
    R"(<script type="application/json" id="results">null</script>)";

// JSON that may stand in a script element: every '<' is written as \u003c, so that no text ends the
// element or opens a comment.
[[nodiscard]] std::string jsonForScript(const nlohmann::ordered_json& report);

// Errors: kIo when the template has not exactly one place.
[[nodiscard]] Result<std::string> fillReport(std::string_view page,
                                             const nlohmann::ordered_json& report);

} // namespace froxel::bench
