#include "guest/guest_store.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

namespace froxel::guest {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using Why = StoreRefusal::Why;
using Files = std::vector<GuestStore::Announced::File>;

// Files have the times of this system.
const GuestStore::Time kNow =
    std::chrono::ceil<std::chrono::seconds>(std::chrono::system_clock::now());

class GuestStoreTest : public testing::Test {
  protected:
    GuestStoreTest() { fs::remove_all(folder_); }
    ~GuestStoreTest() override { fs::remove_all(folder_); }

    void start(GuestStore::Time now = kNow) {
        store_.reset(); // which holds the folder
        store_ = std::make_shared<GuestStore>(folder_, limits_, now);
    }
    GuestStore::Begun
    begin(const Files& files, const std::string& account = "a", GuestStore::Time now = kNow) {
        auto begun = store_->begin({files}, account, now);
        EXPECT_TRUE(begun) << begun.error().message;
        return begun ? std::move(*begun) : GuestStore::Begun{};
    }
    Why whyNot(const Files& files, const std::string& account = "a") {
        const auto begun = store_->begin({files}, account, kNow);
        EXPECT_FALSE(begun);
        return begun ? Why::kUnknown : begun.error().why;
    }
    // In one go. The offset behind it.
    uint64_t send(const std::string& upload, uint64_t offset, std::string_view bytes) {
        const auto opened = store_->open(upload, offset, kNow);
        if (!opened) {
            ADD_FAILURE() << opened.error().message;
            return 0;
        }
        EXPECT_TRUE((*opened)->append(std::as_bytes(std::span(bytes)), kNow));
        const auto ended = (*opened)->end(kNow);
        EXPECT_TRUE(ended);
        return ended ? ended->offset : 0;
    }
    // A scene of one file that is there.
    GuestStore::Begun
    put(const std::string& content, const std::string& account = "a", GuestStore::Time now = kNow) {
        auto begun = begin({{"a.glb", content.size()}}, account, now);
        send(begun.uploads.front(), 0, content);
        (void)store_->use(begun.id, now);
        return begun;
    }
    static std::string textOf(const GuestFile& file) {
        std::string text(file.size_bytes, '\0');
        EXPECT_EQ(::pread(file.descriptor.get(), text.data(), text.size(), 0),
                  static_cast<ssize_t>(text.size()));
        return text;
    }
    // Beside the lock.
    size_t entries() const {
        return static_cast<size_t>(
            std::distance(fs::directory_iterator(folder_), fs::directory_iterator()) - 1);
    }

    const fs::path folder_ =
        fs::path(testing::TempDir()) / ("froxel_store_" + std::to_string(getpid()));
    StoreLimits limits_{.file_bytes = 1000, .all_bytes = 4000, .free_share = 0};
    std::shared_ptr<GuestStore> store_;
};

TEST_F(GuestStoreTest, SceneIsThere_WithTheLastByteOfItsLastFile) {
    start();
    const auto begun = begin({{"textures/b.png", 3}, {"a.gltf", 4}});
    EXPECT_EQ(begun.id.size(), 32U);
    EXPECT_EQ(store_->factsOf(begun.id)->state, GuestStore::State::kReceiving);
    EXPECT_FALSE(store_->use(begun.id, kNow));
    EXPECT_EQ(send(begun.uploads[1], 0, "sce"), 3U);
    EXPECT_EQ(store_->standingOf(begun.uploads[1])->offset, 3U);
    EXPECT_EQ(send(begun.uploads[0], 0, "png"), 3U);
    EXPECT_FALSE(store_->use(begun.id, kNow));
    EXPECT_EQ(send(begun.uploads[1], 3, "n"), 4U);
    const auto facts = store_->factsOf(begun.id);
    EXPECT_EQ(facts->state, GuestStore::State::kReady);
    EXPECT_TRUE(store_->isReady(begun.id));
    EXPECT_EQ(facts->name, "a.gltf");
    EXPECT_EQ(facts->received_bytes, 7U);
    const auto scene = store_->use(begun.id, kNow);
    ASSERT_TRUE(scene);
    ASSERT_EQ(scene->files.size(), 2U);
    EXPECT_EQ(scene->files[0].name, "a.gltf");
    EXPECT_EQ(textOf(scene->files[0]), "scen");
    EXPECT_EQ(scene->files[1].name, "textures/b.png");
    EXPECT_EQ(textOf(scene->files[1]), "png");
}

TEST_F(GuestStoreTest, AnnouncementsThatAreWrong_AreNamed) {
    start();
    const std::string long_name = std::string(252, 'x') + ".glb";
    for (const Files& files :
         {Files{}, Files{{"a.bin", 1}}, Files{{"a.glb", 1}, {"b.gltf", 1}}, Files{{"a.glb", 0}},
          Files{{"a.glb", 1}, {"a.glb", 1}}, Files{{"../a.glb", 1}}, Files{{"/a.glb", 1}},
          Files{{"b/../a.glb", 1}}, Files{{"./a.glb", 1}}, Files{{"", 1}}, Files{{"a\n.glb", 1}},
          Files{{"a.glb", 1}, {"b/", 1}}, Files{{"a.glb", 1}, {"..", 1}}, Files{{long_name, 1}},
          Files(kMostGuestFiles + 1, {"a.glb", 1})}) {
        EXPECT_EQ(whyNot(files), Why::kMalformed) << (files.empty() ? "" : files.back().name);
    }
    EXPECT_EQ(whyNot({{"a.glb", 1001}}), Why::kTooLarge);
    EXPECT_EQ(whyNot({{"a.glb", UINT64_MAX}, {"b.bin", 2}}), Why::kTooLarge);
    EXPECT_EQ(whyNot({{"a.glb", 1000}, {"b.bin", 1000}, {"c.bin", 1}}), Why::kTooLarge)
        << "half of the store is an account's";
    EXPECT_EQ(entries(), 0U);
}

TEST_F(GuestStoreTest, Upload_IsOfOneConnection_AndGoesOnWhereItEnded) {
    start();
    const auto begun = begin({{"a.glb", 4}});
    const std::string& upload = begun.uploads.front();
    {
        const auto opened = store_->open(upload, 0, kNow).value();
        EXPECT_EQ(store_->open(upload, 0, kNow).error().why, Why::kBusy);
        EXPECT_TRUE(opened->append(std::as_bytes(std::span("ab", 2)), kNow));
    } // the connection is lost
    EXPECT_EQ(store_->standingOf(upload)->offset, 2U);
    EXPECT_EQ(store_->open(upload, 0, kNow).error().why, Why::kOffset);
    EXPECT_EQ(store_->open(upload, 3, kNow).error().why, Why::kOffset);
    {
        const auto opened = store_->open(upload, 2, kNow).value();
        EXPECT_EQ(opened->append(std::as_bytes(std::span("cde", 3)), kNow).error().why,
                  Why::kTooLarge);
    }
    EXPECT_EQ(send(upload, 2, "cd"), 4U);
    EXPECT_TRUE(store_->use(begun.id, kNow));
    EXPECT_EQ(store_->open(upload, 4, kNow).error().why, Why::kOffset);
    EXPECT_TRUE(store_->use(begun.id, kNow));
}

TEST_F(GuestStoreTest, WrongNames_AreUnknown) {
    start();
    const auto begun = begin({{"a.glb", 4}});
    const std::string key = begun.uploads.front().substr(0, 32);
    for (const std::string& wrong :
         {std::string(), key, key + "-", key + "-1", key + "-0x", key + "--0", key + "-+0",
          begun.id + "-0", begun.owner_key + "-0", std::string("../") + key}) {
        EXPECT_EQ(store_->standingOf(wrong).error().why, Why::kUnknown) << wrong;
    }
    EXPECT_FALSE(store_->factsOf(key));
    EXPECT_FALSE(store_->remove(begun.id, ""));
    EXPECT_FALSE(store_->remove(begun.id, begun.id));
    EXPECT_FALSE(store_->remove("", begun.owner_key));
    int told = 0;
    store_->onRemoved([&] { ++told; });
    EXPECT_TRUE(store_->remove(begun.id, begun.owner_key));
    EXPECT_FALSE(store_->remove(begun.id, begun.owner_key));
    EXPECT_EQ(told, 1);
    EXPECT_EQ(entries(), 0U);
}

// As after kill -9, at each byte of a file.
TEST_F(GuestStoreTest, Restart_KeepsWhatCame) {
    const std::string content = "12345678";
    for (size_t came = 0; came <= content.size(); ++came) {
        start();
        const auto begun = begin({{"a.glb", content.size()}, {"b.bin", 1}});
        {
            const auto opened = store_->open(begun.uploads[0], 0, kNow).value();
            ASSERT_TRUE(opened->append(std::as_bytes(std::span(content)).first(came), kNow));
        } // not ended
        start();
        EXPECT_EQ(store_->standingOf(begun.uploads[0])->offset, came);
        EXPECT_EQ(store_->factsOf(begun.id)->state, GuestStore::State::kReceiving);
        if (came < content.size()) {
            EXPECT_EQ(send(begun.uploads[0], came, content.substr(came)), content.size());
        }
        EXPECT_EQ(send(begun.uploads[1], 0, "b"), 1U);
        start();
        const auto scene = store_->use(begun.id, kNow);
        ASSERT_TRUE(scene) << came;
        EXPECT_EQ(textOf(scene->files[0]), content);
        EXPECT_TRUE(store_->remove(begun.id, begun.owner_key));
    }
    EXPECT_EQ(entries(), 0U);
}

// A folder that a crash left half made, and what others put there.
TEST_F(GuestStoreTest, Restart_RemovesWhatIsBroken) {
    start();
    const auto good = put("good");
    for (const char* manifest :
         {"", "{", "[]", "{\"files\":[]}", "{\"account\":1}",
          R"({"account":"a","owner_key":"b","upload_key":"c","files":[{"path":"a","bytes":-1}]})",
          R"({"account":"a","owner_key":"b","upload_key":"c","files":[]})"}) {
        const fs::path folder = folder_ / ("broken" + std::to_string(entries()));
        fs::create_directories(folder);
        std::ofstream(folder / "manifest.json") << manifest;
    }
    fs::create_directories(folder_ / "empty");
    std::ofstream(folder_ / "file") << "x";
    ASSERT_EQ(entries(), 10U);
    start();
    EXPECT_EQ(entries(), 1U);
    EXPECT_TRUE(store_->use(good.id, kNow));
}

TEST_F(GuestStoreTest, Folder_IsOfOneServer) {
    start();
    EXPECT_THROW(GuestStore(folder_, limits_, kNow), StartupError);
    start();
}

TEST_F(GuestStoreTest, RoomIsShort_WhatWasUsedLongestAgoGoes) {
    start();
    const auto a = put(std::string(1000, 'a'), "x", kNow);
    const auto b = put(std::string(1000, 'b'), "y", kNow + 1s);
    const auto c = put(std::string(1000, 'c'), "z", kNow + 2s);
    const auto d = put(std::string(1000, 'd'), "w", kNow + 3s);
    EXPECT_EQ(store_->counts().bytes, 4000U);
    EXPECT_TRUE(store_->use(a.id, kNow + 4s));
    const auto e = put(std::string(1000, 'e'), "v", kNow + 5s);
    EXPECT_FALSE(store_->use(b.id, kNow));
    EXPECT_TRUE(store_->use(a.id, kNow + 4s));
    EXPECT_EQ(entries(), 4U);
    // An account's own go before others'.
    (void)put(std::string(1000, 'f'), "x", kNow + 6s);
    (void)put(std::string(1000, 'g'), "x", kNow + 7s);
    EXPECT_FALSE(store_->use(a.id, kNow));
    EXPECT_TRUE(store_->use(d.id, kNow + 8s));
    EXPECT_TRUE(store_->use(e.id, kNow + 8s));
    EXPECT_FALSE(store_->use(c.id, kNow));
}

TEST_F(GuestStoreTest, WhatIsOnItsWay_KeepsItsRoom) {
    start();
    for (int i = 0; i < 2; ++i) {
        (void)begin({{"a.glb", 1000}}, "x");
        (void)begin({{"a.glb", 1000}}, "y");
    }
    EXPECT_EQ(whyNot({{"a.glb", 1}}, "x"), Why::kAccount);
    EXPECT_EQ(whyNot({{"a.glb", 1}}, "z"), Why::kFull);
    limits_.receiving_of_account = 2;
    limits_.all_bytes = 100'000;
    start();
    EXPECT_EQ(whyNot({{"a.glb", 1}}, "x"), Why::kAccount);
    EXPECT_TRUE(store_->begin({{{"a.glb", 1}}}, "", kNow)) << "this host is exempt";
}

TEST_F(GuestStoreTest, DiskIsNearlyFull_NothingBegins) {
    limits_.free_share = 1;
    start();
    EXPECT_EQ(whyNot({{"a.glb", 1}}), Why::kFull);
    EXPECT_EQ(store_->counts().bytes, 0U);
    EXPECT_EQ(entries(), 0U);
}

TEST_F(GuestStoreTest, UnusedScenes_GoInTheEnd) {
    start();
    EXPECT_FALSE(store_->expire(kNow));
    const auto ready = put("ready");
    const auto coming = begin({{"a.glb", 4}});
    EXPECT_EQ(store_->expire(kNow), kNow + limits_.patience);
    {
        const auto opened = store_->open(coming.uploads[0], 0, kNow + 30min).value();
        EXPECT_EQ(store_->expire(kNow + 2h), kNow + 30min + limits_.patience)
            << "whoever sends it has it";
    }
    EXPECT_EQ(store_->expire(kNow + 2h), kNow + limits_.kept);
    EXPECT_EQ(store_->open(coming.uploads[0], 0, kNow).error().why, Why::kUnknown);
    EXPECT_TRUE(store_->use(ready.id, kNow + 20h));
    EXPECT_EQ(store_->expire(kNow + 40h), kNow + 20h + limits_.kept);
    const GuestStore::Counts counts = store_->counts();
    EXPECT_EQ(counts.ready, 1U);
    EXPECT_EQ(counts.receiving, 0U);
    EXPECT_EQ(counts.completed_total, 1U);
    EXPECT_THAT(counts.removed_total, testing::ElementsAre(0U, 1U, 0U, 0U));
    start(kNow + 43h); // the time of its use outlives a restart
    EXPECT_TRUE(store_->factsOf(ready.id));
    start(kNow + 45h);
    EXPECT_FALSE(store_->factsOf(ready.id));
    EXPECT_EQ(entries(), 0U);
}

// Whoever reads a scene that is removed reads on.
TEST_F(GuestStoreTest, RemovedWhileItComesOrIsRead_HarmsNobody) {
    start();
    const auto read = put("content");
    const auto scene = store_->use(read.id, kNow);
    ASSERT_TRUE(store_->remove(read.id, read.owner_key));
    EXPECT_EQ(textOf(scene->files.front()), "content");

    const auto coming = begin({{"a.glb", 4}});
    const auto upload = store_->open(coming.uploads[0], 0, kNow).value();
    ASSERT_TRUE(store_->terminate(coming.uploads[0]));
    EXPECT_EQ(upload->append(std::as_bytes(std::span("ab", 2)), kNow).error().why, Why::kUnknown);
    EXPECT_EQ(upload->end(kNow).error().why, Why::kUnknown);
    EXPECT_EQ(entries(), 0U);
}

TEST_F(GuestStoreTest, ManyAtOnce_LeaveNothingBehind) {
    limits_.receiving_of_account = 100;
    limits_.all_bytes = 100'000;
    start();
    std::atomic<int> ready = 0;
    {
        std::vector<std::jthread> threads;
        for (int thread = 0; thread < 8; ++thread) {
            threads.emplace_back([&, thread] {
                for (int i = 0; i < 10; ++i) {
                    const std::string content(static_cast<size_t>(100 + i), 'c');
                    const auto begun =
                        store_->begin({{{"a.glb", content.size()}}}, std::to_string(thread), kNow);
                    const auto upload = store_->open(begun->uploads[0], 0, kNow).value();
                    (void)upload->append(std::as_bytes(std::span(content)), kNow);
                    (void)upload->end(kNow);
                    ready += store_->use(begun->id, kNow) ? 1 : 0;
                    (void)store_->expire(kNow);
                    (void)store_->counts().bytes;
                    (void)store_->remove(begun->id, begun->owner_key);
                }
            });
        }
    }
    EXPECT_EQ(ready, 80);
    EXPECT_EQ(store_->counts().bytes, 0U);
    EXPECT_EQ(entries(), 0U);
}

} // namespace
} // namespace froxel::guest
