// What steps draw into besides their view's targets.
#pragma once

#include "gpu/memory.h"

#include <functional>
#include <map>
#include <memory>
#include <typeindex>
#include <utility>

namespace froxel::render {

// One step's, of one view. Frames in flight keep theirs alive.
class StepTargets {
  public:
    using Visit = std::function<void(const gpu::Image& image, vk::ImageAspectFlags aspect)>;

    StepTargets() = default;
    virtual ~StepTargets() = default;
    StepTargets(const StepTargets&) = delete;
    StepTargets& operator=(const StepTargets&) = delete;

    // All images end in the GENERAL layout, where they stay.
    virtual void forEachImage(const Visit& /*visit*/) const {}

    // Nobody knows how much of the frame that drew into them was drawn: nothing of it is kept.
    virtual void forgetDrawn() {}

    // They are fresh: the frame that is recorded finds nothing in them.
    virtual void begin() {}

    bool fresh = true; // the images still await their first transition
};

// Those that the frame last recorded into a slot draws into, by their type.
class HeldTargets {
  public:
    template <class T>
    void hold(std::shared_ptr<T> targets) {
        held_[typeid(T)] = std::move(targets);
    }
    template <class T>
    [[nodiscard]] const T& get() const {
        return static_cast<const T&>(*held_.at(typeid(T)));
    }
    // Null: that frame has none.
    template <class T>
    [[nodiscard]] const T* find() const {
        const auto at = held_.find(typeid(T));
        return at != held_.end() ? static_cast<const T*>(at->second.get()) : nullptr;
    }
    void clear() { held_.clear(); }

    template <class Visit>
    void forEach(Visit visit) const {
        for (const auto& [type, targets] : held_) {
            visit(*targets);
        }
    }

  private:
    std::map<std::type_index, std::shared_ptr<StepTargets>> held_;
};

} // namespace froxel::render
