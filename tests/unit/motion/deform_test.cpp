// Vertices moved by joints and targets, against sums in double and against what they must equal.
#include "motion/bounds.h"
#include "motion/deform.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace froxel::motion {
namespace {

using scene::Deformation;
using scene::Primitive;

float uniform(std::mt19937_64& random, float low, float high) {
    return std::uniform_real_distribution(low, high)(random);
}

glm::vec3 anyVector(std::mt19937_64& random) {
    return {uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)};
}

Primitive cloud(size_t count, std::mt19937_64& random) {
    Primitive primitive;
    for (size_t i = 0; i < count; ++i) {
        primitive.positions.push_back(anyVector(random));
        primitive.normals.push_back(glm::vec3(glm::normalize(glm::dvec3(anyVector(random)))));
        const glm::vec3 tangent(glm::normalize(glm::dvec3(anyVector(random))));
        primitive.tangents.emplace_back(tangent, i % 2 == 0 ? 1 : -1);
    }
    return primitive;
}

// Every vertex follows `joints` by the weights given.
Deformation followers(size_t count, const std::vector<scene::Influence>& influences) {
    Deformation deformation;
    deformation.first_influence = {0};
    for (size_t v = 0; v < count; ++v) {
        deformation.influences.insert(deformation.influences.end(), influences.begin(),
                                      influences.end());
        deformation.first_influence.push_back(static_cast<uint32_t>(deformation.influences.size()));
    }
    return deformation;
}

SkinPose posedBy(const std::vector<glm::dmat4>& joints) {
    scene::Skin skin;
    Pose pose;
    for (const glm::dmat4& joint : joints) {
        skin.joints.push_back(static_cast<uint32_t>(pose.world_from_node.size()));
        skin.joint_from_object.emplace_back(1);
        pose.world_from_node.push_back(joint);
    }
    SkinPose result;
    poseSkin(skin, pose, result);
    return result;
}

PosedVertices deformed(const Primitive& primitive,
                       const Deformation& deformation,
                       std::span<const double> weights,
                       const SkinPose* skin) {
    PosedVertices out;
    deform(primitive, deformation, weights, skin, out);
    return out;
}

glm::dvec3 inWorld(const SkinPose& skin, const glm::vec3& posed) {
    return glm::dvec3(skin.world_from_posed * glm::dvec4(posed, 1));
}

TEST(Deform, JointsAtRest_ChangeNoBit) {
    std::mt19937_64 random(1);
    const Primitive primitive = cloud(500, random);
    const SkinPose skin = posedBy({glm::dmat4(1), glm::dmat4(1), glm::dmat4(1)});
    const Deformation deformation = followers(500, {{0, 0.5F}, {2, 0.25F}, {1, 0.25F}});
    const PosedVertices out = deformed(primitive, deformation, {}, &skin);
    EXPECT_EQ(out.positions, primitive.positions);
    EXPECT_EQ(out.normals, primitive.normals);
    EXPECT_EQ(out.tangents, primitive.tangents);
}

TEST(Deform, TargetsAtZero_ChangeNoBit) {
    std::mt19937_64 random(2);
    const Primitive primitive = cloud(1, random);
    const Deformation deformation{{}, {}, {0, 1}, {{0, {1, 2, 3}, {1, 0, 0}, {0, 1, 0}}}, false};
    const double zero = 0;
    const PosedVertices out = deformed(primitive, deformation, std::span(&zero, 1), nullptr);
    EXPECT_EQ(out.positions, primitive.positions);
    EXPECT_EQ(out.normals, primitive.normals);
}

// The sums of the specification in double. The error is that of some sums in single precision.
TEST(Deform, RandomSkin_IsTheSumInDouble) {
    std::mt19937_64 random(3);
    const Primitive primitive = cloud(300, random);
    std::vector<glm::dmat4> joints;
    for (int i = 0; i < 8; ++i) {
        glm::dmat4 m(1);
        for (int column = 0; column < 3; ++column) {
            m[column] += glm::dvec4(0.4 * glm::dvec3(anyVector(random)), 0);
        }
        m[3] = glm::dvec4(3.0 * glm::dvec3(anyVector(random)), 1);
        joints.push_back(m);
    }
    Deformation deformation;
    deformation.first_influence = {0};
    for (size_t v = 0; v < 300; ++v) {
        const float share = uniform(random, 0.01F, 0.99F);
        deformation.influences.push_back({static_cast<uint32_t>(v % 8), share});
        deformation.influences.push_back({static_cast<uint32_t>((v * 5 + 3) % 8), 1 - share});
        deformation.first_influence.push_back(static_cast<uint32_t>(2 * v + 2));
    }
    const SkinPose skin = posedBy(joints);
    const PosedVertices out = deformed(primitive, deformation, {}, &skin);
    for (size_t v = 0; v < 300; ++v) {
        glm::dmat4 sum(0);
        for (size_t i = 2 * v; i < 2 * v + 2; ++i) {
            sum += static_cast<double>(deformation.influences[i].weight) *
                   joints[deformation.influences[i].joint];
        }
        const glm::dvec3 position(sum * glm::dvec4(primitive.positions[v], 1));
        const glm::dvec3 normal = glm::normalize(glm::transpose(glm::inverse(glm::dmat3(sum))) *
                                                 glm::dvec3(primitive.normals[v]));
        const glm::dvec3 tangent =
            glm::normalize(glm::dmat3(sum) * glm::dvec3(primitive.tangents[v]));
        EXPECT_LT(glm::length(inWorld(skin, out.positions[v]) - position), 3e-6);
        // A mirror is its own inverse transpose.
        const glm::dmat3 turn(skin.world_from_posed);
        EXPECT_LT(glm::length(turn * glm::dvec3(out.normals[v]) - normal), 3e-5);
        EXPECT_LT(glm::length(turn * glm::dvec3(out.tangents[v]) - tangent), 3e-6);
    }
}

TEST(Deform, UnevenScale_TiltsNormals) {
    Primitive primitive;
    primitive.positions = {{1, 1, 0}};
    primitive.normals = {glm::vec3(std::sqrt(0.5F), std::sqrt(0.5F), 0)};
    const SkinPose skin = posedBy({glm::scale(glm::dmat4(1), {1, 2, 1})});
    const PosedVertices out = deformed(primitive, followers(1, {{0, 1}}), {}, &skin);
    EXPECT_NEAR(out.normals[0].x, 2 / std::sqrt(5.0), 1e-7); // M^-T (1, 1) ~ (1, 1/2)
    EXPECT_NEAR(out.normals[0].y, 1 / std::sqrt(5.0), 1e-7);
}

TEST(Deform, MirroredJoint_IsAMirroredInstance) {
    std::mt19937_64 random(8);
    const Primitive primitive = cloud(20, random);
    const glm::dmat4 mirror = glm::scale(glm::dmat4(1), {-1, 1, 1});
    const SkinPose skin = posedBy({mirror});
    EXPECT_EQ(skin.world_from_posed, mirror);
    const PosedVertices out = deformed(primitive, followers(20, {{0, 1}}), {}, &skin);
    EXPECT_EQ(out.positions, primitive.positions);
    EXPECT_EQ(out.normals, primitive.normals);
    EXPECT_EQ(out.tangents, primitive.tangents);
}

// What follows the second joint, which mirrors where the first does not, has the other handedness.
TEST(Deform, JointMirroredAgainstTheFirst_TurnsTheTangentsSide) {
    std::mt19937_64 random(9);
    const Primitive primitive = cloud(20, random);
    const glm::dmat4 mirror = glm::scale(glm::dmat4(1), {-1, 1, 1});
    const SkinPose skin = posedBy({glm::dmat4(1), mirror});
    const auto tangent_of = [&](uint32_t joint) {
        return deformed(primitive, followers(20, {{joint, 1}}), {}, &skin).tangents;
    };
    const auto kept = tangent_of(0);
    const auto turned = tangent_of(1);
    for (size_t i = 0; i < 20; ++i) {
        EXPECT_EQ(kept[i], primitive.tangents[i]);
        EXPECT_EQ(turned[i].w, -primitive.tangents[i].w);
        EXPECT_NEAR(turned[i].x, -primitive.tangents[i].x, 1e-6F);
    }
}

TEST(Deform, JointOfNoSize_KeepsDirections) {
    std::mt19937_64 random(4);
    const Primitive primitive = cloud(20, random);
    const SkinPose skin = posedBy({glm::dmat4(glm::dmat3(0))});
    const PosedVertices out = deformed(primitive, followers(20, {{0, 1}}), {}, &skin);
    EXPECT_EQ(out.positions, std::vector<glm::vec3>(20, glm::vec3(0)));
    EXPECT_EQ(out.normals, primitive.normals);
}

TEST(Deform, JointOutOfRange_GoesToTheAnchor) {
    glm::dmat4 far(1);
    far[3].x = 1e300;
    glm::dmat4 broken(1);
    broken[0].x = std::numeric_limits<double>::quiet_NaN();
    const SkinPose skin = posedBy({far, broken});
    EXPECT_EQ(skin.world_from_posed, glm::dmat4(1));
    for (const JointMatrix& joint : skin.joints) {
        for (const glm::vec4& row : joint.row) {
            EXPECT_EQ(row, glm::vec4(0));
        }
    }
}

// A tenth of a millimetre at a distance where single precision has steps of 6 cm.
TEST(Deform, FarAway_IsAsExactAsAtHome) {
    std::mt19937_64 random(5);
    const Primitive primitive = cloud(100, random);
    const Deformation deformation = followers(100, {{0, 0.5F}, {1, 0.5F}});
    const glm::dmat4 turned = glm::rotate(glm::dmat4(1), 0.3, {0, 0, 1});
    const glm::dmat4 far = glm::translate(glm::dmat4(1), {1e6, 0, 0});
    const SkinPose home = posedBy({glm::dmat4(1), turned});
    const SkinPose away = posedBy({far, far * turned});
    EXPECT_EQ(glm::dvec3(away.world_from_posed[3]), glm::dvec3(1e6, 0, 0));
    EXPECT_EQ(deformed(primitive, deformation, {}, &home).positions,
              deformed(primitive, deformation, {}, &away).positions);
}

TEST(Deform, Targets_AddBeforeTheSkin) {
    Primitive primitive;
    primitive.positions = {{0, 0, 0}, {1, 0, 0}};
    primitive.normals = {{0, 0, 1}, {0, 0, 1}};
    Deformation deformation = followers(2, {{0, 1}});
    deformation.first_delta = {0, 2, 2}; // sparse: the second vertex has none
    deformation.deltas = {{0, {0, 1, 0}, {1, 0, 0}, {}}, {3, {0, 0, 4}, {}, {}}};
    const double weights[] = {2, 9, 9, -0.5};
    const SkinPose skin = posedBy({glm::scale(glm::dmat4(1), {1, 3, 1})});
    const PosedVertices out = deformed(primitive, deformation, weights, &skin);
    EXPECT_EQ(out.positions[0], glm::vec3(0, 6, -2));
    EXPECT_EQ(out.positions[1], glm::vec3(1, 0, 0));
    EXPECT_NEAR(out.normals[0].x, 2 / std::sqrt(5.0), 1e-7);
    EXPECT_NEAR(out.normals[0].z, 1 / std::sqrt(5.0), 1e-7);
    EXPECT_EQ(out.normals[1], glm::vec3(0, 0, 1));
}

TEST(Deform, FlatNormals_AreThoseOfTheMovedTriangle) {
    Primitive primitive;
    primitive.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    primitive.normals.assign(3, {0, 0, 1});
    primitive.indices = {0, 1, 2};
    const Deformation deformation{{}, {}, {0, 0, 0, 1}, {{0, {0, -1, 1}, {}, {}}}, true};
    const double one = 1;
    const PosedVertices out = deformed(primitive, deformation, std::span(&one, 1), nullptr);
    EXPECT_EQ(out.normals[0], glm::vec3(0, -1, 0));
    EXPECT_EQ(out.normals[2], glm::vec3(0, -1, 0));
}

TEST(Bounds, AnyPose_LiesInside) {
    std::mt19937_64 random(6);
    for (int round = 0; round < 50; ++round) {
        const Primitive primitive = cloud(40, random);
        Deformation deformation = followers(40, {});
        deformation.first_influence = {0};
        deformation.first_delta = {0};
        for (uint32_t v = 0; v < 40; ++v) {
            const float share = uniform(random, 0, 1);
            deformation.influences.push_back({v % 4, share});
            deformation.influences.push_back({4, 1 - share});
            deformation.first_influence.push_back(2 * v + 2);
            deformation.deltas.push_back({v % 3, anyVector(random), {}, {}});
            deformation.first_delta.push_back(v + 1);
        }
        std::vector<glm::dmat4> joints;
        for (int j = 0; j < 5; ++j) {
            const glm::dmat4 turned = glm::rotate(glm::dmat4(1), 3.0 * anyVector(random).x,
                                                  glm::normalize(glm::dvec3(anyVector(random))));
            joints.push_back(glm::translate(glm::dmat4(1), glm::dvec3(anyVector(random))) * turned *
                             glm::scale(glm::dmat4(1), 2.0 * glm::dvec3(anyVector(random))));
        }
        const double weights[] = {uniform(random, -2, 2), uniform(random, -2, 2), 0};
        const SkinPose skin = posedBy(joints);
        const DeformExtent extent = extentOf(primitive, deformation, 3);
        EXPECT_EQ(extent.joints.size(), 5U);
        const BoundsD3 skinned = boundsOf(extent, weights, &skin);
        const BoundsD3 morphed = boundsOf(extent, weights, nullptr);
        const auto expectInside = [](const BoundsD3& box, const std::vector<glm::vec3>& points) {
            for (const glm::dvec3 p : points) {
                EXPECT_TRUE(glm::all(glm::lessThanEqual(box.min, p)) &&
                            glm::all(glm::lessThanEqual(p, box.max)));
            }
        };
        expectInside(skinned, deformed(primitive, deformation, weights, &skin).positions);
        deformation.first_influence.clear();
        expectInside(morphed, deformed(primitive, deformation, weights, nullptr).positions);
        EXPECT_LT(glm::length(skinned.size()), 60); // a box, not the world
    }
}

TEST(Bounds, OneRigidJoint_IsTight) {
    Primitive primitive;
    primitive.positions = {{-1, -2, -3}, {1, 2, 3}};
    const SkinPose skin = posedBy({glm::translate(glm::dmat4(1), {5, 0, 0})});
    const BoundsD3 box = boundsOf(extentOf(primitive, followers(2, {{0, 1}}), 0), {}, &skin);
    EXPECT_LT(glm::length(box.min - glm::dvec3(-1, -2, -3)), 1e-4); // relative to the anchor
    EXPECT_LT(glm::length(box.max - glm::dvec3(1, 2, 3)), 1e-4);
}

} // namespace
} // namespace froxel::motion
