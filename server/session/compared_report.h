// What is told of a comparison beside the stream. Pure; any thread.
#pragma once

#include "session/state_message.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <string>

namespace froxel::session {

// {"pixels", "differing", "max", "rmse", "flip", "first": {"x", "y", "left", "right"}, "promised",
// "left_us", "right_us"}; flip is null where it was not measured, first where no pixel differs, and
// times that nobody took are left out.
[[nodiscard]] nlohmann::ordered_json comparedReport(const ComparedRecord& compared,
                                                    uint64_t pixel_count);

// "equal, 230400 pixels compared", or the figures and the first pixel that differs.
[[nodiscard]] std::string wordsOf(const ComparedRecord& compared, uint64_t pixel_count);

} // namespace froxel::session
