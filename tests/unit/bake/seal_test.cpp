#include "bake/seal.h"
#include "core/file_descriptor.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <future>
#include <sys/mman.h>
#include <unistd.h>

namespace froxel::bake {
namespace {

TEST(Seal, WaitsForMappingsThatWrite_AndNothingWritesAfterwards) {
    constexpr size_t kBytes = 4096;
    const FileDescriptor memory(memfd_create("seal_test", MFD_CLOEXEC | MFD_ALLOW_SEALING));
    ASSERT_EQ(ftruncate(memory.get(), kBytes), 0);
    void* const mapped = mmap(nullptr, kBytes, PROT_READ | PROT_WRITE, MAP_SHARED, memory.get(), 0);
    ASSERT_NE(mapped, MAP_FAILED);
    EXPECT_FALSE(seal(memory.get(), std::chrono::milliseconds(0)));
    EXPECT_EQ(errno, EBUSY);
    auto sealed = std::async(std::launch::async, [&] { return seal(memory.get()); });
    munmap(mapped, kBytes);
    EXPECT_TRUE(sealed.get());
    EXPECT_EQ(write(memory.get(), "x", 1), -1);
    EXPECT_EQ(errno, EPERM);
}

TEST(Seal, OfNoMemory_FailsAtOnce) {
    EXPECT_FALSE(seal(-1));
    EXPECT_EQ(errno, EBADF);
}

} // namespace
} // namespace froxel::bake
