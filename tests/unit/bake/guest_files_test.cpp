#include "bake/guest_files.h"
#include "gltf/failure.h"
#include "guest/memory_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <unistd.h>
#include <utility>
#include <vector>

namespace froxel::bake {
namespace {

using guest::GuestFile;
using guest::GuestScene;
using guest::MemoryFile;

GuestFile fileOf(const std::string& name, std::string_view text) {
    auto file = MemoryFile::make().value();
    file.append(std::as_bytes(std::span(text))).value();
    return std::move(file).complete(name).value();
}

std::shared_ptr<const GuestScene> sceneOf(std::vector<std::pair<std::string, std::string>> texts) {
    GuestScene scene;
    for (const auto& [name, text] : texts) {
        scene.files.push_back(fileOf(name, text));
    }
    return std::make_shared<const GuestScene>(std::move(scene));
}

std::string textOf(const gltf::OpenedFile& file) {
    std::array<char, 64> text{};
    const ssize_t size = ::read(file.descriptor.get(), text.data(), text.size());
    return {text.data(), static_cast<size_t>(std::max<ssize_t>(size, 0))};
}

TEST(GuestFiles, EachOpening_StandsAtTheBegin) {
    GuestFiles files(sceneOf({{"a.gltf", "scene"}, {"parts/b.bin", "buffer"}}));
    EXPECT_EQ(textOf(files.openScene()), "scene");
    EXPECT_EQ(textOf(files.openScene()), "scene");
    EXPECT_EQ(textOf(files.open("parts/b.bin", "buffer 0")), "buffer");
    EXPECT_EQ(textOf(files.open("parts/../parts/./b.bin", "buffer 0")), "buffer");
}

// No name is a path.
TEST(GuestFiles, WhatDidNotCome_IsNamed) {
    GuestFiles files(sceneOf({{"a.gltf", "scene"}}));
    for (const char* name : {"b.bin", "/etc/passwd", "../a.gltf", "/proc/self/environ", ""}) {
        try {
            (void)files.open(name, "buffer 0");
            ADD_FAILURE() << name;
        } catch (const gltf::Unusable& unusable) {
            EXPECT_EQ(std::string(unusable.what()).find("buffer 0 needs '"), 0U);
        }
    }
}

} // namespace
} // namespace froxel::bake
