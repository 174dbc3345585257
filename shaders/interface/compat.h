// Lets one header describe a buffer to C++ and to GLSL. Included first by every *_io.h.
#ifndef FROXEL_INTERFACE_COMPAT_H
#define FROXEL_INTERFACE_COMPAT_H

#ifdef __cplusplus
#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>

#define FROXEL_IO_NAMESPACE_BEGIN namespace froxel::io {
#define FROXEL_IO_NAMESPACE_END }
#define FROXEL_SIZE_ASSERT(type, bytes) static_assert(sizeof(type) == (bytes))
#define FROXEL_CONST inline constexpr
#define FROXEL_USUAL(...)                                                                          \
    { __VA_ARGS__ } // of a member
namespace froxel::io {
using uint = uint32_t;
using vec2 = glm::vec2;
using vec3 = glm::vec3;
using vec4 = glm::vec4;
using uvec2 = glm::uvec2;
using uvec4 = glm::uvec4;
using mat3 = glm::mat3;
using mat4 = glm::mat4;
} // namespace froxel::io
#else
#define FROXEL_IO_NAMESPACE_BEGIN
#define FROXEL_IO_NAMESPACE_END
#define FROXEL_SIZE_ASSERT(type, bytes)
#define FROXEL_CONST const
#define FROXEL_USUAL(value)
#endif

#endif
