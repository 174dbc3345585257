// A file of another format than glTF, which its first byte tells (o, p, s, 3): a scene that can be
// drawn, or one line.
#include "core/assert.h"
#include "formats/scene_loader.h"
#include "fuzz/target.h"
#include "support/scene_promises.h"
#include "support/temp_folder.h"

#include <fstream>
#include <map>

// lib3mf 1.8.1 leaks what libzip keeps of a package. The process that reads a scene ends with it.
extern "C" const char* __lsan_default_suppressions() {
    return "leak:libzip.so\nleak:lib3MF.so\n";
}
extern "C" const char* __lsan_default_options() {
    return "print_suppressions=0";
}

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace froxel;
    static const test::TempFolder folder("formats");
    static const std::map<char, std::string> kNames = {
        {'o', "scene.obj"}, {'p', "scene.ply"}, {'s', "scene.stl"}, {'3', "scene.3mf"}};
    static const bool ready = [] {
        std::ofstream(folder.path() / "scene.mtl") << "newmtl a\nKd 1 0 0\nmap_Kd none.png\n";
        return true;
    }();
    const auto name = size == 0 ? kNames.end() : kNames.find(static_cast<char>(data[0]));
    if (name == kNames.end() || !ready) {
        return 0;
    }
    std::ofstream(folder.path() / name->second, std::ios::binary)
        .write(reinterpret_cast<const char*>(data + 1), static_cast<std::streamsize>(size - 1));
    fuzz::expectNoFault(test::faultOf(formats::load(folder.path() / name->second), name->second));
    return 0;
}
