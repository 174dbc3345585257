#include "files.h"

#include <array>
#include <gmock/gmock.h>
#include <zlib.h>

namespace froxel::formats {
namespace {

using testing::HasSubstr;

template <class T>
void add(std::string& bytes, T value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// A zip whose files are stored as they are.
std::string zipOf(const std::vector<std::pair<std::string, std::string>>& files) {
    std::string zip;
    std::string directory;
    for (const auto& [name, content] : files) {
        const auto size = static_cast<uint32_t>(content.size());
        const auto check =
            static_cast<uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(content.data()), size));
        std::string common;
        for (const auto word :
             std::to_array<uint16_t>({20, 0, 0, 0, 0x21})) { // version, flags, stored, time, date
            add(common, word);
        }
        add(common, check);
        add(common, size);
        add(common, size);
        add(common, static_cast<uint16_t>(name.size()));
        add(common, uint16_t{0});
        directory += "PK\x01\x02";
        add(directory, uint16_t{20});
        directory += common;
        directory.append(10, '\0');
        add(directory, static_cast<uint32_t>(zip.size()));
        directory += name;
        zip += "PK\x03\x04" + common + name + content;
    }
    const auto begin = static_cast<uint32_t>(zip.size());
    zip += directory + "PK\x05\x06";
    add(zip, uint32_t{0});
    add(zip, static_cast<uint16_t>(files.size()));
    add(zip, static_cast<uint16_t>(files.size()));
    add(zip, static_cast<uint32_t>(directory.size()));
    add(zip, begin);
    add(zip, uint16_t{0});
    return zip;
}

constexpr const char* kTypes =
    R"(<?xml version="1.0" encoding="UTF-8"?><Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types"><Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/><Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>)";
constexpr const char* kRelations =
    R"(<?xml version="1.0" encoding="UTF-8"?><Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship Target="/3D/3dmodel.model" Id="r" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>)";
// A tetrahedron, whose first triangle is green and whose others are red.
constexpr const char* kMesh =
    R"(<basematerials id="5"><base name="red" displaycolor="#FF0000"/><base name="green" displaycolor="#00FF00FF"/></basematerials>)"
    R"(<object id="1" type="model" name="tetrahedron" pid="5" pindex="0"><mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/><vertex x="0" y="2" z="0"/><vertex x="0" y="0" z="3"/></vertices>)"
    R"(<triangles><triangle v1="0" v2="2" v3="1" pid="5" p1="1"/><triangle v1="0" v2="1" v3="3"/><triangle v1="0" v2="3" v3="2"/><triangle v1="1" v2="2" v3="3"/></triangles></mesh></object>)";

std::string package(const std::string& resources, const std::string& build) {
    const std::string model =
        R"(<?xml version="1.0" encoding="UTF-8"?><model unit="centimeter" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources>)" +
        resources + "</resources><build>" + build + "</build></model>";
    return zipOf({{"[Content_Types].xml", kTypes},
                  {"_rels/.rels", kRelations},
                  {"3D/3dmodel.model", model}});
}

TEST(ThreeMf, UnitAxisAndColours) {
    const auto scene =
        Files().add("a.3mf", package(kMesh, R"(<item objectid="1"/>)")).load("a.3mf");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->instances[0].name, "tetrahedron");
    // Centimetres; z is up.
    EXPECT_NEAR(scene->bounds_world.max.x, 0.01, 1e-9);
    EXPECT_NEAR(scene->bounds_world.max.y, 0.03, 1e-9);
    EXPECT_NEAR(scene->bounds_world.min.z, -0.02, 1e-9);
    const scene::Primitive& part = scene->meshes[0].primitives[0];
    ASSERT_EQ(part.colors.size(), 12U);
    EXPECT_EQ(part.colors[0], glm::vec4(0, 1, 0, 1));
    EXPECT_EQ(part.colors[3], glm::vec4(1, 0, 0, 1));
}

TEST(ThreeMf, ComponentsArePlacedByAllOfTheirTransforms) {
    const std::string pair =
        R"(<object id="2" type="model"><components><component objectid="1"/>)"
        R"(<component objectid="1" transform="1 0 0 0 1 0 0 0 1 30 0 0"/></components></object>)";
    // A quarter about z, then 5 up.
    const auto scene =
        Files()
            .add("a.3mf", package(kMesh + pair,
                                  R"(<item objectid="2" transform="0 1 0 -1 0 0 0 0 1 0 0 5"/>)"))
            .load("a.3mf");
    ASSERT_TRUE(scene) << scene.error().message;
    ASSERT_EQ(scene->instances.size(), 2U);
    EXPECT_EQ(scene->meshes.size(), 1U);
    // x becomes y, which is -z in glTF.
    const glm::dvec3 second(scene->instances[1].world_from_object[3]);
    EXPECT_NEAR(second.x, 0, 1e-6);
    EXPECT_NEAR(second.y, 0.05, 1e-6);
    EXPECT_NEAR(second.z, -0.3, 1e-6);
}

TEST(ThreeMf, ComponentsThatMultiplyAreRefused) {
    std::string objects = kMesh;
    for (int id = 10; id < 28; ++id) {
        const std::string child = id == 10 ? "1" : std::to_string(id - 1);
        objects += "<object id=\"" + std::to_string(id) + "\" type=\"model\"><components>" +
                   "<component objectid=\"" + child + "\"/><component objectid=\"" + child +
                   "\"/></components></object>";
    }
    EXPECT_THAT(Files().add("a.3mf", package(objects, R"(<item objectid="27"/>)")).faultOf("a.3mf"),
                HasSubstr("places more than 65536 objects"));
}

TEST(ThreeMf, WhatIsNoneIsRefused) {
    const auto faultOf = [](const std::string& file) {
        return Files().add("a.3mf", file).faultOf("a.3mf");
    };
    EXPECT_THAT(faultOf(""), HasSubstr("it is no 3MF file"));
    EXPECT_THAT(faultOf(zipOf({{"a.txt", "text"}})), HasSubstr("it is no 3MF file"));
    EXPECT_THAT(faultOf(package(kMesh, "")), HasSubstr("its build has no triangles"));
    const std::string whole = package(kMesh, R"(<item objectid="1"/>)");
    for (size_t size = 1; size < whole.size(); size += 7) {
        EXPECT_NE(faultOf(whole.substr(0, size)), "") << size;
    }
}

} // namespace
} // namespace froxel::formats
