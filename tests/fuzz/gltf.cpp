// A scene file, .gltf or .glb by its first bytes, in a folder with a buffer, a picture, and a link
// to a file outside: a scene that can be drawn or one line, and the file outside is never opened.
#include "core/assert.h"
#include "fuzz/target.h"
#include "gltf/gltf_loader.h"
#include "support/scene_promises.h"
#include "support/temp_folder.h"

#include <fstream>
#include <sys/inotify.h>
#include <unistd.h>

namespace froxel::fuzz {
namespace {

// One pixel.
constexpr unsigned char kPng[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n', 0,    0,    0,    13,
                                  'I',  'H', 'D', 'R', 0,    0,    0,    1,    0,    0,    0,    1,
                                  8,    2,   0,   0,   0,    0x90, 'w',  'S',  0xDE, 0,    0,    0,
                                  12,   'I', 'D', 'A', 'T',  0x78, 0x9C, 'c',  0xF8, 0xCF, 0xC0, 0,
                                  0,    3,   1,   1,   0,    0xC9, 0xFE, 0x92, 0xEF, 0,    0,    0,
                                  0,    'I', 'E', 'N', 'D',  0xAE, 'B',  '`',  0x82};

class Scenes {
  public:
    Scenes() {
        std::filesystem::create_directory(inside());
        std::ofstream(outside()) << std::string(64, 'o');
        std::ofstream(inside() / "data.bin") << std::string(256, '\0');
        std::ofstream(inside() / "pixel.png")
            .write(reinterpret_cast<const char*>(kPng), sizeof kPng);
        std::filesystem::create_symlink("../secret.bin", inside() / "link.bin");
        watch_ = inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
        FROXEL_ASSERT(watch_ >= 0 && inotify_add_watch(watch_, outside().c_str(), IN_OPEN) >= 0,
                      "the file outside is watched");
    }
    ~Scenes() { close(watch_); }
    Scenes(const Scenes&) = delete;
    Scenes& operator=(const Scenes&) = delete;

    void load(std::string_view file) {
        const std::string name = file.starts_with("glTF") ? "scene.glb" : "scene.gltf";
        std::ofstream(inside() / name, std::ios::binary)
            .write(file.data(), static_cast<std::streamsize>(file.size()));
        expectNoFault(test::faultOf(gltf::load(inside() / name), name));
        char event[sizeof(inotify_event) + 256];
        FROXEL_ASSERT(read(watch_, event, sizeof event) < 0, "a file outside was opened");
    }

  private:
    [[nodiscard]] std::filesystem::path inside() const { return folder_.path() / "scene"; }
    [[nodiscard]] std::filesystem::path outside() const { return folder_.path() / "secret.bin"; }

    test::TempFolder folder_{"froxel_fuzz_gltf"};
    int watch_ = -1;
};

} // namespace
} // namespace froxel::fuzz

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static froxel::fuzz::Scenes scenes;
    scenes.load(froxel::fuzz::textOf(data, size));
    return 0;
}
