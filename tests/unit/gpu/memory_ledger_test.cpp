#include "gpu/memory_ledger.h"

#include <gtest/gtest.h>

#include <gmock/gmock.h>

namespace froxel::gpu {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Pair;

TEST(MemoryLedger, AddAndRemove_KeepsWhatIsLeftOfEachPurpose) {
    MemoryLedger ledger;
    ledger.add("targets", 100);
    ledger.add("textures", 40);
    ledger.add("targets", 1);
    EXPECT_THAT(ledger.byPurpose(), ElementsAre(Pair("targets", 101), Pair("textures", 40)));
    ledger.remove("targets", 100);
    EXPECT_EQ(ledger.totalBytes(), 41U);
    ledger.remove("targets", 1);
    ledger.remove("textures", 40);
    EXPECT_THAT(ledger.byPurpose(), IsEmpty());
}

TEST(MemoryLedger, EveryChange_HasAnotherVersion) {
    MemoryLedger ledger;
    const auto before = ledger.version();
    ledger.add("targets", 1);
    const auto between = ledger.version();
    ledger.remove("targets", 1);
    EXPECT_NE(between, before);
    EXPECT_NE(ledger.version(), between);
    EXPECT_NE(ledger.version(), before);
}

} // namespace froxel::gpu
