// Writes the table of albedos as C++ source: make_albedo_table FILE.
#include "environment/albedo.h"

#include <cstdio>
#include <fstream>

int main(int argc, char** argv) {
    using namespace froxel::environment;
    if (argc != 2) {
        std::fputs("usage: make_albedo_table FILE\n", stderr);
        return 2;
    }
    std::ofstream out(argv[1]);
    out << std::hexfloat
        << "#include \"environment/albedo.h\"\n\nnamespace {\nconst float kValues[] = {\n";
    for (uint32_t row = 0; row < kAlbedoTableSize; ++row) {
        for (uint32_t column = 0; column < kAlbedoTableSize; ++column) {
            const Albedo entry = albedo(cosineOfColumn(column), roughnessOfRow(row));
            out << static_cast<float>(entry.all) << "F," << static_cast<float>(entry.grazing)
                << "F,\n";
        }
    }
    out << "};\n}\n\n"
           "std::span<const float> froxel::environment::albedoTable() { return kValues; }\n";
    return out.good() ? 0 : 1;
}
