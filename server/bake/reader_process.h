// A scene that a process of its own reads: whatever its file does to the reader, this process stays
// as it was.
#pragma once

#include "bake/isolation.h"
#include "core/error.h"
#include "core/progress.h"
#include "gltf/file_opener.h"
#include "gltf/gltf_loader.h"
#include "scene/scene.h"

#include <filesystem>
#include <string>

namespace froxel::bake {

// kOff: files are read in this process. kBest: with what isolation the system offers. kRequire:
// with all of it, or not at all.
enum class Sandbox : uint8_t { kOff, kBest, kRequire };

struct ReaderProcess {
    Sandbox sandbox = Sandbox::kOff;
    std::filesystem::path binary = "/proc/self/exe"; // `binary` bake reads
    uint32_t cpu_s = 3600;                           // that it may take, of all threads
    std::string form_boundary{};                     // as Task has it
};

// As gltf::load(), whose messages it gives. Also of a reader that crashes, is killed, or hands back
// what is no scene: kScene, one line that says at which stage. kUnsupported: the isolation that is
// required is not there. Any thread; asks `report` ten times a second, and ends the reader where
// that says so.
[[nodiscard]] Result<scene::Scene> load(const std::filesystem::path& file,
                                        const ReaderProcess& process,
                                        const ProgressReport& report = workOn,
                                        const gltf::LoadLimits& limits = {});

// Likewise of files that somebody else opens, and always in a process of its own; `file` names the
// scene. Without Scene::files. kUnsupported: `process` has none.
[[nodiscard]] Result<scene::Scene> loadFrom(gltf::FileOpener& opener,
                                            const std::filesystem::path& file,
                                            const ReaderProcess& process,
                                            const ProgressReport& report,
                                            uint64_t memory_bytes);

} // namespace froxel::bake
