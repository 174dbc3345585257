// How structs say what they consist of, to be written as bytes and read again (flat_bytes.h).
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstddef>
#include <tuple>

namespace froxel::bake {

// Fields<T>::of(value): references to all members of a struct, const as it is.
template <class T>
struct Fields;

template <class T>
concept HasFields = requires(T& value) {
    Fields<T>::of(value);
};

// Structs of which any bits will do, without members that are left out: written as they lie in
// memory, many at a time.
template <class T>
inline constexpr bool kAnyBits = false;
template <int kLength, class Scalar>
inline constexpr bool kAnyBits<glm::vec<kLength, Scalar>> = true;
template <int kColumns, int kRows, class Scalar>
inline constexpr bool kAnyBits<glm::mat<kColumns, kRows, Scalar>> = true;
template <class Scalar>
inline constexpr bool kAnyBits<glm::qua<Scalar>> = true;

// The least and the greatest value of an enumeration without gaps.
template <class Enum>
struct Values;
template <class Enum, Enum kLeast, Enum kGreatest>
struct ValuesFrom {
    static constexpr Enum kFirst = kLeast;
    static constexpr Enum kLast = kGreatest;
};
namespace detail {

struct Anything {
    template <class T>
    operator T() const; // NOLINT(google-explicit-constructor): stands for a member of any type
};

template <class T, class... Members>
consteval size_t memberCount() {
    if constexpr (requires { T{Members{}..., Anything{}}; }) {
        return memberCount<T, Members..., Anything>();
    } else {
        return sizeof...(Members);
    }
}

} // namespace detail

// A struct with a member more does not compile until it is listed, or counted as left out. In
// namespace froxel::bake.
#define FROXEL_FIELDS(type, left_out, ...)                                                         \
    template <>                                                                                    \
    struct Fields<type> {                                                                          \
        template <class Value>                                                                     \
        static auto of(Value& v) {                                                                 \
            const auto all = std::tie(__VA_ARGS__);                                                \
            static_assert(std::tuple_size_v<decltype(std::tie(__VA_ARGS__))> + (left_out) ==       \
                              detail::memberCount<type>(),                                         \
                          "every member is listed");                                               \
            return all;                                                                            \
        }                                                                                          \
    };

} // namespace froxel::bake
