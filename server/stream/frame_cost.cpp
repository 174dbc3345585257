#include "stream/frame_cost.h"

#include "core/keep_for_good.h"

namespace froxel::stream {
namespace {

// Of what is measured, in frames that a device takes at once.
constexpr uint32_t kRounds = 2;

Result<void>
draw(ViewSource& view, const settings::ViewSettings& settings, uint32_t frames, uint32_t depth) {
    uint32_t waiting = 0; // pieces of the frame begun last
    uint32_t on_device = 0;
    for (uint32_t begun = 0, done = 0; done < frames;) {
        if (waiting == 0 && begun < frames && on_device < depth && view.canBegin()) {
            const auto work = view.begin(settings, {}, 0);
            if (!work) {
                return work.error();
            }
            if (work->half_built) {
                continue;
            }
            waiting = work->piece_count;
            ++begun;
        }
        if (waiting > 0 && on_device < depth) {
            if (auto submitted = view.submitPiece(); !submitted) {
                return submitted;
            }
            --waiting;
            ++on_device;
            continue;
        }
        const auto collected = view.collect();
        if (!collected) {
            return collected.error();
        }
        --on_device;
        done += collected->outcome == Collected::Outcome::kFrame ? 1U : 0U;
        if (collected->outcome == Collected::Outcome::kAgain) {
            waiting = 0;
            --begun;
        }
    }
    return {};
}

} // namespace

Result<Seconds> measureFrameCost(FrameSource& source, const settings::ViewSettings& settings) {
    auto view = source.makeView();
    if (!view) {
        return view.error();
    }
    const uint32_t frames = kRounds * source.depth();
    TimePoint begin{};
    auto drawn = draw(**view, settings, 1, 1);
    if (drawn) {
        begin = Clock::now();
        drawn = draw(**view, settings, frames, source.depth());
    }
    if (!drawn) {
        if (drawn.error().code == ErrorCode::kDevice) {
            keepForGood(std::move(*view));
        }
        return drawn.error();
    }
    return Seconds(Clock::now() - begin) / frames;
}

} // namespace froxel::stream
