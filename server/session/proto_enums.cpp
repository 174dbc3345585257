#include "session/proto_enums.h"

#include "core/assert.h"
#include "core/text.h"

#include <algorithm>
#include <string>

namespace froxel::session {

using google::protobuf::EnumDescriptor;

std::vector<int> enumNumbers(const EnumDescriptor& type, std::span<const std::string_view> names) {
    constexpr std::string_view kFirst = "UNSPECIFIED";
    const std::string& first = type.value(0)->name();
    const std::string prefix = first.substr(0, first.size() - kFirst.size());
    std::vector<int> numbers;
    for (const std::string_view name : names) {
        std::string full = prefix;
        std::transform(name.begin(), name.end(), std::back_inserter(full), [](char c) {
            return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
        });
        const auto* value = type.FindValueByName(full);
        FROXEL_ASSERT(value != nullptr, "the schema has each of our names");
        numbers.push_back(value->number());
    }
    return numbers;
}

size_t enumIndex(FieldValidator& fields,
                 std::string_view field,
                 const EnumDescriptor& type,
                 const std::vector<int>& numbers,
                 int number) {
    const auto found = std::find(numbers.begin(), numbers.end(), number);
    if (found != numbers.end()) {
        return static_cast<size_t>(found - numbers.begin());
    }
    std::string known;
    for (const int of_ours : numbers) {
        known += (known.empty() ? "" : ", ") + type.FindValueByNumber(of_ours)->name();
    }
    fields.fail(RejectCode::kUnsupported, field,
                "is " + numberText(number) + "; known are " + known);
    return 0;
}

} // namespace froxel::session
