#include "gpu/pipeline_cache.h"

#include "core/replace_file.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>

namespace froxel::gpu {

namespace {

namespace fs = std::filesystem;

constexpr std::array<char, 8> kMagic = {'F', 'R', 'O', 'X', 'P', 'C', '0', '1'};
constexpr uint64_t kLargestBytes = uint64_t{256} << 20U; // more is not believed

struct Header {
    std::array<char, 8> magic = kMagic;
    PipelineCacheKey key;
    uint64_t length = 0; // of what follows
    uint64_t hash = 0;   // of what follows
};
static_assert(sizeof(Header) == 64);

// What Vulkan itself puts first: VkPipelineCacheHeaderVersionOne.
struct VulkanHeader {
    uint32_t size = 0;
    uint32_t version = 0;
    uint32_t vendor = 0;
    uint32_t device = 0;
    std::array<uint8_t, 16> uuid{};
};
static_assert(sizeof(VulkanHeader) == 32);

// Empty: the driver may be given these bytes.
std::string faultOf(std::span<const std::byte> bytes, const PipelineCacheKey& key) {
    VulkanHeader header;
    if (bytes.size() < sizeof(header)) {
        return "is shorter than Vulkan's header";
    }
    std::memcpy(&header, bytes.data(), sizeof(header));
    if (header.size < sizeof(header) || header.size > bytes.size() || header.version != 1) {
        return "has another kind of Vulkan header";
    }
    if (header.vendor != key.vendor || header.device != key.device || header.uuid != key.uuid) {
        return "belongs to another device or driver";
    }
    return {};
}

std::string faultOf(const Header& header, const PipelineCacheKey& key) {
    if (header.magic != kMagic) {
        return "is not a pipeline cache of froxel";
    }
    if (header.key.vendor != key.vendor || header.key.device != key.device ||
        header.key.uuid != key.uuid || header.key.driver_version != key.driver_version) {
        return "belongs to another device or driver";
    }
    if (header.key.build != key.build) {
        return "belongs to another build";
    }
    return header.length > kLargestBytes ? "states an impossible length" : std::string();
}

fs::path absoluteFrom(const char* variable) {
    const char* value = std::getenv(variable);
    const fs::path path = value != nullptr ? value : "";
    return path.is_absolute() ? path : fs::path();
}

} // namespace

uint64_t hashBytes(std::span<const std::byte> bytes, uint64_t seed) {
    uint64_t hash = seed;
    for (const std::byte byte : bytes) {
        hash = (hash ^ std::to_integer<uint64_t>(byte)) * 0x100000001b3U;
    }
    return hash;
}

fs::path defaultPipelineCacheFolder() {
    if (const fs::path cache = absoluteFrom("XDG_CACHE_HOME"); !cache.empty()) {
        return cache / "froxel";
    }
    const fs::path home = absoluteFrom("HOME");
    return home.empty() ? fs::path() : home / ".cache" / "froxel";
}

fs::path pipelineCacheFile(const fs::path& folder, const PipelineCacheKey& key) {
    static constexpr char kDigits[] = "0123456789abcdef";
    const auto name = hashBytes(std::as_bytes(std::span(key.uuid)));
    std::string text = "pipelines-";
    for (const uint64_t word : {uint64_t{key.vendor} << 32U | key.device, name}) {
        for (int shift = 60; shift >= 0; shift -= 4) {
            text += kDigits[word >> static_cast<unsigned>(shift) & 15U];
        }
    }
    return folder / (text + ".bin");
}

PipelineCacheContent readPipelineCache(const fs::path& file, const PipelineCacheKey& key) {
    errno = 0;
    std::ifstream stream(file, std::ios::binary);
    if (!stream) {
        const bool absent = errno == ENOENT || errno == ENOTDIR;
        return {{}, absent ? "" : "cannot be read"};
    }
    Header header;
    header.magic = {};
    stream.read(reinterpret_cast<char*>(&header), sizeof(header));
    if (!stream) {
        return {{}, "is shorter than its header"};
    }
    if (auto fault = faultOf(header, key); !fault.empty()) {
        return {{}, std::move(fault)};
    }
    std::vector<std::byte> bytes(header.length);
    stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!stream || stream.peek() != std::ifstream::traits_type::eof()) {
        return {{}, "is not as long as it states"};
    }
    if (hashBytes(bytes) != header.hash) {
        return {{}, "is damaged"};
    }
    if (auto fault = faultOf(bytes, key); !fault.empty()) {
        return {{}, std::move(fault)};
    }
    return {std::move(bytes), {}};
}

Result<void> writePipelineCache(const fs::path& file,
                                const PipelineCacheKey& key,
                                std::span<const std::byte> bytes) {
    if (const auto fault = faultOf(bytes, key); !fault.empty()) {
        return Error{ErrorCode::kIo, "what the driver gave to write " + fault};
    }
    const Header header{.key = key, .length = bytes.size(), .hash = hashBytes(bytes)};
    return replaceFile(file, std::array{std::as_bytes(std::span(&header, 1)), bytes},
                       Durable::kYes);
}

} // namespace froxel::gpu
