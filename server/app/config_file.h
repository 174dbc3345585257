// A TOML file of options: one key an option, by its long name.
#pragma once

#include "core/error.h"

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace froxel::app {

// By name; an array has several values, anything else one. As text, to be parsed as on the command
// line.
using ConfigValues = std::map<std::string, std::vector<std::string>, std::less<>>;

// Pure. `name` is the file's, for messages. Errors: kInvalidArgument naming file and line: no TOML,
// or a table or date where a value should be.
[[nodiscard]] Result<ConfigValues> parseConfig(std::string_view text, const std::string& name);

// At most 1 MiB. Errors: those of parseConfig, and an unreadable file.
[[nodiscard]] Result<ConfigValues> readConfigFile(const std::filesystem::path& path);

} // namespace froxel::app
