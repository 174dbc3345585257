#include "app/device_losses.h"

#include "core/text.h"

#include <spdlog/spdlog.h>

#include <fstream>
#include <system_error>

namespace froxel::app {

DeviceLosses::DeviceLosses(const std::filesystem::path& folder)
    : file_(folder.empty() ? folder : folder / "device_losses") {
    std::ifstream file(file_);
    if (file && !(file >> count_)) {
        count_ = 0;
        spdlog::warn(
            "event=losses_not_read file={} advice=\"the file contains no number; remove it\"",
            logValue(file_.string()));
    }
}

void DeviceLosses::add() {
    ++count_;
    if (file_.empty()) {
        return;
    }
    std::error_code failure;
    std::filesystem::create_directories(file_.parent_path(), failure);
    std::ofstream file(file_, std::ios::trunc);
    file << count_ << '\n' << std::flush;
    if (!file) {
        spdlog::warn("event=loss_not_noted file={}", logValue(file_.string()));
    }
}

} // namespace froxel::app
