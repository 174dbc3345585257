// What a reader hands back: the bytes of a small scene, changed here and there; a scene that can be
// drawn or one line. Each three bytes of input are a place, the lower one first, and what is there.
#include "bake/flat_scene.h"

#include "core/assert.h"
#include "fuzz/target.h"
#include "support/scene_promises.h"
#include "unit/bake/flat_form.h"

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace froxel;
    static const std::vector<std::byte> whole = bake::flat(bake::smallScene());
    std::vector<std::byte> bytes = whole;
    for (size_t i = 0; i + 3 <= size; i += 3) {
        bytes[(data[i] + 256U * data[i + 1]) % bytes.size()] = std::byte{data[i + 2]};
    }
    const auto read = bake::readFlat(bytes);
    if (read) {
        FROXEL_ASSERT(test::faultOf(*read).empty(), "what is accepted can be drawn");
    } else {
        FROXEL_ASSERT(fuzz::isOneLine(read.error().message), "a refusal is one line");
    }
    return 0;
}
