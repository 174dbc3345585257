#include "load/script.h"

#include "load/orbit_script.h"
#include "load/path_script.h"
#include "load/scene_script.h"
#include "load/storm_script.h"

#include <cstddef>
#include <functional>
#include <random>
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

// A pause after each pass.
class ThinkingScript final : public Script {
  public:
    using Make = std::function<std::unique_ptr<Script>()>;
    // `pass`: how long one takes; none: until the script is over, which is then made anew.
    ThinkingScript(Make make, std::optional<Seconds> pass, const ThinkTime& think, uint32_t viewer)
        : make_(std::move(make)), pass_(pass), think_(think), random_(viewer), script_(make_()) {}

    [[nodiscard]] std::optional<Step> next() override {
        auto step = script_->next();
        if (!step && !pass_) {
            pause_ = last_ + pause();
            script_ = make_();
            step = script_->next();
        }
        if (!step) {
            return step;
        }
        if (pass_) {
            const auto passes = static_cast<uint64_t>(Seconds(step->at) / *pass_);
            for (; passes_ < passes; ++passes_) {
                pause_ += pause();
            }
        }
        step->at += pause_;
        last_ = step->at;
        return step;
    }

  private:
    // Not by a distribution of the standard library, whose values are each library's own.
    [[nodiscard]] Clock::duration pause() {
        const double share = static_cast<double>(random_()) / static_cast<double>(random_.max());
        return std::chrono::duration_cast<Clock::duration>(think_.least +
                                                           (think_.most - think_.least) * share);
    }

    const Make make_;
    const std::optional<Seconds> pass_;
    const ThinkTime think_;
    std::mt19937 random_;
    std::unique_ptr<Script> script_;
    Clock::duration pause_{}; // that is added to the script's own times
    Clock::duration last_{};
    uint64_t passes_ = 0; // done
};

struct PassLength {
    std::optional<Seconds> operator()(Idle /*choice*/) const { return std::nullopt; }
    std::optional<Seconds> operator()(Orbit /*choice*/) const { return kOrbitPeriod; }
    std::optional<Seconds> operator()(Storm /*choice*/) const { return kStormPass; }
    std::optional<Seconds> operator()(const Scenes& /*choice*/) const { return kSceneStay; }
    std::optional<Seconds> operator()(const Path& path) const {
        return path->seconds() > 0 ? std::optional(Seconds(path->seconds())) : std::nullopt;
    }
    std::optional<Seconds> operator()(const Recording& /*choice*/) const { return std::nullopt; }
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
    std::unique_ptr<Script> operator()(const Path& path) const {
        return std::make_unique<PathScript>(path, viewer);
    }
    std::unique_ptr<Script> operator()(const Recording& steps) const {
        return std::make_unique<RecordedScript>(steps);
    }
};

} // namespace

std::unique_ptr<Script> makeScript(const ScriptChoice& choice,
                                   const v1::Welcome& welcome,
                                   uint32_t viewer,
                                   const std::optional<ThinkTime>& think) {
    const auto make = [choice, welcome, viewer] {
        return std::visit(Maker{welcome, viewer}, choice);
    };
    if (!think) {
        return make();
    }
    return std::make_unique<ThinkingScript>(make, std::visit(PassLength(), choice), *think, viewer);
}

bool isRestless(const ScriptChoice& choice, const std::optional<ThinkTime>& think) {
    const auto* path = std::get_if<Path>(&choice);
    return !think &&
           (std::holds_alternative<Orbit>(choice) || std::holds_alternative<Storm>(choice) ||
            (path != nullptr && (*path)->seconds() > 0));
}

} // namespace froxel::load
