#include "gltf/scene_folder.h"

#include "core/is_inside.h"
#include "core/text.h"
#include "gltf/failure.h"
#include "gltf/uri.h"

#include <algorithm>
#include <cerrno>
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

// Of an error that says nothing about the file: what it belongs to cannot do without it this time.
bool passes(int error) {
    return error == EMFILE || error == ENFILE || error == ENOMEM || error == EIO || error == ESTALE;
}

// The format's specification: its first line, and at most 1024 bytes.
bool isLfsPointer(const Bytes& bytes) {
    constexpr std::string_view kBegin = "version https://git-lfs.github.com/spec/";
    return bytes.size() >= kBegin.size() && bytes.size() <= 1024 &&
           std::memcmp(bytes.data(), kBegin.data(), kBegin.size()) == 0;
}

[[noreturn]] void failToOpen(const std::string& what, int error) {
    if (passes(error)) {
        fail(what + reason(error));
    }
    throw Unusable(warning::kMissingFile, what + reason(error));
}

} // namespace

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
        fail("cannot open its folder: " + error.message());
    }
}

Bytes SceneFolder::readSceneFile() {
    files_.push_back({scene_file_, 0});
    return readFile(scene_file_, no_link_, "the scene");
}

// NONBLOCK: opening a pipe must not wait for its writer.
Bytes SceneFolder::readFile(const fs::path& path, bool canonical, const std::string& user) {
    const std::string shown = "'" + printable(shownPath(path), 300) + "'";
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    if (file.get() < 0) {
        failToOpen(user + " cannot open " + shown + ": ", errno);
    }
    struct stat status {};
    if (::fstat(file.get(), &status) != 0) {
        failToOpen(user + " cannot open " + shown + ": ", errno);
    }
    files_.back().stamp = stampOf(status);
    if (canonical && !isAt(file.get(), path)) {
        fail(user + " names " + shown + ", which meanwhile became a link; expected a file");
    }
    if (!S_ISREG(status.st_mode)) {
        throw Unusable(warning::kMissingFile,
                       user + " names " + shown + ", which is not a regular file");
    }
    const auto size = static_cast<size_t>(status.st_size);
    bytes_.take(size, user);
    Bytes bytes(size);
    size_t done = 0;
    while (done < size) {
        progress_.ask();
        const ssize_t got =
            ::read(file.get(), bytes.data() + done, std::min(size - done, kReadAtOnce));
        if (got < 0 && errno == EINTR) {
            continue;
        }
        if (got <= 0) {
            fail(user + " cannot read " + shown + ": " +
                 (got < 0 ? reason(errno) : "it became shorter while it was read"));
        }
        done += static_cast<size_t>(got);
    }
    if (isLfsPointer(bytes)) {
        throw Unusable(
            warning::kMissingFile,
            user + " names " + shown +
                ", which is a Git LFS pointer; expected the file itself; git lfs pull fetches it");
    }
    file_bytes_ += size;
    return bytes;
}

// Visitors are told it, who need not know the server's folders.
std::string SceneFolder::shownPath(const fs::path& path) const {
    return isInside(path, folder_) ? path.lexically_relative(folder_).string()
                                   : path.filename().string();
}

Bytes SceneFolder::read(const std::string& uri, const std::string& user) {
    if (isDataUri(uri)) {
        bytes_.take(uri.size(), user); // at most; the JSON text's limit bounds it
        return bytesOfDataUri(uri, user);
    }
    const fs::path relative = relativePathFromUri(uri, user);
    files_.push_back({folder_ / relative, 0});
    std::error_code error;
    const fs::path target = fs::canonical(folder_ / relative, error);
    if (error) {
        failToOpen(user + " cannot open '" + printable(relative.string(), 300) +
                       "' in the scene's folder: ",
                   error.value());
    }
    if (!isInside(target, folder_)) {
        throw Unusable(warning::kUri,
                       user + " has the URI '" + printable(uri) +
                           "', a link that leaves the scene's folder; expected a file inside it");
    }
    return readFile(target, true, user);
}

} // namespace froxel::gltf
