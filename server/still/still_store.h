// Stills that were drawn, within so many bytes of memory: what was asked for longest ago goes
// first. Whoever owns it serialises access.
#pragma once

#include "core/encoded_frame.h"

#include <cstdint>
#include <list>
#include <string>
#include <unordered_map>

namespace froxel::still {

class StillStore {
  public:
    explicit StillStore(uint64_t most_bytes) : most_bytes_(most_bytes) {}

    // What one takes: its tag may be longer than the picture.
    [[nodiscard]] static uint64_t weightOf(const std::string& tag, const SharedBytes& bytes);

    // Null: it is not here.
    [[nodiscard]] SharedBytes find(const std::string& tag);
    // One that is larger than a quarter of all is not kept.
    void keep(const std::string& tag, SharedBytes bytes);
    [[nodiscard]] uint64_t bytes() const { return bytes_; }

  private:
    struct Kept {
        std::string tag;
        SharedBytes bytes;
    };
    void drop(std::list<Kept>::iterator kept);

    const uint64_t most_bytes_;
    uint64_t bytes_ = 0;
    std::list<Kept> newest_first_;
    std::unordered_map<std::string, std::list<Kept>::iterator> by_tag_;
};

} // namespace froxel::still
