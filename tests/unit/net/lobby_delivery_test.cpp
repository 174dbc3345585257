// Which picture who gets in a room, and how it is made. No sockets, no threads.
#include "unit/net/lobby_fixture.h"

namespace froxel::net {
namespace {

TEST_F(LobbyTest, LateJoiner_GetsTheNewestPictureAtOnce) {
    const Guest first = enter("hall");
    EXPECT_FALSE(first.seat.picture);
    port_.deliver(1, now_);
    port_.deliver(2, now_);
    now_ += 1min;
    const Guest late = enter("hall");
    ASSERT_TRUE(late.seat.picture);
    EXPECT_EQ(late.seat.picture->record.frame_id, 2U);
    EXPECT_EQ(late.seat.picture->ready_at, now_);
    EXPECT_EQ(port_.session().states.size(), 1U) << "nothing is drawn for it";
}

// A link that is slow, unknown, or of somebody who looks away makes no picture worse or better.
TEST_F(LobbyTest, Room_IsDeliveredAsToTheBestLinkThatPicturesGoTo) {
    const auto at = [](uint32_t rung) {
        session::Delivery delivery;
        delivery.rung = rung;
        return delivery;
    };
    const Guest slow = enter("hall");
    const Guest quick = enter("hall");
    slow.seat.session->setDelivery(slow.seat.place, at(4));
    EXPECT_EQ(port_.session().delivery.rung, 4U) << "the other has acknowledged nothing yet";
    quick.seat.session->setDelivery(quick.seat.place, at(0));
    EXPECT_EQ(port_.session().delivery.rung, 0U);
    quick.seat.session->setPaused(quick.seat.place, true, now_);
    EXPECT_EQ(port_.session().delivery.rung, 4U);
    quick.seat.session->setDelivery(quick.seat.place, at(1));
    EXPECT_EQ(port_.session().delivery.rung, 4U) << "of what it acknowledged late";
    quick.seat.session->setPaused(quick.seat.place, false, now_);
    EXPECT_EQ(port_.session().delivery.rung, 1U);
    lose(quick);
    EXPECT_EQ(port_.session().delivery.rung, 4U);
}

// What nobody takes costs the device nothing.
TEST_F(LobbyTest, Room_TakesFrames_WhileAnyOfItsViewersDoes) {
    const Guest first = enter("hall");
    const Guest second = enter("hall");
    EXPECT_TRUE(port_.session().takes_frames);
    first.seat.session->setPaused(first.seat.place, true, now_);
    EXPECT_TRUE(port_.session().takes_frames);
    lose(second);
    EXPECT_FALSE(port_.session().takes_frames);
    first.seat.session->setPaused(first.seat.place, false, now_);
    EXPECT_TRUE(port_.session().takes_frames);
}

TEST_F(LobbyTest, Newcomer_GetsThePlainPictureFirst_AndTheRefinedOneAsItsLinkCarriesIt) {
    const auto deliver = [this](uint64_t id, session::Refinement refinement, size_t bytes) {
        session::ReadyFrame frame;
        frame.record.frame_id = id;
        frame.record.delivered.refinement = refinement;
        frame.bytes = std::make_shared<const std::vector<std::byte>>(bytes);
        port_.sink()->deliver(std::move(frame));
    };
    const auto link = [](double bits_per_s) {
        session::Delivery delivery;
        delivery.link_rate = bits_per_s;
        return delivery;
    };
    const Guest first = enter("hall");
    deliver(1, session::Refinement::kInteractive, 1000);
    deliver(2, session::Refinement::kLossless, 1'000'000);
    EXPECT_EQ(first.ear->count<session::ReadyFrame>(), 2U) << "nothing is known of its link";

    const Guest quick = enter("hall");
    const Guest slow = enter("hall");
    ASSERT_TRUE(quick.seat.picture);
    EXPECT_EQ(quick.seat.picture->record.frame_id, 1U);
    quick.seat.session->setDelivery(quick.seat.place, link(100e6));
    slow.seat.session->setDelivery(slow.seat.place, link(1e6));
    quick.seat.session->setDelivery(quick.seat.place, link(200e6));
    ASSERT_EQ(quick.ear->count<session::ReadyFrame>(), 1U);
    EXPECT_EQ(quick.ear->last<session::ReadyFrame>()->record.frame_id, 2U);
    EXPECT_EQ(slow.ear->count<session::ReadyFrame>(), 0U) << "8 s of its link";

    deliver(3, session::Refinement::kInteractive, 1000);
    deliver(4, session::Refinement::kLossless, 1'000'000);
    EXPECT_EQ(slow.ear->count<session::ReadyFrame>(), 1U);
    EXPECT_EQ(quick.ear->count<session::ReadyFrame>(), 3U);
}

} // namespace
} // namespace froxel::net
