#include "app/configuration.h"

#include "core/text.h"

#include <spdlog/spdlog.h>

namespace froxel::app {

Environment readEnvironment(const char* const* variables) {
    Environment environment;
    for (; *variables != nullptr; ++variables) {
        const std::string_view text = *variables;
        if (const size_t equals = text.find('='); equals != std::string_view::npos) {
            environment.emplace(text.substr(0, equals), text.substr(equals + 1));
        }
    }
    return environment;
}

void logConfiguration(const Configuration& configuration) {
    for (size_t i = 0; i < kOptionSourceNames.size(); ++i) {
        std::string line;
        for (const OptionInForce& option : configuration.options) {
            if (option.source == static_cast<OptionSource>(i)) {
                line += " " + option.name + "=" + logValue(option.value);
            }
        }
        if (!line.empty()) {
            spdlog::info("event=configuration from={}{}", kOptionSourceNames[i], line);
        }
    }
    for (const std::string& name : configuration.unknown_variables) {
        spdlog::warn("event=unknown_variable name={} text=\"names no option of froxel serve\"",
                     logValue(name));
    }
}

} // namespace froxel::app
