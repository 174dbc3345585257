#include "gltf/failure.h"

#include <algorithm>

namespace froxel::gltf {
namespace {

constexpr size_t kMaxLines = 100;

} // namespace

void Warnings::add(std::string line) {
    if (std::find(lines_.begin(), lines_.end(), line) != lines_.end()) {
        return;
    }
    if (lines_.size() == kMaxLines) {
        ++left_out_count_;
        return;
    }
    lines_.push_back(std::move(line));
}

std::vector<std::string> Warnings::take() {
    if (left_out_count_ > 0) {
        lines_.push_back(std::to_string(left_out_count_) + " more warnings are not shown");
    }
    left_out_count_ = 0;
    return std::exchange(lines_, {});
}

} // namespace froxel::gltf
