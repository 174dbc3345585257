#include "app/option_sources.h"

#include "app/config_file.h"
#include "core/text.h"

#include <algorithm>
#include <array>
#include <utility>

namespace froxel::app {
namespace {

constexpr std::string_view kPrefix = "FROXEL_";
constexpr const char* kFileOption = "config";

std::string nameOf(const CLI::Option& option) {
    return option.get_lnames().empty() ? std::string() : option.get_lnames().front();
}

std::vector<CLI::Option*> optionsOf(CLI::App& cli) {
    return cli.get_options([](const CLI::Option* option) {
        const std::string name = nameOf(*option);
        return !name.empty() && name != "help";
    });
}

bool takesSeveral(const CLI::Option& option) {
    return option.get_items_expected_max() > 1;
}

std::vector<std::string> split(const std::string& list) {
    std::vector<std::string> items;
    for (size_t begin = 0; begin <= list.size();) {
        const size_t end = std::min(list.find(',', begin), list.size());
        items.push_back(list.substr(begin, end - begin));
        begin = end + 1;
    }
    return items;
}

std::string join(const std::vector<std::string>& items) {
    std::string list;
    for (const std::string& item : items) {
        list += (list.empty() ? "" : ",") + item;
    }
    return list;
}

// Of an option without a value; CLI11 takes every number and what follows it.
bool isSwitch(const std::string& value) {
    constexpr std::array kWords = {"true", "false", "on", "off", "yes", "no", "1", "0"};
    return std::ranges::find(kWords, CLI::ignore_case(value)) != kWords.end();
}

// `where` is what a person has to mend: the variable, or file and key.
void give(CLI::Option& option, std::vector<std::string> values, const std::string& where) {
    if (values.empty() || (values.size() > 1 && !takesSeveral(option))) {
        throw CLI::ValidationError(where,
                                   "has " + numberText(values.size()) + " values; it takes one");
    }
    if (option.get_items_expected_max() == 0 && !isSwitch(values.front())) {
        throw CLI::ValidationError(where, "'" + printable(values.front(), 200) +
                                              "' is none of true, false, on, off, yes, no, 1, 0");
    }
    try {
        option.add_result(std::move(values));
        option.run_callback();
    } catch (const CLI::ParseError& error) {
        std::string why = error.what();
        const std::string named = "--" + nameOf(option) + ": ";
        why = why.compare(0, named.size(), named) == 0 ? why.substr(named.size()) : why;
        throw CLI::ValidationError(where, printable(why, 1000)); // the value is in it
    }
}

void takeVariable(CLI::Option& option, const Environment& environment) {
    const auto found = environment.find(variableName(nameOf(option)));
    if (option.count() == 0 && found != environment.end()) {
        give(option,
             takesSeveral(option) ? split(found->second) : std::vector<std::string>{found->second},
             found->first);
    }
}

ConfigValues fileOf(const CLI::App& cli) {
    const CLI::Option* file = cli.get_option_no_throw(std::string("--") + kFileOption);
    if (file == nullptr || file->count() == 0) {
        return {};
    }
    auto values = readConfigFile(file->results().front());
    if (!values) {
        throw CLI::ValidationError("--config", values.error().message);
    }
    return std::move(*values);
}

OptionSource sourceOf(const CLI::Option& option, OptionSource source) {
    return option.count() == 0 ? OptionSource::kDefault : source;
}

void takeFile(CLI::App& cli, std::map<const CLI::Option*, OptionSource>& sources) {
    const ConfigValues file = fileOf(cli);
    for (const auto& [key, values] : file) {
        const std::string where =
            "--config " + printable(cli.get_option("--config")->results().front(), 200);
        CLI::Option* option = cli.get_option_no_throw("--" + key);
        if (option == nullptr || key == kFileOption || key == "help") {
            throw CLI::ValidationError(where, "'" + printable(key) + "' is not an option there");
        }
        if (option->count() == 0) {
            give(*option, values, where + ": " + key);
            sources[option] = OptionSource::kFile;
        }
    }
}

} // namespace

std::string variableName(std::string_view option) {
    std::string name(kPrefix);
    for (const char c : option) {
        name += c == '-' ? '_' : static_cast<char>(c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c);
    }
    return name;
}

Configuration applySources(const CommandBuilder& command, const Environment& environment) {
    const std::vector<CLI::Option*> options = optionsOf(command.cli());
    std::map<const CLI::Option*, OptionSource> sources;
    for (CLI::Option* option : options) {
        sources[option] = sourceOf(*option, OptionSource::kCommandLine);
        takeVariable(*option, environment);
        if (sources[option] == OptionSource::kDefault) {
            sources[option] = sourceOf(*option, OptionSource::kEnvironment);
        }
    }
    takeFile(command.cli(), sources);

    Configuration configuration;
    for (const CLI::Option* option : options) {
        const OptionSource source = sources[option];
        const bool is_default = source == OptionSource::kDefault;
        configuration.options.push_back(
            {nameOf(*option), is_default ? command.shownDefault(*option) : join(option->results()),
             source});
    }
    for (const auto& variable : environment) {
        const std::string& name = variable.first;
        const bool ours = name.compare(0, kPrefix.size(), kPrefix) == 0;
        if (ours && std::none_of(options.begin(), options.end(), [&](const CLI::Option* option) {
                return variableName(nameOf(*option)) == name;
            })) {
            configuration.unknown_variables.push_back(name);
        }
    }
    return configuration;
}

} // namespace froxel::app
