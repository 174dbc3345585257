// URIs of glTF files: RFC 3986; `data:` as RFC 2397 and what browsers fetch have it.
#pragma once

#include "gltf/bytes.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace froxel::gltf {

// Whatever the case of its scheme.
[[nodiscard]] bool isDataUri(std::string_view uri);

// The bytes of a `data:` URI of any type. Throws Unusable, naming `user`, where there are none or
// they cannot be decoded.
[[nodiscard]] Bytes bytesOfDataUri(std::string_view uri, const std::string& user);

// The path that a relative URI names: percent-decoded, with slashes for backslashes, without a
// query, a fragment and `.` and `..` parts. Throws Unusable for a URI with a scheme, and where that
// path is absolute, leads up out of the folder or has a NUL; `user` is named in the message.
[[nodiscard]] std::filesystem::path relativePathFromUri(const std::string& uri,
                                                        const std::string& user);

} // namespace froxel::gltf
