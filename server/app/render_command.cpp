#include "app/render_command.h"

#include "app/drawing.h"
#include "app/output_file.h"
#include "app/timings_report.h"
#include "encode/image_file.h"
#include "session/compared_report.h"
#include "session/comparison.h"
#include "session/session_state.h"
#include "stream/compared_picture.h"

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>
#include <spdlog/fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <array>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

namespace froxel::app {

namespace {

void writePicture(const RenderOptions& options, const Still& still) {
    if (!outputsOf(options).none()) {
        encode::writeRadiance(options.out, still.linear).value();
    } else {
        encode::writeImage(options.out, still.pixels(), options.encoding).value();
    }
}

// FOLDER/00001.png and so on.
void writeFrame(const RenderOptions& options, const Still& still, uint32_t index) {
    const auto file = options.out / fmt::format("{:05}.png", index + 1);
    encode::writeImage(file, still.pixels(), options.encoding).value();
}

// What the colours of a debug view say.
std::string legendLine(const DebugLegend& legend) {
    std::string line = fmt::format("{}: {}", legend.view, legend.words);
    if (!legend.colors.empty()) {
        line += fmt::format("; from {} to {} {} by #{:06x}", legend.min, legend.max, legend.unit,
                            fmt::join(legend.colors, ", #"));
    }
    return line;
}

// "12.3 ms" of a time of timingsReport().
std::string medianText(const nlohmann::ordered_json& time) {
    return time.is_null() ? "unknown"
                          : fmt::format("{:.1f} ms", time["median"].get<double>() / 1000);
}

void printTimes(const TimedRun& run, const nlohmann::ordered_json& timings) {
    const auto& frame = timings["frame"];
    fmt::print("{} of {}x{}: median {}; GPU {}, host {}\n",
               run.frames.size() == 1 ? "1 frame" : fmt::format("{} frames", run.frames.size()),
               run.settings.size.width_px, run.settings.size.height_px,
               medianText(frame["frame_us"]), medianText(frame["gpu_us"]),
               medianText(frame["host_us"]));
}

void tellFiles(const RenderOptions& options) {
    for (const auto* file : {&options.out, &options.timings}) {
        if (!file->empty()) {
            fmt::print("wrote {}\n", file->string());
        }
    }
}

void drawOne(const RenderOptions& options, Drawing& drawing) {
    TimedRun run = drawing.start();
    const auto last = drawing.draw(options, run, [&options](const Still& still, uint32_t index) {
        if (options.writesFolder()) {
            writeFrame(options, still, index);
        }
    });
    if (!options.out.empty() && !options.writesFolder()) {
        writePicture(options, last);
    }
    const auto timings = timingsReport(run);
    if (!options.timings.empty()) {
        writeText(options.timings, timings.dump(2) + "\n");
    }
    printTimes(run, timings);
    if (last.frame.stats.details->legend) {
        fmt::print("{}\n", legendLine(*last.frame.stats.details->legend));
    }
}

// Draws both sides of the same frames, one after the other.
int drawBoth(const RenderOptions& options, Drawing& drawing) {
    std::array<PixelLease, 2> sides;
    std::array<settings::Encoding, 2> encodings;
    nlohmann::ordered_json report = {{"schema", "froxel.compare.v1"}};
    std::optional<session::SessionState> left;
    for (size_t i = 0; i < sides.size(); ++i) {
        TimedRun run = drawing.start();
        const auto state = changed(options, run, options.compare[i]);
        run.settings = state.settings;
        encodings[i] = state.encoding;
        Still still = drawing.draw(options, run);
        const PixelView pixels = still.pixels();
        sides[i] = owningLease(pixels, std::move(still));
        const char* name = i == 0 ? "left" : "right";
        report[name] = timingsReport(run);
        fmt::print("{}: {}: ", name,
                   options.compare[i].empty() ? "as set" : session::textOf(options.compare[i]));
        printTimes(run, report[name]);
        if (i == 0) {
            left = state;
        }
    }
    left->comparison = session::Comparison{options.compare[1]};
    session::ComparedRecord record;
    record.promised = options.compare[0].empty() && session::promisesEqualBits(*left);
    stream::ComparedSides both{.left = std::move(sides[0]),
                               .divided = true,
                               .split = options.compare_split,
                               .left_encoding = encodings[0],
                               .right_encoding = encodings[1],
                               .flip_wanted = true};
    const PixelLease picture = stream::compose(both, std::move(sides[1]), record);
    const PixelView& pixels = picture.view();
    const uint64_t pixel_count = uint64_t{pixels.width_px} * pixels.height_px;
    fmt::print("{}\n", session::wordsOf(record, pixel_count));
    if (!options.out.empty()) {
        encode::writeImage(options.out, pixels, options.encoding).value();
    }
    if (!options.timings.empty()) {
        report["compared"] = session::comparedReport(record, pixel_count);
        writeText(options.timings, report.dump(2) + "\n");
    }
    return record.flip.value_or(0) > options.max_flip.value_or(1) ? 1 : 0;
}

} // namespace

int runRender(const RenderOptions& options) try {
    if (options.writesFolder()) {
        std::error_code failure; // writing says what is wrong
        std::filesystem::create_directories(options.out, failure);
    }
    for (const auto* file : {&options.out, &options.timings}) {
        if (!file->empty()) {
            requireFolderOf(*file);
        }
    }
    Drawing drawing(options);
    int exit_code = 0;
    if (options.compare.empty()) {
        drawOne(options, drawing);
    } else {
        exit_code = drawBoth(options, drawing);
    }
    tellFiles(options);
    return exit_code;
} catch (const vk::SystemError& error) {
    throw StartupError({ErrorCode::kDevice, fmt::format("Vulkan: {}", error.what())});
}

} // namespace froxel::app
