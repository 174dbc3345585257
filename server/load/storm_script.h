// Every setting that the protocol has, over the whole of what the server takes, faster than
// anyone's hands are.
#pragma once

#include "load/random_values.h"
#include "load/script.h"

namespace froxel::load {

class StormScript final : public Script {
  public:
    // Seeded by `viewer`.
    StormScript(const v1::Welcome& welcome, uint32_t viewer);
    [[nodiscard]] std::optional<Step> next() override;

  private:
    // Those whose fields have to do with one another.
    void fillCamera(v1::SetCamera& command);
    void fillLights(v1::SetLights& command);
    void fillAnimation(v1::SetAnimation& command);
    void fillBox(v1::Box& box);
    void fillGrid(v1::SetGrid& command);
    void fillFog(v1::Fog& fog);
    void fillEnvironment(v1::SetEnvironment& command);
    void fillEncoding(v1::SetEncoding& command);
    void fillToon(v1::SetToon& command);
    void fillCompare(v1::SetCompare& command);
    void fillPlacedLights(v1::PlacedLights& command);
    void fillOther(v1::ClientMessage& message, int number);
    void fillCommand(v1::ClientMessage& message);

    const v1::ViewState start_;
    std::vector<std::string> cameras_;
    std::vector<double> durations_s_; // of the scene's animations
    const uint32_t material_variants_;
    RandomValues values_;
    uint64_t count_ = 0;
};

} // namespace froxel::load
