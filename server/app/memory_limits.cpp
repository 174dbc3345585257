#include "app/memory_limits.h"

#include "gpu/memory.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#include <sys/resource.h>
#include <unistd.h>
#include <vector>

namespace froxel::app {

namespace {

namespace fs = std::filesystem;

// A file with one number; none where it is not there, or has a word ("max": no limit).
std::optional<uint64_t> readBytes(const fs::path& path) {
    std::ifstream file(path);
    uint64_t bytes = 0;
    return file >> bytes ? std::optional(bytes) : std::nullopt;
}

// Where a group's limit stands, and how much its processes take.
struct GroupFiles {
    fs::path limit;
    fs::path taken;
};

// Those of this process's group and of all above it, of both versions.
std::vector<GroupFiles> groupFiles(const fs::path& root) {
    const fs::path mount = root / "sys/fs/cgroup";
    std::vector<GroupFiles> files;
    const auto add = [&](fs::path folder, const fs::path& group, const char* limit,
                         const char* taken) {
        files.push_back({folder / limit, folder / taken}); // a container sees its own group here
        for (const fs::path& part : group.relative_path()) {
            folder /= part;
            files.push_back({folder / limit, folder / taken});
        }
    };
    std::ifstream groups(root / "proc/self/cgroup");
    for (std::string line; std::getline(groups, line);) { // ID:CONTROLLERS:GROUP
        const auto first = line.find(':');
        const auto second = line.find(':', first + 1);
        if (first == std::string::npos || second == std::string::npos) {
            continue;
        }
        const std::string controllers = line.substr(first + 1, second - first - 1);
        const fs::path group = line.substr(second + 1);
        if (controllers.empty()) {
            add(mount, group, "memory.max", "memory.current");
        } else if (("," + controllers + ",").find(",memory,") != std::string::npos) {
            add(mount / "memory", group, "memory.limit_in_bytes", "memory.usage_in_bytes");
        }
    }
    return files;
}

std::optional<uint64_t> hostMemory(const fs::path& root, const std::string& wanted) {
    std::ifstream file(root / "proc/meminfo");
    for (std::string line; std::getline(file, line);) { // NAME: KIB kB
        std::istringstream words(line);
        std::string name;
        uint64_t kib = 0;
        if (words >> name >> kib && name == wanted) {
            return kib << 10U;
        }
    }
    return {};
}

// That RLIMIT_AS leaves; none where there is no such limit.
std::optional<uint64_t> freeAddressSpace(const fs::path& root) {
    rlimit limit{};
    std::ifstream file(root / "proc/self/statm");
    uint64_t pages = 0;
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY || !(file >> pages)) {
        return {};
    }
    const uint64_t taken = pages * static_cast<uint64_t>(sysconf(_SC_PAGESIZE));
    return taken < limit.rlim_cur ? limit.rlim_cur - taken : 0;
}

uint64_t share(std::optional<uint64_t> bytes, double part) {
    return bytes ? static_cast<uint64_t>(part * static_cast<double>(*bytes))
                 : render::MemoryLimits::kNone;
}

void keepLeast(std::optional<uint64_t>& least, std::optional<uint64_t> bytes) {
    if (bytes) {
        least = std::min(least.value_or(*bytes), *bytes);
    }
}

} // namespace

std::optional<uint64_t> hostMemoryBytes(const fs::path& root) {
    std::optional<uint64_t> least = hostMemory(root, "MemTotal:");
    for (const GroupFiles& group : groupFiles(root)) {
        keepLeast(least, readBytes(group.limit));
    }
    return least;
}

std::optional<uint64_t> freeMemoryBytes(const fs::path& root) {
    std::optional<uint64_t> least = hostMemory(root, "MemAvailable:");
    for (const GroupFiles& group : groupFiles(root)) {
        const auto limit = readBytes(group.limit);
        const uint64_t taken = readBytes(group.taken).value_or(0);
        if (limit) {
            keepLeast(least, taken < *limit ? *limit - taken : 0);
        }
    }
    keepLeast(least, freeAddressSpace(root));
    return least;
}

uint64_t readMemoryBytes() {
    return share(freeMemoryBytes(), kOnlyReadShare);
}

ReadShares::Share ReadShares::take(uint64_t scene_bytes) {
    constexpr uint64_t kNone = render::MemoryLimits::kNone;
    const uint64_t of_scene = scene_bytes > kNone / kReadBytesOfSceneByte
                                  ? kNone
                                  : std::max(scene_bytes * kReadBytesOfSceneByte, kLeastReadBytes);
    const auto free_bytes = free_bytes_();
    if (!free_bytes) {
        return std::make_shared<const uint64_t>(of_scene);
    }
    const std::lock_guard lock(promised_->mutex);
    const uint64_t left = *free_bytes - std::min(*free_bytes, promised_->bytes);
    const uint64_t bytes = std::min(of_scene, share(left, kSharedReadShare));
    promised_->bytes += bytes;
    const auto promise = std::make_shared<Promise>(promised_, bytes);
    return {promise, &promise->bytes};
}

uint64_t sessionMemoryBytes(const MemoryOptions& options, bool device_is_cpu) {
    const uint32_t usual_mib = device_is_cpu ? kCpuSessionMemory_mib : kGpuSessionMemory_mib;
    return uint64_t{options.session_mib.value_or(usual_mib)} << 20U;
}

uint64_t sceneMemoryBytes(const MemoryOptions& options, const render::MemoryLimits& limits) {
    return options.scene_mib ? uint64_t{*options.scene_mib} << 20U
                             : static_cast<uint64_t>(kSceneMemoryShare *
                                                     static_cast<double>(limits.device_bytes));
}

render::MemoryLimits memoryLimits(const MemoryOptions& options, const gpu::Device& device) {
    const bool is_cpu = device.traits().is_cpu;
    render::MemoryLimits limits{.session_bytes = sessionMemoryBytes(options, is_cpu)};
    const uint64_t host_bytes = share(hostMemoryBytes(), kHostMemoryShare);
    limits.device_bytes = options.device_mib ? uint64_t{*options.device_mib} << 20U
                          : is_cpu           ? host_bytes
                                   : share(gpu::deviceMemoryBytes(device), kGpuMemoryShare);
    if (!is_cpu) {
        limits.host_bytes = host_bytes;
    }
    return limits;
}

} // namespace froxel::app
