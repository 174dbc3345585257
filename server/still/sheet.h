// Several stills as one picture, each with its name.
#pragma once

#include "core/encoded_frame.h"
#include "core/error.h"
#include "settings/settings.h"

#include <cstdint>
#include <span>
#include <string>

namespace froxel::still {

struct SheetPart {
    std::string label; // ASCII
    SharedBytes png;   // all of one size
};

// Of the sheet, RGBA8 in memory.
inline constexpr uint64_t kMostSheetArea_px = uint64_t{32} << 20U;

// From left to right and down, in about as many columns as rows. `encoding`: a codec of single
// pictures of 8 bits. Errors: kIo; kCapacity, where it is too large. Pure, takes long; any thread.
[[nodiscard]] Result<SharedBytes> makeSheet(std::span<const SheetPart> parts,
                                            const settings::Encoding& encoding);

} // namespace froxel::still
