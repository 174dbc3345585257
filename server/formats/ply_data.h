// A PLY file as its own header describes it: elements, each with items of the same properties.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace froxel::formats {

enum class PlyType : uint8_t { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

// visit(T()) of the type's own T.
template <class Visit>
[[nodiscard]] double ofPlyType(PlyType type, Visit visit) {
    switch (type) {
    case PlyType::kInt8:
        return visit(int8_t());
    case PlyType::kUint8:
        return visit(uint8_t());
    case PlyType::kInt16:
        return visit(int16_t());
    case PlyType::kUint16:
        return visit(uint16_t());
    case PlyType::kInt32:
        return visit(int32_t());
    case PlyType::kUint32:
        return visit(uint32_t());
    case PlyType::kFloat:
        return visit(float());
    case PlyType::kDouble:
        break;
    }
    return visit(double());
}

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::kFloat;
    std::optional<PlyType> length; // of a list
};

struct PlyElement {
    std::string name;
    uint64_t count = 0;
    std::vector<PlyProperty> properties;
};

struct PlyHeader {
    enum class Encoding : uint8_t { kText, kLittleEndian, kBigEndian };
    Encoding encoding = Encoding::kText;
    std::vector<PlyElement> elements;
    std::string texture_file; // of "comment TextureFile"
    size_t size_bytes = 0;
};

// Throws gltf::Failure.
[[nodiscard]] PlyHeader readPlyHeader(std::string_view file);

// The numbers behind the header, one after the other, as doubles. All throw gltf::Failure where the
// file ends.
class PlyNumbers {
  public:
    PlyNumbers(std::span<const std::byte> file, const PlyHeader& header)
        : file_(file), at_(header.size_bytes), encoding_(header.encoding) {}

    [[nodiscard]] double next(PlyType type);
    // A list's length; each of its numbers takes a byte at least, so what the file cannot hold is
    // refused.
    [[nodiscard]] size_t nextLength(PlyType type);

    [[nodiscard]] size_t left() const { return file_.size() - at_; }

  private:
    [[nodiscard]] double nextOfText();
    template <class T>
    [[nodiscard]] double nextOfBytes();

    std::span<const std::byte> file_;
    size_t at_;
    PlyHeader::Encoding encoding_;
};

} // namespace froxel::formats
