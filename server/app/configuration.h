// Which options are in force, and where each came from.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace froxel::app {

using Environment = std::map<std::string, std::string, std::less<>>;
// Of a process: "NAME=value" strings, ended by null.
[[nodiscard]] Environment readEnvironment(const char* const* variables);

enum class OptionSource : uint8_t { kCommandLine, kEnvironment, kFile, kDefault };
inline constexpr std::array kOptionSourceNames = {
    std::string_view("command_line"), std::string_view("environment"), std::string_view("file"),
    std::string_view("default")};

struct OptionInForce {
    std::string name; // "max-sessions"
    std::string value;
    OptionSource source = OptionSource::kDefault;
};

struct Configuration {
    std::vector<OptionInForce> options;
    // Variables that look like ours and name no option. They are no error: Kubernetes puts
    // FROXEL_SERVICE_HOST into every container beside a service named froxel.
    std::vector<std::string> unknown_variables;
};

// One line a source, on the default logger. No option's value is a secret: those are in files.
void logConfiguration(const Configuration& configuration);

} // namespace froxel::app
