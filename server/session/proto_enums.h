// The schema's enums beside ours. They share their names: A_TROUS of BloomKind is
// BLOOM_KIND_A_TROUS.
#pragma once

#include "froxel/v1/common.pb.h"
#include "session/field_validator.h"

#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace froxel::session {

// The numbers of an enum's values in the order of `names`; each is there (FROXEL_ASSERT).
[[nodiscard]] std::vector<int> enumNumbers(const google::protobuf::EnumDescriptor& type,
                                           std::span<const std::string_view> names);
// The place of a number among them. One that is not there is refused with the names that are.
[[nodiscard]] size_t enumIndex(FieldValidator& fields,
                               std::string_view field,
                               const google::protobuf::EnumDescriptor& type,
                               const std::vector<int>& numbers,
                               int number);

// Of the schema's enum `Proto`, always with the same names.
template <class Proto>
const std::vector<int>& numbersOf(std::span<const std::string_view> names) {
    static const std::vector<int> numbers =
        enumNumbers(*google::protobuf::GetEnumDescriptor<Proto>(), names);
    return numbers;
}

template <class Proto, class Ours>
[[nodiscard]] Proto toProto(std::span<const std::string_view> names, Ours value) {
    return static_cast<Proto>(numbersOf<Proto>(names)[static_cast<size_t>(value)]);
}

// None for a value that this server does not know, UNSPECIFIED among them.
template <class Ours, class Proto>
[[nodiscard]] std::optional<Ours> fromProto(std::span<const std::string_view> names, Proto value) {
    const std::vector<int>& numbers = numbersOf<Proto>(names);
    for (size_t index = 0; index < numbers.size(); ++index) {
        if (numbers[index] == static_cast<int>(value)) {
            return static_cast<Ours>(index);
        }
    }
    return std::nullopt;
}

} // namespace froxel::session
