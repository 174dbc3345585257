#include "gltf/scene_files.h"

#include "gltf/failure.h"
#include "gltf/uri.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace froxel::gltf {
namespace {

// Of a file, until it is asked whether it is still wanted.
constexpr size_t kReadAtOnce = size_t{16} << 20U;

// The format's specification: its first line, and at most 1024 bytes.
bool isLfsPointer(const Bytes& bytes) {
    constexpr std::string_view kBegin = "version https://git-lfs.github.com/spec/";
    return bytes.size() >= kBegin.size() && bytes.size() <= 1024 &&
           std::memcmp(bytes.data(), kBegin.data(), kBegin.size()) == 0;
}

} // namespace

Bytes readAll(const OpenedFile& file, const std::string& user, const std::function<void()>& ask) {
    const auto size = static_cast<size_t>(file.size_bytes);
    Bytes bytes(size);
    size_t done = 0;
    while (done < size) {
        ask();
        const ssize_t got =
            ::pread(file.descriptor.get(), bytes.data() + done, std::min(size - done, kReadAtOnce),
                    static_cast<off_t>(file.begin + done));
        if (got < 0 && errno == EINTR) {
            continue;
        }
        if (got <= 0) {
            fail(user + " cannot read '" + file.shown + "': " +
                 (got < 0 ? std::generic_category().message(errno)
                          : "it became shorter while it was read"));
        }
        done += static_cast<size_t>(got);
    }
    if (isLfsPointer(bytes)) {
        throw Unusable(
            warning::kMissingFile,
            user + " names '" + file.shown +
                "', which is a Git LFS pointer; expected the file itself; git lfs pull fetches it");
    }
    return bytes;
}

Bytes SceneFiles::readSceneFile() {
    return take(opener_.openScene(), "the scene");
}

Bytes SceneFiles::take(OpenedFile file, const std::string& user) {
    bytes_.take(file.size_bytes, user);
    Bytes bytes =
        file.descriptor ? readAll(file, user, [this] { progress_.ask(); }) : std::move(file.bytes);
    file_bytes_ += bytes.size();
    return bytes;
}

Bytes SceneFiles::read(const std::string& uri, const std::string& user) {
    if (isDataUri(uri)) {
        bytes_.take(uri.size(), user); // at most; the JSON text's limit bounds it
        return bytesOfDataUri(uri, user);
    }
    return take(opener_.open(relativePathFromUri(uri, user), user), user);
}

} // namespace froxel::gltf
