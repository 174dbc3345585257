// A form that holds a scene's files, as the process that reads scenes takes it apart; its boundary
// is "x". Parts that lie within it, or one line.
#include "bake/form_parts.h"
#include "bake/guest_files.h"
#include "core/assert.h"
#include "fuzz/target.h"
#include "gltf/failure.h"
#include "guest/memory_file.h"

#include <span>
#include <utility>

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace froxel;
    if (size == 0) {
        return 0;
    }
    auto file = guest::MemoryFile::make().value();
    file.append(std::as_bytes(std::span(data, size))).value();
    guest::GuestScene scene;
    scene.files.push_back(std::move(file).complete("form").value());
    bake::GuestFiles form(std::make_shared<const guest::GuestScene>(std::move(scene)));
    try {
        bake::FormParts parts(form, "x");
        const auto whole = parts.openScene();
        FROXEL_ASSERT(whole.begin <= size && whole.size_bytes <= size - whole.begin,
                      "a part lies within the form");
        for (const char* name : {"a.bin", "textures/b.png", "../c", ""}) {
            const auto part = parts.open(name, "buffer 0");
            FROXEL_ASSERT(part.begin <= size && part.size_bytes <= size - part.begin,
                          "a part lies within the form");
        }
    } catch (const gltf::Failure& failure) {
        FROXEL_ASSERT(fuzz::isOneLine(failure.what()), "a refusal is one line");
    }
    return 0;
}
