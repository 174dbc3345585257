#include "app/load_arguments.h"

#include "protocol/limits.h"
#include "session/room.h"

#include <limits>

namespace froxel::app {
namespace {

constexpr settings::Range<uint32_t> kViewersRange{"viewers", 1, 10'000};
constexpr settings::Range<double> kSecondsRange{"seconds", 0.1, 86'400.0};
constexpr settings::Range<double> kRampRange{"ramp", 0.0, 3'600.0};
constexpr settings::Range<double> kLatencyRange{"max_latency_ms", 0.001, 1e6};
constexpr settings::Range<double> kRateRange{"min_fps", 0.001, 1e6};

constexpr const char* kFooter =
    "Latency is from sending a command to having the last byte of the first frame that shows it, "
    "by the frame's echo of that command, one sample for each frame that shows a new one; "
    "decoding is not in it. Reaction is the same of every command, also of those that a newer one "
    "overtook; one that no frame has shown at the end counts with its wait so far. Age is latency "
    "without the wait on the server before drawing began; of frames that show no new command, as a "
    "room's watchers get, it is told by the lights' clock and may be a lower bound. A stall is how "
    "long a frame had been due for more than 5 % of the measured time: always while lights move or "
    "the script is orbit or storm, else while a command waits. "
    "Measuring begins when every viewer has its first frame. Frames are acknowledged as the page "
    "does, at the next refresh of a 60 Hz display. A FILE.jsonl has a ClientMessage in the "
    "protocol's JSON on each line and, optionally, \"at_ms\" since the start.";

Result<std::string> parseScript(const std::string& text) {
    const std::filesystem::path path(text);
    if (text == "orbit" || text == "idle" || text == "storm" || text == "scenes" ||
        path.extension() == ".jsonl") {
        return text;
    }
    return Error{ErrorCode::kInvalidArgument,
                 fmt::format("'{}' is not orbit, idle, storm, scenes or a .jsonl file", text)};
}

Result<std::string> parseRoom(const std::string& text) {
    if (session::isRoomName(text)) {
        return text;
    }
    return Error{ErrorCode::kInvalidArgument,
                 fmt::format("'{}' is no room's name: 1 to {} of A-Z a-z 0-9 . _ -", text,
                             protocol::kMaxRoomNameBytes)};
}

} // namespace

void addLoadArguments(CommandBuilder& command, LoadOptions& options) {
    const auto target = [&options](const std::string& text) {
        options.url = text;
        return load::parseTarget(text);
    };
    command
        .value("URL", "ws[s]://HOST:PORT/ws", options.target, target, "",
               "The server, or the http[s]:// URL that serve prints")
        ->required();
    command.number("--viewers", options.viewer_count, kViewersRange, "Viewers at once");
    command.number("--seconds", options.seconds, kSecondsRange, "How long to measure");
    command.value("--script", "NAME|FILE", options.script, parseScript, options.script,
                  "orbit: the camera circles, 60 commands a second; idle: nothing; storm: every "
                  "setting over its whole range, 200 a second; scenes: another scene of the "
                  "server's every 2 seconds; or a FILE.jsonl");
    command.number("--ramp", options.ramp_s, kRampRange, "Seconds over which viewers join");
    command.value("--room", "NAME", options.room, parseRoom, "a session each",
                  "Room that all viewers share; the first one there controls, the others watch "
                  "and send nothing of the script");
    command.text("--token-file", "FILE", options.token_file, "",
                 "Tokens of a server that asks for one, a line each; viewers show them in turn");
    command.text("--tls-authorities", "FILE", options.tls_authorities, "the system's",
                 "Certificates to trust with wss://, in PEM");
    command.value("--size", "WxH", options.size, parseSize, "the server's", "Picture in pixels");
    command.number("--lights", options.light_count, settings::kLightCountRange, "the server's",
                   "Seeded lights");
    command.name("--codec", options.codec, settings::kChosenCodecNames, "How pictures are encoded");
    command.number("--video-kbps", options.video_kbps, settings::kVideoKbpsRange, "the server's",
                   "Of a video codec: 1000 bits a second");
    command.number(
        "--max-latency-ms", options.max_latency_ms, kLatencyRange, "",
        "Exit 1 where a viewer's 95th percentile of latency or reaction, or its stall, is "
        "above");
    command.number("--min-fps", options.min_fps, kRateRange, "",
                   "Exit 1 where a viewer has fewer frames a second");
    command.text("--json", "FILE|-", options.json, "",
                 "Every figure; -: to standard output, and the table to stderr");
    command.cli().footer(kFooter);
}

} // namespace froxel::app
