// Writes the table of every lobe as C++ source: make_area_light_table FILE.
#include "area_light_table/fit.h"

#include <cstdio>
#include <fstream>
#include <future>

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("usage: make_area_light_table FILE\n", stderr);
        return 2;
    }
    std::ofstream out(argv[1]);
    out << std::hexfloat
        << "#include \"area_light_table/table.h\"\n\nnamespace {\nconst float kValues[] = {\n";
    auto second = std::async(std::launch::async, [] {
        return froxel::area_light_table::fit(froxel::area_light_table::Lobe::kBlinnPhong);
    });
    for (const auto& entries :
         {froxel::area_light_table::fit(froxel::area_light_table::Lobe::kGgx), second.get()}) {
        for (const auto& entry : entries) {
            for (const float value : {entry.a, entry.b, entry.c, entry.d, entry.albedo,
                                      entry.grazing, entry.padding0, entry.padding1}) {
                out << value << "F,";
            }
            out << '\n';
        }
    }
    out << "};\n}\n\n"
           "std::span<const float> froxel::area_light_table::table() { return kValues; }\n";
    return out.good() ? 0 : 1;
}
