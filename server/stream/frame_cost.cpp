#include "stream/frame_cost.h"

namespace froxel::stream {
namespace {

// Of what is measured, in frames that a device takes at once.
constexpr uint32_t kRounds = 2;

Result<void>
draw(ViewSource& view, const view::ViewSettings& settings, uint32_t frames, uint32_t depth) {
    for (uint32_t submitted = 0, collected = 0; collected < frames;) {
        if (submitted < frames && submitted - collected < depth && view.canSubmit()) {
            if (auto begun = view.submit(settings, 0); !begun) {
                return begun;
            }
            ++submitted;
            continue;
        }
        if (auto frame = view.collect(); !frame) {
            return frame.error();
        }
        ++collected;
    }
    return {};
}

} // namespace

Result<Seconds> measureFrameCost(FrameSource& source, const view::ViewSettings& settings) {
    const auto view = source.makeView();
    if (!view) {
        return view.error();
    }
    if (auto first = draw(**view, settings, 1, 1); !first) {
        return first.error();
    }
    const uint32_t frames = kRounds * source.depth();
    const TimePoint begin = Clock::now();
    if (auto measured = draw(**view, settings, frames, source.depth()); !measured) {
        return measured.error();
    }
    return Seconds(Clock::now() - begin) / frames;
}

} // namespace froxel::stream
