#include "core/enumerators.h"

#include <gtest/gtest.h>

namespace froxel {
namespace {

enum class Fruit : uint16_t { kPear = 9, kApple = 2, kPlum = 300 };

constexpr bool isFruit(Fruit fruit) {
    switch (fruit) {
    case Fruit::kPear:
    case Fruit::kApple:
    case Fruit::kPlum:
        return true;
    }
    return false;
}

TEST(Enumerators, All_AreListedOnceInTheirOrder) {
    constexpr auto all = enumerators<Fruit, 300, isFruit>();
    EXPECT_EQ(all, (std::array{Fruit::kApple, Fruit::kPear, Fruit::kPlum}));
}

} // namespace
} // namespace froxel
