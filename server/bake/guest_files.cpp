#include "bake/guest_files.h"

#include "core/text.h"
#include "gltf/failure.h"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <system_error>

namespace froxel::bake {

namespace {

// A descriptor of its own, which stands at the begin and cannot write.
gltf::OpenedFile openAgain(const guest::GuestFile& file) {
    const std::string link = "/proc/self/fd/" + std::to_string(file.descriptor.get());
    const std::string shown = printable(file.name, 300);
    FileDescriptor opened(::open(link.c_str(), O_RDONLY | O_CLOEXEC));
    if (!opened) {
        gltf::fail("cannot open '" + shown + "': " + std::generic_category().message(errno));
    }
    return {std::move(opened), file.size_bytes, shown};
}

} // namespace

gltf::OpenedFile GuestFiles::openScene() {
    return openAgain(scene_->files.front());
}

gltf::OpenedFile GuestFiles::open(const std::filesystem::path& relative, const std::string& user) {
    const std::string name = relative.lexically_normal().generic_string();
    const auto found = std::ranges::find(scene_->files, name, &guest::GuestFile::name);
    if (found == scene_->files.end()) {
        throw gltf::Unusable(gltf::warning::kMissingFile,
                             user + " needs '" + printable(name, 300) +
                                 "', which did not come with the scene");
    }
    return openAgain(*found);
}

} // namespace froxel::bake
