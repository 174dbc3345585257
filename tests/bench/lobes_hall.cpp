// Writes the built-in hall with a material variant for each lobe and for some together, every solid
// surface in it, for `froxel bench --preset material_variants --scene FILE`:
//   lobes_hall FILE.glb
#include "builtin_scene/hall.h"
#include "gltf_writer/glb_writer.h"

#include <array>
#include <cstdint>
#include <cstdio>
#include <utility>

namespace froxel {
namespace {

void giveCoat(scene::Material& m) {
    m.coat = {.strength = 1, .roughness = 0.2F};
}
void giveSheen(scene::Material& m) {
    m.sheen = {.color = {0.5F, 0.4F, 0.3F}, .roughness = 0.5F};
}
void giveAnisotropy(scene::Material& m) {
    m.anisotropy = {.strength = 0.6F};
}
void giveFilm(scene::Material& m) {
    m.film = {.strength = 0.8F};
}
void letThrough(scene::Material& m) {
    m.diffuse_transmission.strength = 0.5F;
}

struct Dress {
    const char* name;
    void (*give)(scene::Material&);
};

constexpr std::array kDresses = {
    Dress{"coat", giveCoat},
    Dress{"sheen", giveSheen},
    Dress{"anisotropy", giveAnisotropy},
    Dress{"iridescence", giveFilm},
    Dress{"diffuse transmission", letThrough},
    Dress{"coat and sheen",
          [](scene::Material& m) {
              giveCoat(m);
              giveSheen(m);
          }},
    Dress{"all",
          [](scene::Material& m) {
              giveCoat(m);
              giveSheen(m);
              giveAnisotropy(m);
              giveFilm(m);
              letThrough(m);
          }},
};

void addVariants(scene::Scene& scene) {
    const auto count = static_cast<uint32_t>(scene.materials.size());
    for (uint32_t variant = 0; variant < kDresses.size(); ++variant) {
        scene.material_variants.emplace_back(kDresses[variant].name);
        for (uint32_t i = 0; i < count; ++i) {
            scene::Material dressed = scene.materials[i];
            if (dressed.alpha_mode != scene::AlphaMode::kBlend) {
                kDresses[variant].give(dressed);
            }
            scene.materials.push_back(std::move(dressed));
        }
        for (scene::Mesh& mesh : scene.meshes) {
            for (scene::Primitive& p : mesh.primitives) {
                p.variant_materials.push_back({variant, p.material + count * (variant + 1)});
            }
        }
    }
}

} // namespace
} // namespace froxel

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("usage: lobes_hall FILE.glb\n", stderr);
        return 2;
    }
    auto hall = froxel::builtin_scene::makeHall();
    froxel::addVariants(hall);
    if (const auto written = froxel::gltf_writer::writeGlb(hall, argv[1]); !written) {
        std::fprintf(stderr, "%s\n", written.error().message.c_str());
        return 1;
    }
    return 0;
}
