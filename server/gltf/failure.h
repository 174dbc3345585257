// How the parts of the loader give up. Inside this layer a broken file is an exception: it ends
// dozens of nested readers at once. `load` catches it.
#pragma once

#include "gltf/warnings.h"

#include <cstddef>
#include <stdexcept>
#include <string>

namespace froxel::gltf {

class Failure : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

// Of a thing that the rest of the file can do without: who may leave it out catches this and warns.
class Unusable : public Failure {
  public:
    Unusable(const WarningKind& kind, const std::string& message) : Failure(message), kind_(kind) {}
    [[nodiscard]] const WarningKind& kind() const { return kind_; }

  private:
    WarningKind kind_;
};

// One line without the file's name, which `load` puts in front.
[[noreturn]] inline void fail(const std::string& message) {
    throw Failure(message);
}

// Of a file of glTF 1.x, whichever way it tells so.
[[noreturn]] inline void failOldVersion(const std::string& how) {
    fail("it is a glTF 1.0 file (" + how + "); expected glTF 2.0; gltf-pipeline converts it");
}

// "mesh 3 primitive 0": how messages name a thing of the file.
[[nodiscard]] inline std::string thing(const char* kind, size_t index) {
    return std::string(kind) + " " + std::to_string(index);
}

// `index` as a position in an array of `size` things; fails where it is outside.
[[nodiscard]] inline size_t
checkedIndex(int index, size_t size, const char* kind, const std::string& user) {
    if (index < 0 || static_cast<size_t>(index) >= size) {
        fail(user + " uses " + kind + " " + std::to_string(index) + "; the file has " +
             std::to_string(size) + ", counted from 0");
    }
    return static_cast<size_t>(index);
}

} // namespace froxel::gltf
