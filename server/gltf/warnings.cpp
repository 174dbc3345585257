#include "gltf/warnings.h"

#include <algorithm>
#include <utility>

namespace froxel::gltf {

void Warnings::add(const WarningKind& kind, std::string pointer, std::string message) {
    scene::Warning warning{kind.code, kind.severity, std::move(pointer), std::move(message)};
    if (std::find(kept_.begin(), kept_.end(), warning) != kept_.end()) {
        return;
    }
    size_t& count = kept_of_kind_[{kind.code, kind.severity}];
    if (count == kind.most) {
        ++left_out_count_;
        return;
    }
    ++count;
    kept_.push_back(std::move(warning));
}

void Warnings::moveInto(scene::Scene& scene) {
    std::stable_sort(kept_.begin(), kept_.end(), [](const auto& left, const auto& right) {
        return left.severity < right.severity;
    });
    scene.warnings = std::move(kept_);
    scene.warnings_left_out = left_out_count_;
}

} // namespace froxel::gltf
