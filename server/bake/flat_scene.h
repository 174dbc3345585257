// A scene as one run of bytes, in which the process that read its file hands it to another one of
// the same binary. Not a file format: it changes with the structs.
#pragma once

#include "bake/flat_bytes.h"
#include "core/error.h"
#include "scene/scene.h"

#include <cstddef>
#include <span>

namespace froxel::bake {

// All of it but its files, and of images in the pool (FlatWriter) but their places. Passes on what
// `sink` throws.
void writeFlat(const scene::Scene& scene,
               const ByteSink& sink,
               std::span<const std::byte> pool = {});

// Trusts nothing in the bytes: takes memory in proportion to them, and checks what whoever uses the
// scene relies on (scene::findFault(), sizes of images, finite cameras, lights and bounds, numbers
// of things and lengths of names). pool: never changes while `keeper` lives; images share it.
// Errors: kScene, one line. Throws std::bad_alloc.
[[nodiscard]] Result<scene::Scene> readFlat(std::span<const std::byte> bytes,
                                            std::span<const std::byte> pool = {},
                                            std::shared_ptr<const void> keeper = {});

} // namespace froxel::bake
