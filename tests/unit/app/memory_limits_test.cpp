#include "app/memory_limits.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdlib.h>
#include <string>

namespace froxel::app {
namespace {

namespace fs = std::filesystem;

constexpr uint64_t kMib = 1 << 20U;

// A made-up /proc and /sys.
class HostMemory : public testing::Test {
  protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "froxel_host_XXXXXX").string();
        ASSERT_NE(::mkdtemp(name.data()), nullptr);
        root_ = name;
        write("proc/meminfo", "MemTotal:       8388608 kB\nMemFree: 1 kB\n");
    }
    void TearDown() override { fs::remove_all(root_); }
    void write(const fs::path& path, const std::string& text) const {
        fs::create_directories((root_ / path).parent_path());
        std::ofstream(root_ / path) << text;
    }
    [[nodiscard]] std::optional<uint64_t> bytes() const { return hostMemoryBytes(root_); }

    fs::path root_;
};

TEST_F(HostMemory, WithoutGroups_IsAllOfIt) {
    EXPECT_EQ(bytes(), 8192 * kMib);
}

TEST_F(HostMemory, ContainersOwnGroup_Limits) {
    write("proc/self/cgroup", "0::/\n");
    write("sys/fs/cgroup/memory.max", std::to_string(3072 * kMib) + "\n");
    EXPECT_EQ(bytes(), 3072 * kMib);
}

TEST_F(HostMemory, GroupAboveTheUnits_LimitsToo) {
    write("proc/self/cgroup", "0::/system.slice/froxel.service\n");
    write("sys/fs/cgroup/system.slice/memory.max", std::to_string(2048 * kMib) + "\n");
    write("sys/fs/cgroup/system.slice/froxel.service/memory.max", "max\n");
    EXPECT_EQ(bytes(), 2048 * kMib);
}

TEST_F(HostMemory, GroupsOfVersion1_Limit) {
    write("proc/self/cgroup", "5:cpu,cpuacct:/a\n4:memory:/docker/abc\n");
    write("sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n");
    write("sys/fs/cgroup/memory/docker/abc/memory.limit_in_bytes", std::to_string(1024 * kMib));
    EXPECT_EQ(bytes(), 1024 * kMib);
}

TEST_F(HostMemory, Free_IsWhatHostAndGroupsLeave) {
    write("proc/meminfo", "MemTotal: 8388608 kB\nMemFree: 1 kB\nMemAvailable: 4194304 kB\n");
    EXPECT_EQ(freeMemoryBytes(root_), 4096 * kMib);
    write("proc/self/cgroup", "0::/system.slice/froxel.service\n");
    write("sys/fs/cgroup/system.slice/memory.max", std::to_string(2048 * kMib) + "\n");
    write("sys/fs/cgroup/system.slice/memory.current", std::to_string(1948 * kMib) + "\n");
    write("sys/fs/cgroup/system.slice/froxel.service/memory.max", "max\n");
    EXPECT_EQ(freeMemoryBytes(root_), 100 * kMib);
    write("sys/fs/cgroup/system.slice/memory.current", std::to_string(3000 * kMib) + "\n");
    EXPECT_EQ(freeMemoryBytes(root_), 0U);
}

TEST_F(HostMemory, NothingToRead_IsUnknown) {
    fs::remove(root_ / "proc/meminfo");
    EXPECT_EQ(bytes(), std::nullopt);
}

TEST(ReadShares, OfSeveralReads_StayBelowWhatIsFree) {
    constexpr uint64_t kScenes = 4096 * kMib;
    ReadShares shares([] { return std::optional(1024 * kMib); });
    auto first = shares.take(kScenes);
    EXPECT_EQ(*first, 512 * kMib);
    const auto second = shares.take(kScenes);
    EXPECT_EQ(*second, 256 * kMib);
    first.reset();
    EXPECT_EQ(*shares.take(kScenes), 384 * kMib);
    EXPECT_EQ(*shares.take(1), kLeastReadBytes) << "no scene of more would be taken";
}

TEST(ReadShares, UnknownMemory_LeavesThatOfTheScenes) {
    ReadShares shares([] { return std::optional<uint64_t>(); });
    EXPECT_EQ(*shares.take(1024 * kMib), 3072 * kMib);
}

TEST(SessionMemory, Default_IsByTheDevicesKind) {
    EXPECT_EQ(sessionMemoryBytes({}, true), kCpuSessionMemory_mib * kMib);
    EXPECT_EQ(sessionMemoryBytes({}, false), kGpuSessionMemory_mib * kMib);
    EXPECT_EQ(sessionMemoryBytes({.device_mib = {}, .session_mib = 64}, true), 64 * kMib);
}

} // namespace
} // namespace froxel::app
