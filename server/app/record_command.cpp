#include "app/record_command.h"

#include "app/drawing.h"
#include "app/output_file.h"
#include "core/clock.h"
#include "core/text.h"
#include "encode/vp9_encoder.h"
#include "webm/writer.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <system_error>
#include <thread>
#include <utility>

namespace froxel::app {
namespace {

constexpr double kKeySeconds = 2; // between frames that players seek to
constexpr uint32_t kTold = 10;    // times of progress

// Goes at the end, unless it was given its name.
class PartFile {
  public:
    explicit PartFile(std::filesystem::path wanted) : wanted_(std::move(wanted)), path_(wanted_) {
        path_ += ".part";
    }
    ~PartFile() {
        std::error_code gone;
        std::filesystem::remove(path_, gone);
    }
    PartFile(const PartFile&) = delete;
    PartFile& operator=(const PartFile&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    void keep() const {
        std::error_code failure;
        std::filesystem::rename(path_, wanted_, failure);
        if (failure) {
            throw StartupError({ErrorCode::kIo, fmt::format("{}: cannot be written: {}",
                                                            wanted_.string(), failure.message())});
        }
    }

  private:
    std::filesystem::path wanted_;
    std::filesystem::path path_;
};

void tellProgress(uint32_t done, uint32_t count) {
    if (done * uint64_t{kTold} / count != (done - 1) * uint64_t{kTold} / count && done < count) {
        fmt::print("recorded {} of {} frames\n", done, count);
        std::fflush(stdout);
    }
}

RenderOptions picturesOf(const RecordOptions& options) {
    RenderOptions pictures = options.pictures;
    pictures.frame_count =
        static_cast<uint32_t>(std::max(1.0, std::round(options.seconds * options.pictures.fps)));
    pictures.keep_surfaces = true;
    return pictures;
}

void record(const RecordOptions& options) {
    requireFolderOf(options.out);
    const RenderOptions pictures = picturesOf(options);
    Drawing drawing(pictures);
    TimedRun run = drawing.start();
    const uint32_t count = drawing.pictureCount(pictures);
    if (count > kMaxRecordedFrames) {
        throw StartupError(
            {ErrorCode::kInvalidArgument,
             fmt::format("a recording of {} frames at {} frames a second is too long; one "
                         "may have {}: lower --fps, or shorten the path",
                         count, pictures.fps, kMaxRecordedFrames)});
    }
    const auto [width, height] = run.settings.size;
    const PartFile part(options.out);
    auto file = webm::Writer::create(part.path(), {width, height, pictures.fps}).value();
    encode::Vp9Encoder encoder(std::thread::hardware_concurrency(), {options.crf});
    const auto key_each =
        static_cast<uint32_t>(std::max(1.0, std::round(kKeySeconds * pictures.fps)));
    uint64_t bytes = 0;
    (void)drawing.draw(pictures, run, [&](const Still& still, uint32_t index) {
        const TimePoint at{
            std::chrono::duration_cast<Clock::duration>(Seconds(index / pictures.fps))};
        const auto frame =
            encoder.encode(still.pixels(), pictures.encoding, index % key_each == 0, at).value();
        file.add(frame.bytes, frame.key).value();
        bytes += frame.bytes.size();
        run.frames.clear(); // nobody asks for their times
        tellProgress(index + 1, count);
    });
    file.finish().value();
    part.keep();
    fmt::print("wrote {}: {} frames of {}x{}, {:.1f} s, {:.1f} MB\n", options.out.string(), count,
               width, height, count / pictures.fps, static_cast<double>(bytes) / 1e6);
}

} // namespace

void runRecord(const RecordOptions& options) try {
    record(options);
} catch (const vk::SystemError& error) {
    throw StartupError({ErrorCode::kDevice, fmt::format("Vulkan: {}", error.what())});
}

} // namespace froxel::app
