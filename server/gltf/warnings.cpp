#include "gltf/warnings.h"

#include "gltf/limits.h"

#include <algorithm>
#include <utility>

namespace froxel::gltf {

void Warnings::add(const WarningKind& kind, std::string pointer, std::string message) {
    if (known_.contains({pointer, message})) {
        return;
    }
    size_t& count = kept_of_kind_[{kind.code, kind.severity}];
    if (count == kind.most) {
        ++left_out_count_;
        return;
    }
    ++count;
    known_.emplace(pointer, message);
    kept_.push_back({kind.code, kind.severity, std::move(pointer), std::move(message)});
}

void tellTooMany(const std::string& things, size_t left_out, Warnings& warnings) {
    if (left_out > 0) {
        warnings.add(warning::kTooMany, "",
                     "the file has " + std::to_string(kMaxChoices + left_out) + " " + things +
                         "; the first " + std::to_string(kMaxChoices) + " are read");
    }
}

void Warnings::moveInto(scene::Scene& scene) {
    kept_.insert(kept_.begin(), scene.warnings.begin(), scene.warnings.end());
    std::stable_sort(kept_.begin(), kept_.end(), [](const auto& left, const auto& right) {
        return left.severity < right.severity;
    });
    scene.warnings = std::move(kept_);
    scene.warnings_left_out += left_out_count_;
}

} // namespace froxel::gltf
