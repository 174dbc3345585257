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
    "Latency is the time from sending a command to receiving the last byte of the first frame that "
    "shows it, without decoding. The frame echoes the command. There is one sample for each frame "
    "that shows a new command. Reaction is the same for every command, including those that a "
    "newer one overtook. A command that no frame has shown at the end counts with its wait so "
    "far. Age is latency without the wait on the server before drawing began. Frames that show no "
    "new command, such as those of a room's watchers, get their age from the lights' clock, which "
    "gives a lower bound. A stall is the duration for which a due frame was missing for more than "
    "5 % of the measured time. A frame is always due while lights move or the script is orbit or "
    "storm, and otherwise while a command waits. Measuring begins when every viewer has its first "
    "frame. Viewers acknowledge frames as the page does, at the next refresh of a 60 Hz display. "
    "A FILE.jsonl has a ClientMessage in the protocol's JSON on each line and, optionally, "
    "\"at_ms\" since the start.";

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
                 fmt::format("'{}' is not a room name; use 1 to {} characters of A-Z a-z 0-9 . _ -",
                             text, protocol::kMaxRoomNameBytes)};
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
    command.number("--seconds", options.seconds, kSecondsRange, "Duration of the measurement");
    command.value("--script", "NAME|FILE", options.script, parseScript, options.script,
                  "Behaviour of the viewers. orbit: the camera circles, 60 commands a second; "
                  "idle: nothing; storm: random values of every setting, 200 commands a second; "
                  "scenes: another scene of the server every 2 seconds; or a FILE.jsonl");
    command.number("--ramp", options.ramp_s, kRampRange, "Seconds over which viewers join");
    command.value("--room", "NAME", options.room, parseRoom, "a session each",
                  "Room that all viewers share; the first viewer controls it and plays the script, "
                  "the others watch");
    command.text("--token-file", "FILE", options.token_file, "",
                 "File of tokens, one in each line, for a server that requires one; viewers use "
                 "them in turn");
    command.text("--tls-authorities", "FILE", options.tls_authorities, "the system's",
                 "Certificates to trust with wss://, in PEM");
    command.value("--size", "WxH", options.size, parseSize, "the server's", "Picture in pixels");
    command.number("--lights", options.light_count, settings::kLightCountRange, "the server's",
                   "Seeded lights");
    command.name("--codec", options.codec, settings::kChosenCodecNames, "Encoding of pictures");
    command.number("--video-kbps", options.video_kbps, settings::kVideoKbpsRange, "the server's",
                   "Bit rate of a video codec");
    command.number("--max-latency-ms", options.max_latency_ms, kLatencyRange, "",
                   "Exit with 1 if a viewer's 95th percentile of latency or reaction, or its "
                   "stall, is longer");
    command.number("--min-fps", options.min_fps, kRateRange, "",
                   "Exit with 1 if a viewer has fewer frames a second");
    command.text("--json", "FILE|-", options.json, "",
                 "File for all figures, as JSON; -: standard output, with the table on stderr");
    command.cli().footer(kFooter);
}

} // namespace froxel::app
