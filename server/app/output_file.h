// Files that commands write and read.
#pragma once

#include "core/error.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>

namespace froxel::app {

// Throws StartupError(kIo) where the file's folder does not exist: told before the work, not after.
void requireFolderOf(const std::filesystem::path& file);

// Throws StartupError(kIo), naming the file.
void writeText(const std::filesystem::path& path, const std::string& text);

// Results of a command: `table` for a person on standard output, `report` to the file. "-": the
// report on standard output, the table on standard error; empty: no report. Throws as writeText().
void printResults(const std::filesystem::path& json,
                  const std::string& table,
                  const nlohmann::ordered_json& report);

// Errors: kIo, naming the file.
[[nodiscard]] Result<std::string> readText(const std::filesystem::path& path);

// The folder of the built page: `given`, else the one beside the binary, else where this build made
// it; empty when none has an index.html.
[[nodiscard]] std::filesystem::path findWebRoot(const std::filesystem::path& given);

} // namespace froxel::app
