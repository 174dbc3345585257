// How libpng's errors come out: it reports by a callback that must not return, so longjmp leaves
// its frames, and only its frames.
#pragma once

#include "core/error.h"

#include <png.h>

#include <cstdio>

namespace froxel::png {

// libpng's text; it has none where it could not allocate its structs.
struct Failure {
    char reason[96] = {};

    [[nodiscard]] Error error() const {
        return {ErrorCode::kIo, reason[0] != '\0' ? reason : "out of memory"};
    }
};

// The error pointer of every struct is a Failure. Nothing may be thrown through these, C calls
// them.
inline void onError(png_structp png, png_const_charp text) {
    auto* failure = static_cast<Failure*>(png_get_error_ptr(png));
    std::snprintf(failure->reason, sizeof failure->reason, "%s", text);
    png_longjmp(png, 1);
}
inline void onWarning(png_structp /*png*/, png_const_charp /*text*/) {}

} // namespace froxel::png
