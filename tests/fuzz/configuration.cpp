// A file of options, as --config reads it: parsed, and given to the options of the service.
#include "app/config_file.h"
#include "app/option_sources.h"
#include "app/serve_arguments.h"
#include "core/assert.h"
#include "fuzz/memory_file.h"
#include "fuzz/target.h"

namespace froxel::fuzz {
namespace {

constexpr const char* kName = "fuzz.toml";

std::string tomlString(std::string_view text) {
    constexpr std::string_view kHex = "0123456789abcdef";
    std::string out = "\"";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x20 || c == '"' || c == '\\' || byte == 0x7F) {
            out += "\\u00";
            out += kHex[byte >> 4U];
            out += kHex[byte & 0xFU];
        } else {
            out += c;
        }
    }
    return out + '"';
}

std::string written(const app::ConfigValues& values) {
    std::string toml;
    for (const auto& [key, items] : values) {
        toml += tomlString(key) + " = [";
        for (const std::string& item : items) {
            toml += tomlString(item) + ",";
        }
        toml += "]\n";
    }
    return toml;
}

void parse(std::string_view text) {
    const auto values = app::parseConfig(text, kName);
    if (!values) {
        const std::string& message = values.error().message;
        FROXEL_ASSERT(isOneLine(message) && message.starts_with(kName),
                      "a refusal is one line that begins with the file");
        return;
    }
    const auto again = app::parseConfig(written(*values), kName);
    FROXEL_ASSERT(again && *again == *values, "what was read can be written and reads the same");
}

void apply(const std::string& path) {
    app::ServeOptions options;
    CLI::App app;
    app::CommandBuilder command(app, "serve", "");
    app::addServeAddresses(command, options);
    app::addServeLimits(command, options);
    bool whole = false;
    command.cli().callback([&] {
        const app::Configuration configuration = app::applySources(command, {});
        whole = configuration.options.size() > 10 && configuration.unknown_variables.empty();
    });
    try {
        app.parse(std::vector<std::string>{path, "--config", "serve"}); // from the last
        FROXEL_ASSERT(whole, "every option has a source");
    } catch (const CLI::ParseError& error) {
        FROXEL_ASSERT(isOneLine(error.what(), 4000), "a refusal is one line");
    }
}

} // namespace
} // namespace froxel::fuzz

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static const froxel::fuzz::MemoryFile file;
    const std::string_view text = froxel::fuzz::textOf(data, size);
    froxel::fuzz::parse(text);
    file.write(text);
    froxel::fuzz::apply(file.path());
    return 0;
}
