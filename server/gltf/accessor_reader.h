// Typed arrays out of accessors: every component type, stride, sparse substitution, normalised
// integers, accessors without data (zeros).
#pragma once

#include "gltf/buffer_views.h"
#include "gltf/document.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace froxel::gltf {

enum class NotFinite { kRefused, kKept };

// Not thread-safe. Every function throws Failure, naming `user`, for an accessor that does not
// exist or whose elements do not lie inside its buffer view. What is returned is not larger than
// count() elements; the caller asks its budget first.
class AccessorReader {
  public:
    AccessorReader(const Document& document, BufferViews& views)
        : document_(document), views_(views) {}

    [[nodiscard]] uint64_t count(int accessor, const std::string& user) const;
    [[nodiscard]] bool normalized(int accessor, const std::string& user) const;
    // 1 to 4; of a matrix 16.
    [[nodiscard]] int components(int accessor, const std::string& user) const;

    // Elements of exactly N components as floats: normalised integers in 0..1 or -1..1, others as
    // their value. Not-finite floats are refused, naming the element, unless the caller mends them.
    template <int N>
    [[nodiscard]] std::vector<glm::vec<N, float>>
    vectors(int accessor, const std::string& user, NotFinite not_finite = NotFinite::kRefused);

    // The same one after another, whether they are finite or not; matrices by columns.
    [[nodiscard]] std::vector<float>
    numbers(int accessor, size_t components, const std::string& user);

    // Unsigned integer scalars.
    [[nodiscard]] std::vector<uint32_t> indices(int accessor, const std::string& user);

  private:
    struct Elements;

    [[nodiscard]] const tinygltf::Accessor& at(int accessor, const std::string& user) const;
    [[nodiscard]] Elements elements(int accessor, const std::string& user);
    [[nodiscard]] Elements elementsOf(int accessor, size_t components, const std::string& user);
    template <class Visit>
    void eachNumber(int accessor, const Elements& source, const Visit& visit) const;
    void
    substitute(const tinygltf::Accessor& accessor, Elements& elements, const std::string& name);

    const Document& document_;
    BufferViews& views_;
};

} // namespace froxel::gltf
