#include "gltf/meshopt_view.h"

#include "core/text.h"
#include "gltf/extension_value.h"
#include "gltf/failure.h"
#include "gltf/limits.h"

#include <tiny_gltf.h>

#include <meshoptimizer.h>

namespace froxel::gltf {
namespace {

// Data of KHR_meshopt_compression may need a newer one than the library is.
std::string libraryVersion() {
    return std::to_string(MESHOPTIMIZER_VERSION / 1000) + "." +
           std::to_string(MESHOPTIMIZER_VERSION % 1000 / 10);
}

MeshoptMode modeFrom(const std::string& text, const std::string& name) {
    if (text == "ATTRIBUTES") {
        return MeshoptMode::kAttributes;
    }
    if (text == "TRIANGLES") {
        return MeshoptMode::kTriangles;
    }
    if (text == "INDICES") {
        return MeshoptMode::kIndices;
    }
    fail(name + " has the meshopt mode '" + printable(text) +
         "'; expected ATTRIBUTES, TRIANGLES or INDICES");
}

MeshoptFilter filterFrom(const std::string& text, const std::string& name) {
    if (text == "NONE") {
        return MeshoptFilter::kNone;
    }
    if (text == "OCTAHEDRAL") {
        return MeshoptFilter::kOctahedral;
    }
    if (text == "QUATERNION") {
        return MeshoptFilter::kQuaternion;
    }
    if (text == "EXPONENTIAL") {
        return MeshoptFilter::kExponential;
    }
    fail(name + " has the meshopt filter '" + printable(text) +
         "'; expected NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL");
}

// The decoders take these as preconditions and check them by assert at most.
bool strideFits(const MeshoptView& view) {
    if (view.mode != MeshoptMode::kAttributes) {
        return view.stride_bytes == 2 || view.stride_bytes == 4;
    }
    switch (view.filter) {
    case MeshoptFilter::kOctahedral:
        return view.stride_bytes == 4 || view.stride_bytes == 8;
    case MeshoptFilter::kQuaternion:
        return view.stride_bytes == 8;
    default:
        return view.stride_bytes >= 4 && view.stride_bytes <= 256 && view.stride_bytes % 4 == 0;
    }
}

void applyFilter(const MeshoptView& view, Bytes& bytes) {
    switch (view.filter) {
    case MeshoptFilter::kNone:
        break;
    case MeshoptFilter::kOctahedral:
        meshopt_decodeFilterOct(bytes.data(), view.count, view.stride_bytes);
        break;
    case MeshoptFilter::kQuaternion:
        meshopt_decodeFilterQuat(bytes.data(), view.count, view.stride_bytes);
        break;
    case MeshoptFilter::kExponential:
        meshopt_decodeFilterExp(bytes.data(), view.count, view.stride_bytes);
        break;
    }
}

} // namespace

std::optional<MeshoptView> meshoptView(const tinygltf::BufferView& view, const std::string& name) {
    const tinygltf::Value* extension = findExtension(view.extensions, "EXT_meshopt_compression");
    if (extension == nullptr) { // its successor has the same members
        extension = findExtension(view.extensions, "KHR_meshopt_compression");
    }
    if (extension == nullptr) {
        return std::nullopt;
    }
    MeshoptView result;
    result.buffer = intOr(*extension, "buffer", -1);
    result.offset_bytes = static_cast<uint64_t>(numberOr(*extension, "byteOffset", 0));
    result.size_bytes = static_cast<uint64_t>(numberOr(*extension, "byteLength", 0));
    result.stride_bytes = static_cast<size_t>(intOr(*extension, "byteStride", 0));
    result.count = static_cast<size_t>(intOr(*extension, "count", 0));
    result.mode = modeFrom(textOr(*extension, "mode", ""), name);
    result.filter = filterFrom(textOr(*extension, "filter", "NONE"), name);
    if (!strideFits(result)) {
        fail(name + " has the meshopt byteStride " + std::to_string(result.stride_bytes) +
             "; expected 2 or 4 for indices, a multiple of 4 up to 256 for attributes, 4 or 8 for "
             "OCTAHEDRAL and 8 for QUATERNION");
    }
    if (result.mode == MeshoptMode::kTriangles && result.count % 3 != 0) {
        fail(name + " has the meshopt count " + std::to_string(result.count) +
             "; expected a multiple of 3 for TRIANGLES");
    }
    if (result.mode != MeshoptMode::kAttributes && result.filter != MeshoptFilter::kNone) {
        fail(name + " has a meshopt filter on indices; expected NONE");
    }
    return result;
}

void checkRatio(const MeshoptView& view, const std::string& name) {
    const uint64_t ratio = view.mode == MeshoptMode::kAttributes  ? kMeshoptVertexRatio
                           : view.mode == MeshoptMode::kTriangles ? kMeshoptTriangleRatio
                                                                  : kMeshoptIndexRatio;
    if (view.decodedBytes() > view.size_bytes * ratio) {
        fail(name + " says " + std::to_string(view.size_bytes) + " bytes of meshopt data hold " +
             std::to_string(view.decodedBytes()) + "; they can hold at most " +
             std::to_string(view.size_bytes * ratio));
    }
}

Bytes decodeMeshopt(const MeshoptView& view,
                    std::span<const std::byte> encoded,
                    const std::string& name) {
    Bytes bytes(view.decodedBytes());
    const auto* data = reinterpret_cast<const unsigned char*>(encoded.data());
    int status = 0;
    switch (view.mode) {
    case MeshoptMode::kAttributes:
        status = meshopt_decodeVertexBuffer(bytes.data(), view.count, view.stride_bytes, data,
                                            encoded.size());
        break;
    case MeshoptMode::kTriangles:
        status = meshopt_decodeIndexBuffer(bytes.data(), view.count, view.stride_bytes, data,
                                           encoded.size());
        break;
    case MeshoptMode::kIndices:
        status = meshopt_decodeIndexSequence(bytes.data(), view.count, view.stride_bytes, data,
                                             encoded.size());
        break;
    }
    if (status != 0) {
        fail(name + " has " + std::to_string(encoded.size()) +
             " bytes of meshopt data that do not decode to " + std::to_string(view.count) +
             " elements of " + std::to_string(view.stride_bytes) + " bytes, as meshoptimizer " +
             libraryVersion() + " reads it");
    }
    applyFilter(view, bytes);
    return bytes;
}

} // namespace froxel::gltf
