#include "load/script.h"

#include "load/orbit_script.h"
#include "load/scene_script.h"
#include "load/storm_script.h"

#include <cstddef>
#include <utility>

namespace froxel::load {
namespace {

class IdleScript final : public Script {
  public:
    [[nodiscard]] std::optional<Step> next() override { return std::nullopt; }
};

class RecordedScript final : public Script {
  public:
    explicit RecordedScript(Recording steps) : steps_(std::move(steps)) {}
    [[nodiscard]] std::optional<Step> next() override {
        return next_ < steps_->size() ? std::optional((*steps_)[next_++]) : std::nullopt;
    }

  private:
    const Recording steps_;
    size_t next_ = 0;
};

struct Maker {
    const v1::Welcome& welcome;
    uint32_t viewer;

    std::unique_ptr<Script> operator()(Idle /*choice*/) const {
        return std::make_unique<IdleScript>();
    }
    std::unique_ptr<Script> operator()(Orbit /*choice*/) const {
        return std::make_unique<OrbitScript>(welcome.state(), viewer);
    }
    std::unique_ptr<Script> operator()(Storm /*choice*/) const {
        return std::make_unique<StormScript>(welcome, viewer);
    }
    std::unique_ptr<Script> operator()(const Scenes& scenes) const {
        return std::make_unique<SceneScript>(scenes.ids, welcome.scene().id(), viewer);
    }
    std::unique_ptr<Script> operator()(const Recording& steps) const {
        return std::make_unique<RecordedScript>(steps);
    }
};

} // namespace

std::unique_ptr<Script>
makeScript(const ScriptChoice& choice, const v1::Welcome& welcome, uint32_t viewer) {
    return std::visit(Maker{welcome, viewer}, choice);
}

} // namespace froxel::load
