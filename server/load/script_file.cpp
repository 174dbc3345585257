#include "load/script_file.h"

#include "core/text.h"
#include "protocol/limits.h"
#include "session/command_decode.h"
#include "session/json_input.h"

#include <google/protobuf/util/json_util.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <fstream>
#include <utility>

namespace froxel::load {
namespace {

using Json = nlohmann::json;

// A year: what double and the clock's ticks hold exactly, and more than any run.
constexpr double kMaxAtMs = 365.0 * 24 * 3600 * 1000;

Error bad(const std::string& reason) {
    return {ErrorCode::kInvalidArgument, reason};
}

Result<Clock::duration> readTime(const Json& value, Clock::duration before) {
    const double at_ms = value.is_number() ? value.get<double>() : -1;
    if (!(at_ms >= 0 && at_ms <= kMaxAtMs)) {
        return bad("at_ms is " + printable(value.dump()) + "; it must be milliseconds from 0");
    }
    const auto at = std::chrono::duration_cast<Clock::duration>(Seconds(at_ms / 1000));
    if (at < before) {
        return bad("at_ms is " + numberText(at_ms) + ", less than a line's before");
    }
    return at;
}

// What a server would refuse, and fields that it would ignore.
Result<void> checkMessage(const Json& object, v1::ClientMessage& message) {
    const auto strict = google::protobuf::util::JsonStringToMessage(object.dump(), &message);
    if (!strict.ok()) {
        return bad(printable(strict.message().ToString(), 200));
    }
    if (message.has_hello() || message.has_ack()) {
        return bad(std::string(message.has_hello() ? "hello" : "ack") +
                   " is said by the viewer itself");
    }
    message.set_seq(1);
    const std::string bytes = message.SerializeAsString();
    const auto command =
        session::decodeCommand(protocol::bytesOf(bytes), protocol::WireFormat::kBinary);
    return command ? Result<void>() : bad(command.error().message);
}

Result<Step> readStep(const std::string& line, Clock::duration before) {
    if (line.size() > protocol::kMaxMessageBytes) {
        return bad(numberText(line.size()) + " bytes; a message has at most " +
                   numberText(protocol::kMaxMessageBytes));
    }
    // The session's own reader first: it tells repeated keys, depth and wrong types apart.
    v1::ClientMessage ignored;
    if (const auto read = session::parseJson(protocol::bytesOf(line), ignored); !read) {
        return bad(read.error().message);
    }
    Json object = Json::parse(line);
    Step step;
    step.at = before;
    if (const auto time = object.find("at_ms"); time != object.end()) {
        const auto at = readTime(*time, before);
        if (!at) {
            return at.error();
        }
        step.at = *at;
        object.erase(time);
    }
    if (const auto checked = checkMessage(object, step.message); !checked) {
        return checked.error();
    }
    return step;
}

} // namespace

Result<Recording> readScript(std::istream& lines, const std::string& file_name) {
    auto steps = std::make_shared<std::vector<Step>>();
    std::string line;
    for (size_t number = 1; std::getline(lines, line); ++number) {
        auto step = readStep(line, steps->empty() ? Clock::duration{} : steps->back().at);
        if (!step) {
            return bad(printable(file_name, 400) + ":" + numberText(number) + ": " +
                       step.error().message);
        }
        steps->push_back(std::move(*step));
    }
    return Recording(std::move(steps));
}

Result<Recording> readScriptFile(const std::filesystem::path& path) {
    std::ifstream file(path);
    if (!file || std::filesystem::is_directory(path)) {
        return Error{ErrorCode::kIo, "cannot read '" + printable(path.string(), 400) + "'"};
    }
    auto script = readScript(file, path.string());
    if (script && file.bad()) {
        return Error{ErrorCode::kIo, "reading '" + printable(path.string(), 400) + "' failed"};
    }
    return script;
}

} // namespace froxel::load
