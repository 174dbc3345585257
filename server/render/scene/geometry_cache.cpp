#include "render/scene/geometry_cache.h"

#include "core/parallel.h"
#include "core/replace_file.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <meshoptimizer.h>
#include <openssl/evp.h>
#include <span>
#include <string>
#include <vector>

namespace froxel::render {
namespace {

namespace fs = std::filesystem;
using Bytes = std::span<const std::byte>;

constexpr std::array<char, 8> kMagic = {'F', 'R', 'O', 'X', 'G', 'E', '0', '1'};
constexpr std::string_view kPrefix = "geometry-";
constexpr size_t kChunkBytes = size_t{4} << 20U; // that are hashed by themselves

struct Counts {
    uint64_t primitives = 0;
    uint64_t meshlets = 0;
    uint64_t details = 0;
    uint64_t words = 0;
    uint64_t indices = 0; // these are not in the file
};

struct Header {
    std::array<char, 8> magic = kMagic;
    GeometryHash hash{};
    GeometryHash content{}; // of what follows
    Counts counts;
};
static_assert(sizeof(Header) == 112);

// What follows the header, in this order.
struct Content {
    std::vector<TriangleRanges> ranges; // mesh by mesh
    std::vector<Meshlet> meshlets;
    std::vector<MeshletDetail> details;
    std::vector<uint32_t> words;
};

std::array<Bytes, 4> bytesOf(std::span<const TriangleRanges> ranges,
                             std::span<const Meshlet> meshlets,
                             std::span<const MeshletDetail> details,
                             std::span<const uint32_t> words) {
    return {std::as_bytes(ranges), std::as_bytes(meshlets), std::as_bytes(details),
            std::as_bytes(words)};
}

GeometryHash sha256(Bytes bytes) {
    GeometryHash hash;
    EVP_Digest(bytes.data(), bytes.size(), reinterpret_cast<unsigned char*>(hash.data()), nullptr,
               EVP_sha256(), nullptr);
    return hash;
}

// Of the parts' lengths, and of the hashes of their chunks, which are taken on several threads.
GeometryHash hashOf(std::span<const Bytes> parts) {
    std::vector<Bytes> chunks;
    std::vector<uint64_t> lengths;
    size_t bytes = 0;
    for (Bytes part : parts) {
        lengths.push_back(part.size());
        bytes += part.size();
        while (!part.empty()) {
            chunks.push_back(part.first(std::min(part.size(), kChunkBytes)));
            part = part.subspan(chunks.back().size());
        }
    }
    std::vector<GeometryHash> hashes(chunks.size() + 1);
    hashes[chunks.size()] = sha256(std::as_bytes(std::span(lengths)));
    eachOnThreads(chunks.size(), threadCount(bytes, kChunkBytes),
                  [&](size_t i) { hashes[i] = sha256(chunks[i]); });
    return sha256(std::as_bytes(std::span(hashes)));
}

GeometryHash hashOf(const Counts& counts, std::span<const Bytes> content) {
    std::vector<Bytes> parts(content.begin(), content.end());
    parts.push_back(std::as_bytes(std::span(&counts, 1)));
    return hashOf(parts);
}

// Empty where all is there, else what is wrong.
std::string
readContent(const fs::path& file, const GeometryHash& hash, Header& header, Content& out) {
    std::ifstream stream(file, std::ios::binary);
    stream.read(reinterpret_cast<char*>(&header), sizeof(header));
    std::error_code failure;
    const uint64_t size = fs::file_size(file, failure);
    if (!stream || failure || header.magic != kMagic || header.hash != hash) {
        return "is not the geometry that its name says";
    }
    // No product overflows, since no file has 2^58 bytes.
    const std::array counts = {header.counts.primitives, header.counts.meshlets,
                               header.counts.details, header.counts.words};
    if (std::ranges::any_of(counts, [&](uint64_t count) { return count > size; }) ||
        sizeof(Header) + header.counts.primitives * sizeof(TriangleRanges) +
                header.counts.meshlets * sizeof(Meshlet) +
                header.counts.details * sizeof(MeshletDetail) +
                header.counts.words * sizeof(uint32_t) !=
            size) {
        return "is not as long as it states";
    }
    const auto read = [&](auto& to, uint64_t count) {
        to.resize(count);
        const auto bytes = std::as_writable_bytes(std::span(to));
        stream.read(reinterpret_cast<char*>(bytes.data()),
                    static_cast<std::streamsize>(bytes.size()));
    };
    read(out.ranges, header.counts.primitives);
    read(out.meshlets, header.counts.meshlets);
    read(out.details, header.counts.details);
    read(out.words, header.counts.words);
    const auto content = bytesOf(out.ranges, out.meshlets, out.details, out.words);
    return stream && hashOf(header.counts, content) == header.content ? "" : "is damaged";
}

bool isWithin(uint64_t first, uint64_t count, uint64_t size) {
    return first + count <= size;
}

// Checks meshlets [first, first + count) of a primitive, and writes what their words say into
// `indices`.
bool expand(const Content& content,
            uint32_t first,
            uint32_t count,
            size_t vertex_count,
            std::span<uint32_t> indices) {
    if (!isWithin(first, count, content.meshlets.size())) {
        return false;
    }
    std::atomic<bool> good = true;
    onThreads(count, threadCount(count, 1024), [&](size_t, size_t begin, size_t end) {
        for (size_t m = first + begin; m < first + end; ++m) {
            const Meshlet& meshlet = content.meshlets[m];
            const uint64_t words = uint64_t{meshlet.vertex_count} + meshlet.index_count / 3;
            if (meshlet.index_count % 3 != 0 || meshlet.vertex_count > io::kMeshletVertices ||
                meshlet.index_count > 3 * io::kMeshletTriangles ||
                !isWithin(meshlet.first_word, words, content.words.size()) ||
                !isWithin(meshlet.first_index, meshlet.index_count, indices.size())) {
                good = false;
                return;
            }
            const MeshletTriangles of(meshlet, content.words);
            for (uint32_t i = 0; i < meshlet.index_count; ++i) {
                const uint32_t local = localVertex(of.triangles[i / 3], i % 3);
                if (local >= of.vertices.size() || of.vertices[local] >= vertex_count) {
                    good = false;
                    return;
                }
                indices[meshlet.first_index + i] = of.vertices[local];
            }
        }
    });
    return good;
}

// The indices that the words say; none where the content makes no sense.
std::vector<uint32_t>
indicesOf(const Content& content, uint64_t index_count, const scene::Scene& scene) {
    if (index_count > 3 * content.words.size() ||
        (!content.details.empty() && content.details.size() != content.meshlets.size())) {
        return {};
    }
    std::vector<uint32_t> indices(index_count);
    auto ranges = content.ranges.begin();
    for (const auto& mesh : scene.meshes) {
        for (const auto& primitive : mesh.primitives) {
            if (ranges == content.ranges.end() ||
                !isWithin(ranges->first_index, ranges->index_count, index_count) ||
                !expand(content, ranges->first_meshlet, ranges->meshlet_count,
                        primitive.positions.size(), indices) ||
                !expand(content, ranges->first_coarser_meshlet, ranges->coarser_meshlet_count,
                        primitive.positions.size(), indices)) {
                return {};
            }
            ++ranges;
        }
    }
    return ranges == content.ranges.end() ? std::move(indices) : std::vector<uint32_t>();
}

// Removes files beside this one, those used longest ago first, until there is room for so much.
void makeRoom(const fs::path& file, uint64_t bytes, uint64_t most_bytes) {
    struct Found {
        fs::file_time_type used;
        fs::path path;
        uint64_t bytes = 0;
    };
    std::vector<Found> found;
    std::error_code failure;
    for (const auto& entry : fs::directory_iterator(file.parent_path(), failure)) {
        std::error_code gone;
        if (entry.path() != file && entry.path().filename().string().starts_with(kPrefix)) {
            found.push_back({entry.last_write_time(gone), entry.path(), entry.file_size(gone)});
            bytes += gone ? 0 : found.back().bytes;
        }
    }
    std::ranges::sort(found, {}, &Found::used);
    for (const Found& oldest : found) {
        if (bytes <= most_bytes) {
            return;
        }
        fs::remove(oldest.path, failure);
        bytes -= oldest.bytes;
    }
}

} // namespace

GeometryHash hashOfGeometry(const scene::Scene& scene, const PackOptions& options) {
    std::vector<Bytes> parts;
    std::vector<uint8_t> kinds;
    const std::vector<bool> bent = bentMeshes(scene);
    for (size_t m = 0; m < scene.meshes.size(); ++m) {
        for (const auto& primitive : scene.meshes[m].primitives) {
            parts.push_back(std::as_bytes(std::span(primitive.positions)));
            parts.push_back(std::as_bytes(std::span(primitive.indices)));
            kinds.push_back(isExtended(primitive) ? 1 : 0);
        }
        kinds.push_back(bent[m] ? 3 : 2);
    }
    const std::array<uint64_t, 3> how = {options.most_at_once, options.detail_levels ? 1U : 0U,
                                         MESHOPTIMIZER_VERSION};
    constexpr std::string_view kCode = FROXEL_HASH_OF_PACKING;
    parts.push_back(std::as_bytes(std::span(kinds)));
    parts.push_back(std::as_bytes(std::span(how)));
    parts.push_back(std::as_bytes(std::span(kCode)));
    return hashOf(parts);
}

fs::path geometryCacheFile(const fs::path& folder, const GeometryHash& hash) {
    std::string name(kPrefix);
    for (const std::byte byte : std::span(hash).first(16)) {
        name += fmt::format("{:02x}", std::to_integer<unsigned>(byte));
    }
    return folder / (name + ".bin");
}

bool readGeometry(const fs::path& file,
                  const GeometryHash& hash,
                  const scene::Scene& scene,
                  PackedGeometry& out) {
    std::error_code failure;
    if (!fs::exists(file, failure)) {
        return false;
    }
    Header header;
    Content content;
    std::string fault = readContent(file, hash, header, content);
    std::vector<uint32_t> indices;
    if (fault.empty()) {
        indices = indicesOf(content, header.counts.indices, scene);
        fault = indices.empty() ? "makes no sense" : "";
    }
    if (!fault.empty()) {
        spdlog::warn("event=geometry_cache_ignored file='{}' reason=\"it {}\"", file.string(),
                     fault);
        return false;
    }
    out.triangles = {std::move(indices), std::move(content.words), std::move(content.meshlets)};
    out.details = std::move(content.details);
    auto ranges = content.ranges.begin();
    for (auto& mesh : out.meshes) {
        for (PackedPrimitive& primitive : mesh) {
            static_cast<TriangleRanges&>(primitive) = *ranges++;
        }
    }
    fs::last_write_time(file, fs::file_time_type::clock::now(), failure); // it was used
    return true;
}

Result<void> writeGeometry(const fs::path& file,
                           const GeometryHash& hash,
                           const PackedGeometry& packed,
                           uint64_t most_bytes) {
    std::vector<TriangleRanges> ranges;
    for (const auto& mesh : packed.meshes) {
        for (const PackedPrimitive& primitive : mesh) {
            ranges.push_back(primitive);
        }
    }
    const auto content =
        bytesOf(ranges, packed.triangles.meshlets, packed.details, packed.triangles.words);
    const Counts counts = {ranges.size(), packed.triangles.meshlets.size(), packed.details.size(),
                           packed.triangles.words.size(), packed.triangles.indices.size()};
    const Header header{.hash = hash, .content = hashOf(counts, content), .counts = counts};
    std::vector<Bytes> parts = {std::as_bytes(std::span(&header, 1))};
    parts.insert(parts.end(), content.begin(), content.end());
    uint64_t bytes = 0;
    for (const Bytes part : parts) {
        bytes += part.size();
    }
    if (bytes > most_bytes) {
        return Error{ErrorCode::kIo, fmt::format("'{}' would take {} bytes; the most is {}",
                                                 file.string(), bytes, most_bytes)};
    }
    makeRoom(file, bytes, most_bytes);
    return replaceFile(file, parts, Durable::kNo);
}

} // namespace froxel::render
