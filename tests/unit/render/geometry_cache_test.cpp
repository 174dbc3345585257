#include "render/scene/geometry_cache.h"
#include "scene/motion.h"
#include "support/ball.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <set>
#include <string>
#include <vector>

namespace froxel::render {
namespace {

namespace fs = std::filesystem;

scene::Primitive ballOf(uint32_t rings, bool colored) {
    const test::Ball ball = test::makeBall(rings, [](const glm::vec3&) { return 1.0F; });
    scene::Primitive p;
    p.positions = ball.positions;
    p.normals = ball.positions;
    p.indices = ball.indices;
    for (const auto& position : p.positions) {
        p.bounds.add(position);
    }
    if (colored) {
        p.colors.assign(p.positions.size(), glm::vec4(0.5F));
    }
    return p;
}

scene::Scene twoMeshes() {
    scene::Scene scene;
    scene.meshes.push_back({"plain and none", {ballOf(24, false), {}}});
    scene.meshes.push_back({"colored", {ballOf(16, true)}});
    return scene;
}

std::string contentOf(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

void overwrite(const fs::path& file, const std::string& content) {
    std::ofstream(file, std::ios::binary | std::ios::trunc) << content;
}

template <class T>
bool sameBytes(const std::vector<T>& a, const std::vector<T>& b) {
    const auto bytes_a = std::as_bytes(std::span(a));
    const auto bytes_b = std::as_bytes(std::span(b));
    return std::ranges::equal(bytes_a, bytes_b);
}

void expectSame(const PackedGeometry& a, const PackedGeometry& b) {
    EXPECT_EQ(a.triangles.indices, b.triangles.indices);
    EXPECT_EQ(a.triangles.words, b.triangles.words);
    EXPECT_TRUE(sameBytes(a.triangles.meshlets, b.triangles.meshlets));
    EXPECT_TRUE(sameBytes(a.details, b.details));
    EXPECT_EQ(a.positions, b.positions);
    ASSERT_EQ(a.meshes.size(), b.meshes.size());
    for (size_t m = 0; m < a.meshes.size(); ++m) {
        ASSERT_EQ(a.meshes[m].size(), b.meshes[m].size());
        for (size_t p = 0; p < a.meshes[m].size(); ++p) {
            const PackedPrimitive& x = a.meshes[m][p];
            const PackedPrimitive& y = b.meshes[m][p];
            EXPECT_EQ(x.vertex_offset, y.vertex_offset);
            EXPECT_EQ(x.first_index, y.first_index);
            EXPECT_EQ(x.index_count, y.index_count);
            EXPECT_EQ(x.first_meshlet, y.first_meshlet);
            EXPECT_EQ(x.meshlet_count, y.meshlet_count);
            EXPECT_EQ(x.first_coarser_meshlet, y.first_coarser_meshlet);
            EXPECT_EQ(x.coarser_meshlet_count, y.coarser_meshlet_count);
        }
    }
}

class GeometryCacheTest : public testing::Test {
  protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "froxel_geometry_XXXXXX").string();
        ASSERT_NE(::mkdtemp(name.data()), nullptr);
        folder_ = name;
    }
    void TearDown() override { fs::remove_all(folder_); }

    [[nodiscard]] PackOptions kept(bool levels = true) const {
        return {.most_at_once = 500,
                .detail_levels = levels,
                .cache_folder = folder_ / "inner",
                .least_cached_triangles = 100};
    }
    [[nodiscard]] static PackOptions notKept(PackOptions options) {
        options.cache_folder.clear();
        return options;
    }
    [[nodiscard]] std::vector<fs::path> files() const {
        std::vector<fs::path> found;
        for (const auto& entry : fs::directory_iterator(folder_ / "inner")) {
            found.push_back(entry.path());
        }
        return found;
    }
    fs::path folder_;
};

TEST_F(GeometryCacheTest, WhatIsKept_IsWhatPackingMakes) {
    const scene::Scene scene = twoMeshes();
    for (const bool levels : {false, true}) {
        const PackedGeometry made = packGeometry(scene, notKept(kept(levels)));
        EXPECT_EQ(made.details.empty(), !levels);
        expectSame(packGeometry(scene, kept(levels)), made);
        expectSame(packGeometry(scene, kept(levels)), made);
        const GeometryHash hash = hashOfGeometry(scene, kept(levels));
        PackedGeometry read;
        read.meshes = {{{}, {}}, {{}}};
        ASSERT_TRUE(readGeometry(geometryCacheFile(folder_ / "inner", hash), hash, scene, read));
        EXPECT_EQ(read.triangles.indices, made.triangles.indices);
    }
    EXPECT_EQ(files().size(), 2U);
}

TEST_F(GeometryCacheTest, SmallScenes_AreNotKept) {
    PackOptions options = kept();
    options.least_cached_triangles = 1'000'000;
    (void)packGeometry(twoMeshes(), options);
    EXPECT_FALSE(fs::exists(folder_ / "inner"));
}

TEST_F(GeometryCacheTest, WhateverPackingDependsOn_ChangesTheHash) {
    const scene::Scene scene = twoMeshes();
    std::set<GeometryHash> hashes = {hashOfGeometry(scene, kept())};
    EXPECT_EQ(hashOfGeometry(scene, kept()), *hashes.begin());
    EXPECT_EQ(hashOfGeometry(scene, notKept(kept())), *hashes.begin());
    scene::Scene moved = scene;
    moved.meshes[0].primitives[0].positions.back().z = -1.0000001F;
    scene::Scene turned = scene;
    std::swap(turned.meshes[1].primitives[0].indices[3], turned.meshes[1].primitives[0].indices[4]);
    scene::Scene plain = scene;
    plain.meshes[1].primitives[0].colors.clear();
    scene::Scene bent = scene;
    auto motion = std::make_shared<scene::Motion>();
    motion->deformed.emplace_back().mesh = 1;
    bent.motion = std::move(motion);
    scene::Scene apart = scene; // the same primitives in other meshes
    apart.meshes.push_back({"", {apart.meshes[0].primitives[1]}});
    apart.meshes[0].primitives.pop_back();
    for (const auto* other : {&moved, &turned, &plain, &bent, &apart}) {
        EXPECT_TRUE(hashes.insert(hashOfGeometry(*other, kept())).second);
    }
    PackOptions parts = kept();
    parts.most_at_once = 501;
    EXPECT_TRUE(hashes.insert(hashOfGeometry(scene, parts)).second);
    EXPECT_TRUE(hashes.insert(hashOfGeometry(scene, kept(false))).second);
}

TEST_F(GeometryCacheTest, DamagedFile_IsMadeAnew) {
    const scene::Scene scene = twoMeshes();
    const PackedGeometry made = packGeometry(scene, kept());
    const fs::path file = files().front();
    const std::string good = contentOf(file);
    std::vector<std::string> damaged = {"", good.substr(0, 50), good.substr(0, good.size() - 1),
                                        good + "x", std::string(good.size(), '\xff')};
    for (size_t at = 0; at < good.size(); at += at < 112 ? 1 : 997) {
        damaged.push_back(good);
        damaged.back()[at] = static_cast<char>(damaged.back()[at] ^ 0x10);
    }
    const GeometryHash hash = hashOfGeometry(scene, kept());
    for (const std::string& content : damaged) {
        overwrite(file, content);
        PackedGeometry out;
        ASSERT_FALSE(readGeometry(file, hash, scene, out));
        ASSERT_TRUE(out.triangles.indices.empty());
    }
    expectSame(packGeometry(scene, kept()), made);
    EXPECT_EQ(contentOf(file), good);
}

// Written by another program that knows how: no index leads beyond what is there.
TEST_F(GeometryCacheTest, ContentThatMakesNoSense_IsNotBelieved) {
    const scene::Scene scene = twoMeshes();
    const PackedGeometry made = packGeometry(scene, notKept(kept()));
    const GeometryHash hash = hashOfGeometry(scene, kept());
    const fs::path file = geometryCacheFile(folder_, hash);
    const auto believed = [&](auto change) {
        PackedGeometry changed = made;
        change(changed);
        EXPECT_TRUE(writeGeometry(file, hash, changed));
        PackedGeometry out;
        out.meshes = {{{}, {}}, {{}}};
        return readGeometry(file, hash, scene, out);
    };
    EXPECT_TRUE(believed([](PackedGeometry&) {}));
    constexpr uint32_t kMost = 0xffffffff;
    for (const uint32_t value : {kMost, kMost - 2, uint32_t{100'000'000}}) {
        EXPECT_FALSE(believed([=](auto& g) { g.triangles.meshlets[1].first_index = value; }));
        EXPECT_FALSE(believed([=](auto& g) { g.triangles.meshlets[1].index_count = value; }));
        EXPECT_FALSE(believed([=](auto& g) { g.triangles.meshlets[1].first_word = value; }));
        EXPECT_FALSE(believed([=](auto& g) { g.triangles.meshlets[1].vertex_count = value; }));
        EXPECT_FALSE(believed([=](auto& g) { g.triangles.words.front() = value; }));
        EXPECT_FALSE(believed([=](auto& g) { g.meshes[0][0].first_meshlet = value; }));
        EXPECT_FALSE(believed([=](auto& g) { g.meshes[0][0].meshlet_count = value; }));
        EXPECT_FALSE(believed([=](auto& g) { g.meshes[0][0].first_coarser_meshlet = value; }));
        EXPECT_FALSE(believed([=](auto& g) { g.meshes[0][0].coarser_meshlet_count = value; }));
        EXPECT_FALSE(believed([=](auto& g) { g.meshes[0][0].index_count = value; }));
        EXPECT_FALSE(believed([=](auto& g) { g.meshes[1][0].first_index = value; }));
    }
    const Meshlet& first = made.triangles.meshlets.front();
    EXPECT_FALSE(believed([&](auto& g) { // one of its vertices that it has not
        g.triangles.words[first.first_word + first.vertex_count] |= 0xff;
    }));
    EXPECT_FALSE(believed([](auto& g) { g.details.pop_back(); }));
    EXPECT_FALSE(believed([](auto& g) { g.meshes.pop_back(); }));
    EXPECT_FALSE(believed([](auto& g) { g.meshes.push_back({{}}); }));
}

TEST_F(GeometryCacheTest, TooManyBytes_TheOldestFilesGo) {
    const scene::Scene scene = twoMeshes();
    const PackedGeometry made = packGeometry(scene, notKept(kept()));
    const auto fileOf = [&](uint8_t number) {
        GeometryHash hash{};
        hash[0] = std::byte(number);
        return std::pair(geometryCacheFile(folder_, hash), hash);
    };
    const auto write = [&](uint8_t number, uint64_t most_bytes) {
        const auto [file, hash] = fileOf(number);
        const auto written = writeGeometry(file, hash, made, most_bytes);
        if (written) { // as if at another time
            fs::last_write_time(file, fs::file_time_type::clock::now() -
                                          std::chrono::hours(100 - number));
        }
        return written;
    };
    overwrite(folder_ / "pipelines-1.bin", "of another kind");
    ASSERT_TRUE(write(1, kMostCachedBytes));
    const uint64_t each = fs::file_size(fileOf(1).first);
    ASSERT_TRUE(write(2, 3 * each));
    ASSERT_TRUE(write(3, 3 * each));
    // The first is used again, so that the second is the oldest.
    PackedGeometry out;
    out.meshes = {{{}, {}}, {{}}};
    ASSERT_TRUE(readGeometry(fileOf(1).first, fileOf(1).second, scene, out));
    ASSERT_TRUE(write(4, 3 * each));
    EXPECT_TRUE(fs::exists(fileOf(1).first));
    EXPECT_FALSE(fs::exists(fileOf(2).first));
    EXPECT_TRUE(fs::exists(fileOf(3).first));
    const auto refused = write(5, each - 1);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find(std::to_string(each - 1)), std::string::npos);
    EXPECT_TRUE(fs::exists(fileOf(4).first)) << "in vain nothing goes";
    EXPECT_TRUE(fs::exists(folder_ / "pipelines-1.bin"));
}

TEST_F(GeometryCacheTest, FolderThatCannotBeWritten_HindersNothing) {
    PackOptions options = kept();
    overwrite(options.cache_folder, "a file is in its place");
    const scene::Scene scene = twoMeshes();
    expectSame(packGeometry(scene, options), packGeometry(scene, notKept(options)));
    // A folder where the file should be.
    options.cache_folder = folder_;
    fs::create_directory(geometryCacheFile(folder_, hashOfGeometry(scene, options)));
    expectSame(packGeometry(scene, options), packGeometry(scene, notKept(options)));
}

} // namespace
} // namespace froxel::render
