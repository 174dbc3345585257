// The scene that a session shows and the one that it waits for.
#pragma once

#include "session/command.h"
#include "session/scene_port.h"

#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace froxel::net {

// Its session's lock covers it.
class SceneWish {
  public:
    // A scene that is not there yet.
    struct Awaited {
        std::string id;
        session::CommandStamp stamp; // of the command that selected it
        Progress progress;
    };

    [[nodiscard]] bool waits() const { return awaited_.has_value(); }
    [[nodiscard]] bool waitsFor(const std::string& id) const {
        return awaited_ && awaited_->id == id;
    }
    [[nodiscard]] const std::optional<Awaited>& awaited() const { return awaited_; }
    void await(std::string id, const session::CommandStamp& stamp) {
        awaited_ = Awaited{std::move(id), stamp, {"waiting for its turn", 0}};
    }
    void note(const Progress& progress) { awaited_->progress = progress; }
    // It has come, or never will: of the command that selected it.
    [[nodiscard]] session::CommandStamp take() {
        return std::exchange(awaited_, std::nullopt)->stamp;
    }
    // Whoever waits does not want it any more.
    void callOff(session::ScenePort* scenes, const std::weak_ptr<session::SceneWaiter>& waiter) {
        if (awaited_) {
            scenes->dismiss(awaited_->id, waiter);
            awaited_.reset();
        }
    }

    // Another scene is shown from now on, for a command; none: since a picture of it was refused.
    void show(std::optional<session::CommandStamp> stamp) {
        shown_for_ = stamp.value_or(shown_for_);
        ++count_;
    }
    // Of those shown so far.
    [[nodiscard]] uint64_t count() const { return count_; }
    [[nodiscard]] const session::CommandStamp& shownFor() const { return shown_for_; }

  private:
    std::optional<Awaited> awaited_;
    session::CommandStamp shown_for_;
    uint64_t count_ = 1;
};

} // namespace froxel::net
