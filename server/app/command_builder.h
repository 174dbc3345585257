// One subcommand under construction: every value goes through value_parsers, so that every refusal
// reads the same; CLI11 does the rest.
#pragma once

#include "app/pipeline_cache_option.h"
#include "app/value_parsers.h"
#include "gpu/device_options.h"

#include <CLI/CLI.hpp>
#include <spdlog/fmt/fmt.h>

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace froxel::app {

template <class T>
struct Unwrapped {
    using Type = T;
};
template <class T>
struct Unwrapped<std::optional<T>> {
    using Type = T;
};

// Targets outlive the parse; a target is written only by an option that was given.
class CommandBuilder {
  public:
    CommandBuilder(CLI::App& app, const std::string& name, const std::string& description)
        : cli_(*app.add_subcommand(name, description)) {
        cli_.set_help_all_flag(); // none: the program's own shows all
    }

    [[nodiscard]] CLI::App& cli() const { return cli_; }
    // What --help shows for an option that is not given.
    [[nodiscard]] std::string shownDefault(const CLI::Option& option) const {
        const auto found = defaults_.find(&option);
        const bool flag = option.get_items_expected_max() == 0;
        return found != defaults_.end() ? found->second : flag ? "false" : "";
    }

    // `parse` is Result<...>(const std::string&) and converts to the target's type.
    template <class T, class Parse>
    CLI::Option* value(const std::string& option,
                       const std::string& type,
                       T& target,
                       Parse parse,
                       const std::string& shown_default,
                       const std::string& help) {
        const auto set = [&target](const auto& parsed) {
            target = static_cast<typename Unwrapped<T>::Type>(parsed);
        };
        return parsed(option, type, parse, set, shown_default, help);
    }

    // Likewise; `set` takes what was parsed.
    template <class Parse, class Set>
    CLI::Option* parsed(const std::string& option,
                        const std::string& type,
                        Parse parse,
                        Set set,
                        const std::string& shown_default,
                        const std::string& help) {
        const auto store = [set, parse, option](const std::string& text) {
            const auto result = parse(text);
            if (!result) {
                throw CLI::ValidationError(option, result.error().message);
            }
            set(*result);
        };
        return declared(
            cli_.add_option_function<std::string>(option, store, withDefault(help, shown_default)),
            type, shown_default);
    }

    // A number whose default is shown in words.
    template <class T, class Limit>
    CLI::Option* number(const std::string& option,
                        T& target,
                        const settings::Range<Limit>& range,
                        const std::string& shown_default,
                        const std::string& help) {
        const auto parse = [range](const std::string& text) { return parseNumber(text, range); };
        const auto text = fmt::format("{}; {} to {}", help, range.min, range.max);
        return value(option, "N", target, parse, shown_default, text);
    }

    template <class T, class Limit>
    CLI::Option* number(const std::string& option,
                        T& target,
                        const settings::Range<Limit>& range,
                        const std::string& help) {
        return number(option, target, range, fmt::format("{}", target), help);
    }

    // One of `names`, which are in the order of the target's enumerators.
    template <class T>
    CLI::Option* name(const std::string& option,
                      T& target,
                      std::span<const std::string_view> names,
                      const std::string& shown_default,
                      const std::string& help) {
        const auto parse = [names](const std::string& text) { return parseName(text, names); };
        const auto text = fmt::format("{}: {}", help, describe(names));
        return value(option, "NAME", target, parse, shown_default, text);
    }

    template <class Enum>
    CLI::Option* name(const std::string& option,
                      Enum& target,
                      std::span<const std::string_view> names,
                      const std::string& help) {
        const std::string shown(names[static_cast<size_t>(target)]);
        return name(option, target, names, shown, help);
    }

    // Any text, such as a path.
    template <class T>
    CLI::Option* text(const std::string& option,
                      const std::string& type,
                      T& target,
                      const std::string& shown_default,
                      const std::string& help) {
        return declared(cli_.add_option(option, target, withDefault(help, shown_default)), type,
                        shown_default);
    }

    // Of one that would leave a door open if it counted as not given: a variable that is set to
    // nothing, as templates do.
    static void neverEmpty(CLI::Option* option) {
        option->check([](const std::string& text) {
            return text.empty() ? std::string("is empty; give it a value, or remove it")
                                : std::string();
        });
    }

    // Shows all options since the last group under this heading.
    void group(const std::string& heading) const {
        const CLI::Option* help = cli_.get_help_ptr();
        for (CLI::Option* option : cli_.get_options({})) {
            if (option != help && option->get_group() == help->get_group()) { // CLI11's usual one
                option->group(heading);
            }
        }
    }

    void device(gpu::DeviceChoice& choice, bool& validation) {
        name("--device", choice, gpu::kDeviceChoiceNames, "Vulkan device, a GPU before a CPU");
        cli_.add_flag("--validation", validation, "Turn on the Vulkan validation layer (slow)");
    }

    void pipelineCache(gpu::PipelineCacheOptions& target) {
        target = defaultPipelineCache();
        value("--pipeline-cache", "DIR|off", target, parsePipelineCache,
              "$XDG_CACHE_HOME/froxel or ~/.cache/froxel",
              "Folder where compiled pipelines, and meshlets of large scenes, are kept from run to "
              "run");
    }

  private:
    CLI::Option*
    declared(CLI::Option* option, const std::string& type, const std::string& shown_default) {
        defaults_.emplace(option, shown_default);
        return option->type_name(type);
    }
    static std::string withDefault(const std::string& help, const std::string& shown_default) {
        return shown_default.empty() ? help : fmt::format("{} [{}]", help, shown_default);
    }

    CLI::App& cli_;
    std::map<const CLI::Option*, std::string> defaults_;
};

} // namespace froxel::app
