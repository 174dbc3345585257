// What the render loop needs of a renderer, and no more: the real one is behind renderer_source.h,
// tests bring their own. Used by the render thread only; a PixelLease may end on any thread.
#pragma once

#include "core/clock.h"
#include "core/error.h"
#include "core/frame_stats.h"
#include "core/frame_work.h"
#include "core/outputs.h"
#include "core/pixel_view.h"
#include "motion/playback.h"
#include "settings/settings.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace froxel::scene {
struct Scene;
}

namespace froxel::stream {

// Where all that moves stands in a frame.
struct FrameTime {
    double lights_s = 0;                                   // the lights' clock
    std::optional<motion::Playing> playing = std::nullopt; // of a scene that moves
};

struct SourceFrame {
    PixelLease pixels; // in the form that was allowed
    FrameStats stats;
};

// What became of the oldest piece on the device.
struct Collected {
    enum class Outcome : uint8_t {
        kPiece, // done; more of its frame follow, or it was given up
        kFrame, // the last one: the picture is there
        kAgain, // the frame needs more than it was given; the view's next one will be given it
    };
    Outcome outcome = Outcome::kPiece;
    std::optional<SourceFrame> frame = std::nullopt; // with kFrame
};

// What encoding a frame's picture takes of it.
struct EncodingNeeds {
    uint64_t bytes = 0; // of the same memory
    Outputs outputs{};  // beside the pixels
    // What it becomes, so that a device may give it in the form that this takes
    // (CodecRow::device_form); none: its pixels are wanted.
    std::optional<settings::Encoding> becomes = std::nullopt;
};

// What else begin() is told.
struct FrameTerms {
    EncodingNeeds encoding = {};
    double limit_share = 1; // times the longest that a frame may take
};

// One viewer's targets. Frames complete in the order in which they begin.
//
// A frame runs as pieces, one after another, between which the device may run those of other
// views: a long frame holds it for no longer than one piece takes.
class ViewSource {
  public:
    virtual ~ViewSource() = default;
    // Whether begin() may be called: a readback slot is free, and no frame has pieces that wait.
    [[nodiscard]] virtual bool canBegin() const = 0;
    // Builds and records a frame as all stands at `time`; nothing runs yet. Errors: kCapacity when
    // this size does not fit, kTooLong when the frame would take too long, and kUnsupported when
    // the device cannot do what the settings ask for (earlier ones still work), kDevice when the
    // device is lost.
    [[nodiscard]] virtual Result<FrameWork> begin(const settings::ViewSettings& settings,
                                                  const FrameTime& time,
                                                  const FrameTerms& terms) = 0;
    // Gives the device the next piece of the frame begun last. Errors: kDevice.
    [[nodiscard]] virtual Result<void> submitPiece() = 0;
    // Gives up the pieces that wait of the frame begun last. Those on the device are still to be
    // collected; with none there, the frame is gone at once.
    virtual void abandon() = 0;
    // Waits for the oldest piece on the device. kAgain and kCapacity (what its lists hold does not
    // fit) end its frame as abandon() does. Errors: kCapacity, kDevice.
    [[nodiscard]] virtual Result<Collected> collect() = 0;
};

// A scene on a device. Views end before it.
class SceneSource {
  public:
    virtual ~SceneSource() = default;
    // Errors: kCapacity, kDevice.
    [[nodiscard]] virtual Result<std::unique_ptr<ViewSource>> makeView() = 0;
    // Of the device's memory; any thread.
    [[nodiscard]] virtual uint64_t bytes() const { return 0; }
    // Whether views may ask for a geometry error.
    [[nodiscard]] virtual bool hasDetailLevels() const { return false; }
};

// A scene on its way to a device that draws others meanwhile.
class SceneMove {
  public:
    virtual ~SceneMove() = default;
    // Gives the device the next slice of it, unless it is still at what it was given
    // before. Null: not all is there yet; else this is done. Errors: kDevice.
    [[nodiscard]] virtual Result<std::unique_ptr<SceneSource>> advance() = 0;
    // Of it that the device was given, 0 to 1.
    [[nodiscard]] virtual double fraction() const = 0;
};

// A device, with the scene that it began with.
class FrameSource : public SceneSource {
  public:
    // Pieces on the device at once that keep it busy: 1 where the host is the device.
    [[nodiscard]] virtual uint32_t depth() const = 0;
    // Whether its work is done by the host's cores, which encoders use too.
    [[nodiscard]] virtual bool isHost() const = 0;
    // How long frames of late took, times what was expected of the device when it was opened.
    [[nodiscard]] virtual double pace() const { return 1; }
    // What a scene will take of the device's memory, about. Any thread.
    [[nodiscard]] virtual uint64_t sceneBytes(const scene::Scene& /*scene*/) const { return 0; }
    // Does what needs no device's time. Any thread. Errors: kCapacity, kScene, kUnsupported.
    [[nodiscard]] virtual Result<std::unique_ptr<SceneMove>>
    moveScene(std::shared_ptr<const scene::Scene> /*scene*/) {
        return Error{ErrorCode::kUnsupported, "this device accepts no other scene"};
    }
    // From now on begin() does not wait for variants of shaders that are missing.
    virtual void makeVariantsInBackground() {}
};

} // namespace froxel::stream
