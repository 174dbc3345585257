#include "net/process_metrics.h"

#include "net/metric_family.h"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <malloc.h>
#include <optional>
#include <string>
#include <sys/resource.h>
#include <system_error>

namespace froxel::net {
namespace {

using prometheus::MetricType;

// Of this process, near enough: before main().
const double start_time_s =
    std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();

// A number of /proc/self/status, in the unit of the file.
std::optional<double> statusNumber(const std::string& name) {
    std::ifstream file("/proc/self/status");
    for (std::string line; std::getline(file, line);) {
        if (line.rfind(name + ":", 0) == 0) {
            return std::stod(line.substr(name.size() + 1));
        }
    }
    return {};
}

std::optional<double> openDescriptors() {
    std::error_code failure;
    std::filesystem::directory_iterator entries("/proc/self/fd", failure);
    if (failure) {
        return {};
    }
    double count = -1; // the one that reads this
    for (; entries != std::filesystem::directory_iterator(); entries.increment(failure)) {
        ++count;
    }
    return count;
}

double secondsOf(const timeval& time) {
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) / 1e6;
}

} // namespace

std::vector<prometheus::MetricFamily> processMetrics() {
    std::vector<prometheus::MetricFamily> families;
    const auto add = [&](MetricType type, const char* name, const char* help, double value) {
        families.push_back(metricFamily(type, name, help, "", {{"", value}}));
    };
    if (const auto kibibytes = statusNumber("VmRSS")) {
        add(MetricType::Gauge, "process_resident_memory_bytes", "Resident memory.",
            *kibibytes * 1024);
    }
    // Resident memory has holes, too, which come and go with what is torn down in which order.
    const auto heap = mallinfo2();
    add(MetricType::Gauge, "process_heap_used_bytes", "Allocated heap memory.",
        static_cast<double>(heap.uordblks + heap.hblkhd));
    if (const auto count = statusNumber("Threads")) {
        add(MetricType::Gauge, "process_threads", "Threads of the process.", *count);
    }
    if (const auto count = openDescriptors()) {
        add(MetricType::Gauge, "process_open_fds", "Open file descriptors.", *count);
    }
    if (rlimit limit{}; getrlimit(RLIMIT_NOFILE, &limit) == 0) {
        add(MetricType::Gauge, "process_max_fds", "Maximum number of open file descriptors.",
            static_cast<double>(limit.rlim_cur));
    }
    add(MetricType::Gauge, "process_start_time_seconds",
        "Start time of the process, in seconds since 1970.", start_time_s);
    if (rusage usage{}; getrusage(RUSAGE_SELF, &usage) == 0) {
        add(MetricType::Counter, "process_cpu_seconds_total", "CPU time of all threads.",
            secondsOf(usage.ru_utime) + secondsOf(usage.ru_stime));
    }
    return families;
}

} // namespace froxel::net
