// A message's enum as one of ours.
#pragma once

#include "session/field_validator.h"
#include "session/proto_enums.h"

#include <array>
#include <string>
#include <string_view>
#include <utility>

namespace froxel::session {

// A value that the table lacks is refused, with those that it has.
template <class Proto, class Ours, size_t N>
Ours enumeration(FieldValidator& fields,
                 std::string_view field,
                 const std::array<std::pair<Proto, Ours>, N>& table,
                 Proto value) {
    if (const auto known = fromProto(table, value)) {
        return *known;
    }
    std::string names;
    for (const auto& [proto, ours] : table) {
        names += (names.empty() ? "" : ", ") +
                 google::protobuf::GetEnumDescriptor<Proto>()->FindValueByNumber(proto)->name();
    }
    fields.fail(RejectCode::kUnsupported, field,
                "is " + numberText(static_cast<int>(value)) + "; known are " + names);
    return {};
}

} // namespace froxel::session
