#include "app/memory_limits.h"

#include "gpu/memory.h"

#include <algorithm>
#include <fstream>
#include <string>
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

// Where limits of this process may stand: its group's folder and all above it, of both versions.
std::vector<fs::path> limitFiles(const fs::path& root) {
    const fs::path mount = root / "sys/fs/cgroup";
    std::vector<fs::path> files;
    const auto add = [&](fs::path folder, const fs::path& group, const char* name) {
        files.push_back(folder / name); // a container sees its own group here
        for (const fs::path& part : group.relative_path()) {
            folder /= part;
            files.push_back(folder / name);
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
            add(mount, group, "memory.max");
        } else if (("," + controllers + ",").find(",memory,") != std::string::npos) {
            add(mount / "memory", group, "memory.limit_in_bytes");
        }
    }
    return files;
}

std::optional<uint64_t> totalMemory(const fs::path& root) {
    std::ifstream file(root / "proc/meminfo");
    std::string name;
    uint64_t kib = 0;
    return file >> name >> kib && name == "MemTotal:" ? std::optional(kib << 10U) : std::nullopt;
}

} // namespace

std::optional<uint64_t> hostMemoryBytes(const fs::path& root) {
    std::optional<uint64_t> least = totalMemory(root);
    for (const fs::path& file : limitFiles(root)) {
        if (const auto limit = readBytes(file)) {
            least = std::min(least.value_or(*limit), *limit);
        }
    }
    return least;
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
    const auto share = [](std::optional<uint64_t> bytes, double part) {
        return bytes ? static_cast<uint64_t>(part * static_cast<double>(*bytes))
                     : render::MemoryLimits::kNone;
    };
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
