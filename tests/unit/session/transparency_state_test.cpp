#include "unit/session/context.h"

#include <gtest/gtest.h>

namespace froxel::session {
namespace {

TEST(TransparencyState, Parts_AreSetOneByOne) {
    const SessionContext context = makeContext();
    const SessionState initial = initialState(context, {});
    const auto kind =
        apply(initial, {{1, 0}, SetTransparency{view::Transparency::kPeeled, {}}}, context, {});
    ASSERT_TRUE(kind);
    EXPECT_EQ(kind->settings.transparency, view::Transparency::kPeeled);
    EXPECT_EQ(kind->settings.peel_layers, initial.settings.peel_layers);
    const auto layers = apply(*kind, {{2, 0}, SetTransparency{{}, 9}}, context, {});
    ASSERT_TRUE(layers);
    EXPECT_EQ(layers->settings.transparency, view::Transparency::kPeeled);
    EXPECT_EQ(layers->settings.peel_layers, 9U);
}

} // namespace
} // namespace froxel::session
