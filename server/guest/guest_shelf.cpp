#include "guest/guest_shelf.h"

#include "core/unguessable.h"

#include <utility>

namespace froxel::guest {

GuestShelf::SharedHold GuestShelf::put(GuestScene scene) {
    constexpr size_t kIdBytes = 16;
    auto kept = std::make_shared<const GuestScene>(std::move(scene));
    auto hold = std::make_shared<const Hold>(shared_from_this(), unguessable(kIdBytes));
    const std::lock_guard lock(mutex_);
    scenes_.emplace(hold->id(), std::move(kept));
    return hold;
}

std::shared_ptr<const GuestScene> GuestShelf::find(const std::string& id) const {
    const std::lock_guard lock(mutex_);
    const auto found = scenes_.find(id);
    return found == scenes_.end() ? nullptr : found->second;
}

void GuestShelf::takeOff(const std::string& id) {
    std::shared_ptr<const GuestScene> gone; // ends without the lock
    {
        const std::lock_guard lock(mutex_);
        const auto found = scenes_.find(id);
        if (found != scenes_.end()) {
            gone = std::move(found->second);
            scenes_.erase(found);
        }
    }
    gone.reset();
    tell_();
}

} // namespace froxel::guest
