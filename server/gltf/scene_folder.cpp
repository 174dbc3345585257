#include "gltf/scene_folder.h"

#include "core/is_inside.h"
#include "core/text.h"
#include "gltf/failure.h"

#include <cerrno>
#include <fcntl.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace froxel::gltf {
namespace {

namespace fs = std::filesystem;

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

[[noreturn]] void failToOpen(const std::string& what, int error) {
    if (passes(error)) {
        fail(what + reason(error));
    }
    throw Unusable(warning::kMissingFile, what + reason(error));
}

} // namespace

SceneFolder::SceneFolder(const fs::path& scene_file, bool no_link)
    : scene_file_(scene_file), no_link_(no_link) {
    std::error_code error;
    const fs::path parent = scene_file.has_parent_path() ? scene_file.parent_path() : ".";
    folder_ = fs::canonical(parent, error);
    if (error) {
        fail("cannot open its folder: " + error.message());
    }
}

OpenedFile SceneFolder::openScene() {
    files_.push_back({scene_file_, 0});
    return openFile(scene_file_, no_link_, "the scene");
}

// NONBLOCK: opening a pipe must not wait for its writer.
OpenedFile SceneFolder::openFile(const fs::path& path, bool canonical, const std::string& user) {
    const std::string name = printable(shownPath(path), 300);
    const std::string shown = "'" + name + "'";
    FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    struct stat status {};
    if (!file || ::fstat(file.get(), &status) != 0) {
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
    return {std::move(file), static_cast<uint64_t>(status.st_size), name};
}

// Visitors are told it, who need not know the server's folders.
std::string SceneFolder::shownPath(const fs::path& path) const {
    return isInside(path, folder_) ? path.lexically_relative(folder_).string()
                                   : path.filename().string();
}

OpenedFile SceneFolder::open(const fs::path& relative, const std::string& user) {
    files_.push_back({folder_ / relative, 0});
    const std::string shown = "'" + printable(relative.string(), 300) + "'";
    std::error_code error;
    const fs::path target = fs::canonical(folder_ / relative, error);
    if (error) {
        failToOpen(user + " cannot open " + shown + " in the scene's folder: ", error.value());
    }
    if (!isInside(target, folder_)) {
        throw Unusable(warning::kUri,
                       user + " names " + shown +
                           ", a link that leaves the scene's folder; expected a file inside it");
    }
    return openFile(target, true, user);
}

} // namespace froxel::gltf
