// A script from a file of JSON lines.
//
//   {"at_ms": 0, "setLights": {"count": 500}}
//   {"at_ms": 250, "setCamera": {"eye": {"z": 5}, "target": {}}}
//
// A line is the JSON of a ClientMessage and, optionally, at_ms: milliseconds since the script's
// start, never less than a line's before; absent, that line's. seq and clientTimeUs may be there,
// as in a recording, and are replaced. Hello and Ack are the viewer's own affair and refused.
#pragma once

#include "core/error.h"
#include "load/script.h"

#include <filesystem>
#include <istream>
#include <string>

namespace froxel::load {

// Errors: kInvalidArgument, one line that names file, line and reason. Stricter than a server: an
// unknown field is an error too. What only a server knows, such as its scene's cameras, is not
// looked at.
[[nodiscard]] Result<Recording> readScript(std::istream& lines, const std::string& file_name);

// Errors: as above; kIo.
[[nodiscard]] Result<Recording> readScriptFile(const std::filesystem::path& path);

} // namespace froxel::load
