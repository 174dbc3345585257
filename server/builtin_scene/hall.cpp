#include "builtin_scene/hall.h"

#include "builtin_scene/bay.h"
#include "builtin_scene/cameras.h"
#include "builtin_scene/column.h"
#include "builtin_scene/furnish.h"
#include "builtin_scene/materials.h"
#include "builtin_scene/plan.h"
#include "builtin_scene/stage.h"
#include "builtin_scene/vault.h"

namespace froxel::builtin_scene {
namespace {

constexpr float kAisleZ = -0.5F * (4.25F + 7.85F);

void addColonnades(Stage& stage) {
    const uint32_t nave = stage.mesh("nave_column", naveColumn());
    const uint32_t verde = stage.mesh("gallery_column_verde", galleryColumn(Surface::kVerde));
    const uint32_t rosso = stage.mesh("gallery_column_rosso", galleryColumn(Surface::kRosso));
    const uint32_t pilaster = stage.mesh("wall_pilaster", wallPilaster());
    const uint32_t arch = stage.mesh("aisle_arch", aisleArch());
    for (uint32_t line = 0; line <= plan::kBays; ++line) {
        const float x = plan::lineX(line);
        const bool at_wall = line == 0 || line == plan::kBays;
        if (at_wall) {
            const float turn = line == 0 ? 0.5F : -0.5F;
            stage.placeBothSides(pilaster,
                                 moved(x, 0, -plan::kColumnZ) * turnedY(turn * glm::pi<float>()));
        } else {
            stage.placeBothSides(nave, moved(x, 0, -plan::kColumnZ));
        }
        stage.placeBothSides(pilaster, moved(x, 0, -plan::kWallZ));
        stage.placeBothSides(arch, moved(x, plan::kSpring, kAisleZ));
        stage.placeBothSides(verde, moved(x, plan::kGalleryFloor, -plan::kColumnZ));
        if (line < plan::kBays) {
            stage.placeBothSides(
                rosso, moved(x + 0.5F * plan::kBay, plan::kGalleryFloor, -plan::kColumnZ));
        }
    }
}

void addBays(Stage& stage) {
    const uint32_t arcade = stage.mesh("arcade_bay", arcadeBay());
    const uint32_t outer = stage.mesh("outer_bay", outerBay());
    const uint32_t groin = stage.mesh("groin_bay", groinBay());
    const uint32_t coffered = stage.mesh("vault_bay", barrelBay(Crown::kCoffered));
    const uint32_t skylight = stage.mesh("vault_skylight", barrelBay(Crown::kSkylight));
    const uint32_t oculus = stage.mesh("vault_oculus", barrelBay(Crown::kOculus));
    const uint32_t rib = stage.mesh("vault_rib", barrelRib());
    for (uint32_t bay = 0; bay < plan::kBays; ++bay) {
        const float x = plan::bayX(bay);
        stage.placeBothSides(arcade, moved(x, 0, 0));
        stage.placeBothSides(outer, moved(x, 0, 0));
        stage.placeBothSides(groin, moved(x, plan::kSpring, kAisleZ));
        const uint32_t ceiling = bay == plan::kBays / 2 ? oculus
                                 : bay % 2 == 1         ? skylight
                                                        : coffered;
        stage.place(ceiling, moved(x, 0, 0));
    }
    for (uint32_t line = 0; line <= plan::kBays; ++line) {
        stage.place(rib, moved(plan::lineX(line), 0, 0));
    }
}

void addShell(Stage& stage) {
    stage.place("floor", groundFloor());
    stage.place("apse", apse());
    stage.place(stage.mesh("west_wall", endWall(End::kWest)), moved(-plan::kHalfLength, 0, 0));
    stage.place(stage.mesh("east_wall", endWall(End::kEast)),
                moved(plan::kHalfLength, 0, 0) * turnedY(glm::pi<float>()));
}

void computeBounds(scene::Scene& scene) {
    for (const scene::Instance& instance : scene.instances) {
        for (const scene::Primitive& primitive : scene.meshes[instance.mesh].primitives) {
            for (const glm::vec3& position : primitive.positions) {
                scene.bounds_world.add(
                    glm::dvec3(instance.world_from_object * glm::dvec4(position, 1.0)));
            }
        }
    }
}

} // namespace

scene::Scene makeHall() {
    scene::Scene scene;
    scene.name = "Hall";
    addMaterials(scene);
    Stage stage(scene);
    addShell(stage);
    addBays(stage);
    addColonnades(stage);
    furnish(stage);
    addCameras(scene);
    addLights(scene);
    computeBounds(scene);
    return scene;
}

} // namespace froxel::builtin_scene
