// Clips as they are commanded.
#include "motion/playback.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>

namespace froxel::motion {
namespace {

using scene::Motion;
using settings::Animation;

// Clips of 1, 2, 4, 8, 16 and 32 s that move nothing.
std::shared_ptr<const Motion> sixClips() {
    Motion motion;
    for (const double duration_s : {1.0, 2.0, 4.0, 8.0, 16.0, 32.0}) {
        motion.clips.push_back({"", duration_s, {}, {}});
    }
    return std::make_shared<const Motion>(std::move(motion));
}

Playback begun(const Animation& animation, double now_s = 0) {
    return {sixClips(), animation, now_s};
}

TEST(Playback, OfASceneThatRests_IsNothing) {
    Playback rests;
    rests.follow({.number = 1}, 3);
    EXPECT_EQ(rests.at(3), std::nullopt);
    EXPECT_EQ(rests.timeAt(3), std::nullopt);
    EXPECT_EQ(rests.pausedAt(), std::nullopt);
    EXPECT_FALSE(rests.movesAt(3));
}

TEST(Playback, NoAnimation_IsTheRestPose) {
    const Playback none = begun({.number = 0});
    ASSERT_TRUE(none.at(1));
    EXPECT_EQ(none.at(1)->clips.at(0).clip, scene::kNone);
    EXPECT_EQ(none.timeAt(1), std::nullopt);
    EXPECT_FALSE(none.movesAt(1));
}

TEST(Playback, PauseSpeedAndSeek_GoOnFromWhereItStands) {
    Animation animation{.number = 3};
    Playback playback = begun(animation, 100);
    EXPECT_EQ(playback.timeAt(105.5), 1.5);
    animation.playing = false;
    playback.follow(animation, 106);
    EXPECT_EQ(playback.pausedAt(), 2);
    EXPECT_EQ(playback.timeAt(1000), 2);
    EXPECT_FALSE(playback.movesAt(1000));
    playback.seek(3, 1000);
    EXPECT_EQ(playback.pausedAt(), 3);
    animation.playing = true;
    animation.speed = -2;
    playback.follow(animation, 1000);
    EXPECT_EQ(playback.pausedAt(), std::nullopt);
    EXPECT_EQ(playback.timeAt(1001), 1);
    EXPECT_EQ(playback.timeAt(1002), 3);
    EXPECT_TRUE(playback.movesAt(1002));
}

TEST(Playback, OtherRepeat_GoesOnFromWhatIsSeen) {
    Animation animation{.number = 3};
    Playback playback = begun(animation);
    animation.repeat = Repeat::kOnce;
    playback.follow(animation, 9); // third time round, at 1 s
    EXPECT_EQ(playback.timeAt(9), 1);
    EXPECT_EQ(playback.timeAt(11.5), 3.5);
    EXPECT_EQ(playback.timeAt(99), 4);
    EXPECT_TRUE(playback.movesAt(11.75));
    EXPECT_FALSE(playback.movesAt(12));
    animation.repeat = Repeat::kPingPong;
    playback.follow(animation, 99);
    EXPECT_EQ(playback.timeAt(100.5), 2.5) << "on its way back";
    animation.repeat = Repeat::kLoop;
    playback.follow(animation, 100.5);
    EXPECT_EQ(playback.timeAt(101), 3) << "onwards again";
}

TEST(Playback, AnotherAnimation_BeginsAndCoversTheLast) {
    Animation animation{.number = 3, .fade_s = 2};
    Playback playback = begun(animation);
    animation.number = 2;
    playback.follow(animation, 3);
    EXPECT_EQ(playback.timeAt(3.5), 0.5);
    const auto playing = playback.at(4);
    ASSERT_EQ(playing->clips.size(), 2U);
    EXPECT_EQ(playing->clips[0].clip, 2U);
    EXPECT_EQ(playing->clips[0].clock.timeAt(4, 4), 0) << "it goes on while it fades";
    EXPECT_EQ(playing->clips[1].clip, 1U);
    EXPECT_EQ(playing->clips[1].fade.weightAt(4), 0.5);
    EXPECT_TRUE(playing->clips[1].covers);
    animation.number = 1;
    playback.follow(animation, 5); // that fade is over
    EXPECT_EQ(playback.at(5)->clips.size(), 2U);
    animation.fade_s = 0;
    animation.number = 4;
    playback.follow(animation, 5.5);
    EXPECT_EQ(playback.at(5.5)->clips.size(), 1U);
}

TEST(Playback, PausedInAFade_MovesUntilThatIsOver) {
    Animation animation{.number = 3, .fade_s = 2};
    Playback playback = begun(animation);
    animation.number = 2;
    animation.playing = false;
    playback.follow(animation, 3);
    EXPECT_TRUE(playback.movesAt(4.5));
    EXPECT_FALSE(playback.movesAt(5));
}

TEST(Playback, ManyAnimationsAtOnce_AreFew) {
    Animation animation{.number = 1, .fade_s = 10};
    Playback playback = begun(animation);
    for (uint32_t i = 2; i <= 6; ++i) {
        animation.number = i;
        playback.follow(animation, i);
    }
    const auto playing = playback.at(6);
    ASSERT_EQ(playing->clips.size(), Playback::kMostClips);
    EXPECT_EQ(playing->clips.front().fade.weightAt(6), 1) << "nothing of the rest pose shows";
    EXPECT_EQ(playing->clips.back().clip, 5U);
}

// Commands of one time that name other things, in every order.
TEST(Playback, OrderAtOneTime_DoesNotMatter) {
    using Edit = std::function<void(Animation&)>;
    const Edit edits[] = {
        [](Animation& a) { a.playing = false; }, [](Animation& a) { a.speed = -0.3F; },
        [](Animation& a) { a.repeat = Repeat::kPingPong; }, [](Animation& a) { a.number = 5; }};
    std::vector<size_t> order{0, 1, 2, 3};
    const auto play = [&] {
        Animation animation{.number = 2, .speed = 1.7F, .repeat = Repeat::kLoop, .fade_s = 3};
        Playback playback = begun(animation, 0.1);
        for (const size_t i : order) {
            edits[i](animation);
            playback.follow(animation, 77.7);
        }
        animation.playing = true;
        playback.follow(animation, 78.9);
        return *playback.at(79.3);
    };
    const Playing first = play();
    while (std::next_permutation(order.begin(), order.end())) {
        EXPECT_EQ(play(), first);
    }
}

TEST(Playback, SeekHistory_DoesNotMatter) {
    Playback direct = begun({.number = 4});
    Playback wandered = direct;
    std::mt19937_64 random(7);
    for (int i = 0; i < 100; ++i) {
        wandered.seek(std::uniform_real_distribution(0.0, 8.0)(random), i);
        (void)wandered.at(1e6);
    }
    wandered.seek(3.21, 200);
    direct.seek(3.21, 200);
    EXPECT_EQ(wandered, Playback(direct));
    EXPECT_EQ(wandered.at(201.5), direct.at(201.5));
}

} // namespace
} // namespace froxel::motion
