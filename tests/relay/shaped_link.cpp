#include "relay/shaped_link.h"

#include "core/assert.h"

#include <algorithm>
#include <utility>

namespace froxel::test {
namespace {

// Bytes that leave the queue together.
constexpr size_t kPieceBytes = static_cast<size_t>(TokenBucket::kMinBurstBytes);

} // namespace

ShapedLink::ShapedLink(const LinkOptions& options, TimePoint now)
    : options_(options), bucket_(options.bytes_per_s, now) {}

size_t ShapedLink::room() const {
    return options_.queue_bytes - std::min(options_.queue_bytes, queue_.size());
}

void ShapedLink::push(std::span<const uint8_t> bytes, TimePoint now) {
    FROXEL_ASSERT(bytes.size() <= room(), "more than the link's queue takes");
    launch(now);
    queue_.insert(queue_.end(), bytes.begin(), bytes.end());
    launch(now);
}

void ShapedLink::launch(TimePoint now) {
    while (!queue_.empty() && under_way_bytes_ < kMaxUnderWayBytes) {
        const size_t piece = std::min(kPieceBytes, queue_.size());
        if (!bucket_.take(piece, now)) {
            return;
        }
        const auto end = queue_.begin() + static_cast<std::ptrdiff_t>(piece);
        under_way_.push_back({now + options_.delay, {queue_.begin(), end}});
        queue_.erase(queue_.begin(), end);
        under_way_bytes_ += piece;
    }
}

std::vector<uint8_t> ShapedLink::take(TimePoint now) {
    launch(now);
    std::vector<uint8_t> arrived;
    while (!under_way_.empty() && under_way_.front().due <= now) {
        const Flight& flight = under_way_.front();
        arrived.insert(arrived.end(), flight.bytes.begin(), flight.bytes.end());
        under_way_bytes_ -= flight.bytes.size();
        under_way_.pop_front();
    }
    return arrived;
}

std::optional<TimePoint> ShapedLink::nextDue(TimePoint now) {
    launch(now);
    std::optional<TimePoint> due;
    if (!under_way_.empty()) {
        due = under_way_.front().due;
    }
    if (!queue_.empty() && under_way_bytes_ < kMaxUnderWayBytes) {
        // Pieces are launched when this asks, so it must ask again when the next may go.
        const TimePoint next = bucket_.whenReady(std::min(kPieceBytes, queue_.size()), now);
        due = due ? std::min(*due, next) : next;
    }
    return due;
}

void ShapedLink::setRate(double bytes_per_s, TimePoint now) {
    launch(now);
    bucket_.setRate(bytes_per_s, now);
}

} // namespace froxel::test
