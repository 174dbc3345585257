// The camera along a path.
#pragma once

#include "load/script.h"

namespace froxel::load {

class PathScript final : public Script {
  public:
    PathScript(Path path, uint32_t viewer);
    [[nodiscard]] std::optional<Step> next() override;

  private:
    const Path path_;
    const double begin_s_; // on the path
    uint64_t count_ = 0;
};

} // namespace froxel::load
