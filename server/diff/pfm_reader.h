// PFM files (Debevec, "PFM Portable FloatMap Image Format") to linear radiance. The files may come
// from anywhere: sizes are held against the file's before pixels are allocated.
#pragma once

#include "core/error.h"
#include "core/linear_image.h"
#include "core/picture_size.h"

#include <cstddef>
#include <functional>
#include <span>

namespace froxel::diff {

// By the first bytes: "PF", colours, or "Pf", grey.
[[nodiscard]] bool isPfm(std::span<const std::byte> file);

// Values as in the file, times the size of its scale, NaN and infinity included. `check` is asked
// before pixels are allocated. Errors, none of which names the file: kIo where it is broken, those
// of `check`. Any thread.
[[nodiscard]] Result<LinearImage>
readPfm(std::span<const std::byte> file,
        const std::function<Result<void>(const PictureSize&)>& check);

} // namespace froxel::diff
