// The built pages that commands put their results into.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace froxel::app {

// The page `name` in the folder of the built page, `web_root` or where findWebRoot() finds it,
// which bench::fillReport() can fill. Throws StartupError(kIo): no such folder or file, or one
// without a place for results. So it is told before anything is measured.
[[nodiscard]] std::string readReportPage(const std::filesystem::path& web_root,
                                         std::string_view name);

} // namespace froxel::app
