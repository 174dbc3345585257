#include "app/log_setup.h"

#include "app/log_limit.h"
#include "app/log_line.h"
#include "app/log_queue.h"

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <mutex>
#include <string>
#include <unistd.h>
#include <utility>

namespace froxel::app {
namespace {

// %v of our patterns: the payload as one safe line, or as JSON fields.
class Payload final : public spdlog::custom_flag_formatter {
  public:
    explicit Payload(LogFormat format) : format_(format) {}
    void format(const spdlog::details::log_msg& message,
                const std::tm& /*time*/,
                spdlog::memory_buf_t& out) override {
        const std::string_view payload(message.payload.data(), message.payload.size());
        const std::string text =
            format_ == LogFormat::kJson ? jsonFields(payload) : textLine(payload);
        out.append(text.data(), text.data() + text.size());
    }
    [[nodiscard]] std::unique_ptr<custom_flag_formatter> clone() const override {
        return std::make_unique<Payload>(format_);
    }

  private:
    const LogFormat format_;
};

std::unique_ptr<spdlog::formatter> makeFormatter(LogFormat format) {
    auto formatter = std::make_unique<spdlog::pattern_formatter>();
    formatter->add_flag<Payload>('*', format);
    formatter->set_pattern(format == LogFormat::kJson
                               ? R"({"time":"%Y-%m-%dT%H:%M:%S.%e%z","level":"%l",%*})"
                               : "%Y-%m-%dT%H:%M:%S.%e %l %*");
    return formatter;
}

// Some MB at most: a line has some 4 KB at most, and mostly 100 bytes.
constexpr size_t kLinesWaiting = 1024;

class LimitedStderr final : public spdlog::sinks::base_sink<std::mutex> {
  public:
    explicit LimitedStderr(LogFormat format)
        : base_sink(makeFormatter(format)), limit_(kLogBurst, Seconds(kLogPeriod_s)),
          queue_(STDERR_FILENO, kLinesWaiting, [format](uint64_t lost) {
              return lineOf(*makeFormatter(format), "event=log_lost lines=" + std::to_string(lost));
          }) {}
    ~LimitedStderr() override { tellLeftOut(true); }
    LimitedStderr(const LimitedStderr&) = delete;
    LimitedStderr& operator=(const LimitedStderr&) = delete;

    [[nodiscard]] uint64_t lost() const { return queue_.lost(); }

  protected:
    void sink_it_(const spdlog::details::log_msg& message) override {
        const std::string_view kind = eventOf({message.payload.data(), message.payload.size()});
        const bool said = kind.empty() || limit_.admit(kind, Clock::now());
        tellLeftOut(false);
        if (said) {
            queue_.add(lineOf(*formatter_, message));
        }
    }
    // Before the end, which need not destroy this.
    void flush_() override {
        tellLeftOut(true);
        queue_.flush();
    }

  private:
    static std::string lineOf(spdlog::formatter& formatter,
                              const spdlog::details::log_msg& message) {
        spdlog::memory_buf_t line;
        formatter.format(message, line);
        return {line.data(), line.size()};
    }
    static std::string lineOf(spdlog::formatter& formatter, const std::string& warning) {
        return lineOf(formatter, spdlog::details::log_msg("", spdlog::level::warn, warning));
    }
    void tellLeftOut(bool end) {
        for (const auto& [kind, count] : limit_.takeLeftOut(Clock::now(), end)) {
            queue_.add(lineOf(*formatter_, "event=log_limited kind=" + kind +
                                               " left_out=" + std::to_string(count)));
        }
    }

    LogLimit limit_;
    LogQueue queue_;
};

// The default logger's.
std::shared_ptr<LimitedStderr>& theSink() {
    static std::shared_ptr<LimitedStderr> sink;
    return sink;
}

} // namespace

void startLog(LogLevel level, LogFormat format) {
    constexpr std::array kLevels = {spdlog::level::debug, spdlog::level::info, spdlog::level::warn,
                                    spdlog::level::err};
    theSink() = std::make_shared<LimitedStderr>(format);
    auto logger = std::make_shared<spdlog::logger>("froxel", theSink());
    logger->set_level(kLevels[static_cast<size_t>(level)]);
    spdlog::set_default_logger(std::move(logger));
}

uint64_t logLinesLost() {
    return theSink() ? theSink()->lost() : 0;
}

} // namespace froxel::app
