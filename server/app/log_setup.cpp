#include "app/log_setup.h"

#include "app/log_limit.h"
#include "app/log_line.h"

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>

#include <cstdio>
#include <mutex>
#include <string>
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

class LimitedStderr final : public spdlog::sinks::base_sink<std::mutex> {
  public:
    explicit LimitedStderr(LogFormat format)
        : base_sink(makeFormatter(format)), limit_(kLogBurst, Seconds(kLogPeriod_s)) {}
    ~LimitedStderr() override { tellLeftOut(true); }
    LimitedStderr(const LimitedStderr&) = delete;
    LimitedStderr& operator=(const LimitedStderr&) = delete;

  protected:
    void sink_it_(const spdlog::details::log_msg& message) override {
        const std::string_view kind = eventOf({message.payload.data(), message.payload.size()});
        const bool said = kind.empty() || limit_.admit(kind, Clock::now());
        tellLeftOut(false);
        if (said) {
            write(message);
        }
    }
    // Before the end, which need not destroy this.
    void flush_() override {
        tellLeftOut(true);
        std::fflush(stderr);
    }

  private:
    void tellLeftOut(bool end) {
        for (const auto& [kind, count] : limit_.takeLeftOut(Clock::now(), end)) {
            const std::string text =
                "event=log_limited kind=" + kind + " left_out=" + std::to_string(count);
            write(spdlog::details::log_msg("", spdlog::level::warn, text));
        }
    }
    void write(const spdlog::details::log_msg& message) {
        spdlog::memory_buf_t line;
        formatter_->format(message, line);
        std::fwrite(line.data(), 1, line.size(), stderr);
    }

    LogLimit limit_;
};

} // namespace

void startLog(LogLevel level, LogFormat format) {
    constexpr std::array kLevels = {spdlog::level::debug, spdlog::level::info, spdlog::level::warn,
                                    spdlog::level::err};
    auto logger =
        std::make_shared<spdlog::logger>("froxel", std::make_shared<LimitedStderr>(format));
    logger->set_level(kLevels[static_cast<size_t>(level)]);
    spdlog::set_default_logger(std::move(logger));
}

} // namespace froxel::app
