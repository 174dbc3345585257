// The protocol's document says what the code does.
#include "core/text.h"
#include "froxel/v1/client.pb.h"
#include "froxel/v1/server.pb.h"
#include "protocol/limits.h"
#include "settings/ranges.h"
#include "support/places.h"

#include <google/protobuf/descriptor.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <iterator>
#include <sstream>

namespace froxel::session {
namespace {

using ::testing::HasSubstr;

std::filesystem::path readmePath() {
    return test::repositoryPath("protocol/README.md");
}

std::string readme() {
    std::ifstream stream(readmePath());
    EXPECT_TRUE(stream) << readmePath();
    return {std::istreambuf_iterator<char>(stream), {}};
}

// The row of a table that names `code` in backquotes or plainly in its first column.
std::string rowOf(const std::string& text, const std::string& code) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        const std::string first = line.substr(0, line.find('|', 1));
        if (line.rfind("| ", 0) == 0 && first.find(code) != std::string::npos) {
            return line;
        }
    }
    return "no row of " + code;
}

TEST(ProtocolReadme, RangeTable_IsTheCodes) {
    const std::string text = readme();
    const auto check = [&](std::string_view field, auto min, auto max) {
        const std::string row = rowOf(text, "`" + std::string(field) + "`");
        EXPECT_THAT(row, HasSubstr(" | " + numberText(min) + " | " + numberText(max)));
    };
    std::apply([&](const auto&... range) { (check(range.field, range.min, range.max), ...); },
               settings::kOtherRanges);
}

void addMessage(const google::protobuf::Descriptor& message, std::string& lines) {
    lines += "- `" + message.name() + "`:";
    for (int i = 0; i < message.field_count(); ++i) {
        const auto& field = *message.field(i);
        lines +=
            std::string(i > 0 ? "," : "") + " `" + field.name() + "` " + numberText(field.number());
    }
    lines += message.field_count() > 0 ? "\n" : " no fields\n";
    for (int i = 0; i < message.nested_type_count(); ++i) {
        addMessage(*message.nested_type(i), lines);
    }
}

void addEnum(const google::protobuf::EnumDescriptor& names, std::string& lines) {
    lines += "- `" + names.name() + "`:";
    for (int i = 0; i < names.value_count(); ++i) {
        const auto& value = *names.value(i);
        lines +=
            std::string(i > 0 ? "," : "") + " `" + value.name() + "` " + numberText(value.number());
    }
    lines += "\n";
}

std::string numbersAndNames() {
    std::string messages;
    std::string enums;
    for (const auto* file :
         {v1::ClientMessage::descriptor()->file(), v1::ServerMessage::descriptor()->file(),
          v1::Vec3::descriptor()->file()}) {
        for (int i = 0; i < file->message_type_count(); ++i) {
            addMessage(*file->message_type(i), messages);
        }
        for (int i = 0; i < file->enum_type_count(); ++i) {
            addEnum(*file->enum_type(i), enums);
        }
    }
    return messages + "\nEnums:\n\n" + enums;
}

// FROXEL_WRITE_NUMBERS=1 writes them.
TEST(ProtocolReadme, NumbersAndNames_AreTheSchemas) {
    const std::string text = readme();
    const std::string mark = "Messages:\n\n";
    const size_t at = text.find("\n" + mark);
    ASSERT_NE(at, std::string::npos);
    const size_t begin = at + 1 + mark.size();
    if (std::getenv("FROXEL_WRITE_NUMBERS") != nullptr) {
        std::ofstream(readmePath()) << text.substr(0, begin) << numbersAndNames();
    } else {
        EXPECT_EQ(text.substr(begin), numbersAndNames());
    }
}

TEST(ProtocolReadme, CloseCodes_AreListed) {
    const std::string text = readme();
    using protocol::CloseCode;
    for (const CloseCode code : protocol::kCloseCodes) {
        EXPECT_THAT(text, HasSubstr("\n| " + numberText(static_cast<uint16_t>(code)) + " |"));
    }
}

} // namespace
} // namespace froxel::session
