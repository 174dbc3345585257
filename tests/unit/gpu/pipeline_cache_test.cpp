#include "gpu/pipeline_cache.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

namespace froxel::gpu {

namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr PipelineCacheKey kKey{.vendor = 0x10de,
                                .device = 0x2335,
                                .driver_version = 580,
                                .build = 77,
                                .uuid = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16}};

// As a driver of the key's device would give it: Vulkan's header, then its own.
std::vector<std::byte> driverData(const PipelineCacheKey& key, size_t length, unsigned fill) {
    std::vector<std::byte> bytes(32 + length, static_cast<std::byte>(fill));
    const std::array<uint32_t, 4> words = {32, 1, key.vendor, key.device};
    std::memcpy(bytes.data(), words.data(), sizeof(words));
    std::memcpy(bytes.data() + sizeof(words), key.uuid.data(), key.uuid.size());
    return bytes;
}

class PipelineCacheFile : public ::testing::Test {
  protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "froxel_cache_XXXXXX").string();
        ASSERT_NE(::mkdtemp(name.data()), nullptr);
        folder_ = name;
        file_ = pipelineCacheFile(folder_, kKey);
    }
    void TearDown() override { fs::remove_all(folder_); }

    void write(size_t length = 1000, unsigned fill = 7) {
        ASSERT_TRUE(writePipelineCache(file_, kKey, driverData(kKey, length, fill)));
    }
    void expectRefused(const PipelineCacheKey& key, const std::string& why) {
        const auto content = readPipelineCache(file_, key);
        EXPECT_TRUE(content.bytes.empty());
        EXPECT_THAT(content.refused, HasSubstr(why));
    }

    fs::path folder_;
    fs::path file_;
};

} // namespace

TEST_F(PipelineCacheFile, WhatWasWritten_IsReadBack) {
    write();
    const auto content = readPipelineCache(file_, kKey);
    EXPECT_EQ(content.bytes, driverData(kKey, 1000, 7));
    EXPECT_EQ(content.refused, "");
}

TEST_F(PipelineCacheFile, Absent_IsNoFault) {
    const auto content = readPipelineCache(file_, kKey);
    EXPECT_TRUE(content.bytes.empty());
    EXPECT_EQ(content.refused, "");
}

TEST_F(PipelineCacheFile, AnyByteDamaged_IsRefused) {
    write(200);
    const auto whole = folder_ / "whole";
    fs::copy_file(file_, whole);
    const auto size = static_cast<std::streamoff>(fs::file_size(file_));
    for (std::streamoff at = 0; at < size; ++at) {
        if (at >= 20 && at < 24) {
            continue; // padding of the key
        }
        std::fstream stream(file_, std::ios::in | std::ios::out | std::ios::binary);
        stream.seekg(at);
        const auto byte = static_cast<char>(stream.get() ^ 0x10);
        stream.seekp(at);
        stream.put(byte);
        stream.close();
        const auto content = readPipelineCache(file_, kKey);
        EXPECT_TRUE(content.bytes.empty()) << "byte " << at;
        EXPECT_NE(content.refused, "") << "byte " << at;
        fs::copy_file(whole, file_, fs::copy_options::overwrite_existing);
    }
}

TEST_F(PipelineCacheFile, TruncatedOrLengthened_IsRefused) {
    write(200);
    const auto size = fs::file_size(file_);
    for (const auto length : {uintmax_t{0}, uintmax_t{1}, uintmax_t{63}, uintmax_t{64},
                              uintmax_t{100}, size - 1, size + 1}) {
        fs::resize_file(file_, length);
        const auto content = readPipelineCache(file_, kKey);
        EXPECT_TRUE(content.bytes.empty()) << length;
        EXPECT_NE(content.refused, "") << length;
        write(200);
    }
}

TEST_F(PipelineCacheFile, ImpossibleLength_IsRefusedWithoutTryingIt) {
    write(200);
    std::fstream stream(file_, std::ios::in | std::ios::out | std::ios::binary);
    stream.seekp(48);
    const uint64_t length = ~uint64_t{0};
    stream.write(reinterpret_cast<const char*>(&length), sizeof(length));
    stream.close();
    expectRefused(kKey, "impossible length");
}

TEST_F(PipelineCacheFile, OtherDeviceDriverOrBuild_IsRefused) {
    write();
    auto other = kKey;
    other.device ^= 1U;
    expectRefused(other, "another device");
    other = kKey;
    other.uuid[15] ^= 1U;
    expectRefused(other, "another device");
    other = kKey;
    ++other.driver_version;
    expectRefused(other, "another device or driver");
    other = kKey;
    ++other.build;
    expectRefused(other, "another build");
}

TEST_F(PipelineCacheFile, DriverDataOfAnotherDevice_IsNotWritten) {
    auto other = kKey;
    other.vendor ^= 1U;
    EXPECT_FALSE(writePipelineCache(file_, kKey, driverData(other, 10, 0)));
    EXPECT_FALSE(writePipelineCache(file_, kKey, {}));
    EXPECT_FALSE(fs::exists(file_));
}

TEST_F(PipelineCacheFile, DevicesApart_HaveFilesApart) {
    auto other = kKey;
    other.uuid[0] ^= 1U;
    EXPECT_NE(pipelineCacheFile(folder_, other), file_);
    other = kKey;
    ++other.build; // takes the place of its forerunner
    EXPECT_EQ(pipelineCacheFile(folder_, other), file_);
}

TEST_F(PipelineCacheFile, MissingFolder_IsMadeForItsOwnerOnly) {
    const auto file = pipelineCacheFile(folder_ / "a" / "b", kKey);
    ASSERT_TRUE(writePipelineCache(file, kKey, driverData(kKey, 10, 0)));
    EXPECT_EQ(fs::status(folder_ / "a" / "b").permissions(), fs::perms::owner_all);
    EXPECT_FALSE(readPipelineCache(file, kKey).bytes.empty());
}

TEST_F(PipelineCacheFile, FolderThatCannotBeWritten_IsAnErrorThatNamesTheFile) {
    const auto in_the_way = folder_ / "file";
    std::ofstream(in_the_way) << "not a folder";
    const auto file = pipelineCacheFile(in_the_way, kKey);
    const auto written = writePipelineCache(file, kKey, driverData(kKey, 10, 0));
    ASSERT_FALSE(written);
    EXPECT_THAT(written.error().message, HasSubstr(file.string()));
}

// Writers are processes in life; in any order, a reader sees one whole file or another.
TEST_F(PipelineCacheFile, ConcurrentWriters_LeaveOneWholeFile) {
    constexpr unsigned kWriters = 6;
    std::array<pid_t, kWriters> children{};
    for (unsigned i = 0; i < kWriters; ++i) {
        children[i] = ::fork();
        if (children[i] == 0) {
            bool good = true;
            for (unsigned k = 0; k < 10; ++k) {
                const auto data = driverData(kKey, 5000 + 1000 * i, i);
                good = writePipelineCache(file_, kKey, data).has_value() && good;
            }
            ::_exit(good ? 0 : 1);
        }
    }
    for (unsigned running = kWriters; running > 0;) {
        const auto content = readPipelineCache(file_, kKey);
        EXPECT_EQ(content.refused, "");
        int status = 0;
        if (::waitpid(-1, &status, WNOHANG) > 0) {
            EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
            --running;
        }
    }
    EXPECT_FALSE(readPipelineCache(file_, kKey).bytes.empty());
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1); // no temporary is left
}

TEST(PipelineCacheFolder, EnvironmentVariables_MustBeAbsolute) {
    ::setenv("XDG_CACHE_HOME", "/x/cache", 1);
    EXPECT_EQ(defaultPipelineCacheFolder(), "/x/cache/froxel");
    ::setenv("XDG_CACHE_HOME", "relative", 1);
    ::setenv("HOME", "/home/someone", 1);
    EXPECT_EQ(defaultPipelineCacheFolder(), "/home/someone/.cache/froxel");
    ::unsetenv("XDG_CACHE_HOME");
    ::unsetenv("HOME");
    EXPECT_EQ(defaultPipelineCacheFolder(), "");
}

} // namespace froxel::gpu
