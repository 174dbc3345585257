// Files that mean harm or are broken: each one line that names the thing.
#include "gltf/scene_folder.h"
#include "gltf/uri.h"
#include "unit/gltf/scene_file.h"

#include <gtest/gtest.h>

#include <gmock/gmock.h>
#include <limits>
#include <sys/stat.h>

namespace froxel::gltf {
namespace {

using test::Bytes;
using test::bytesOf;
using test::failure;
using test::Json;
using test::loaded;
using test::loadText;
using test::SceneFile;
using test::TempFolder;
using testing::HasSubstr;

std::string refusedUri(const std::string& uri) {
    SceneFile file;
    file.json["buffers"][0]["uri"] = uri;
    return failure(file.load());
}

TEST(Uri, ParentFolder_IsRefused) {
    for (const char* uri : {"../scene.bin", "a/../../scene.bin", "..", "%2e%2e/scene.bin",
                            "%2E./scene.bin", "..%2fscene.bin", "..\\scene.bin", "./../x"}) {
        EXPECT_THAT(refusedUri(uri), HasSubstr("leaves the scene's folder by '..'")) << uri;
    }
}

TEST(Uri, AbsolutePath_IsRefused) {
    for (const char* uri : {"/etc/passwd", "%2fetc/passwd", "//host/share", "\\\\host\\share"}) {
        EXPECT_THAT(refusedUri(uri), HasSubstr("is absolute")) << uri;
    }
}

TEST(Uri, Scheme_IsRefused) {
    for (const char* uri : {"file:///etc/passwd", "http://127.0.0.1/x", "https://a/b",
                            "FILE:scene.bin", "C:\\scene.bin"}) {
        EXPECT_THAT(refusedUri(uri), HasSubstr("has a scheme")) << uri;
    }
    EXPECT_THAT(refusedUri("file%3a///etc/passwd"), HasSubstr("cannot open 'file:/etc/passwd'"));
}

TEST(Uri, Nul_IsRefused) {
    EXPECT_THAT(refusedUri("scene.bin%00.png"), HasSubstr("NUL"));
}

TEST(Uri, OddOnes_NameTheFileThatIsMeant) {
    for (const auto& [uri, file] :
         {std::pair("mesh 50%.bin", "mesh 50%.bin"), std::pair("%zz%+1%", "%zz%+1%"),
          std::pair("mesh%2", "mesh%2"), std::pair("a%20b.bin", "a b.bin"),
          std::pair("mesh.bin?v=3", "mesh.bin"), std::pair("mesh.bin#0", "mesh.bin"),
          std::pair("a%23b.bin", "a#b.bin"), std::pair("textures/../a.png", "a.png"),
          std::pair("./a/%2e%2e//b/./c.png", "b/c.png"), std::pair("my%3Atex.png", "my:tex.png"),
          std::pair("2026-01-02T10:11:12.png", "2026-01-02T10:11:12.png"),
          std::pair("textures/a:b.png", "textures/a:b.png")}) {
        EXPECT_EQ(relativePathFromUri(uri, "buffer 0"), file) << uri;
    }
    EXPECT_EQ(relativePathFromUri("data\\mesh.bin", "buffer 0"), "data/mesh.bin");
    EXPECT_EQ(relativePathFromUri("data%5Cmesh.bin", "buffer 0"), "data/mesh.bin");
    EXPECT_THAT(refusedUri("?a"), HasSubstr("is empty"));
}

TEST(Uri, LinkOutOfTheFolder_IsRefused) {
    const TempFolder outside;
    outside.write("secret.bin", std::string(64, 'x'));
    const TempFolder folder;
    std::filesystem::create_symlink(outside.path() / "secret.bin", folder.path() / "link.bin");
    std::filesystem::create_directory_symlink(outside.path(), folder.path() / "sub");
    for (const char* uri : {"link.bin", "sub/secret.bin"}) {
        SceneFile file;
        file.json["buffers"][0]["uri"] = uri;
        EXPECT_THAT(failure(file.loadIn(folder)), HasSubstr("a link that leaves")) << uri;
    }
}

TEST(Uri, LinkInsideTheFolder_IsFollowed) {
    const TempFolder folder;
    std::filesystem::create_symlink("scene.bin", folder.path() / "link.bin");
    SceneFile file;
    file.json["buffers"][0]["uri"] = "link.bin";
    EXPECT_EQ(loaded(file.loadIn(folder)).instances.size(), 1U);
}

TEST(Uri, NeighbourFolderOfTheSamePrefix_IsOutside) {
    const TempFolder parent;
    std::filesystem::create_directory(parent.path() / "scene");
    std::filesystem::create_directory(parent.path() / "scene2");
    parent.write("scene2/secret.bin", std::string(64, 'x'));
    std::filesystem::create_symlink("../scene2/secret.bin", parent.path() / "scene/link.bin");
    SceneFile file;
    file.json["buffers"][0].update({{"uri", "link.bin"}, {"byteLength", 64}});
    EXPECT_THAT(failure(load(parent.write("scene/scene.gltf", file.json.dump()))),
                HasSubstr("a link that leaves"));
}

TEST(Uri, Pipe_IsRefusedAndDoesNotHang) {
    const TempFolder folder;
    ASSERT_EQ(::mkfifo((folder.path() / "pipe").c_str(), 0600), 0);
    SceneFile file;
    file.json["buffers"][0]["uri"] = "pipe";
    EXPECT_THAT(failure(file.loadIn(folder)), HasSubstr("not a regular file"));
}

TEST(Uri, Folder_IsRefused) {
    EXPECT_THAT(refusedUri("."), HasSubstr("not a regular file"));
}

TEST(Uri, UnknownData_IsRefused) {
    EXPECT_THAT(refusedUri("data:text/html,hello"), HasSubstr("there are 5"));
    EXPECT_THAT(refusedUri("data:text/html,"), HasSubstr("cannot be decoded"));
    EXPECT_THAT(refusedUri("data:;base64,AAAA*AAA"), HasSubstr("cannot be decoded"));
    EXPECT_THAT(refusedUri("data:;base64,AAAAA"), HasSubstr("cannot be decoded"));
    EXPECT_THAT(refusedUri("data:;base64,AA==AAAA"), HasSubstr("cannot be decoded"));
    EXPECT_THAT(refusedUri("data:application/octet-stream;base64,"),
                HasSubstr("cannot be decoded"));
    EXPECT_THAT(refusedUri("data:application/octet-stream"), HasSubstr("cannot be decoded"));
    EXPECT_THAT(refusedUri("data:application/octet-stream;base64,AAAA"),
                HasSubstr("buffer 0 says 36 bytes, but there are 3"));
}

// RFC 2397, RFC 3986 3.1, and "forgiving-base64 decode" of WHATWG's Infra.
TEST(Uri, DataInAnySpelling_IsDecoded) {
    const Bytes abcd{std::byte{'a'}, std::byte{'b'}, std::byte{'c'}, std::byte{0xFF}};
    for (const char* uri :
         {"data:application/octet-stream;base64,YWJj/w==", "data:;base64,YWJj/w",
          "DATA:application/octet-stream;BASE64,YWJj/w==", "data:;base64,YWJj%2Fw%3D%3D",
          "data:a/b;charset=utf-8;base64,YWJj/w==", "data:a/b; base64 ,YW\nJj\r\n /w=\t=",
          "data:a/b,abc%FF", "data:,abc%ff#part", "data:;base64x,abc%ff"}) {
        EXPECT_TRUE(isDataUri(uri)) << uri;
        EXPECT_EQ(bytesOfDataUri(uri, "buffer 0"), abcd) << uri;
    }
    EXPECT_FALSE(isDataUri("data.bin"));
}

TEST(Files, GitLfsPointer_IsNamedAsOne) {
    const std::string pointer = "version https://git-lfs.github.com/spec/v1\n"
                                "oid sha256:4d7a2146\nsize 12345\n";
    const TempFolder folder;
    EXPECT_THAT(failure(load(folder.write("scene.glb", pointer))),
                HasSubstr("the scene names 'scene.glb', which is a Git LFS pointer"));
    folder.write("mesh.bin", pointer);
    SceneFile file;
    file.json["buffers"][0]["uri"] = "mesh.bin";
    EXPECT_THAT(failure(file.loadIn(folder)), HasSubstr("git lfs pull fetches it"));
}

TEST(Buffers, Missing_IsRefused) {
    EXPECT_THAT(refusedUri("missing.bin"), HasSubstr("buffer 0 cannot open 'missing.bin'"));
    SceneFile file;
    file.json["buffers"][0].erase("uri");
    EXPECT_THAT(failure(file.load()), HasSubstr("buffer 0 has no URI"));
    file.json.erase("buffers");
    EXPECT_THAT(failure(file.load()), HasSubstr("uses buffer 0; the file has 0"));
}

TEST(Buffers, ShorterThanTheySay_AreRefused) {
    SceneFile file;
    file.json["buffers"][0]["byteLength"] = 37;
    EXPECT_THAT(failure(file.load()), HasSubstr("buffer 0 says 37 bytes, but there are 36"));
}

std::string refusedView(const char* key, const Json& value) {
    SceneFile file;
    file.json["bufferViews"][0][key] = value;
    return failure(file.load());
}

TEST(Views, OutOfTheirBuffer_AreRefused) {
    EXPECT_THAT(refusedView("byteOffset", 1), HasSubstr("ends at byte 37, but buffer 0 has 36"));
    EXPECT_THAT(refusedView("byteLength", 2'147'483'647), HasSubstr("ends at byte 2147483647"));
    EXPECT_THAT(refusedView("buffer", 1), HasSubstr("bufferView 0 uses buffer 1"));
    EXPECT_THAT(refusedView("byteStride", 8), HasSubstr("byteStride 8"));
    EXPECT_THAT(refusedView("byteStride", 16), HasSubstr("ends at byte 44"));
    EXPECT_THAT(refusedView("byteStride", 300), HasSubstr("ends at byte 612"));
}

TEST(Views, HugeNumbers_AreRefusedByTheirPlace) {
    EXPECT_THAT(refusedView("byteOffset", std::numeric_limits<uint64_t>::max()),
                HasSubstr("/bufferViews/0/byteOffset is 18446744073709551615"));
    EXPECT_THAT(
        refusedView("byteLength", 1ULL << 32U),
        HasSubstr(
            "/bufferViews/0/byteLength is 4294967296; expected an integer from 0 to 4294967295"));
    EXPECT_THAT(refusedView("byteOffset", -4), HasSubstr("/bufferViews/0/byteOffset is -4"));
    EXPECT_THAT(refusedView("byteOffset", 1.5), HasSubstr("/bufferViews/0/byteOffset is 1.5"));
    EXPECT_THAT(refusedView("buffer", 1ULL << 32U), HasSubstr("/bufferViews/0/buffer"));
}

std::string refusedAccessor(const char* key, const Json& value) {
    SceneFile file;
    file.json["accessors"][0][key] = value;
    return failure(file.load());
}

TEST(Accessors, OutOfTheirView_AreRefused) {
    EXPECT_THAT(refusedAccessor("count", 4), HasSubstr("accessor 0 ends at byte 48"));
    EXPECT_THAT(refusedAccessor("byteOffset", 4), HasSubstr("accessor 0 ends at byte 40"));
    EXPECT_THAT(refusedAccessor("byteOffset", 2'147'483'647), HasSubstr("accessor 0 ends at"));
    EXPECT_THAT(refusedAccessor("bufferView", 9), HasSubstr("accessor 0 uses bufferView 9"));
}

TEST(Accessors, HugeCounts_AreRefused) {
    EXPECT_THAT(refusedAccessor("count", 1ULL << 62U), HasSubstr("/accessors/0/count"));
    EXPECT_THAT(refusedAccessor("count", 2'000'000'000),
                HasSubstr("mesh 0 primitive 0 needs 2000000000 vertices"));
    SceneFile file;
    file.json["accessors"][0].erase("bufferView");
    file.json["accessors"][0]["count"] = 2'000'000'001;
    EXPECT_THAT(failure(file.load()), HasSubstr("needs 2000000001 vertices"));
}

TEST(Accessors, BadTypes_AreRefused) {
    EXPECT_THAT(refusedAccessor("componentType", 5124), HasSubstr("componentType 5124"));
    EXPECT_THAT(refusedAccessor("componentType", 5130), HasSubstr("componentType 5130"));
    EXPECT_THAT(refusedAccessor("componentType", 1), HasSubstr("componentType"));
    EXPECT_THAT(refusedAccessor("type", "MAT3"), HasSubstr("is a MAT2 or MAT3"));
    EXPECT_THAT(refusedAccessor("type", "MAT4"), HasSubstr("with 16 components; expected 3"));
    EXPECT_THAT(refusedAccessor("type", "VEC9"), HasSubstr("VEC9"));
}

TEST(Accessors, MissingProperty_IsRefused) {
    SceneFile file;
    file.json["accessors"][0].erase("count");
    EXPECT_THAT(failure(file.load()), HasSubstr("/accessors/0 has no 'count'"));
}

// What is not mended: nothing could stand in for a place.
TEST(Accessors, NotFiniteInstance_IsRefused) {
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        SceneFile file;
        const int places = file.addAccessor<float>({0, 0, 0, 1, bad, 0}, 3);
        file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
            {"TRANSLATION", places}};
        EXPECT_THAT(failure(file.load()), HasSubstr("node 0 accessor 1 element 1 is "));
    }
}

TEST(Accessors, FloatIndices_AreRefused) {
    SceneFile file;
    file.primitive()["indices"] = file.addAccessor<float>({0, 1, 2}, 1);
    EXPECT_THAT(failure(file.load()), HasSubstr("accessor 1 as indices"));
    file.primitive()["indices"] = 44;
    EXPECT_THAT(failure(file.load()), HasSubstr("uses accessor 44"));
    file.primitive()["indices"] = Json::object();
    EXPECT_THAT(failure(file.load()), HasSubstr("an object as indices"));
}

std::string refusedSparse(const Json& patch) {
    SceneFile file;
    const int indices = file.addView(bytesOf<uint16_t>({0, 7}));
    const int values = file.addView(bytesOf<float>({5, 6, 7, 8, 9, 10}));
    Json sparse = {{"count", 1},
                   {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                   {"values", {{"bufferView", values}}}};
    sparse.merge_patch(patch);
    file.json["accessors"][0]["sparse"] = sparse;
    return failure(file.load());
}

TEST(Sparse, BadValues_AreRefused) {
    EXPECT_THAT(refusedSparse({{"count", 2}}), HasSubstr("sparse index 1 is 7; expected below 3"));
    EXPECT_THAT(refusedSparse({{"count", 4}}), HasSubstr("substitutes 4 elements of 3"));
    EXPECT_THAT(refusedSparse({{"indices", {{"componentType", 5126}}}}),
                HasSubstr("sparse indices of componentType 5126"));
    EXPECT_THAT(refusedSparse({{"indices", {{"byteOffset", 3}}}}),
                HasSubstr("sparse indices ends at byte 5"));
    EXPECT_THAT(refusedSparse({{"values", {{"byteOffset", 16}}}}),
                HasSubstr("sparse values ends at byte 28"));
    EXPECT_THAT(refusedSparse({{"values", {{"bufferView", 12}}}}), HasSubstr("bufferView 12"));
    EXPECT_THAT(refusedSparse({{"values", {{"byteOffset", -1}}}}), HasSubstr("byteOffset is -1"));
    EXPECT_THAT(refusedSparse({{"values", {{"byteOffset", 3'000'000'000}}}}),
                HasSubstr("sparse byteOffset of 3000000000; expected at most 2147483647"));
    EXPECT_THAT(refusedSparse({{"indices", nullptr}}), HasSubstr("indices"));
}

TEST(Document, WrongTypes_AreRefusedByTheirPlace) {
    const auto refused = [](const char* pointer, const Json& value) {
        SceneFile file;
        file.json[Json::json_pointer(pointer)] = value;
        return failure(file.load());
    };
    EXPECT_THAT(refused("/nodes", 5), HasSubstr("/nodes is 5"));
    EXPECT_THAT(refused("/nodes/0", "x"), HasSubstr("/nodes is \"x\" at '0'"));
    EXPECT_THAT(refused("/nodes/0/mesh", "0"), HasSubstr("/nodes/0/mesh is \"0\""));
    EXPECT_THAT(refused("/nodes/0/mesh", 4294967296), HasSubstr("/nodes/0/mesh is 4294967296"));
    EXPECT_THAT(refused("/nodes/0/children", {-1}), HasSubstr("/nodes/0/children is -1 at '0'"));
    EXPECT_THAT(refused("/meshes/0/primitives/0/attributes/POSITION", 1.5),
                HasSubstr("attributes is 1.5 at 'POSITION'"));
    EXPECT_THAT(refused("/accessors/0/normalized", 1), HasSubstr("/accessors/0/normalized is 1"));
    EXPECT_THAT(refused("/scenes/0/nodes", "all"), HasSubstr("/scenes/0/nodes is \"all\""));
    EXPECT_THAT(refused("/nodes/0/mesh", 3), HasSubstr("node 0 uses mesh 3; the file has 1"));
}

TEST(Document, WrongTypesOutsideGeometry_AreLeftOutWithTheirPlace) {
    const auto taken = [](const char* pointer, const Json& value) {
        SceneFile file;
        file.json["materials"] = Json::array({Json::object()});
        file.json["animations"] = Json::array({{{"samplers", Json::array()}}});
        file.json[Json::json_pointer(pointer)] = value;
        return test::told(file.load());
    };
    for (const auto& [pointer, value, words] :
         {std::tuple<const char*, Json, const char*>(
              "/nodes/0/translation", {1, nullptr, 2},
              "TYPE_MISMATCH at /nodes/0/translation: /nodes/0/translation is null at '1'; "
              "expected an array of 3 numbers"),
          {"/nodes/0/rotation", {0, 0, 1}, "/nodes/0/rotation is an array of 3; expected"},
          {"/nodes/0/name", 5, "/nodes/0/name is 5; expected a string; it is left out"},
          {"/nodes/0/camera", -1, "/nodes/0/camera is -1"},
          {"/materials", "none", "/materials is \"none\""},
          {"/materials/0", 5,
           "/materials is 5 at '0'; expected an array of objects; that is taken"},
          {"/materials/0/doubleSided", 1, "/materials/0/doubleSided is 1"},
          {"/materials/0/emissiveFactor", {1, 1e39, 0}, "emissiveFactor is 1e+39 at '1'"},
          {"/materials/0/pbrMetallicRoughness", Json::array(),
           "is an array of 0; expected an object"},
          {"/samplers", Json::object(), "/samplers is an object"},
          {"/textures", 3, "/textures is 3"},
          {"/images", 3, "/images is 3"},
          {"/cameras", 3, "/cameras is 3"},
          {"/skins", 3, "/skins is 3"},
          {"/animations/0/channels", 3, "/animations/0/channels is 3"},
          {"/scene", "first", "/scene is \"first\""},
          {"/scene", 3, "the file shows scene 3; it has 1"},
          {"/meshes/0/primitives/0/material", "red", "primitives/0/material is \"red\""},
          {"/meshes/0/primitives/0/mode", 9, "mesh 0 primitive 0 has mode 9 and is not drawn"}}) {
        EXPECT_THAT(taken(pointer, value), HasSubstr(words)) << pointer;
    }
}

TEST(Document, WholeNumbersWrittenAsReals_AreIntegers) {
    SceneFile file;
    file.json["accessors"][0]["count"] = 3.0;
    file.json["bufferViews"][0]["byteLength"] = 36.0;
    file.json["nodes"][0]["mesh"] = 0.0;
    file.json["scenes"][0]["nodes"] = {0.0};
    file.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 0.0;
    const scene::Scene scene = loaded(file.load());
    EXPECT_EQ(scene.instances.size(), 1U);
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(Document, BufferThatNothingUses_IsNothing) {
    SceneFile file;
    file.add("buffers", Json::object());
    file.add("buffers", {{"byteLength", 100}});
    EXPECT_EQ(test::told(file.load()), "");
}

TEST(Document, NotGltf_IsRefused) {
    EXPECT_THAT(failure(loadText("")), HasSubstr("not a glTF 2.0 file"));
    EXPECT_THAT(failure(loadText("hello")), HasSubstr("not a glTF 2.0 file"));
    EXPECT_THAT(failure(loadText("[1]")), HasSubstr("not an object"));
    EXPECT_THAT(failure(loadText("{}")), HasSubstr("/asset/version"));
    for (const char* old :
         {R"({"asset": {"version": "1.0"}})", R"({"asset": {"version": 1}, "nodes": {"a": {}}})",
          R"({"meshes": {"a": {"primitives": []}}})"}) {
        EXPECT_THAT(failure(loadText(old)),
                    HasSubstr("it is a glTF 1.0 file (/asset/version is '"));
    }
    EXPECT_THAT(failure(loadText("{\"asset\": {\"version\": \"3.0\"}}")),
                HasSubstr("/asset/version is '3.0'; 2.0 is supported"));
    EXPECT_THAT(failure(loadText("{\"asset\": {\"version\": \"2.0\", \"minVersion\": \"2.1\"}}")),
                HasSubstr("minVersion is '2.1'"));
    EXPECT_THAT(failure(loadText("{\"a\": \"\xff\xfe\"}")), HasSubstr("not a glTF 2.0 file"));
    EXPECT_THAT(failure(loadText("{\"asset\": {\"version\": \"2.0\"}, \"x\": 1e999}")),
                HasSubstr("not a glTF 2.0 file"));
}

TEST(Document, Empty_IsAnEmptyScene) {
    const scene::Scene scene = loaded(loadText("{\"asset\": {\"version\": \"2.0\"}}"));
    EXPECT_TRUE(scene.instances.empty());
    EXPECT_TRUE(scene.bounds_world.empty());
    EXPECT_EQ(scene.name, "scene");
}

TEST(Document, DeepNesting_IsRefusedOrDropped) {
    const std::string open(1'000'000, '[');
    const std::string close(1'000'000, ']');
    const std::string start = "{\"asset\": {\"version\": \"2.0\"}, ";
    EXPECT_THAT(failure(loadText(start + "\"nodes\": " + open + close + "}")), HasSubstr("/nodes"));
    EXPECT_THAT(failure(loadText(start + "\"other\": " + open + close + "}")),
                HasSubstr("nested deeper than 64"));
    EXPECT_TRUE(loadText(start + "\"extras\": " + open + close + "}").has_value());
}

TEST(Document, TooManyElements_AreRefused) {
    std::string nodes;
    for (int i = 0; i < 1'048'577; ++i) {
        nodes += "{},";
    }
    nodes.back() = ' ';
    EXPECT_THAT(
        failure(loadText("{\"asset\": {\"version\": \"2.0\"}, \"nodes\": [" + nodes + "]}")),
        HasSubstr("/nodes has 1048577 elements; at most 1048576"));
}

TEST(Document, MissingFile_IsRefused) {
    const TempFolder folder;
    EXPECT_THAT(failure(load(folder.path() / "scene.gltf")), HasSubstr("No such file"));
    EXPECT_THAT(failure(load(folder.path() / "none" / "scene.gltf")), HasSubstr("No such file"));
    std::filesystem::create_directory(folder.path() / "scene.glb");
    EXPECT_THAT(failure(load(folder.path() / "scene.glb")), HasSubstr("not a regular file"));
}

std::string refusedGlb(const Bytes& bytes) {
    const TempFolder folder;
    return failure(load(folder.write("scene.glb", bytes)));
}

void putWord(Bytes& bytes, size_t offset, uint32_t value) {
    const Bytes word = bytesOf<uint32_t>({value});
    std::copy(word.begin(), word.end(), bytes.begin() + static_cast<std::ptrdiff_t>(offset));
}

TEST(Glb, Whole_IsLoaded) {
    EXPECT_EQ(loaded(SceneFile().loadGlb()).instances.size(), 1U);
}

TEST(Glb, CutAnywhere_IsRefused) {
    const Bytes whole = SceneFile().glb();
    for (size_t size = 4; size < whole.size(); ++size) {
        Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
        EXPECT_FALSE(refusedGlb(cut).empty()) << size;
    }
}

TEST(Glb, CutWithAFittingHeader_IsRefused) {
    const Bytes whole = SceneFile().glb();
    for (size_t size = 12; size < whole.size(); ++size) {
        Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
        putWord(cut, 8, static_cast<uint32_t>(size));
        EXPECT_FALSE(refusedGlb(cut).empty()) << size;
    }
}

TEST(Glb, BadHeader_IsRefused) {
    Bytes file = SceneFile().glb();
    putWord(file, 4, 1);
    EXPECT_THAT(refusedGlb(file), HasSubstr("GLB version is 1"));
    file = SceneFile().glb();
    putWord(file, 12, 0xFFFFFFFF);
    EXPECT_THAT(refusedGlb(file), HasSubstr("JSON chunk says 4294967295 bytes"));
    file = SceneFile().glb();
    putWord(file, 16, 0x004E4942);
    EXPECT_THAT(refusedGlb(file), HasSubstr("not of type JSON"));
}

TEST(Glb, BinaryChunkLongerThanTheFile_IsRefused) {
    Bytes file = SceneFile().glb();
    const size_t length_word = file.size() - 36 - 8;
    putWord(file, length_word, 40); // up to 8 more: what a check without the chunk's header allows
    EXPECT_THAT(refusedGlb(file), HasSubstr("BIN chunk says 40 bytes, but 36 are left"));
}

} // namespace
} // namespace froxel::gltf
