// The protocol's document says what the code does.
#include "core/text.h"
#include "protocol/limits.h"
#include "view/ranges.h"

#include <gtest/gtest.h>

#include <fstream>
#include <gmock/gmock.h>
#include <iterator>
#include <sstream>

namespace froxel::session {
namespace {

using ::testing::HasSubstr;

std::string readme() {
    std::ifstream stream(FROXEL_PROTOCOL_README);
    EXPECT_TRUE(stream) << FROXEL_PROTOCOL_README;
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
    const auto check = [&](const auto& range) {
        const std::string row = rowOf(text, "`" + std::string(range.field) + "`");
        EXPECT_THAT(row, HasSubstr(" | " + numberText(range.min) + " | " + numberText(range.max)));
    };
    std::apply([&](const auto&... range) { (check(range), ...); }, view::kCommandRanges);
}

TEST(ProtocolReadme, CloseCodes_AreListed) {
    const std::string text = readme();
    using protocol::CloseCode;
    for (const CloseCode code :
         {CloseCode::kNormal, CloseCode::kPolicy, CloseCode::kTooBig, CloseCode::kVersion,
          CloseCode::kToken, CloseCode::kSlowConsumer, CloseCode::kReplaced, CloseCode::kDraining,
          CloseCode::kResting, CloseCode::kCapacity, CloseCode::kDeviceLost}) {
        EXPECT_THAT(text, HasSubstr("\n| " + numberText(static_cast<uint16_t>(code)) + " |"));
    }
}

} // namespace
} // namespace froxel::session
