#include "app/load_arguments.h"

#include "core/text.h"
#include "load/requirement.h"
#include "protocol/limits.h"
#include "session/room.h"

#include <limits>

namespace froxel::app {
namespace {

constexpr settings::Range<uint32_t> kViewersRange{"viewers", 1, 10'000};
constexpr settings::Range<uint32_t> kThreadsRange{"threads", 1, 1024};
constexpr settings::Range<double> kSecondsRange{"seconds", 0.1, 86'400.0};
constexpr settings::Range<uint32_t> kShareRange{"share", 1, 10'000};
constexpr settings::Range<double> kRampRange{"ramp", 0.0, 3'600.0};
constexpr settings::Range<double> kThinkRange{"think", 0.1, 3'600.0};
constexpr settings::Range<double> kStopEarlyRange{"stop_early", 1.0, 86'400.0};
constexpr settings::Range<uint32_t> kTrialsRange{"trials", 1, 100};

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
    "frame; with --stages each viewer measures from its own first frame on. Viewers acknowledge "
    "frames as the page does, at the next refresh of a 60 Hz display. "
    "A FILE.jsonl has a ClientMessage in the protocol's JSON on each line and, optionally, "
    "\"at_ms\" since the start. A FILE.json is a camera path, which viewers follow from different "
    "points of it on, 60 commands a second.";

// "orbit", "idle:3", "drag.jsonl:2", "path.json".
Result<std::string> parseScript(const std::string& text) {
    const ScriptName script = scriptNameOf(text);
    if (script.name == "orbit" || script.name == "idle" || script.name == "storm" ||
        script.name == "scenes" || isPathFile(script.name) ||
        std::filesystem::path(script.name).extension() == ".jsonl") {
        return text;
    }
    return Error{
        ErrorCode::kInvalidArgument,
        fmt::format("'{}' is not orbit, idle, storm, scenes, a .json or a .jsonl file, with "
                    "or without :SHARE behind it",
                    printable(text, 200))};
}

// "2" or "1-5".
Result<load::ThinkTime> parseThink(const std::string& text) {
    const size_t dash = text.find('-');
    const auto least = parseNumber(text.substr(0, dash), kThinkRange);
    const auto most =
        dash == std::string::npos ? least : parseNumber(text.substr(dash + 1), kThinkRange);
    if (!least || !most) {
        return least ? most.error() : least.error();
    }
    if (*most < *least) {
        return Error{ErrorCode::kInvalidArgument,
                     fmt::format("'{}' goes from more to less; expected such as 1-5", text)};
    }
    return load::ThinkTime{Seconds(*least), Seconds(*most)};
}

std::string requirementFault(const std::string& text) {
    const auto parsed = load::parseRequirements(text);
    return parsed ? std::string() : parsed.error().message;
}

std::string seriesFault(const std::string& text) {
    const std::string extension = std::filesystem::path(text).extension().string();
    const bool known = extension == ".jsonl" || extension == ".csv" || extension == ".prom";
    return known ? std::string()
                 : fmt::format("'{}' does not end in .jsonl, .csv or .prom", printable(text, 200));
}

Result<std::string> parseRoom(const std::string& text) {
    if (session::isRoomName(text)) {
        return text;
    }
    return Error{ErrorCode::kInvalidArgument,
                 fmt::format("'{}' is not a room name; use 1 to {} characters of A-Z a-z 0-9 . _ -",
                             text, protocol::kMaxRoomNameBytes)};
}

void addViewers(CommandBuilder& command, LoadOptions& options) {
    auto* const viewers = command.number("--viewers", options.viewer_count, kViewersRange, "1",
                                         "Viewers at once; with --find the most that are tried");
    command.number("--threads", options.thread_count, kThreadsRange,
                   "one for 32 viewers, at most one a core",
                   "Threads that play the viewers: as many cores at most are taken from a server "
                   "on the same host");
    auto* const seconds = command.number("--seconds", options.seconds, kSecondsRange,
                                         "Duration of the measurement; with --find of each trial");
    command
        .text("--script", "NAME[:SHARE]", options.scripts, "orbit",
              "Behaviour of the viewers. orbit: the camera circles, 60 commands a second; "
              "idle: nothing; storm: random values of every setting, 200 commands a second; "
              "scenes: another scene of the server every 2 seconds. Or a file: "
              "FILE.jsonl with commands, FILE.json with a camera path. Repeat it for a mix: "
              "--script orbit:3 --script idle:1 gives three of four viewers the orbit")
        ->allow_extra_args(false)
        ->check([](const std::string& text) {
            const auto script = parseScript(text);
            return script ? std::string() : script.error().message;
        });
    command.value("--think", "SECONDS[-SECONDS]", options.think, parseThink, "none",
                  "Pause after each pass of a script (a circle, a scene, ten seconds of storm, a "
                  "file), at random between the two; a file is then repeated");
    auto* const ramp =
        command.number("--ramp", options.ramp_s, kRampRange, "Seconds over which viewers join");
    command
        .value("--stages", "LENGTH:VIEWERS,...", options.stages, load::parseStages, "",
               "Number of viewers over time, as k6 has it: it goes linearly to VIEWERS during each "
               "LENGTH, from 0. 1m:10,2m:10,0s:50,2m:50 has 10 viewers for two minutes, then 50")
        ->excludes(viewers)
        ->excludes(seconds)
        ->excludes(ramp);
}

void addRequirements(CommandBuilder& command, LoadOptions& options) {
    auto* const require =
        command
            .text("--require", "FIGURE<NUMBER,...", options.requirements, "",
                  "Requirements, such as 'latency.p99<80, fps>=30, refused<=5%'; repeatable. "
                  "Exit with 99 if one is broken. docs/guide/measuring.md lists the figures")
            ->allow_extra_args(false)
            ->check(requirementFault);
    command
        .number("--stop-early", options.stop_early_s, kStopEarlyRange, "never",
                "Seconds for which a requirement must have been broken to end the run early")
        ->needs(require);
    command
        .text("--find", "FIGURE<NUMBER,...", options.find_requirements, "",
              "Find the capacity: with how many viewers these requirements hold at the most, and "
              "nobody is refused")
        ->allow_extra_args(false)
        ->check(requirementFault)
        ->excludes(require)
        ->excludes("--stages");
    command
        .number("--trials", options.trial_count, kTrialsRange,
                "With --find: trials of each of the two numbers beside the limit")
        ->needs("--find");
}

// What each viewer asks for.
void addRequests(CommandBuilder& command, LoadOptions& options) {
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
    command.cli().add_flag("--depth", options.depth,
                           "Ask for depth with pictures, as pages do that show camera movements at "
                           "once, and check it");
    command.number("--video-kbps", options.video_kbps, settings::kVideoKbpsRange, "the server's",
                   "Bit rate of a video codec");
}

void addOutputs(CommandBuilder& command, LoadOptions& options) {
    command.text("--json", "FILE|-", options.json, "",
                 "File for all figures, as JSON; -: standard output, with the table on stderr");
    command
        .text("--series", "FILE", options.series, "",
              "File for the figures of each second: JSON lines (.jsonl), a table (.csv), or the "
              "newest second for node_exporter's textfile collector (.prom)")
        ->check(seriesFault)
        ->excludes("--find");
    command
        .text("--junit", "FILE", options.junit, "",
              "File for the requirements as test cases, in JUnit's XML")
        ->excludes("--find");
    command
        .text("--histograms", "FILE", options.histograms, "",
              "File for the histogram of each time, in HdrHistogram's log format, to add up the "
              "runs of several machines")
        ->excludes("--find");
    command
        .text("--report", "FILE", options.report, "",
              "HTML with the requirements and plots over time, in one file")
        ->excludes("--find");
    command.text("--web-root", "DIR", options.web_root, "web beside the binary, else the build's",
                 "Folder of the built page, for --report");
}

} // namespace

bool isPathFile(const std::string& name) {
    return std::filesystem::path(name).extension() == ".json";
}

ScriptName scriptNameOf(const std::string& text) {
    const size_t colon = text.rfind(':');
    if (colon != std::string::npos) {
        if (const auto share = parseNumber(text.substr(colon + 1), kShareRange)) {
            return {text.substr(0, colon), *share};
        }
    }
    return {text, 1};
}

void addLoadArguments(CommandBuilder& command, LoadOptions& options) {
    const auto target = [&options](const std::string& text) {
        options.url = text;
        return load::parseTarget(text);
    };
    command
        .value("URL", "ws[s]://HOST:PORT/ws", options.target, target, "",
               "The server, or the http[s]:// URL that serve prints")
        ->required();
    addViewers(command, options);
    addRequirements(command, options);
    addRequests(command, options);
    addOutputs(command, options);
    command.cli().footer(kFooter);
}

} // namespace froxel::app
