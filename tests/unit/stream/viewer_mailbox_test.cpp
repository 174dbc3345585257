#include "session/session_context.h"
#include "stream/viewer_mailbox.h"
#include "support/recording_sink.h"

#include <gtest/gtest.h>

namespace froxel::stream {
namespace {

class ViewerMailboxTest : public testing::Test {
  protected:
    session::SessionState state(uint64_t version) {
        auto value = session::initialState(context_, now_);
        value.version = version;
        return value;
    }

    session::SessionContext context_;
    TimePoint now_{};
    session::Account account_{"192.0.2.7"};
    std::shared_ptr<test::RecordingSink> sink_ = std::make_shared<test::RecordingSink>();
    ViewerMailbox mailbox_;
};

TEST_F(ViewerMailboxTest, Take_AfterSeveralUpdates_HasTheNewestState) {
    const auto id = mailbox_.join(sink_, state(1), account_, now_).value();
    mailbox_.update(id, state(2), now_);
    mailbox_.update(id, state(3), now_);
    mailbox_.grant(id, 5);
    const auto news = mailbox_.take();
    ASSERT_EQ(news.size(), 1U);
    EXPECT_EQ(news[0].state->version, 3U);
    EXPECT_EQ(news[0].granted, 5U);
    EXPECT_EQ(news[0].account, account_);
    EXPECT_TRUE(mailbox_.take().empty());
}

TEST_F(ViewerMailboxTest, Take_OnlyCreditIsNew_HasNoState) {
    const auto id = mailbox_.join(sink_, state(1), account_, now_).value();
    EXPECT_EQ(mailbox_.take().size(), 1U);
    mailbox_.grant(id, 1);
    const auto news = mailbox_.take();
    ASSERT_EQ(news.size(), 1U);
    EXPECT_FALSE(news[0].state);
}

TEST_F(ViewerMailboxTest, Update_AfterLeaving_ChangesNothing) {
    const auto id = mailbox_.join(sink_, state(1), account_, now_).value();
    mailbox_.leave(id);
    mailbox_.update(id, state(2), now_);
    const auto news = mailbox_.take();
    ASSERT_EQ(news.size(), 1U);
    EXPECT_TRUE(news[0].left);
    EXPECT_EQ(news[0].state->version, 1U);
    mailbox_.update(id, state(3), now_);
    EXPECT_TRUE(mailbox_.take().empty());
}

TEST_F(ViewerMailboxTest, Join_AfterClose_GivesTheReason) {
    mailbox_.close({ErrorCode::kDevice, "lost"});
    const auto joined = mailbox_.join(sink_, state(1), account_, now_);
    ASSERT_FALSE(joined);
    EXPECT_EQ(joined.error().code, ErrorCode::kDevice);
}

TEST_F(ViewerMailboxTest, Wait_AlreadyAwake_ReturnsAtOnce) {
    mailbox_.wake();
    mailbox_.wait({}, std::nullopt); // hangs when the wake was lost
}

TEST_F(ViewerMailboxTest, Wait_StopRequested_Returns) {
    std::stop_source stop;
    stop.request_stop();
    mailbox_.wait(stop.get_token(), std::nullopt);
}

} // namespace
} // namespace froxel::stream
