#include "guest/guest_shelf.h"
#include "guest/memory_file.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <unistd.h>
#include <utility>

namespace froxel::guest {
namespace {

GuestFile fileOf(const std::string& name, std::string_view text) {
    auto file = MemoryFile::make().value();
    file.append(std::as_bytes(std::span(text))).value();
    return std::move(file).complete(name).value();
}

TEST(MemoryFile, Complete_CannotBeChanged) {
    const GuestFile file = fileOf("a.glb", "glTF");
    EXPECT_EQ(file.size_bytes, 4U);
    EXPECT_LT(::pwrite(file.descriptor.get(), "x", 1, 0), 0);
    EXPECT_EQ(errno, EPERM);
    EXPECT_LT(::ftruncate(file.descriptor.get(), 1), 0);
}

TEST(GuestShelf, SceneIsThere_WhileSomebodyHoldsIt) {
    const auto shelf = std::make_shared<GuestShelf>();
    int told = 0;
    shelf->onTakenOff([&] { ++told; });
    GuestScene scene;
    scene.files.push_back(fileOf("a.glb", "glTF"));
    const auto room = std::make_shared<int>();
    scene.held = room;
    auto hold = shelf->put(std::move(scene));
    const std::string id = hold->id();
    EXPECT_EQ(id.size(), 32U);
    {
        const auto reading = shelf->find(id);
        ASSERT_TRUE(reading);
        hold.reset();
        EXPECT_EQ(told, 1);
        EXPECT_FALSE(shelf->find(id));
        EXPECT_EQ(room.use_count(), 2); // the one who reads it has it still
    }
    EXPECT_EQ(room.use_count(), 1);
}

TEST(GuestShelf, IdsDiffer_AndAnUnknownOneIsNone) {
    const auto shelf = std::make_shared<GuestShelf>();
    const auto put = [&] {
        GuestScene scene;
        scene.files.push_back(fileOf("a.glb", "glTF"));
        return shelf->put(std::move(scene));
    };
    const auto a = put();
    const auto b = put();
    EXPECT_NE(a->id(), b->id());
    EXPECT_NE(shelf->find(a->id()), shelf->find(b->id()));
    EXPECT_FALSE(shelf->find(""));
    EXPECT_FALSE(shelf->find(a->id().substr(1)));
}

} // namespace
} // namespace froxel::guest
