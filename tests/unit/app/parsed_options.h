// Command lines, read or refused.
#pragma once

#include "app/options.h"
#include "app/render_arguments.h"
#include "core/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace froxel::app {

inline Options parse(std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), "froxel");
    return parseOptions(static_cast<int>(arguments.size()), arguments.data());
}

inline RenderOptions parseRender(std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), {"render", "--out", "a.png"});
    return std::get<RenderOptions>(parse(std::move(arguments)).command);
}

inline Options parseTexts(const std::vector<std::string>& texts) {
    std::vector<const char*> arguments;
    std::ranges::transform(texts, std::back_inserter(arguments),
                           [](const std::string& text) { return text.c_str(); });
    return parse(std::move(arguments));
}

// Of a line in which every space is between two arguments.
inline Options parseLine(const std::string& line) {
    std::istringstream words(line);
    return parseTexts({std::istream_iterator<std::string>(words), {}});
}

// What the command line says that repeats a picture, read by the program's own parser.
inline RenderOptions parsedBack(const RenderOptions& options, const std::string& camera = {}) {
    return std::get<RenderOptions>(parseTexts(renderArguments(options, camera)).command);
}

// The message of the usage error that the arguments must cause.
inline std::string refusal(std::vector<const char*> arguments) {
    try {
        static_cast<void>(parse(std::move(arguments)));
    } catch (const StartupError& error) {
        EXPECT_EQ(error.code(), ErrorCode::kInvalidArgument);
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << "not one line";
        return error.what();
    }
    ADD_FAILURE() << "accepted";
    return {};
}

} // namespace froxel::app
