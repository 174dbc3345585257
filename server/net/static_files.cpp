#include "net/static_files.h"

#include "core/text.h"

#include <array>
#include <fstream>
#include <functional>
#include <iterator>
#include <optional>
#include <system_error>
#include <utility>

namespace froxel::net {
namespace {

namespace fs = std::filesystem;

struct ContentType {
    std::string_view extension;
    std::string_view type;
};
constexpr std::array kContentTypes = {
    ContentType{".html", "text/html; charset=utf-8"},
    ContentType{".js", "text/javascript; charset=utf-8"},
    ContentType{".css", "text/css; charset=utf-8"},
    ContentType{".json", "application/json"},
    ContentType{".map", "application/json"},
    ContentType{".svg", "image/svg+xml"},
    ContentType{".png", "image/png"},
    ContentType{".jpg", "image/jpeg"},
    ContentType{".ico", "image/x-icon"},
    ContentType{".webp", "image/webp"},
    ContentType{".woff2", "font/woff2"},
    ContentType{".wasm", "application/wasm"},
    ContentType{".txt", "text/plain; charset=utf-8"},
};

std::string_view contentType(const fs::path& path) {
    const std::string extension = path.extension().string();
    for (const ContentType& known : kContentTypes) {
        if (known.extension == extension) {
            return known.type;
        }
    }
    return "application/octet-stream";
}

Error ioError(const fs::path& path, const std::string& what) {
    return {ErrorCode::kIo, "web page " + path.string() + ": " + what};
}

std::optional<std::string> readFile(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    return in ? std::optional(std::move(bytes)) : std::nullopt;
}

} // namespace

Result<StaticFiles> StaticFiles::load(const fs::path& root) {
    std::error_code failure;
    fs::recursive_directory_iterator entries(root, failure);
    if (failure) {
        return ioError(root, failure.message());
    }
    StaticFiles files;
    size_t total_bytes = 0;
    for (; entries != fs::recursive_directory_iterator(); entries.increment(failure)) {
        if (!fs::is_regular_file(entries->symlink_status(failure))) {
            continue;
        }
        auto body = readFile(entries->path());
        if (!body) {
            return ioError(entries->path(), "cannot be read");
        }
        total_bytes += body->size();
        if (total_bytes > kMaxBytes) {
            return ioError(root, "more than " + numberText(kMaxBytes) + " bytes");
        }
        const std::string name = "/" + entries->path().lexically_relative(root).generic_string();
        std::string etag = '"' + numberText(std::hash<std::string>()(*body)) + '-' +
                           numberText(body->size()) + '"';
        // Vite puts what it names by hash, and nothing else, into assets/.
        const bool immutable = name.starts_with("/assets/");
        files.files_[name] = {std::move(*body), contentType(entries->path()), std::move(etag),
                              immutable};
    }
    if (failure) {
        return ioError(root, failure.message());
    }
    if (files.find("/") == nullptr) {
        return ioError(root, "no index.html in it");
    }
    return files;
}

const StaticFile* StaticFiles::find(std::string_view path) const {
    const auto found = files_.find(path == "/" ? std::string_view("/index.html") : path);
    return found == files_.end() ? nullptr : &found->second;
}

} // namespace froxel::net
