// Filters the studio and writes it as C++ source: make_studio_table FILE.
#include "environment/diffuse.h"
#include "environment/prefiltered.h"
#include "environment/studio.h"
#include "environment/studio_table.h"

#include <cstdio>
#include <fstream>
#include <utility>
#include <vector>

namespace {

void write(std::ofstream& out, const char* name, const char* type, const auto& values) {
    out << "const " << type << " " << name << "[] = {\n";
    for (const auto value : values) {
        out << value << ",\n";
    }
    out << "};\n";
}

} // namespace

int main(int argc, char** argv) {
    using namespace froxel::environment;
    if (argc != 2) {
        std::fputs("usage: make_studio_table FILE\n", stderr);
        return 2;
    }
    froxel::LinearImage panorama = studioPanorama(kStudioWidth_px);
    const Diffuse matt = diffuseOf(panorama);
    const Prefiltered glossy = prefilter(Pyramid(std::move(panorama)), {});
    std::vector<double> terms;
    std::vector<double> roughness;
    std::vector<float> texels;
    for (const auto& term : matt.terms) {
        terms.push_back(term.x);
    }
    for (const CubeLevel& level : glossy.levels) {
        roughness.push_back(level.roughness);
        for (size_t i = 0; i < level.rgb.size(); i += 3) {
            texels.push_back(level.rgb[i]);
        }
    }
    std::ofstream out(argv[1]);
    out << std::hexfloat << "#include \"environment/studio_table.h\"\n\nnamespace {\n";
    write(out, "kRoughness", "double", roughness);
    write(out, "kTexels", "float", texels);
    write(out, "kMatt", "double", terms);
    out << "}\n\nfroxel::environment::StudioTable froxel::environment::studioTable() {\n"
           "    return {kRoughness, kTexels, kMatt};\n}\n";
    return out.good() ? 0 : 1;
}
