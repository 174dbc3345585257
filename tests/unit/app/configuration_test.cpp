// Options of `froxel serve` from the environment and from a file.
#include "app/config_file.h"
#include "app/options.h"
#include "core/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <string>
#include <vector>

namespace froxel::app {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

Options parse(std::vector<const char*> arguments, const Environment& environment = {}) {
    arguments.insert(arguments.begin(), {"froxel", "serve"});
    return parseOptions(static_cast<int>(arguments.size()), arguments.data(), environment);
}

ServeOptions serve(const Options& options) {
    return std::get<ServeOptions>(options.command);
}

std::string refusal(const std::vector<const char*>& arguments,
                    const Environment& environment = {}) {
    try {
        static_cast<void>(parse(arguments, environment));
    } catch (const StartupError& error) {
        EXPECT_EQ(error.code(), ErrorCode::kInvalidArgument);
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << "not one line";
        return error.what();
    }
    ADD_FAILURE() << "accepted";
    return {};
}

OptionInForce inForce(const Options& options, const std::string& name) {
    const auto& all = options.configuration.options;
    const auto found = std::find_if(
        all.begin(), all.end(), [&](const OptionInForce& option) { return option.name == name; });
    EXPECT_NE(found, all.end()) << name;
    return found == all.end() ? OptionInForce{} : *found;
}

class ConfigurationTest : public testing::Test {
  protected:
    ~ConfigurationTest() override { std::filesystem::remove(path_); }
    const char* file(const std::string& text) {
        std::ofstream(path_) << text;
        return path_.c_str();
    }
    std::string path_ = testing::TempDir() + "froxel_configuration_" +
                        testing::UnitTest::GetInstance()->current_test_info()->name() + ".toml";
};

TEST_F(ConfigurationTest, Precedence_CommandLineThenEnvironmentThenFileThenDefault) {
    const Options options =
        parse({"--config", file("port = 1\nmax-sessions = 1\nresume-grace = 1.5\n"), "--port", "3"},
              {{"FROXEL_PORT", "2"}, {"FROXEL_MAX_SESSIONS", "2"}});
    EXPECT_EQ(serve(options).port, 3);
    EXPECT_EQ(serve(options).sessions_max, 2U);
    EXPECT_EQ(serve(options).resume_grace_s, 1.5);
    EXPECT_EQ(serve(options).address, "127.0.0.1");
    EXPECT_EQ(inForce(options, "port").source, OptionSource::kCommandLine);
    EXPECT_EQ(inForce(options, "max-sessions").source, OptionSource::kEnvironment);
    EXPECT_EQ(inForce(options, "max-sessions").value, "2");
    EXPECT_EQ(inForce(options, "resume-grace").source, OptionSource::kFile);
    EXPECT_EQ(inForce(options, "address").source, OptionSource::kDefault);
    EXPECT_EQ(inForce(options, "address").value, "127.0.0.1");
}

TEST_F(ConfigurationTest, EveryKindOfOption_IsTakenFromTheFile) {
    const Options options =
        parse({"--config", file("# a comment\n"
                                "scene = \"/a b/#1.glb\"\n"
                                "validation = true\n"
                                "agones = true\n"
                                "no-depth = true\n"
                                "lens-shift = '0.5,-1'\n"
                                "allow-origin = ['https://a.example', 'https://b.example']\n"
                                "renderer = \"naive\"\n"
                                "log-format = \"json\"\n")});
    EXPECT_EQ(serve(options).scene, "/a b/#1.glb");
    EXPECT_TRUE(serve(options).validation);
    EXPECT_TRUE(serve(options).agones && serve(options).no_depth);
    EXPECT_EQ(serve(options).lens_shift, glm::dvec2(0.5, -1));
    EXPECT_THAT(serve(options).allowed_origins,
                ElementsAre("https://a.example", "https://b.example"));
    EXPECT_EQ(serve(options).first_view.renderer, settings::Renderer::kNaive);
    EXPECT_EQ(options.log_format, LogFormat::kJson);
}

TEST_F(ConfigurationTest, EnvironmentNamesTheFile_AndListsAreSplitAtCommas) {
    const char* path = file("port = 7\n");
    const Options options =
        parse({}, {{"FROXEL_CONFIG", path},
                   {"FROXEL_VALIDATION", "false"},
                   {"FROXEL_AGONES", "true"},
                   {"FROXEL_ALLOW_ORIGIN", "https://a.example,https://b.example"}});
    EXPECT_EQ(serve(options).port, 7);
    EXPECT_FALSE(serve(options).validation);
    EXPECT_TRUE(serve(options).agones);
    EXPECT_THAT(serve(options).allowed_origins,
                ElementsAre("https://a.example", "https://b.example"));
}

TEST_F(ConfigurationTest, BadValue_NamesWhereItCameFrom) {
    EXPECT_THAT(refusal({}, {{"FROXEL_PORT", "tcp://10.0.0.1:8080"}}),
                AllOf(HasSubstr("FROXEL_PORT: 'tcp://10.0.0.1:8080'"), HasSubstr("0 to 65535")));
    EXPECT_THAT(refusal({"--config", file("quality = 101\n")}),
                AllOf(HasSubstr(path_ + ": quality: '101'"), HasSubstr("1 to 100")));
    EXPECT_THAT(refusal({"--config", file("port = [1, 2]\n")}), HasSubstr("has 2 values"));
    EXPECT_THAT(refusal({"--config", file("port = {a = 1}\n")}), HasSubstr("line 1: port must be"));
}

// As templates write it. Taken as not given, it would open the server.
TEST_F(ConfigurationTest, EmptyValueOfWhatKeepsADoorShut_IsRefused) {
    for (const char* variable : {"FROXEL_TOKEN_FILE", "FROXEL_ADMIN_TOKEN_FILE", "FROXEL_TLS_CERT",
                                 "FROXEL_TLS_KEY", "FROXEL_ADDRESS", "FROXEL_CONFIG"}) {
        EXPECT_THAT(refusal({}, {{variable, ""}}), HasSubstr(std::string(variable) + ": is empty"));
    }
    EXPECT_THAT(refusal({"--token-file", ""}), HasSubstr("is empty"));
    EXPECT_THAT(refusal({"--config", file("token-file = \"\"\n")}),
                HasSubstr(path_ + ": token-file: is empty"));
}

TEST_F(ConfigurationTest, Switch_IsTrueOrFalseAndNothingElse) {
    for (const char* value : {"1\\n2", "2", "-1", "1x", "true ", ""}) {
        const std::string line = std::string("validation = \"") + value + "\"\n";
        EXPECT_THAT(refusal({"--config", file(line.c_str())}),
                    HasSubstr("is none of true, false, on"))
            << value;
    }
    EXPECT_THAT(refusal({}, {{"FROXEL_AGONES", "2"}}), HasSubstr("FROXEL_AGONES: '2'"));
    for (const char* value : {"true", "True", "on", "yes", "1"}) {
        EXPECT_TRUE(serve(parse({}, {{"FROXEL_VALIDATION", value}})).validation) << value;
    }
}

TEST_F(ConfigurationTest, ValueOfSeveralLines_IsRefusedInOne) {
    EXPECT_THAT(refusal({"--config", file("quality = \"1\\n2\"\n")}), HasSubstr("'1\\x0a2'"));
    EXPECT_THAT(refusal({"--quality", "1\n2"}), HasSubstr("'1\\x0a2'"));
    EXPECT_THAT(refusal({"--no-such\noption"}), HasSubstr("--no-such\\x0aoption"));
}

TEST_F(ConfigurationTest, UnknownKey_IsRefused) {
    EXPECT_THAT(refusal({"--config", file("max_sessions = 3\n")}),
                AllOf(HasSubstr(path_), HasSubstr("'max_sessions' is not an option")));
    EXPECT_THAT(refusal({"--config", file("config = 'b.toml'\n")}), HasSubstr("'config'"));
    EXPECT_THAT(refusal({"--config", file("[serve]\nport = 1\n")}), HasSubstr("serve"));
}

TEST_F(ConfigurationTest, BrokenFile_IsRefusedWithItsLine) {
    EXPECT_THAT(refusal({"--config", file("port = 1\nport = 2\n")}), HasSubstr("line 2"));
    EXPECT_THAT(refusal({"--config", file("port = 1\nquality 3\n")}), HasSubstr("line 2"));
    EXPECT_THAT(refusal({"--config", "/no/such.toml"}), HasSubstr("/no/such.toml cannot be read"));
    EXPECT_THAT(refusal({"--config", "/"}), HasSubstr("cannot be read"));
}

TEST_F(ConfigurationTest, UnknownVariable_IsToldAndNoError) {
    const Options options = parse({}, {{"FROXEL_SERVICE_HOST", "10.0.0.1"}, {"PATH", "/bin"}});
    EXPECT_THAT(options.configuration.unknown_variables, ElementsAre("FROXEL_SERVICE_HOST"));
}

TEST_F(ConfigurationTest, OtherSubcommands_ReadNoEnvironment) {
    const std::vector<const char*> arguments = {"froxel", "info"};
    const Options options = parseOptions(2, arguments.data(), {{"FROXEL_DEVICE", "nonsense"}});
    EXPECT_TRUE(std::holds_alternative<InfoOptions>(options.command));
}

} // namespace
} // namespace froxel::app
