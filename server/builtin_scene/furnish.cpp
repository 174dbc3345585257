#include "builtin_scene/furnish.h"

#include "builtin_scene/furnishing.h"
#include "builtin_scene/garden.h"
#include "builtin_scene/plan.h"

#include <array>
#include <vector>

namespace froxel::builtin_scene {
namespace {

constexpr float kNaveFace = -plan::kColumnZ + plan::kArcadeHalfDepth; // of the north arcade
constexpr float kAisleMiddle = -6.05F;

void placeParapets(Stage& stage) {
    const uint32_t stone = stage.mesh("balustrade", balustrade());
    const uint32_t bronze = stage.mesh("grille_parapet", grilleParapet());
    for (uint32_t bay = 0; bay < plan::kBays; ++bay) {
        for (const float half : {-0.25F, 0.25F}) {
            stage.placeBothSides(
                bay % 2 == 0 ? stone : bronze,
                moved(plan::bayX(bay) + half * plan::kBay, plan::kGalleryFloor, -plan::kColumnZ));
        }
    }
}

void placeLamps(Stage& stage) {
    const uint32_t nave = stage.mesh("nave_lantern", lantern(5.6F, 1.4F));
    const uint32_t aisle = stage.mesh("aisle_lantern", lantern(1.3F, 0.9F));
    for (const uint32_t line : {3U, 4U}) {
        stage.placeBothSides(nave, moved(plan::lineX(line), 12.0F, -2.35F));
    }
    for (uint32_t bay = 0; bay < plan::kBays; ++bay) {
        stage.placeBothSides(aisle, moved(plan::bayX(bay), 5.38F, kAisleMiddle));
    }
}

void placeSpandrels(Stage& stage) {
    const uint32_t cloth = stage.mesh("banner", banner(0.85F, 1.75F));
    const uint32_t red = stage.mesh("roundel_rosso", roundel(Surface::kRosso));
    const uint32_t green = stage.mesh("roundel_verde", roundel(Surface::kVerde));
    for (uint32_t line = 1; line < plan::kBays; ++line) {
        const float x = plan::lineX(line);
        if (line == 2 || line == 5) {
            stage.placeBothSides(cloth, moved(x, 5.62F, kNaveFace + 0.13F));
        } else {
            stage.placeBothSides(line % 2 == 0 ? green : red, moved(x, 5.02F, kNaveFace));
        }
    }
}

void placePlants(Stage& stage) {
    const std::array ferns = {stage.mesh("potted_fern_a", pottedFern(3)),
                              stage.mesh("potted_fern_b", pottedFern(4))};
    for (const uint32_t line : {2U, 3U, 4U, 5U}) {
        const float x = plan::lineX(line);
        stage.placeBothSides(ferns[line % 2], moved(x, 0, -3.05F));
    }
    // The garden: two bays of the north aisle and what has grown out of them.
    const uint32_t bed = stage.mesh("planting_bed", plantingBed(3.5F, 2.6F, 7));
    const uint32_t tree = stage.mesh("potted_tree", pottedTree(11));
    const uint32_t winding = stage.mesh("ivy_on_column", ivyOnColumn(13));
    const uint32_t hanging = stage.mesh("ivy_curtain", ivyCurtain(4.0F, 1.3F, 17));
    for (const uint32_t bay : {4U, 5U}) {
        stage.place(bed, moved(plan::bayX(bay), 0, -plan::kWallZ + 0.05F));
        stage.place(hanging, moved(plan::bayX(bay), 6.02F, kNaveFace + 0.28F));
    }
    stage.place(winding, moved(plan::lineX(5), 0, -plan::kColumnZ));
    stage.place(winding, moved(plan::lineX(6), 0, -plan::kColumnZ) * turnedY(2.1F));
    stage.place(tree, moved(plan::bayX(4) - 0.2F, 0, -3.75F));
    stage.place(tree, moved(plan::bayX(5) + 0.1F, 0, -3.8F) * turnedY(1.3F));
    for (const float side : {-1.0F, 1.0F}) {
        stage.place(tree, moved(plan::kHalfLength - 0.9F, 0, side * 3.05F) * turnedY(side));
    }
}

// In the first bay of the south aisle, where only the camera "Glass" looks: goblets that light
// passes, in a case of blended panes and behind two that cross.
void placeGlass(Stage& stage) {
    constexpr float kTop = 0.88F;
    constexpr float kX = -13.7F;
    constexpr float kZ = 6.1F;
    stage.place(stage.mesh("stone_table", stoneTable()), moved(kX, 0, kZ));
    stage.place(stage.mesh("vitrine", vitrine()), moved(kX, kTop, kZ - 0.05F));
    struct Goblet {
        Surface glass;
        const char* name;
        std::vector<glm::vec2> at; // x and z from the table's middle
    };
    const std::array goblets = {
        Goblet{Surface::kRubyGlass, "goblet_ruby", {{0.05F, -0.22F}, {0.42F, -0.33F}}},
        Goblet{Surface::kCobaltGlass, "goblet_cobalt", {{-0.10F, 0.02F}, {0.44F, 0.03F}}},
        Goblet{Surface::kAmberGlass, "goblet_amber", {{0.10F, 0.15F}, {-0.43F, -0.30F}}}};
    for (const Goblet& kind : goblets) {
        const uint32_t mesh = stage.mesh(kind.name, goblet(kind.glass));
        for (const glm::vec2& at : kind.at) {
            stage.place(mesh, moved(kX + at.x, kTop, kZ + at.y));
        }
    }
    const glm::mat4 beside = moved(kX + 0.08F, kTop, kZ + 0.70F);
    stage.place(stage.mesh("screen_ruby", glassScreen(Surface::kRubyPane)),
                beside * turnedY(0.75F));
    stage.place(stage.mesh("screen_cobalt", glassScreen(Surface::kCobaltPane)),
                beside * turnedY(2.2F));
}

} // namespace

void furnish(Stage& stage) {
    stage.place("fountain", fountain());
    stage.place(stage.mesh("knot", knotOnPlinth()),
                moved(plan::kHalfLength + plan::kEndWallDepth + 1.15F, 0.445F, 0));
    placeParapets(stage);
    placeLamps(stage);
    placeSpandrels(stage);
    placePlants(stage);
    placeGlass(stage);
}

} // namespace froxel::builtin_scene
