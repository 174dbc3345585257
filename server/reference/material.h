// glTF 2.0 materials at a point of a surface.
#pragma once

#include "reference/brdf.h"
#include "reference/geometry.h"
#include "reference/texture.h"

#include <array>
#include <map>
#include <memory>
#include <span>
#include <utility>

namespace froxel::reference {

// Materials with the mip chains that they need. Immutable: any number of threads may read.
class Materials {
  public:
    // Makes the chains of `used`, indices into scene.materials; keeps a reference to the scene.
    Materials(const scene::Scene& scene,
              std::span<const uint32_t> used,
              const TextureFilter& filter);

    // Of the base colour, by the texture's base level.
    [[nodiscard]] double alpha(uint32_t material, const SurfacePoint& point) const;
    [[nodiscard]] Surface at(uint32_t material, const SurfacePoint& point) const;

  private:
    struct Slot {
        const MipChain* chain = nullptr; // null: none
        scene::Sampler sampler;
        scene::TextureSlot settings;
    };
    using Look = std::array<Slot, io::kMaterialSlots>; // by its number

    Slot slot(const scene::TextureSlot& settings, bool srgb);
    // White where there is no texture.
    [[nodiscard]] glm::dvec4 sample(const Slot& slot, const SurfacePoint& point) const;
    // By one of its normal maps.
    [[nodiscard]] glm::dvec3 normalAt(const scene::Material& material,
                                      const Slot& map,
                                      float scale,
                                      const SurfacePoint& point) const;

    // Its coat, its sheen and its film.
    void addLayers(const scene::Material& material,
                   const Look& look,
                   const SurfacePoint& point,
                   Surface& surface) const;

    // Where highlights are longer, on the shape's surface.
    [[nodiscard]] Anisotropy
    anisotropyAt(const scene::Material& material, const Slot& map, const SurfacePoint& point) const;

    const scene::Scene& scene_;
    TextureFilter filter_;
    std::map<std::pair<uint32_t, bool>, std::unique_ptr<MipChain>> chains_; // by image, encoding
    std::map<uint32_t, Look> looks_;
};

} // namespace froxel::reference
