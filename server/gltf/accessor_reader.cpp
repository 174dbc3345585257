#include "gltf/accessor_reader.h"

#include "core/text.h"
#include "gltf/failure.h"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstring>
#include <limits>
#include <type_traits>

namespace froxel::gltf {
namespace {

size_t componentBytes(int type, const std::string& name) {
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return 4;
    default:
        fail(name + " has componentType " + std::to_string(type) +
             "; expected 5120, 5121, 5122, 5123, 5125 or 5126");
    }
}

size_t componentCount(int type, const std::string& name) {
    switch (type) {
    case TINYGLTF_TYPE_SCALAR:
        return 1;
    case TINYGLTF_TYPE_VEC2:
        return 2;
    case TINYGLTF_TYPE_VEC3:
        return 3;
    case TINYGLTF_TYPE_VEC4:
        return 4;
    case TINYGLTF_TYPE_MAT4:
        return 16;
    default:
        fail(name + " is a MAT2 or MAT3; expected SCALAR, VEC2, VEC3, VEC4 or MAT4");
    }
}

// `count` elements of `element_bytes` inside `bytes`, the first at `offset`. The count and the
// stride are below 2^31 and the others below 2^32, so 64 bits hold the product and the sum.
void checkFit(std::span<const std::byte> bytes,
              uint64_t offset,
              uint64_t count,
              uint64_t stride,
              uint64_t element_bytes,
              const std::string& name) {
    const uint64_t end = count == 0 ? offset : offset + (count - 1) * stride + element_bytes;
    if (end > bytes.size()) {
        fail(name + " ends at byte " + std::to_string(end) + " of its bufferView, which has " +
             std::to_string(bytes.size()));
    }
}

// tinygltf before 2.9 narrows these, and only these, to 32 bits with a sign: no version takes more.
template <std::integral Offset>
size_t sparseOffset(Offset offset, const std::string& name) {
    const auto bytes = static_cast<size_t>(static_cast<std::make_unsigned_t<Offset>>(offset));
    if (bytes > std::numeric_limits<int32_t>::max()) {
        fail(name + " has a sparse byteOffset of " + std::to_string(bytes) +
             "; expected at most 2147483647");
    }
    return bytes;
}

template <class T>
T load(const std::byte* address) {
    T value;
    std::memcpy(&value, address, sizeof value);
    return value;
}

// Calls `body(T{})` with the C++ type of a component.
template <class Body>
void withComponentType(int type, Body body) {
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return body(int8_t{});
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return body(uint8_t{});
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return body(int16_t{});
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return body(uint16_t{});
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return body(uint32_t{});
    default:
        return body(float{});
    }
}

template <class T>
float toFloat(T value, bool normalized) {
    if constexpr (std::is_floating_point_v<T>) {
        return value;
    } else {
        const auto number = static_cast<float>(value);
        constexpr auto kLargest = static_cast<float>(std::numeric_limits<T>::max());
        return normalized ? std::max(number / kLargest, -1.0F) : number;
    }
}

} // namespace

// Where the elements of one accessor are; `owned` backs `first` where the file's bytes do not.
struct AccessorReader::Elements {
    const std::byte* first = nullptr;
    size_t stride = 0;
    size_t count = 0;
    size_t components = 0;
    size_t element_bytes = 0;
    Bytes owned;
};

const tinygltf::Accessor& AccessorReader::at(int accessor, const std::string& user) const {
    const auto& all = document_.model.accessors;
    return all[checkedIndex(accessor, all.size(), "accessor", user)];
}

uint64_t AccessorReader::count(int accessor, const std::string& user) const {
    return at(accessor, user).count;
}

bool AccessorReader::normalized(int accessor, const std::string& user) const {
    return at(accessor, user).normalized;
}

int AccessorReader::components(int accessor, const std::string& user) const {
    return static_cast<int>(
        componentCount(at(accessor, user).type, user + " accessor " + std::to_string(accessor)));
}

AccessorReader::Elements AccessorReader::elements(int index, const std::string& user) {
    const tinygltf::Accessor& accessor = at(index, user);
    const std::string name = user + " accessor " + std::to_string(index);
    Elements result;
    result.count = accessor.count;
    result.components = componentCount(accessor.type, name);
    result.element_bytes = result.components * componentBytes(accessor.componentType, name);
    result.stride = result.element_bytes;
    if (accessor.bufferView >= 0) {
        const auto bytes = views_.bytes(accessor.bufferView, name);
        const size_t stride = views_.stride(accessor.bufferView);
        if (stride != 0 && stride < result.element_bytes) {
            fail(name + " has elements of " + std::to_string(result.element_bytes) +
                 " bytes in a bufferView with byteStride " + std::to_string(stride));
        }
        result.stride = stride != 0 ? stride : result.element_bytes;
        checkFit(bytes, accessor.byteOffset, result.count, result.stride, result.element_bytes,
                 name);
        result.first = bytes.data() + accessor.byteOffset;
    }
    if (accessor.bufferView < 0 || accessor.sparse.isSparse) {
        Bytes packed(result.count * result.element_bytes);
        for (size_t i = 0; result.first != nullptr && i < result.count; ++i) {
            std::memcpy(packed.data() + i * result.element_bytes, result.first + i * result.stride,
                        result.element_bytes);
        }
        result.owned = std::move(packed);
        result.first = result.owned.data();
        result.stride = result.element_bytes;
    }
    if (accessor.sparse.isSparse) {
        substitute(accessor, result, name);
    }
    return result;
}

void AccessorReader::substitute(const tinygltf::Accessor& accessor,
                                Elements& elements,
                                const std::string& name) {
    const auto& sparse = accessor.sparse;
    const auto count = static_cast<size_t>(sparse.count);
    if (count > elements.count) {
        fail(name + " substitutes " + std::to_string(count) + " elements of " +
             std::to_string(elements.count));
    }
    const int type = sparse.indices.componentType;
    if (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
        type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
        type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
        fail(name + " has sparse indices of componentType " + std::to_string(type) +
             "; expected 5121, 5123 or 5125");
    }
    const size_t index_bytes = componentBytes(type, name);
    const auto index_view = views_.bytes(sparse.indices.bufferView, name + " sparse indices");
    const auto value_view = views_.bytes(sparse.values.bufferView, name + " sparse values");
    const size_t index_offset = sparseOffset(sparse.indices.byteOffset, name);
    const size_t value_offset = sparseOffset(sparse.values.byteOffset, name);
    checkFit(index_view, index_offset, count, index_bytes, index_bytes, name + " sparse indices");
    checkFit(value_view, value_offset, count, elements.element_bytes, elements.element_bytes,
             name + " sparse values");
    withComponentType(type, [&](auto tag) {
        using T = decltype(tag);
        for (size_t i = 0; i < count; ++i) {
            const T value = load<T>(index_view.data() + index_offset + i * sizeof(T));
            const auto target = static_cast<size_t>(value);
            if (target >= elements.count) {
                fail(name + " sparse index " + std::to_string(i) + " is " + std::to_string(target) +
                     "; expected below " + std::to_string(elements.count));
            }
            std::memcpy(elements.owned.data() + target * elements.element_bytes,
                        value_view.data() + value_offset + i * elements.element_bytes,
                        elements.element_bytes);
        }
    });
}

AccessorReader::Elements
AccessorReader::elementsOf(int index, size_t components, const std::string& user) {
    const std::string name = user + " accessor " + std::to_string(index);
    const size_t own = componentCount(at(index, user).type, name);
    if (own != components) {
        fail(user + " uses accessor " + std::to_string(index) + " with " + std::to_string(own) +
             " components; expected " + std::to_string(components));
    }
    return elements(index, user);
}

// Calls visit(element, component, value) for all numbers.
template <class Visit>
void AccessorReader::eachNumber(int index, const Elements& source, const Visit& visit) const {
    const tinygltf::Accessor& accessor = document_.model.accessors[static_cast<size_t>(index)];
    withComponentType(accessor.componentType, [&](auto tag) {
        using T = decltype(tag);
        for (size_t i = 0; i < source.count; ++i) {
            const std::byte* element = source.first + i * source.stride;
            for (size_t c = 0; c < source.components; ++c) {
                visit(i, c, toFloat(load<T>(element + c * sizeof(T)), accessor.normalized));
            }
        }
    });
}

template <int N>
std::vector<glm::vec<N, float>>
AccessorReader::vectors(int index, const std::string& user, NotFinite not_finite) {
    const Elements source = elementsOf(index, N, user);
    std::vector<glm::vec<N, float>> result(source.count);
    eachNumber(index, source, [&](size_t element, size_t component, float value) {
        if (not_finite == NotFinite::kRefused && !std::isfinite(value)) {
            fail(user + " accessor " + std::to_string(index) + " element " +
                 std::to_string(element) + " is " + numberText(value) +
                 "; expected a finite number");
        }
        result[element][static_cast<int>(component)] = value;
    });
    return result;
}

std::vector<float> AccessorReader::numbers(int index, size_t components, const std::string& user) {
    const Elements source = elementsOf(index, components, user);
    std::vector<float> result;
    result.reserve(source.count * components);
    eachNumber(index, source, [&](size_t /*element*/, size_t /*component*/, float value) {
        result.push_back(value);
    });
    return result;
}

template std::vector<glm::vec2> AccessorReader::vectors<2>(int, const std::string&, NotFinite);
template std::vector<glm::vec3> AccessorReader::vectors<3>(int, const std::string&, NotFinite);
template std::vector<glm::vec4> AccessorReader::vectors<4>(int, const std::string&, NotFinite);

std::vector<uint32_t> AccessorReader::indices(int index, const std::string& user) {
    const int type = at(index, user).componentType;
    const Elements source = elements(index, user);
    if (source.components != 1 || (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
                                   type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
                                   type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)) {
        fail(user + " uses accessor " + std::to_string(index) +
             " as indices; expected SCALAR with componentType 5121, 5123 or 5125");
    }
    std::vector<uint32_t> result(source.count);
    withComponentType(type, [&](auto tag) {
        using T = decltype(tag);
        for (size_t i = 0; i < source.count; ++i) {
            result[i] = static_cast<uint32_t>(load<T>(source.first + i * source.stride));
        }
    });
    return result;
}

} // namespace froxel::gltf
