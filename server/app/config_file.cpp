#include "app/config_file.h"

#include "core/text.h"

#include <fstream>
#include <optional>
#include <toml++/toml.h>
#include <utility>

namespace froxel::app {
namespace {

constexpr std::streamsize kMaxBytes = 1 << 20;

std::string place(const std::string& name, const toml::source_region& source) {
    return printable(name, 200) + " line " + numberText(source.begin.line) + ": ";
}

std::optional<std::string> textOf(const toml::node& node) {
    if (const auto* text = node.as_string()) {
        return text->get();
    }
    if (const auto* whole = node.as_integer()) {
        return numberText(whole->get());
    }
    if (const auto* real = node.as_floating_point()) {
        return numberText(real->get());
    }
    if (const auto* flag = node.as_boolean()) {
        return flag->get() ? "true" : "false";
    }
    return {};
}

std::optional<std::vector<std::string>> valuesOf(const toml::node& node) {
    std::vector<std::string> values;
    const auto add = [&values](const toml::node& item) {
        auto text = textOf(item);
        if (text) {
            values.push_back(std::move(*text));
        }
        return text.has_value();
    };
    if (const auto* items = node.as_array()) {
        for (const toml::node& item : *items) {
            if (!add(item)) {
                return {};
            }
        }
    } else if (!add(node)) {
        return {};
    }
    return values;
}

} // namespace

Result<ConfigValues> parseConfig(std::string_view text, const std::string& name) {
    ConfigValues config;
    try {
        const toml::table table = toml::parse(text);
        for (const auto& [key, node] : table) {
            auto values = valuesOf(node);
            if (!values) {
                return Error{ErrorCode::kInvalidArgument,
                             place(name, node.source()) + printable(key.str()) +
                                 " must be a string, a number, true, false, or a list of these"};
            }
            config.emplace(key.str(), std::move(*values));
        }
    } catch (const toml::parse_error& error) {
        return Error{ErrorCode::kInvalidArgument,
                     place(name, error.source()) + printable(error.description(), 200)};
    }
    return config;
}

Result<ConfigValues> readConfigFile(const std::filesystem::path& path) {
    const auto refuse = [&path](const std::string& why) {
        return Error{ErrorCode::kInvalidArgument, printable(path.string(), 200) + " " + why};
    };
    std::ifstream in(path, std::ios::binary);
    std::string text(static_cast<size_t>(kMaxBytes) + 1, '\0');
    in.read(text.data(), kMaxBytes + 1);
    if (in.gcount() > kMaxBytes) {
        return refuse("has more than " + numberText(kMaxBytes) + " bytes");
    }
    if (!in.eof() || in.bad()) {
        return refuse("cannot be read");
    }
    text.resize(static_cast<size_t>(in.gcount()));
    return parseConfig(text, path.string());
}

} // namespace froxel::app
