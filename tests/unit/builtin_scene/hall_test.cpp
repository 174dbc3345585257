#include "builtin_scene/hall.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

namespace froxel::builtin_scene {
namespace {

const scene::Scene& theHall() {
    static const scene::Scene scene = makeHall();
    return scene;
}

// FNV-1a over the bytes of plain values.
class Digest {
  public:
    template <std::ranges::contiguous_range Values>
    void add(const Values& values) {
        using T = std::ranges::range_value_t<Values>;
        static_assert(std::is_trivially_copyable_v<T>);
        addBytes(values.data(), values.size() * sizeof(T));
    }
    template <class T>
    void addValue(const T& value) {
        addBytes(&value, sizeof(T));
    }
    [[nodiscard]] uint64_t value() const { return hash_; }

  private:
    void addBytes(const void* data, size_t size) {
        const auto* bytes = static_cast<const unsigned char*>(data);
        for (size_t i = 0; i < size; ++i) {
            hash_ = (hash_ ^ bytes[i]) * 0x100000001b3ULL;
        }
    }
    uint64_t hash_ = 0xcbf29ce484222325ULL;
};

uint64_t digestOf(const scene::Scene& scene) {
    Digest digest;
    for (const scene::Image& image : scene.images) {
        digest.add(image.rgba8.span());
    }
    for (const scene::Mesh& mesh : scene.meshes) {
        for (const scene::Primitive& primitive : mesh.primitives) {
            digest.add(primitive.positions);
            digest.add(primitive.normals);
            digest.add(primitive.uv0);
            digest.add(primitive.indices);
            digest.addValue(primitive.material);
        }
    }
    for (const scene::Instance& instance : scene.instances) {
        digest.addValue(instance.mesh);
        digest.addValue(instance.world_from_object);
    }
    for (const scene::NamedCamera& camera : scene.cameras) {
        digest.addValue(camera.camera.eye_world);
        digest.addValue(camera.camera.world_from_view);
    }
    return digest.value();
}

size_t trianglesOf(const scene::Mesh& mesh) {
    size_t count = 0;
    for (const scene::Primitive& primitive : mesh.primitives) {
        count += primitive.indices.size() / 3;
    }
    return count;
}

// Solid geometry met by the ray from `origin`, both sides, glass and leaves left out: its distance,
// or infinity.
double distanceToSolid(const scene::Scene& scene, glm::dvec3 origin, glm::dvec3 direction) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const scene::Instance& instance : scene.instances) {
        const glm::dmat4 object_from_world = glm::inverse(instance.world_from_object);
        const glm::dvec3 o(object_from_world * glm::dvec4(origin, 1));
        const glm::dvec3 d(object_from_world * glm::dvec4(direction, 0));
        for (const scene::Primitive& p : scene.meshes[instance.mesh].primitives) {
            if (scene.materials[p.material].alpha_mode != scene::AlphaMode::kOpaque) {
                continue;
            }
            for (size_t i = 0; i < p.indices.size(); i += 3) {
                const glm::dvec3 a(p.positions[p.indices[i]]);
                const glm::dvec3 ab = glm::dvec3(p.positions[p.indices[i + 1]]) - a;
                const glm::dvec3 ac = glm::dvec3(p.positions[p.indices[i + 2]]) - a;
                const glm::dvec3 h = glm::cross(d, ac);
                const double determinant = glm::dot(ab, h);
                if (std::abs(determinant) < 1e-14) {
                    continue;
                }
                const glm::dvec3 s = o - a;
                const double u = glm::dot(s, h) / determinant;
                const glm::dvec3 q = glm::cross(s, ab);
                const double v = glm::dot(d, q) / determinant;
                const double t = glm::dot(ac, q) / determinant;
                if (u >= 0 && v >= 0 && u + v <= 1 && t > 0) {
                    nearest = std::min(nearest, t);
                }
            }
        }
    }
    return nearest;
}

TEST(Hall, Made_TriangleCountIsWithinItsBudget) {
    size_t count = 0;
    for (const scene::Instance& instance : theHall().instances) {
        count += trianglesOf(theHall().meshes.at(instance.mesh));
    }
    EXPECT_GE(count, 100'000U);
    EXPECT_LE(count, 185'000U);
}

TEST(Hall, MadeTwice_SameBytes) {
    EXPECT_EQ(digestOf(theHall()), digestOf(makeHall()));
}

TEST(Hall, Made_EveryIndexIsValid) {
    const scene::Scene& scene = theHall();
    for (const scene::Mesh& mesh : scene.meshes) {
        ASSERT_FALSE(mesh.primitives.empty()) << mesh.name;
        for (const scene::Primitive& p : mesh.primitives) {
            ASSERT_LT(p.material, scene.materials.size()) << mesh.name;
            ASSERT_EQ(p.normals.size(), p.positions.size()) << mesh.name;
            ASSERT_EQ(p.uv0.size(), p.positions.size()) << mesh.name;
            ASSERT_EQ(p.indices.size() % 3, 0U) << mesh.name;
            for (const uint32_t index : p.indices) {
                ASSERT_LT(index, p.positions.size()) << mesh.name;
            }
        }
    }
    for (const scene::Material& m : scene.materials) {
        for (const scene::TextureSlot* slot :
             {&m.base_color_texture, &m.metallic_roughness_texture, &m.normal_texture,
              &m.occlusion_texture, &m.emissive_texture}) {
            ASSERT_TRUE(slot->texture == scene::kNone || slot->texture < scene.textures.size())
                << m.name;
        }
    }
    for (const scene::Texture& texture : scene.textures) {
        ASSERT_LT(texture.image, scene.images.size());
        ASSERT_LT(texture.sampler, scene.samplers.size());
    }
    for (const scene::Image& image : scene.images) {
        ASSERT_GE(image.width_px, 256U) << image.name;
        ASSERT_LE(image.width_px, 512U) << image.name;
        ASSERT_EQ(image.rgba8.size(), size_t{4} * image.width_px * image.height_px) << image.name;
    }
}

TEST(Hall, Made_NormalsAreUnitAndFacesLookTheirWay) {
    for (const scene::Mesh& mesh : theHall().meshes) {
        for (const scene::Primitive& p : mesh.primitives) {
            for (const glm::vec3& normal : p.normals) {
                ASSERT_NEAR(glm::length(normal), 1.0F, 1e-3F) << mesh.name;
            }
            for (size_t i = 0; i < p.indices.size(); i += 3) {
                const uint32_t a = p.indices[i];
                const uint32_t b = p.indices[i + 1];
                const uint32_t c = p.indices[i + 2];
                const glm::vec3 area =
                    glm::cross(p.positions[b] - p.positions[a], p.positions[c] - p.positions[a]);
                ASSERT_GE(glm::dot(area, p.normals[a] + p.normals[b] + p.normals[c]), -1e-7F)
                    << mesh.name << " material " << theHall().materials[p.material].name;
            }
        }
    }
}

TEST(Hall, Made_FewTrianglesAreDegenerate) {
    size_t thin = 0;
    size_t count = 0;
    for (const scene::Mesh& mesh : theHall().meshes) {
        for (const scene::Primitive& p : mesh.primitives) {
            for (size_t i = 0; i < p.indices.size(); i += 3) {
                const glm::vec3 a = p.positions[p.indices[i]];
                const glm::vec3 area = glm::cross(p.positions[p.indices[i + 1]] - a,
                                                  p.positions[p.indices[i + 2]] - a);
                thin += glm::length(area) < 1e-8F ? 1U : 0U;
                ++count;
            }
        }
    }
    EXPECT_LE(thin * 1000, count);
}

TEST(Hall, Made_TexturesAreRightHanded) {
    for (const scene::Mesh& mesh : theHall().meshes) {
        double mirrored = 0;
        double total = 0;
        for (const scene::Primitive& p : mesh.primitives) {
            for (size_t i = 0; i < p.indices.size(); i += 3) {
                const auto edge = [&](const auto& values, size_t k) {
                    return values[p.indices[i + k]] - values[p.indices[i]];
                };
                const glm::vec2 e1 = edge(p.uv0, 1);
                const glm::vec2 e2 = edge(p.uv0, 2);
                const double area =
                    glm::length(glm::cross(edge(p.positions, 1), edge(p.positions, 2)));
                total += area;
                // v runs down: counter-clockwise in space is clockwise in uv.
                mirrored += e1.x * e2.y - e1.y * e2.x > 1e-9F ? area : 0.0;
            }
        }
        EXPECT_LE(mirrored, 0.001 * total) << mesh.name;
    }
}

TEST(Hall, Made_BoundsHoldEveryInstanceAndAreHallSized) {
    const BoundsD3& bounds = theHall().bounds_world;
    EXPECT_GT(bounds.size().x, 30);
    EXPECT_LT(bounds.size().x, 38);
    EXPECT_GT(bounds.size().y, 11);
    EXPECT_LT(bounds.size().y, 15);
    EXPECT_GT(bounds.size().z, 15);
    EXPECT_LT(bounds.size().z, 18);
}

TEST(Hall, Made_SixNamedCamerasStandFreeInside) {
    const scene::Scene& scene = theHall();
    ASSERT_EQ(scene.cameras.size(), 6U);
    std::set<std::string> names;
    for (const scene::NamedCamera& camera : scene.cameras) {
        names.insert(camera.name);
        const glm::dvec3 eye = camera.camera.eye_world;
        for (const glm::dvec3 direction :
             {glm::dvec3(1, 0, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, -1, 0),
              glm::dvec3(0, 0, 1), glm::dvec3(0, 0, -1)}) {
            // A slant, so that no ray runs along an edge shared by two triangles.
            const double distance = distanceToSolid(
                scene, eye, glm::normalize(direction + glm::dvec3(0.013, 0.007, 0.011)));
            EXPECT_GT(distance, 0.15) << camera.name << " stands in something";
            EXPECT_LT(distance, 40.0) << camera.name << " looks out of the hall";
        }
    }
    EXPECT_EQ(names.size(), 6U);
}

TEST(Hall, Made_HasMaskedBlendedAndEmissiveSurfacesInUse) {
    const scene::Scene& scene = theHall();
    bool masked = false;
    bool blended = false;
    bool glowing = false;
    for (const scene::Instance& instance : scene.instances) {
        for (const scene::Primitive& p : scene.meshes[instance.mesh].primitives) {
            const scene::Material& m = scene.materials[p.material];
            masked |= m.alpha_mode == scene::AlphaMode::kMask;
            blended |= m.alpha_mode == scene::AlphaMode::kBlend;
            glowing |= m.emissive != glm::vec3(0);
        }
    }
    EXPECT_TRUE(masked);
    EXPECT_TRUE(blended);
    EXPECT_TRUE(glowing);
}

} // namespace
} // namespace froxel::builtin_scene
