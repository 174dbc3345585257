// Tells one state of a file from another without reading it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <sys/stat.h>
#include <utility>

namespace froxel {

// Another one after whatever changes a file: its bytes, its size, its owner, or another file at its
// path, with the same times too. 0 is no file's.
[[nodiscard]] inline uint64_t stampOf(const struct stat& status) {
    uint64_t hash = 14'695'981'039'346'656'037U; // FNV-1a over words
    for (const auto word :
         {uint64_t{status.st_dev}, uint64_t{status.st_ino}, static_cast<uint64_t>(status.st_size),
          static_cast<uint64_t>(status.st_mtim.tv_sec),
          static_cast<uint64_t>(status.st_mtim.tv_nsec),
          static_cast<uint64_t>(status.st_ctim.tv_sec),
          static_cast<uint64_t>(status.st_ctim.tv_nsec)}) {
        hash = (hash ^ word) * 1'099'511'628'211U;
    }
    return hash == 0 ? 1 : hash;
}

// Of the file that links lead to; 0: none can be looked at.
[[nodiscard]] inline uint64_t stampOf(const std::filesystem::path& file) {
    struct stat status {};
    return ::stat(file.c_str(), &status) == 0 ? stampOf(status) : 0;
}

// A file that was read, or looked for.
struct StampedFile {
    std::filesystem::path path;
    uint64_t stamp = 0; // when it was opened; 0: it was not there

    [[nodiscard]] bool hasChanged() const { return stampOf(path) != stamp; }
};

} // namespace froxel
