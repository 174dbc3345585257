// The hall's materials; the values index scene::Scene::materials.
#pragma once

#include <cstdint>

namespace froxel::builtin_scene {

enum class Surface : uint32_t {
    kAshlar,       // coursed travertine of the walls
    kLimestone,    // smooth stone of mouldings, arches and capitals
    kPavonazzetto, // white marble with violet veins
    kVerde,        // green serpentine marble
    kRosso,        // red porphyry
    kGiallo,       // honey-coloured marble
    kInlay,        // opus sectile of the nave's floor
    kHerringbone,  // brick floor of the aisles and galleries
    kPlaster,      // painted plaster of the groin vaults
    kStars,        // lapis coffer ground with gold stars
    kMosaic,       // gold tesserae
    kBronze,       // bronze with verdigris
    kGold,         // polished gilding
    kWood,         // dark oak
    kCloth,        // damask banners, both sides
    kFringe,       // gold thread at their ends, both sides
    kTerracotta,   // pots
    kSoil,         // planting beds
    kIvy,          // alpha-masked leaves, both sides
    kFern,         // alpha-masked fronds, both sides
    kGrille,       // alpha-masked bronze lattice, both sides
    kGlass,        // clear panes, blended
    kStainedGlass, // coloured panes, blended, glowing with the sky behind them
    kWater,        // fountain, blended
    kRubyPane,     // tinted panes, blended
    kCobaltPane,   // likewise
    kRubyGlass,    // tinted glass that light passes
    kCobaltGlass,  // likewise
    kAmberGlass,   // likewise
    kSky,          // dusk behind the windows
    kFlame,        // emissive heart of the lamps
    kCount
};

} // namespace froxel::builtin_scene
