// The scene's material variants under a viewer's command.
#include "froxel/v1/server.pb.h"
#include "session/state_message.h"
#include "session/view_state.h"
#include "unit/session/messages.h"
#include "unit/session/state_fixture.h"

#include <gtest/gtest.h>

namespace froxel::session {
namespace {

class MaterialVariant : public State {
  protected:
    MaterialVariant() {
        context.scene.material_variants = {"red", ""};
        initial = initialState(context, kStart);
    }
    std::string refusalOf(uint32_t number) {
        const auto result = apply(initial, {{9, 0}, SetMaterialVariant{number}}, context, kStart);
        EXPECT_FALSE(result);
        return result ? "" : result.error().message;
    }
};

TEST_F(MaterialVariant, Initial_IsTheScenesChoice) {
    EXPECT_EQ(initial.settings.material_variant, 0U);
    context.scene.material_variant = 2;
    EXPECT_EQ(initialState(context, kStart).settings.material_variant, 2U);
}

TEST_F(MaterialVariant, Another_IsANewStateAndTheSameIsNone) {
    const SessionState state = applied(initial, SetMaterialVariant{2});
    EXPECT_EQ(state.settings.material_variant, 2U);
    EXPECT_NE(state.version, initial.version);
    EXPECT_EQ(applied(state, SetMaterialVariant{2}).version, state.version);
    EXPECT_EQ(applied(state, SetMaterialVariant{0}).settings, initial.settings);
}

TEST_F(MaterialVariant, Unknown_IsRefusedWithThoseThatThereAre) {
    EXPECT_EQ(refusalOf(3), "material_variant is 3; this scene has 1 red, 2 (nameless)");
    context.scene.material_variants.clear();
    EXPECT_EQ(refusalOf(1), "material_variant is 1; this scene has none");
}

TEST_F(MaterialVariant, Messages_TellIt) {
    const SessionState state = applied(initial, SetMaterialVariant{1});
    const auto welcome = makeWelcome(1, context, state).welcome();
    ASSERT_EQ(welcome.scene().material_variants_size(), 2);
    EXPECT_EQ(welcome.scene().material_variants(0), "red");
    EXPECT_EQ(welcome.scene().material_variants(1), "");
    EXPECT_EQ(welcome.state().material_variant(), 1U);
}

TEST(DecodeCommand, SetMaterialVariant_NamesOne) {
    v1::ClientMessage message = clientMessage();
    v1::SetMaterialVariant& set = *message.mutable_set_material_variant();
    EXPECT_EQ(refused(decodeBinary(message)).field, "material_variant");
    set.set_material_variant(0);
    EXPECT_EQ(accepted<SetMaterialVariant>(decodeBinary(message)).number, 0U);
    set.set_material_variant(7);
    EXPECT_EQ(accepted<SetMaterialVariant>(decodeBinary(message)).number, 7U);
}

} // namespace
} // namespace froxel::session
