#include "app/output_file.h"

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

#include <cerrno>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <system_error>

namespace froxel::app {

namespace fs = std::filesystem;

namespace {

// Of the last system call that failed.
std::string systemMessage() {
    return std::generic_category().message(errno);
}

} // namespace

void requireFolderOf(const fs::path& file) {
    const auto folder = fs::absolute(file).parent_path();
    if (!fs::is_directory(folder)) {
        throw StartupError(
            {ErrorCode::kIo, fmt::format("cannot write '{}': there is no folder '{}'",
                                         file.string(), folder.string())});
    }
}

void writeText(const fs::path& path, const std::string& text) {
    errno = 0;
    std::ofstream file(path, std::ios::binary);
    file << text;
    file.close();
    if (!file) {
        throw StartupError(
            {ErrorCode::kIo, fmt::format("cannot write '{}': {}", path.string(), systemMessage())});
    }
}

void printResults(const fs::path& json,
                  const std::string& table,
                  const nlohmann::ordered_json& report) {
    const bool to_stdout = json == "-";
    std::fputs(table.c_str(), to_stdout ? stderr : stdout);
    std::fflush(stdout);
    const std::string text = report.dump(2) + "\n";
    if (to_stdout) {
        std::fputs(text.c_str(), stdout);
    } else if (!json.empty()) {
        writeText(json, text);
    }
}

Result<std::string> readText(const fs::path& path) {
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(file), {}};
    if (!file || file.bad()) {
        return Error{ErrorCode::kIo,
                     fmt::format("cannot read '{}': {}", path.string(), systemMessage())};
    }
    return text;
}

fs::path findWebRoot(const fs::path& given) {
    if (!given.empty()) {
        return given;
    }
    std::error_code failure;
    const fs::path binary = fs::read_symlink("/proc/self/exe", failure);
    for (const fs::path& root : {binary.parent_path() / "web", fs::path(FROXEL_WEB_ROOT)}) {
        if (fs::exists(root / "index.html", failure)) {
            return root;
        }
    }
    return {};
}

} // namespace froxel::app
