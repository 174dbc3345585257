#include "app/report_page.h"

#include "app/output_file.h"
#include "bench/html.h"

#include <nlohmann/json.hpp>

namespace froxel::app {

std::string readReportPage(const std::filesystem::path& web_root, std::string_view name) {
    const auto root = findWebRoot(web_root);
    if (root.empty()) {
        throw StartupError({ErrorCode::kIo,
                            "--report: the built page was not found; run ./deploy/build.sh, or "
                            "name its folder with --web-root"});
    }
    auto page = readText(root / name).value();
    bench::fillReport(page, nullptr).value();
    return page;
}

} // namespace froxel::app
