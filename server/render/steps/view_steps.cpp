#include "render/steps/view_steps.h"

#include "render/steps/order.h"

#include <algorithm>

namespace froxel::render {

Step& ViewSteps::findOrMake(const StepRow& row) {
    auto& step = made_[&row];
    if (!step) {
        step = row.make(scene_);
    }
    return *step;
}

void ViewSteps::look(const StepInputs& inputs, FrameFacts& facts) {
    for (const StepRow* row : kOrder) {
        if (row->looks != nullptr && row->looks(inputs.settings)) {
            findOrMake(*row).look(inputs, facts);
        }
    }
}

Result<void> ViewSteps::begin(FramePlan& plan, const StepInputs& inputs) {
    of_frame_.clear();
    for (PlannedStep& planned : plan.steps) {
        Step& step = findOrMake(*planned.row);
        if (auto begun = step.begin(inputs, plan, planned.plan); !begun) {
            return begun;
        }
        planned.reused |= step.holds();
        of_frame_.push_back({&step, planned.reused, planned.plan});
    }
    return {};
}

void ViewSteps::freeUnfit(const ViewTargets* view) {
    for (const auto& [row, step] : made_) {
        const auto in_frame = std::ranges::find(of_frame_, step.get(), &ActiveStep::step);
        in_frame != of_frame_.end() ? step->freeUnfit(view) : step->freeTargets();
    }
}

void ViewSteps::freeTargets() {
    for (const auto& [row, step] : made_) {
        step->freeTargets();
    }
}

} // namespace froxel::render
