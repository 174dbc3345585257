#include "net/static_files.h"

#include "core/is_inside.h"
#include "core/text.h"

#include <boost/beast/http/rfc7230.hpp>

#include <algorithm>
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

struct Coding {
    std::string_view extension;
    std::string_view name;
};
constexpr std::array kCodings = {Coding{".br", "br"}, Coding{".gz", "gzip"}}; // best first

std::string_view contentType(const fs::path& path) {
    const std::string extension = path.extension().string();
    for (const ContentType& known : kContentTypes) {
        if (known.extension == extension) {
            return known.type;
        }
    }
    return "application/octet-stream";
}

Representation representation(std::string body, std::string_view coding) {
    std::string etag =
        '"' + numberText(std::hash<std::string>()(body)) + '-' + numberText(body.size()) + '"';
    return {std::move(body), std::move(etag), coding};
}

// Whether a list such as "br;q=0.9, gzip, *;q=0" allows a coding.
bool allows(std::string_view accept_encoding, std::string_view coding) {
    std::optional<bool> named;
    std::optional<bool> others;
    for (const auto& [name, parameters] : boost::beast::http::ext_list(
             boost::beast::string_view(accept_encoding.data(), accept_encoding.size()))) {
        const bool yes = std::none_of(parameters.begin(), parameters.end(), [](const auto& one) {
            return boost::beast::iequals(one.first, "q") &&
                   one.second.find_first_not_of("0.") == boost::beast::string_view::npos;
        });
        if (boost::beast::iequals(name, boost::beast::string_view(coding.data(), coding.size()))) {
            named = yes;
        } else if (name == "*") {
            others = yes;
        }
    }
    return named.value_or(others.value_or(false));
}

Error ioError(const fs::path& path, const std::string& what) {
    return {ErrorCode::kIo, "web page " + path.string() + ": " + what};
}

// Links are followed to files that are in the root, too: a ConfigMap's are all links.
bool isServed(const fs::directory_entry& entry, const fs::path& real_root) {
    std::error_code failure;
    const fs::path real = fs::canonical(entry.path(), failure);
    return !failure && isInside(real, real_root) && fs::is_regular_file(real, failure);
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
    const fs::path real_root = fs::canonical(root, failure);
    StaticFiles files;
    size_t total_bytes = 0;
    for (; entries != fs::recursive_directory_iterator(); entries.increment(failure)) {
        if (entries->path().filename().string().starts_with(
                "..")) { // where a ConfigMap's links lead
            entries.disable_recursion_pending();
        }
        if (!isServed(*entries, real_root)) {
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
        // Vite puts what it names by hash, and nothing else, into assets/.
        const bool immutable = name.starts_with("/assets/");
        files.files_[name] = {
            representation(std::move(*body), {}), {}, contentType(entries->path()), immutable};
    }
    if (failure) {
        return ioError(root, failure.message());
    }
    if (files.find("/") == nullptr) {
        return ioError(root, "no index.html in it");
    }
    files.gatherCoded();
    return files;
}

void StaticFiles::gatherCoded() {
    for (const Coding& coding : kCodings) {
        for (auto& [name, file] : files_) {
            const auto found = files_.find(name + std::string(coding.extension));
            if (found != files_.end()) {
                file.coded.push_back(
                    representation(std::move(found->second.plain.body), coding.name));
                files_.erase(found); // comes after `name`
            }
        }
    }
}

const Representation& StaticFile::bestFor(std::string_view accept_encoding) const {
    const auto best = std::find_if(coded.begin(), coded.end(), [&](const Representation& one) {
        return allows(accept_encoding, one.coding);
    });
    return best == coded.end() ? plain : *best;
}

const StaticFile* StaticFiles::find(std::string_view path) const {
    const auto found = files_.find(path == "/" ? std::string_view("/index.html") : path);
    return found == files_.end() ? nullptr : &found->second;
}

} // namespace froxel::net
