// Viewers that go over from scene to scene.
#pragma once

#include "load/script.h"
#include "load/target.h"

#include <random>

namespace froxel::load {

// What a server offers, by its listing (protocol/README.md). `token`: shown to it; empty: none.
// Errors: kIo; kInvalidArgument, where it has one scene or the target asks for TLS.
[[nodiscard]] Result<std::vector<std::string>> fetchSceneIds(const Target& target,
                                                             const std::string& token);

class SceneScript final : public Script {
  public:
    SceneScript(std::vector<std::string> ids, std::string shown, uint32_t viewer);
    [[nodiscard]] std::optional<Step> next() override;

  private:
    const std::vector<std::string> ids_;
    std::mt19937 random_;
    Seconds at_;
    std::string wanted_;                 // selected last
    std::optional<std::string> back_to_; // next, to call that off
};

} // namespace froxel::load
