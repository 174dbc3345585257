#include "formats/ply_data.h"

#include "core/text.h"
#include "formats/number_text.h"
#include "gltf/failure.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <sstream>
#include <utility>

namespace froxel::formats {

namespace {

namespace x3 = boost::spirit::x3;

constexpr size_t kLongestHeader = 1U << 16U;

PlyType typeOf(const std::string& word) {
    constexpr std::array<std::pair<std::string_view, PlyType>, 16> kTypes = {{
        {"char", PlyType::kInt8},
        {"int8", PlyType::kInt8},
        {"uchar", PlyType::kUint8},
        {"uint8", PlyType::kUint8},
        {"short", PlyType::kInt16},
        {"int16", PlyType::kInt16},
        {"ushort", PlyType::kUint16},
        {"uint16", PlyType::kUint16},
        {"int", PlyType::kInt32},
        {"int32", PlyType::kInt32},
        {"uint", PlyType::kUint32},
        {"uint32", PlyType::kUint32},
        {"float", PlyType::kFloat},
        {"float32", PlyType::kFloat},
        {"double", PlyType::kDouble},
        {"float64", PlyType::kDouble},
    }};
    for (const auto& [name, type] : kTypes) {
        if (word == name) {
            return type;
        }
    }
    gltf::fail("its header has type '" + printable(word) +
               "'; expected char, uchar, short, ushort, int, uint, float or double");
}

PlyHeader::Encoding encodingOf(const std::string& word) {
    if (word == "ascii") {
        return PlyHeader::Encoding::kText;
    }
    if (word == "binary_little_endian") {
        return PlyHeader::Encoding::kLittleEndian;
    }
    if (word == "binary_big_endian") {
        return PlyHeader::Encoding::kBigEndian;
    }
    gltf::fail("its format is '" + printable(word) +
               "'; expected ascii, binary_little_endian or binary_big_endian");
}

void addLine(std::istringstream line, PlyHeader& header) {
    std::string key;
    std::string first;
    line >> key >> first;
    if (key == "format") {
        header.encoding = encodingOf(first);
    } else if (key == "comment" && first == "TextureFile") {
        std::getline(line >> std::ws, header.texture_file);
        header.texture_file.erase(header.texture_file.find_last_not_of(" \t\r") + 1);
    } else if (key == "element") {
        PlyElement element{first, 0, {}};
        if (!(line >> element.count)) {
            gltf::fail("its header does not say how many of '" + printable(first) + "' there are");
        }
        header.elements.push_back(std::move(element));
    } else if (key == "property") {
        if (header.elements.empty()) {
            gltf::fail("its header has a property before its first element");
        }
        PlyProperty property;
        if (first == "list") {
            std::string length;
            line >> length >> first;
            property.length = typeOf(length);
        }
        property.type = typeOf(first);
        line >> property.name;
        header.elements.back().properties.push_back(std::move(property));
    }
}

} // namespace

PlyHeader readPlyHeader(std::string_view file) {
    PlyHeader header;
    const std::string_view text = file.substr(0, kLongestHeader);
    size_t begin = 0;
    for (bool first = true;; first = false) {
        const size_t end = text.find('\n', begin);
        if (end == std::string_view::npos) {
            gltf::fail("it is no PLY file, or was cut short: its header has no end_header");
        }
        std::string line(text.substr(begin, end - begin));
        line.erase(line.find_last_not_of(" \t\r") + 1);
        begin = end + 1;
        if (first && line != "ply") {
            gltf::fail("it is no PLY file: it begins with '" + printable(line, 20) + "'");
        }
        if (line == "end_header") {
            header.size_bytes = begin;
            return header;
        }
        addLine(std::istringstream(std::move(line)), header);
    }
}

double PlyNumbers::nextOfText() {
    const auto* const file = reinterpret_cast<const char*>(file_.data());
    const char* at = file + at_;
    double number = 0;
    if (!x3::phrase_parse(at, file + file_.size(), kFloat, x3::space, number,
                          x3::skip_flag::dont_post_skip)) {
        gltf::fail("it ends or has no number at byte " +
                   std::to_string(static_cast<size_t>(at - file)));
    }
    at_ = static_cast<size_t>(at - file);
    return number;
}

template <class T>
double PlyNumbers::nextOfBytes() {
    if (left() < sizeof(T)) {
        gltf::fail("it ends at byte " + std::to_string(file_.size()) + ", within its data");
    }
    std::array<std::byte, sizeof(T)> bytes{};
    std::memcpy(bytes.data(), file_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    if (encoding_ == PlyHeader::Encoding::kBigEndian) {
        std::ranges::reverse(bytes);
    }
    return static_cast<double>(std::bit_cast<T>(bytes));
}

double PlyNumbers::next(PlyType type) {
    if (encoding_ == PlyHeader::Encoding::kText) {
        return nextOfText();
    }
    return ofPlyType(type, [this]<class T>(T) { return nextOfBytes<T>(); });
}

size_t PlyNumbers::nextLength(PlyType type) {
    const double length = next(type);
    if (!(length >= 0 && length <= static_cast<double>(left()))) {
        gltf::fail("it has a list of " + numberText(length) + " numbers in " +
                   std::to_string(left()) + " bytes");
    }
    return static_cast<size_t>(length);
}

} // namespace froxel::formats
