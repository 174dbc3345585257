#include "report/host_summary.h"

#include <fstream>
#include <thread>

namespace froxel::report {

namespace {

// The first "model name : ..." that Linux gives.
std::string cpuModel() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        const size_t colon = line.find(": ");
        if (line.starts_with("model name") && colon != std::string::npos) {
            return line.substr(colon + 2);
        }
    }
    return {};
}

} // namespace

HostSummary hostSummary() {
#ifdef NDEBUG
    const char* build_type = "release";
#else
    const char* build_type = "debug";
#endif
#ifdef __clang__
    const char* compiler = "clang " __clang_version__;
#else
    const char* compiler = "g++ " __VERSION__;
#endif
    return {cpuModel(), std::thread::hardware_concurrency(), build_type, compiler};
}

} // namespace froxel::report
