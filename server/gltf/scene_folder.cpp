#include "gltf/scene_folder.h"

#include "core/text.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fcntl.h>
#include <string_view>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace froxel::gltf {
namespace {

namespace fs = std::filesystem;

// Of a file, until it is asked whether it is still wanted.
constexpr size_t kReadAtOnce = size_t{16} << 20U;

class Descriptor {
  public:
    explicit Descriptor(int value) : value_(value) {}
    ~Descriptor() {
        if (value_ >= 0) {
            ::close(value_);
        }
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    [[nodiscard]] int get() const { return value_; }

  private:
    int value_;
};

std::string reason(int error) {
    return std::generic_category().message(error);
}

// Whether a file is where its canonical path says, which may have become a link since that was
// made; so where the system does not tell.
bool isAt(int descriptor, const fs::path& canonical) {
    std::error_code unknown;
    const fs::path real = fs::read_symlink("/proc/self/fd/" + std::to_string(descriptor), unknown);
    return unknown || real == canonical;
}

// NONBLOCK: opening a pipe must not wait for its writer.
Bytes readFile(const fs::path& path,
               bool canonical,
               const std::string& user,
               Budget& budget,
               LoadProgress& progress) {
    const std::string shown = "'" + printable(path.string(), 300) + "'";
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    if (file.get() < 0) {
        fail(user + " cannot open " + shown + ": " + reason(errno));
    }
    if (canonical && !isAt(file.get(), path)) {
        fail(user + " names " + shown + ", where a link was put meanwhile; right is a file there");
    }
    struct stat status {};
    if (::fstat(file.get(), &status) != 0 || !S_ISREG(status.st_mode)) {
        fail(user + " names " + shown + ", which is not a regular file");
    }
    const auto size = static_cast<size_t>(status.st_size);
    budget.take(size, user);
    Bytes bytes(size);
    size_t done = 0;
    while (done < size) {
        progress.ask();
        const ssize_t got =
            ::read(file.get(), bytes.data() + done, std::min(size - done, kReadAtOnce));
        if (got < 0 && errno == EINTR) {
            continue;
        }
        if (got <= 0) {
            fail(user + " cannot read " + shown + ": " +
                 (got < 0 ? reason(errno) : "it is shorter than it was"));
        }
        done += static_cast<size_t>(got);
    }
    return bytes;
}

// What begins no escape stands for itself, as in "wood 50%.png".
std::string percentDecoded(const std::string& uri) {
    std::string text;
    for (size_t i = 0; i < uri.size(); ++i) {
        unsigned value = 0;
        const char* first = uri.data() + i + 1;
        const char* last = uri.data() + std::min(i + 3, uri.size());
        if (uri[i] == '%' && last - first == 2 &&
            std::from_chars(first, last, value, 16).ptr == last) {
            text += static_cast<char>(value);
            i += 2;
        } else {
            text += uri[i];
        }
    }
    return text;
}

bool hasScheme(const std::string& uri) {
    const size_t colon = uri.find(':');
    return colon != std::string::npos && colon > 0 &&
           std::all_of(uri.begin(), uri.begin() + static_cast<std::ptrdiff_t>(colon), [](char c) {
               return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '+' || c == '-' ||
                      c == '.';
           });
}

bool isInside(const fs::path& path, const fs::path& folder) {
    return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first ==
           folder.end();
}

// Whatever type it tells: what counts are the bytes, and tinygltf knows few types.
Bytes dataFromUri(const std::string& uri, const std::string& user) {
    constexpr std::string_view kBase64 = ";base64,";
    constexpr size_t kMaxTypeBytes = 200;
    const size_t end = uri.substr(0, kMaxTypeBytes).find(kBase64);
    std::string mime_type;
    std::vector<unsigned char> decoded;
    if (end == std::string::npos ||
        !tinygltf::DecodeDataURI(&decoded, mime_type,
                                 "data:application/octet-stream" + uri.substr(end), 0, false)) {
        throw Unusable(warning::kBrokenImage,
                       user + " has the URI '" + printable(uri, 40) +
                           "', which cannot be decoded; right is data:TYPE;base64, with at least "
                           "one byte");
    }
    Bytes bytes(decoded.size());
    std::memcpy(bytes.data(), decoded.data(), decoded.size());
    return bytes;
}

} // namespace

fs::path relativePathFromUri(const std::string& uri, const std::string& user) {
    const auto refuse = [&](const char* why, const char* more = "") {
        throw Unusable(warning::kUri, user + " has the URI '" + printable(uri) + "', which " + why +
                                          "; right is a path inside the scene's folder" + more);
    };
    if (hasScheme(uri)) {
        refuse("has a scheme", ", or data:");
    }
    // Neither a query nor a fragment is part of a file's name (RFC 3986, 3.4 and 3.5).
    std::string text = percentDecoded(uri.substr(0, uri.find_first_of("?#")));
    // Some tools that write such files have it separate folders.
    std::replace(text.begin(), text.end(), '\\', '/');
    if (text.empty()) {
        refuse("is empty");
    }
    if (text.find('\0') != std::string::npos) {
        refuse("contains a NUL");
    }
    fs::path path(text);
    if (path.is_absolute() || hasScheme(text)) {
        refuse("is absolute");
    }
    if (std::find(path.begin(), path.end(), "..") != path.end()) {
        refuse("leaves the scene's folder by '..'");
    }
    return path;
}

SceneFolder::SceneFolder(const fs::path& scene_file,
                         bool no_link,
                         LoadProgress& progress,
                         ReadMemory& memory)
    : scene_file_(scene_file), no_link_(no_link), progress_(progress),
      bytes_("bytes of files", kMaxFileBytes, 1, memory) {
    std::error_code error;
    const fs::path parent = scene_file.has_parent_path() ? scene_file.parent_path() : ".";
    folder_ = fs::canonical(parent, error);
    if (error) {
        fail("cannot open its folder '" + printable(parent.string(), 300) +
             "': " + error.message());
    }
}

Bytes SceneFolder::readSceneFile() {
    return readIn(scene_file_, no_link_, "the scene");
}

Bytes SceneFolder::readIn(const fs::path& path, bool canonical, const std::string& user) {
    Bytes bytes = readFile(path, canonical, user, bytes_, progress_);
    file_bytes_ += bytes.size();
    return bytes;
}

Bytes SceneFolder::read(const std::string& uri, const std::string& user) {
    if (uri.starts_with("data:")) {
        // Three bytes for four characters; the URI itself is bounded by the JSON text's limit.
        bytes_.take(uri.size() / 4 * 3, user);
        return dataFromUri(uri, user);
    }
    const fs::path relative = relativePathFromUri(uri, user);
    std::error_code error;
    const fs::path target = fs::canonical(folder_ / relative, error);
    if (error) {
        throw Unusable(warning::kMissingFile, user + " cannot open '" +
                                                  printable(relative.string(), 300) +
                                                  "' in the scene's folder: " + error.message());
    }
    if (!isInside(target, folder_)) {
        throw Unusable(warning::kUri, user + " has the URI '" + printable(uri) +
                                          "', a link that leaves the scene's folder; right is a "
                                          "file inside it");
    }
    return readIn(target, true, user);
}

} // namespace froxel::gltf
