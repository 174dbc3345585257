// Every command that the protocol has, as fast as nobody's hands are.
#pragma once

#include "load/script.h"

#include <random>

namespace froxel::load {

class StormScript final : public Script {
  public:
    // Seeded by `viewer`.
    StormScript(const v1::Welcome& welcome, uint32_t viewer);
    [[nodiscard]] std::optional<Step> next() override;

  private:
    // Both ends included.
    [[nodiscard]] uint32_t whole(uint32_t from, uint32_t to);
    [[nodiscard]] double real(double from, double to);
    template <class Enum>
    [[nodiscard]] Enum named(Enum last);
    void fillRenderer(v1::SetRenderer& command);
    void fillLights(v1::SetLights& command);
    void fillGrid(v1::SetGrid& command);
    void fillToon(v1::SetToon& command);
    void fillPost(v1::SetPost& command);
    void fillPlacedLights(v1::PlacedLights& command);
    void fillFog(v1::Fog& fog);
    void fillShadows(v1::SetShadows& command);
    void fillSize(v1::SetSize& command);

    const v1::ViewState start_;
    std::vector<std::string> cameras_;
    std::mt19937 random_;
    uint64_t count_ = 0;
};

} // namespace froxel::load
