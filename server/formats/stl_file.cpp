#include "formats/stl_file.h"

#include "core/binary_stl.h"
#include "formats/number_text.h"

#include <boost/spirit/home/x3.hpp>

#include <cstring>
#include <string>
#include <string_view>

namespace froxel::formats {

namespace {

namespace x3 = boost::spirit::x3;

constexpr size_t kNormalBytes = 12;
constexpr size_t kCornerBytes = 12;

std::vector<glm::vec3> readBinary(std::span<const std::byte> file) {
    const size_t count = binary_stl::triangleCount(file);
    if (file.size() < binary_stl::sizeBytes(file)) {
        gltf::fail("it is no STL file, or was cut short: it has " + std::to_string(file.size()) +
                   " bytes, and " + std::to_string(count) + " triangles take " +
                   std::to_string(binary_stl::sizeBytes(file)));
    }
    std::vector<glm::vec3> corners(3 * count);
    for (size_t i = 0; i < corners.size(); ++i) {
        const std::byte* const triangle =
            file.data() + binary_stl::kHeaderBytes + i / 3 * binary_stl::kTriangleBytes;
        std::memcpy(&corners[i], triangle + kNormalBytes + i % 3 * kCornerBytes, kCornerBytes);
    }
    return corners;
}

// Words in any case; what stands behind `solid` and `endsolid` is a name.
std::vector<glm::vec3> readText(std::string_view text) {
    std::vector<glm::vec3> corners;
    const auto corner = [&](auto& context) {
        const auto& at = x3::_attr(context);
        corners.emplace_back(boost::fusion::at_c<0>(at), boost::fusion::at_c<1>(at),
                             boost::fusion::at_c<2>(at));
    };
    const auto words = [](const char* of) { return x3::no_case[x3::lit(of)]; };
    const auto vertex = (words("vertex") >> kFloat >> kFloat >> kFloat)[corner];
    const auto facet = words("facet") >> words("normal") >> x3::omit[kFloat >> kFloat >> kFloat] >>
                       words("outer") >> words("loop") >> x3::repeat(3)[vertex] >>
                       words("endloop") >> words("endfacet");
    const auto name = x3::no_skip[*(x3::char_ - x3::eol)];
    const auto frame = (words("solid") | words("endsolid")) >> x3::omit[name];
    const auto* at = text.begin();
    while (x3::phrase_parse(at, text.end(), +facet | frame, x3::space)) {
    }
    if (at != text.end()) {
        gltf::fail("it is no STL file, or was cut short: line " +
                   std::to_string(lineOf(text, static_cast<size_t>(at - text.begin()))) +
                   " is not the facet or solid that is expected");
    }
    corners.resize(corners.size() / 3 * 3);
    return corners;
}

bool isText(std::span<const std::byte> file) {
    constexpr std::string_view kFirst = "solid";
    const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
    const size_t begin = text.find_first_not_of(" \t\r\n");
    // Many binary files begin so, too.
    return begin != std::string_view::npos && text.substr(begin).starts_with(kFirst) &&
           (file.size() < binary_stl::kHeaderBytes || file.size() != binary_stl::sizeBytes(file));
}

} // namespace

Model readStl(std::span<const std::byte> file) {
    Part part;
    if (isText(file)) {
        part.positions = readText({reinterpret_cast<const char*>(file.data()), file.size()});
    } else if (file.size() >= binary_stl::kHeaderBytes) {
        part.positions = readBinary(file);
    }
    if (part.positions.empty()) {
        gltf::fail("it has no triangles; expected an STL file with some");
    }
    Model model;
    model.unit_m = 1e-3;
    model.z_up = true;
    model.materials.emplace_back();
    model.meshes.push_back({"", {std::move(part)}});
    model.placed.emplace_back();
    return model;
}

} // namespace froxel::formats
