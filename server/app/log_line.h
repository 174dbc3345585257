// One line of the log, from what was logged to what is written. Pure.
//
// Events are logged as `event=NAME key=value ...`, values made safe by logValue(); anything else is
// a message in words.
#pragma once

#include <string>
#include <string_view>

namespace froxel::app {

// The event's name; empty for a message in words.
[[nodiscard]] std::string_view eventOf(std::string_view payload);

// `payload` as one line of at most some 4 KB: control characters and bytes beyond ASCII as \xNN.
[[nodiscard]] std::string textLine(std::string_view payload);

// The same as the fields of a JSON object, without its braces: `"event":"hello","session":3` or
// `"message":"in words"`. Values that are plain integers stay numbers.
[[nodiscard]] std::string jsonFields(std::string_view payload);

} // namespace froxel::app
