// What is not a number, infinite, empty or degenerate, in files and in scenes made by code.
#include "core/error.h"
#include "support/exact.h"
#include "support/gpu_fixture.h"
#include "support/shapes.h"
#include "support/test_scenes.h"
#include "unit/gltf/scene_file.h"

#include <cmath>
#include <functional>
#include <limits>

namespace froxel::test {

namespace {

using glm::dvec3;
using ::testing::HasSubstr;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr double kNanD = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinityD = std::numeric_limits<double>::infinity();

class HardBadInput : public SharedGpuTest {
  protected:
    static render::FrameInputs roomInputs(const scene::Scene& scene) {
        auto inputs = hardInputs();
        inputs.settings.camera = scene.cameras[0].camera;
        inputs.settings.lights.count = 1000;
        inputs.settings.lights.radius_m = 1;
        return inputs;
    }
};

using Change = std::function<void(scene::PunctualLight&)>;

scene::PunctualLight lightWith(scene::LightType type, const Change& change) {
    scene::PunctualLight light;
    light.type = type;
    light.position_world = {0, 1, 1};
    light.range_m = 2;
    light.intensity = 3;
    change(light);
    return light;
}

} // namespace

// Case 9. No frame holds a light that is not finite; one that is dark adds nothing.
TEST_F(HardBadInput, UnusableLights_ChangeNothing) {
    using scene::LightType;
    const auto plain = makeRoom();
    auto scene = plain;
    const std::pair<LightType, Change> bad[] = {
        {LightType::kPoint, [](auto& l) { l.position_world.x = kNanD; }},
        {LightType::kPoint, [](auto& l) { l.position_world.z = -kInfinityD; }},
        {LightType::kPoint, [](auto& l) { l.color.y = kNan; }},
        {LightType::kPoint, [](auto& l) { l.color.z = kInfinity; }},
        {LightType::kPoint, [](auto& l) { l.intensity = kNan; }},
        {LightType::kPoint, [](auto& l) { l.intensity = kInfinity; }},
        {LightType::kPoint, [](auto& l) { l.range_m = -1; }},
        {LightType::kPoint, [](auto& l) { l.range_m = kNan; }},
        {LightType::kPoint, [](auto& l) { l.range_m = kInfinity; }},
        {LightType::kSpot, [](auto& l) { l.direction_world = dvec3(0); }},
        {LightType::kSpot, [](auto& l) { l.direction_world.y = kNanD; }},
        {LightType::kSpot, [](auto& l) { l.outer_cone_rad = kNanD; }},
        {LightType::kSpot, [](auto& l) { l.inner_cone_rad = kInfinityD; }},
        {LightType::kDirectional, [](auto& l) { l.direction_world = dvec3(0); }},
        {LightType::kDirectional, [](auto& l) { l.direction_world.x = kInfinityD; }},
        {LightType::kDirectional, [](auto& l) { l.intensity = kNan; }}};
    for (const auto& [type, change] : bad) {
        scene.lights.push_back(lightWith(type, change));
    }
    render::Renderer renderer(device(), scene);
    render::Renderer plain_renderer(device(), plain);
    const auto inputs = roomInputs(scene);
    const auto pictures = expectExact(renderer, inputs, Toon::kNo);
    const auto expected = expectExact(plain_renderer, inputs, Toon::kNo);
    EXPECT_EQ(differingFloats(pictures.naive, expected.naive), 0U);
    EXPECT_EQ(differingFloats(pictures.deferred, expected.deferred), 0U);
    EXPECT_EQ(pictures.forward_plus.stats.lists.light_count, 1000U);
}

TEST_F(HardBadInput, DarkAndTinyLights_AddNothing) {
    const auto plain = makeRoom();
    auto scene = plain;
    scene.lights.push_back(lightWith(scene::LightType::kPoint, [](auto& l) { l.intensity = 0; }));
    scene.lights.push_back(
        lightWith(scene::LightType::kPoint, [](auto& l) { l.range_m = 1e-30F; }));
    scene.lights.push_back(
        lightWith(scene::LightType::kPoint, [](auto& l) { l.position_world.x = 1e300; }));
    render::Renderer renderer(device(), scene);
    render::Renderer plain_renderer(device(), plain);
    const auto inputs = roomInputs(scene);
    const auto pictures = expectExact(renderer, inputs, Toon::kNo);
    EXPECT_EQ(differingFloats(pictures.naive, expectExact(plain_renderer, inputs, Toon::kNo).naive),
              0U);
}

// Cones inside out, of no width and beyond a half turn: finite, and the same by lists.
TEST_F(HardBadInput, ConesInsideOut_AreFiniteAndExact) {
    auto scene = makeRoom();
    const std::pair<double, double> cones[] = {{0.6, 0.3}, {0, 0},  {-1, 1},      {1, -1},
                                               {0, 4},     {4, 10}, {1e300, 0.5}, {0.5, 1e300}};
    for (const auto& [inner, outer] : cones) {
        scene.lights.push_back(lightWith(scene::LightType::kSpot, [&](auto& l) {
            l.inner_cone_rad = inner;
            l.outer_cone_rad = outer;
            l.direction_world = {0.1, -1, -0.3};
        }));
    }
    render::Renderer renderer(device(), scene);
    (void)expectExact(renderer, roomInputs(scene));
}

// A scene made by code that no frame could be drawn from is refused by one line that names the
// thing.
TEST_F(HardBadInput, SceneThatIsNotFinite_IsRefusedByName) {
    using Break = std::function<void(scene::Scene&)>;
    const std::pair<const char*, Break> cases[] = {
        {"positions", [](auto& s) { s.meshes[0].primitives[0].positions[3].y = kNan; }},
        {"normals", [](auto& s) { s.meshes[0].primitives[0].normals[3].y = kInfinity; }},
        {"uv0", [](auto& s) { s.meshes[0].primitives[0].uv0[3].y = kNan; }},
        {"colors", [](auto& s) { s.meshes[0].primitives[0].colors.assign(625, glm::vec4(kNan)); }},
        {"world_from_object", [](auto& s) { s.instances[2].world_from_object[3].x = kInfinityD; }},
        {"world_from_object", [](auto& s) { s.instances[2].world_from_object[1].y = kNanD; }},
        {"world_from_object", [](auto& s) { s.instances[2].world_from_object[1].y = 1e20; }},
        {"base_color", [](auto& s) { s.materials[1].base_color.y = kNan; }},
        {"roughness", [](auto& s) { s.materials[1].roughness = kNan; }},
        {"metallic", [](auto& s) { s.materials[1].metallic = -kInfinity; }},
        {"normal_scale", [](auto& s) { s.materials[1].normal_scale = kInfinity; }},
        {"occlusion_strength", [](auto& s) { s.materials[1].occlusion_strength = kNan; }},
        {"emissive", [](auto& s) { s.materials[1].emissive.z = kInfinity; }},
        {"alpha_cutoff", [](auto& s) { s.materials[1].alpha_cutoff = kNan; }},
        {"offset", [](auto& s) { s.materials[0].base_color_texture.offset.x = kNan; }},
        {"rotation_rad", [](auto& s) { s.materials[0].normal_texture.rotation_rad = kInfinity; }},
        {"scale", [](auto& s) { s.materials[0].base_color_texture.scale.y = kNan; }},
        {"indices", [](auto& s) { s.meshes[0].primitives[0].indices[5] = 625; }},
        {"material", [](auto& s) { s.meshes[0].primitives[0].material = 99; }},
        {"mesh", [](auto& s) { s.instances[0].mesh = 99; }},
        {"texture", [](auto& s) { s.materials[0].base_color_texture.texture = 99; }}};
    for (const auto& [what, broken] : cases) {
        SCOPED_TRACE(what);
        auto scene = makeRoom();
        broken(scene);
        try {
            const render::Renderer renderer(device(), scene);
            ADD_FAILURE() << "taken";
        } catch (const StartupError& error) {
            EXPECT_EQ(error.code(), ErrorCode::kScene);
            EXPECT_THAT(error.what(), HasSubstr(what));
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        }
    }
}

// Nodes that squash things to nothing or blow them up, triangles without area, vertices without a
// direction: finite, and the same by lists.
TEST_F(HardBadInput, DegenerateGeometry_IsFiniteAndExact) {
    auto scene = makeRoom();
    const dvec3 scales[] = {{0, 0, 0},       {1, 1, 0},          {1, 0, 1},    {1e-20, 1, 1},
                            {1e14, 1e14, 1}, {1e-20, 1e-20, -1}, {-1, 1, 1e-9}};
    for (const dvec3& scale : scales) {
        scene::Instance instance{.mesh = 4, .world_from_object = glm::dmat4(1), .name = {}};
        for (int axis = 0; axis < 3; ++axis) {
            instance.world_from_object[axis] *= scale[axis];
        }
        instance.world_from_object[3] = {0.3, 0.5, 2, 1};
        scene.instances.push_back(instance);
    }
    auto& floor = scene.meshes[0].primitives[0];
    for (size_t i = 0; i < floor.positions.size(); i += 5) {
        floor.normals[i] = -floor.normals[i]; // as far apart as normals of a triangle can be
    }
    for (size_t i = 0; i + 2 < floor.indices.size(); i += 21) {
        floor.indices[i] = floor.indices[i + 1];
    }
    auto& wall = scene.meshes[1].primitives[0];
    for (auto& uv : wall.uv0) {
        uv = {0.25F, 0.25F}; // no gradient for the normal map
    }
    for (auto& uv : scene.meshes[3].primitives[0].uv0) {
        uv *= 1e30F;
    }
    render::Renderer renderer(device(), scene);
    auto inputs = roomInputs(scene);
    inputs.settings.lights.count = 100;
    inputs.settings.lights.box = BoundsD3{{-5, 0, -4}, {5, 5, 5}};
    for (const auto shading : {settings::ShadingModel::kLambert,
                               settings::ShadingModel::kBlinnPhong, settings::ShadingModel::kPbr}) {
        inputs.settings.shading = shading;
        (void)expectExact(renderer, inputs, Toon::kNo);
    }
}

TEST_F(HardBadInput, EmptyScene_IsBackground) {
    const scene::Scene nothing;
    render::Renderer renderer(device(), nothing);
    auto inputs = hardInputs();
    inputs.settings.lights.count = 100;
    const auto pictures = expectExact(renderer, inputs);
    EXPECT_EQ(pictures.forward_plus.stats.triangle_count, 0U);
}

// Values that a file may hold at the ends of their ranges: loaded, drawn, finite.
TEST_F(HardBadInput, FileOfExtremeValues_IsFiniteAndExact) {
    gltf::test::SceneFile file;
    using gltf::test::Json;
    file.add("materials", Json::parse(R"({"pbrMetallicRoughness": {"roughnessFactor": 0,
        "metallicFactor": 1, "baseColorFactor": [1, 0, 1, 1]},
        "emissiveFactor": [1, 1, 0], "extensions": {"KHR_materials_emissive_strength":
        {"emissiveStrength": 1e30}}})"));
    file.primitive()["material"] = 0;
    file.useExtension("KHR_materials_emissive_strength");
    file.useExtension("KHR_lights_punctual");
    file.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::parse(R"([
        {"type": "point", "intensity": 3e38, "range": 1e-38},
        {"type": "point", "intensity": 3e38, "range": 3e38},
        {"type": "point", "intensity": 1e-45},
        {"type": "spot", "intensity": 10, "spot": {"outerConeAngle": 1e-30}},
        {"type": "spot", "intensity": 10,
         "spot": {"innerConeAngle": 1.5707963, "outerConeAngle": 1.5707964}},
        {"type": "directional", "intensity": 1e38}])");
    for (int i = 0; i < 6; ++i) {
        Json node = {{"translation", {0.25, 0.25, 1.0}}};
        node["extensions"]["KHR_lights_punctual"]["light"] = i;
        file.json["scenes"][0]["nodes"].push_back(file.add("nodes", node));
    }
    auto scene = gltf::test::loaded(file.load());
    ASSERT_EQ(scene.lights.size(), 6U);
    auto inputs = hardInputs();
    inputs.settings.camera = settings::lookAt({0.3, 0.3, 2}, {0.3, 0.3, 0}, {0, 1, 0});
    inputs.settings.shading = settings::ShadingModel::kPbr;
    render::Renderer renderer(device(), scene);
    (void)expectExact(renderer, inputs);
    // Nothing is left of what its own side scatters, the other's is black, and neither reflects.
    auto& material = scene.materials.at(scene.meshes.at(0).primitives.at(0).material);
    material = {};
    material.metallic = 0;
    material.specular = 0;
    material.diffuse_transmission = {.color = glm::vec3(0), .strength = 1};
    render::Renderer through(device(), scene);
    const auto pictures = expectExact(through, inputs);
    EXPECT_EQ(std::ranges::count(pictures.naive.radiance, 0.0F),
              std::ssize(pictures.naive.radiance));
}

// What a file cannot mean is one line that names it; nothing of it reaches the device.
TEST_F(HardBadInput, FileThatIsNotFinite_IsRefusedOrGoesWithoutThat) {
    using gltf::test::SceneFile;
    SceneFile position;
    position.attributes()["POSITION"] =
        position.addAccessor(std::vector<float>{0, 0, 0, kNan, 0, 0, 0, 1, 0}, 3);
    const auto scene = gltf::test::loaded(position.load());
    EXPECT_THAT(gltf::test::warningLines(scene), testing::Contains(HasSubstr("POSITION")));
    for (const auto& mesh : scene.meshes) {
        EXPECT_TRUE(mesh.primitives.empty());
    }
    SceneFile light;
    light.useExtension("KHR_lights_punctual");
    light.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "point"}, {"intensity", 1e39}}};
    light.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    EXPECT_THAT(gltf::test::told(light.load()), HasSubstr("intensity is 1e+39"));
}

} // namespace froxel::test
