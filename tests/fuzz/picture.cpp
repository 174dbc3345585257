// A picture to compare, of any format by its first bytes: pixels of its size, or one line.
#include "diff/picture.h"

#include "core/assert.h"
#include "fuzz/target.h"

#include <variant>

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace froxel;
    const auto file = diff::decode(std::as_bytes(std::span(data, size)), "picture");
    if (!file) {
        FROXEL_ASSERT(fuzz::isOneLine(file.error().message), "a refusal is one line");
        return 0;
    }
    const uint64_t pixels = diff::sizeOf(file->picture).pixelCount();
    FROXEL_ASSERT(pixels > 0, "a picture has pixels");
    if (const auto* shown = std::get_if<diff::ShownPicture>(&file->picture)) {
        FROXEL_ASSERT(shown->rgba8.size() == 4 * pixels, "four bytes a pixel");
    } else {
        FROXEL_ASSERT(std::get<LinearImage>(file->picture).rgb.size() == 3 * pixels,
                      "three floats a pixel");
    }
    for (const std::string& warning : file->warnings) {
        FROXEL_ASSERT(fuzz::isOneLine(warning), "a warning is one line");
    }
    return 0;
}
