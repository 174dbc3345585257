#include "fuzz/target.h"

#include "core/assert.h"

#include <cstdio>

namespace froxel::fuzz {

void expectNoFault(const std::string& fault) {
    if (!fault.empty()) {
        std::fprintf(stderr, "%s\n", fault.c_str());
    }
    FROXEL_ASSERT(fault.empty(), "a promise is broken");
}

} // namespace froxel::fuzz
