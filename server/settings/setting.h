// One setting of a view, as those see it who carry it and do not use it: options, commands,
// messages, reports, documents. Its row stands beside the struct whose member it is:
// setting_rows.h here, session/delivery_rows.h.
#pragma once

#include "core/math.h"
#include "settings/ranges.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>

namespace froxel::settings {

// An enumerator, as its place among the names.
struct Choice {
    size_t index = 0;
    bool operator==(const Choice&) const = default;
};

// What a setting is at. Floats are told as doubles.
using SettingValue = std::variant<bool, uint32_t, double, Choice, glm::dvec3>;

enum class SettingKind : uint8_t { kSwitch, kWhole, kReal, kChoice, kColor };

// For people, in the field's terms. Each is read alone: on the page, in --help, in reports.
struct SettingWords {
    std::string_view label;  // "Cross-fade"
    std::string_view help;   // says what it does, without a full stop
    std::string_view unit{}; // "m", "1/m", "px"; empty: none
    std::string_view cost{}; // in time, memory or error, where it is on; empty: none
};

struct Setting {
    // Of the protocol, the page's address and, with dashes, of options.
    std::string_view name;
    std::string_view path; // in reports: "lights.radius_m"
    SettingKind kind = SettingKind::kSwitch;
    double min = 0; // of numbers and of a colour's components
    double max = 0;
    std::span<const std::string_view> names; // of a choice, in its enumerators' order
    // Those, and after them the names of values that a state may have but nobody chooses.
    std::span<const std::string_view> value_names;
    bool single = false; // a real number that is kept as a float
    SettingWords words;
    std::string_view member_of; // membersOf<the struct>()

    // NaN is in no range.
    [[nodiscard]] bool contains(double value) const { return value >= min && value <= max; }
};

// "0.5", "mip_chain", "1,1,0.5", "true": what the command line takes.
[[nodiscard]] std::string textOf(const Setting& setting, const SettingValue& value);

// "0.5", "mip_chain", "1": what the page's address takes, and parseSetting().
[[nodiscard]] std::string addressText(const Setting& setting, const SettingValue& value);

// Of a struct that is read and set as a whole, such as ViewSettings.
template <class Whole>
struct SettingOf : Setting {
    SettingValue (*get)(const Whole&) = nullptr;
    // The value is of the setting's kind and in its range.
    void (*set)(Whole&, const SettingValue&) = nullptr;
};

// A setting's name and what it may be at.
struct Switch {
    std::string_view field;
};
struct Names {
    std::string_view field;
    std::span<const std::string_view> names;
    std::span<const std::string_view> value_names = names;
};
struct ColorRange {
    std::string_view field;
    double min;
    double max;
};

namespace detail {

template <class Member>
struct MemberPointer;
template <class Struct, class Member>
struct MemberPointer<Member Struct::*> {
    using Owner = Struct;
    using Type = Member;
};

// object.*First.*Rest...
template <auto First, auto... Rest>
constexpr auto& memberAt(auto& object) {
    if constexpr (sizeof...(Rest) == 0) {
        return object.*First;
    } else {
        return memberAt<Rest...>(object.*First);
    }
}

template <auto First, auto... Rest>
struct LastOf {
    using Pointer = typename LastOf<Rest...>::Pointer;
};
template <auto Last>
struct LastOf<Last> {
    using Pointer = decltype(Last);
};

template <class T>
SettingValue valueOf(const T& member) {
    if constexpr (std::is_enum_v<T>) {
        return Choice{static_cast<size_t>(member)};
    } else if constexpr (std::is_floating_point_v<T>) {
        return static_cast<double>(member);
    } else if constexpr (std::is_same_v<T, glm::vec3>) {
        return glm::dvec3(member);
    } else {
        return member;
    }
}

template <class T>
void assign(T& member, const SettingValue& value) {
    if constexpr (std::is_enum_v<T>) {
        member = static_cast<T>(std::get<Choice>(value).index);
    } else if constexpr (std::is_floating_point_v<T>) {
        member = static_cast<T>(std::get<double>(value));
    } else if constexpr (std::is_same_v<T, glm::vec3>) {
        member = glm::vec3(std::get<glm::dvec3>(value));
    } else {
        member = std::get<T>(value);
    }
}

template <class T>
constexpr SettingKind kindOf() {
    return std::is_same_v<T, bool>        ? SettingKind::kSwitch
           : std::is_same_v<T, uint32_t>  ? SettingKind::kWhole
           : std::is_enum_v<T>            ? SettingKind::kChoice
           : std::is_same_v<T, glm::vec3> ? SettingKind::kColor
                                          : SettingKind::kReal;
}

} // namespace detail

// Tells members of one struct from those of others. Not by an address: with -fsanitize=undefined
// gcc compares none of templates' at compile time.
template <class Struct>
constexpr std::string_view membersOf() {
    return static_cast<const char*>(__PRETTY_FUNCTION__);
}

// The row of a member: `Path` leads there from the whole, `may_be` is a Range, Names, ColorRange
// or Switch, as the member's type has it.
template <auto... Path, class MayBe>
constexpr auto row(const MayBe& may_be, std::string_view path, const SettingWords& words) {
    using Whole = typename detail::MemberPointer<
        std::tuple_element_t<0, std::tuple<decltype(Path)...>>>::Owner;
    using Last = detail::MemberPointer<typename detail::LastOf<Path...>::Pointer>;
    using Member = typename Last::Type;
    SettingOf<Whole> made;
    made.name = may_be.field;
    made.path = path;
    made.kind = detail::kindOf<Member>();
    if constexpr (std::is_same_v<MayBe, Names>) {
        static_assert(std::is_enum_v<Member>);
        made.names = may_be.names;
        made.value_names = may_be.value_names;
    } else if constexpr (std::is_same_v<MayBe, Switch>) {
        static_assert(std::is_same_v<Member, bool>);
    } else {
        static_assert(std::is_same_v<MayBe, ColorRange> ? std::is_same_v<Member, glm::vec3>
                                                        : std::is_arithmetic_v<Member>);
        made.min = static_cast<double>(may_be.min);
        made.max = static_cast<double>(may_be.max);
    }
    made.single = std::is_same_v<Member, float>;
    made.words = words;
    made.member_of = membersOf<typename Last::Owner>();
    made.get = [](const Whole& whole) { return detail::valueOf(detail::memberAt<Path...>(whole)); };
    made.set = [](Whole& whole, const SettingValue& value) {
        detail::assign(detail::memberAt<Path...>(whole), value);
    };
    return made;
}

} // namespace froxel::settings
