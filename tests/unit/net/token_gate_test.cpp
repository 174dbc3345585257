#include "net/token_gate.h"
#include "unit/net/conversation_fixture.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <memory>
#include <string>

namespace froxel::net {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string kToken = "correct-horse-battery";

class TokenGateTest : public testing::Test {
  protected:
    ~TokenGateTest() override { std::filesystem::remove(path_); }
    Result<void> load(const std::string& text) {
        std::ofstream(path_) << text;
        return gate_->load(path_);
    }
    const std::string path_ = testing::TempDir() + "froxel_token_gate_" +
                              testing::UnitTest::GetInstance()->current_test_info()->name();
    std::shared_ptr<TokenGate> gate_ = std::make_shared<TokenGate>();
};

TEST_F(TokenGateTest, NothingLoaded_LetsEverybodyIn) {
    EXPECT_TRUE(gate_->lets(""));
}

TEST_F(TokenGateTest, Loaded_LetsInWhoKnowsOneOfThem) {
    ASSERT_TRUE(load("# viewers\n\n" + kToken + "\r\nanother-token-0123\n"));
    EXPECT_TRUE(gate_->lets(kToken));
    EXPECT_TRUE(gate_->lets("another-token-0123"));
    for (const std::string& wrong :
         {std::string(), kToken + "x", kToken.substr(1), std::string("# viewers"), kToken + "\r"}) {
        EXPECT_FALSE(gate_->lets(wrong)) << wrong;
    }
}

TEST_F(TokenGateTest, BrokenFile_NamesTheLineAndNoToken_AndChangesNothing) {
    ASSERT_TRUE(load(kToken + "\n"));
    for (const std::string& broken :
         {std::string("secret-short\n"), std::string("secret with some spaces\n"),
          "secret" + std::string(600, 'x') + "\n", std::string("secret-\x01-0123456789\n")}) {
        const auto loaded = load("# a\n" + broken);
        ASSERT_FALSE(loaded);
        EXPECT_THAT(loaded.error().message, HasSubstr(path_ + " line 2"));
        EXPECT_THAT(loaded.error().message, Not(HasSubstr("secret")));
    }
    EXPECT_THAT(load("# nobody\n").error().message, HasSubstr("contains no token"));
    EXPECT_THAT(gate_->load("/no/such/file").error().message, HasSubstr("/no/such/file"));
    EXPECT_TRUE(gate_->lets(kToken));
    EXPECT_FALSE(gate_->lets(""));
}

TEST_F(TokenGateTest, Pass_LastsAsLongAsItsTokenIsInTheFile) {
    ASSERT_TRUE(load(kToken + "\nanother-token-0123\n"));
    const auto stays = gate_->admit(kToken);
    const auto goes = gate_->admit("another-token-0123");
    ASSERT_TRUE(stays && goes);
    EXPECT_TRUE(stays->valid() && goes->valid());
    ASSERT_TRUE(load("a-third-token-0123\n" + kToken + "\n"));
    EXPECT_TRUE(stays->valid());
    EXPECT_FALSE(goes->valid());
    EXPECT_FALSE(load("short\n"));
    EXPECT_TRUE(stays->valid()) << "a broken file changes nothing";
}

TEST_F(TokenGateTest, NoDepth_IsOfTheTokenThatItFollows) {
    ASSERT_TRUE(load(kToken + " no-depth\nanother-token-0123\n"));
    const auto without = gate_->admit(kToken);
    const auto with = gate_->admit("another-token-0123");
    ASSERT_TRUE(without && with);
    EXPECT_FALSE(without->depth());
    EXPECT_TRUE(with->depth());
    EXPECT_FALSE(gate_->lets(kToken + " no-depth"));
    ASSERT_TRUE(load(kToken + "\nanother-token-0123\n"));
    EXPECT_FALSE(without->valid()) << "its viewer connects again, with other rights";
    EXPECT_TRUE(with->valid());
    EXPECT_THAT(load(kToken + " no-deepth\n").error().message, HasSubstr("\" no-depth\" may"));
}

// One that says Hello with a token to a server that serves.
struct Talk {
    Talk(std::shared_ptr<const TokenGate> gate, const std::string& token)
        : conversation(
              {}, std::make_shared<Lobby>(LobbyRules{}), std::make_shared<Metrics>(), {}, gate) {
        status.serving = Serving{std::make_shared<const session::SessionContext>(), &port};
        conversation.onService(status, TimePoint());
        v1::ClientMessage hello;
        hello.set_seq(1);
        hello.mutable_hello()->set_protocol_major(protocol::kMajor);
        hello.mutable_hello()->set_token(token);
        conversation.onMessage(protocol::bytesOf(hello.SerializeAsString()), WireFormat::kBinary,
                               TimePoint());
    }
    FakePort port;
    ServiceStatus status;
    Conversation conversation;
};

TEST_F(TokenGateTest, Conversation_WhoseTokenIsTakenAway_EndsAtTheNextWord) {
    ASSERT_TRUE(load(kToken + "\nanother-token-0123\n"));
    Talk stays(gate_, kToken);
    Talk goes(gate_, "another-token-0123");
    ASSERT_TRUE(load(kToken + "\n"));
    for (Talk* talk : {&stays, &goes}) {
        talk->conversation.onService(talk->status, TimePoint());
    }
    EXPECT_FALSE(stays.conversation.closing());
    ASSERT_TRUE(goes.conversation.closing());
    EXPECT_EQ(goes.conversation.closing()->code, protocol::CloseCode::kToken);
}

TEST_F(TokenGateTest, Conversation_WithAToken_IsChargedToItByANameThatIsNoSecret) {
    ASSERT_TRUE(load("another-token-0123\n" + kToken + "\n"));
    const auto chargedTo = [this](const std::string& token) {
        return Talk(gate_, token).port.session().account.key;
    };
    EXPECT_EQ(chargedTo(kToken), "token 2");
    ASSERT_TRUE(load(kToken + "\na-third-token-0123\n"));
    EXPECT_EQ(chargedTo(kToken), "token 2") << "as before";
    EXPECT_EQ(chargedTo("a-third-token-0123"), "token 3");
}

TEST_F(TokenGateTest, Conversation_WithoutTheToken_GetsNoSession) {
    ASSERT_TRUE(load(kToken + "\n"));
    for (const std::string& token : {std::string(), std::string("wrong-horse-battery"), kToken}) {
        const Talk talker(gate_, token);
        const auto& [port, status, talk] = talker;
        EXPECT_EQ(port.sessions.size(), token == kToken ? 1U : 0U) << token;
        EXPECT_EQ(talk.closing().has_value(), token != kToken);
        if (talk.closing()) {
            EXPECT_EQ(talk.closing()->code, protocol::CloseCode::kToken);
        }
    }
}

} // namespace
} // namespace froxel::net
