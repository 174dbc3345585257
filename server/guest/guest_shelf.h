// Guest scenes by id, as long as somebody holds them there. Any thread.
#pragma once

#include "guest/guest_scene.h"

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace froxel::guest {

class GuestShelf : public std::enable_shared_from_this<GuestShelf> {
  public:
    // Of one scene. Its last holder takes the scene off.
    class Hold {
      public:
        Hold(std::shared_ptr<GuestShelf> shelf, std::string id)
            : shelf_(std::move(shelf)), id_(std::move(id)) {}
        ~Hold() { shelf_->takeOff(id_); }
        Hold(const Hold&) = delete;
        Hold& operator=(const Hold&) = delete;

        // Unguessable, 128 bits: who knows it may see the scene.
        [[nodiscard]] const std::string& id() const { return id_; }

      private:
        const std::shared_ptr<GuestShelf> shelf_;
        const std::string id_;
    };
    using SharedHold = std::shared_ptr<const Hold>;

    // Called without a lock, when a scene was taken off. Set before the first one is put.
    void onTakenOff(std::function<void()> tell) { tell_ = std::move(tell); }

    [[nodiscard]] SharedHold put(GuestScene scene);
    // Null: there is none of this id.
    [[nodiscard]] std::shared_ptr<const GuestScene> find(const std::string& id) const;

  private:
    void takeOff(const std::string& id);

    std::function<void()> tell_ = [] {};
    mutable std::mutex mutex_;
    std::map<std::string, std::shared_ptr<const GuestScene>> scenes_;
};

} // namespace froxel::guest
