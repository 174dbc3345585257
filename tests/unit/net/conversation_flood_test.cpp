// What one connection may say, and have said to it, when it says too much.
#include "unit/net/conversation_fixture.h"

#include <string>

namespace froxel::net {
namespace {

using protocol::CloseCode;
using Standing = ReadBudget::Standing;

class ConversationFlood : public ConversationTest {
  protected:
    void pick() {
        v1::ClientMessage message;
        message.mutable_pick_light()->set_id(7);
        say(message);
    }
    // The codes of the errors that wait.
    std::vector<v1::ErrorCode> errors() {
        std::vector<v1::ErrorCode> codes;
        while (const auto answer = nextAnswer()) {
            if (answer->has_error()) {
                codes.push_back(answer->error().code());
            }
        }
        return codes;
    }
};

TEST_F(ConversationFlood, PickLight_NothingThere_IsNoOffence) {
    join();
    for (uint32_t i = 0; i < 2 * protocol::kMaxRejects; ++i) {
        pick();
        EXPECT_EQ(errors(), std::vector{v1::ERROR_CODE_OUT_OF_RANGE});
        now_ += 200ms;
    }
    EXPECT_FALSE(talk_.closing());
}

TEST_F(ConversationFlood, PickLight_MoreThanItsRate_IsRefusedUnlooked) {
    join();
    const auto allowed = static_cast<size_t>(Conversation::kPicksAtOnce);
    for (size_t i = 0; i < allowed + 1; ++i) {
        pick();
    }
    std::vector<v1::ErrorCode> expected(allowed, v1::ERROR_CODE_OUT_OF_RANGE);
    expected.push_back(v1::ERROR_CODE_RATE_LIMIT);
    EXPECT_EQ(errors(), expected);
}

TEST_F(ConversationFlood, Throttled_IsToldAndGoesOn) {
    join();
    talk_.onFlood(Standing::kThrottled);
    EXPECT_EQ(errors(), std::vector{v1::ERROR_CODE_RATE_LIMIT});
    EXPECT_FALSE(talk_.closing());
}

TEST_F(ConversationFlood, Spent_IsToldAndCloses) {
    join();
    talk_.onFlood(Standing::kSpent);
    EXPECT_EQ(errors(), std::vector{v1::ERROR_CODE_RATE_LIMIT});
    ASSERT_TRUE(talk_.closing());
    EXPECT_EQ(talk_.closing()->code, CloseCode::kPolicy);
}

TEST_F(ConversationFlood, Errors_WithoutARefusedMessage_AreCountedToo) {
    join();
    talk_.onFlood(Standing::kThrottled);
    EXPECT_NE(metrics_->text().find(R"(froxel_command_rejects_total{reason="rate_limit"} 1)"),
              std::string::npos);
}

TEST_F(ConversationFlood, RoomStates_OfManyChanges_AreFewAndTheLastComes) {
    serve();
    v1::ClientMessage message;
    message.mutable_hello()->set_protocol_major(protocol::kMajor);
    message.mutable_hello()->set_room("hall");
    say(message);
    drainAnswers();
    size_t told = 0;
    for (int i = 0; i < 200; ++i) {
        talk_.onNotice(RoomNews{});
        const auto answer = nextAnswer();
        told += answer && answer->has_room_state() ? 1U : 0U;
    }
    EXPECT_EQ(told, static_cast<size_t>(Conversation::kStatesAtOnce));
    const auto due = talk_.wakeAt(now_);
    ASSERT_TRUE(due) << "the last change is not forgotten";
    now_ = *due;
    const auto last = nextAnswer();
    EXPECT_TRUE(last && last->has_room_state());
}

TEST_F(ConversationFlood, LongAnswer_IsMadeByWhoWritesIt) {
    join();
    v1::ClientMessage message;
    for (uint32_t id = 1; id <= 1000; ++id) {
        v1::PlacedLight& light = *message.mutable_set_placed_lights()->add_lights();
        light.set_id(id);
        light.mutable_position()->set_x(id);
    }
    say(message);
    auto out = talk_.nextMessage(now_);
    ASSERT_TRUE(out && out->unmade);
    EXPECT_TRUE(out->head.empty());
    out->make();
    v1::ServerMessage answer;
    protocol::decodeServerMessage(protocol::bytesOf(out->head), out->format, answer).value();
    EXPECT_EQ(answer.state().placed_lights().lights_size(), 1000);
}

} // namespace
} // namespace froxel::net
