#include "app/load_early_stop.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace froxel::app {
namespace {

// What was only waiting is not measured yet.
void remove(load::Samples& from, const load::Samples& waiting) {
    for (const load::SampleSeries& series : load::kSampleSeries) {
        auto& samples = from.*series.samples;
        samples.resize(samples.size() - (waiting.*series.samples).size());
    }
}

} // namespace

LoadEarlyStop::LoadEarlyStop(std::vector<load::Requirement> requirements, Seconds patience)
    : requirements_(std::move(requirements)), patience_(patience),
      broken_for_(requirements_.size(), Seconds(0)) {}

bool LoadEarlyStop::goesOn(const load::RunSecond& second) {
    so_far_.viewers.resize(second.changes.size());
    for (size_t index = 0; index < second.changes.size(); ++index) {
        const load::ViewerChange& change = second.changes[index];
        load::ViewerResult& viewer = so_far_.viewers[index];
        viewer.measured.add(change.measured);
        viewer.measured.seconds += change.measured.seconds;
        viewer.measured.samples.add(change.waiting);
        viewer.received_bytes += change.received_bytes;
        viewer.failure = change.failure;
        viewer.refused = change.refused;
        viewer.tried = change.tried;
        viewer.first_frame_ms = change.first_frame_ms;
    }
    const auto outcomes = load::check(requirements_, so_far_);
    for (size_t index = 0; index < second.changes.size(); ++index) {
        remove(so_far_.viewers[index].measured.samples, second.changes[index].waiting);
    }
    bool goes_on = true;
    for (size_t index = 0; index < outcomes.size(); ++index) {
        const bool broken = outcomes[index].measured && !outcomes[index].held;
        broken_for_[index] = broken ? broken_for_[index] + second.length : Seconds(0);
        goes_on = goes_on && broken_for_[index] < patience_;
    }
    return goes_on;
}

} // namespace froxel::app
