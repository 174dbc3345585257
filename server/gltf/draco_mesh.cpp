#include "gltf/draco_mesh.h"

#include "core/text.h"
#include "gltf/failure.h"
#include "gltf/limits.h"

#include <algorithm>
#include <cmath>
#include <draco/compression/decode.h>
#include <draco/compression/point_cloud/point_cloud_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/metadata_decoder.h>
#include <limits>

namespace froxel::gltf {
namespace {

constexpr uint16_t kBitstream = 0x0202; // the only version that glTF allows

draco::DecoderBuffer bufferOf(std::span<const std::byte> stream) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(stream.data()), stream.size());
    return buffer;
}

template <class T>
float normalizedValue(float value) {
    return std::max(value / static_cast<float>(std::numeric_limits<T>::max()), -1.0F);
}

// Draco's own flag may be missing although the accessor says that the integers are normalised.
float normalize(float value, draco::DataType type) {
    switch (type) {
    case draco::DT_INT8:
        return normalizedValue<int8_t>(value);
    case draco::DT_UINT8:
        return normalizedValue<uint8_t>(value);
    case draco::DT_INT16:
        return normalizedValue<int16_t>(value);
    case draco::DT_UINT16:
        return normalizedValue<uint16_t>(value);
    default:
        return value;
    }
}

} // namespace

// The part of the stream in front of the connectivity, by Draco's own readers.
DracoCounts readDracoCounts(std::span<const std::byte> stream, const std::string& user) {
    draco::DecoderBuffer buffer = bufferOf(stream);
    draco::DracoHeader header{};
    if (!draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok()) {
        fail(user + " has no Draco header");
    }
    if (header.version_major != 2 || header.version_minor != 2 ||
        header.encoder_type != draco::TRIANGULAR_MESH) {
        fail(user + " has a Draco stream of version " + std::to_string(header.version_major) + "." +
             std::to_string(header.version_minor) + " and type " +
             std::to_string(header.encoder_type) + "; expected a mesh (1) of version 2.2");
    }
    buffer.set_bitstream_version(kBitstream);
    bool good = true;
    if ((header.flags & METADATA_FLAG_MASK) != 0) {
        draco::GeometryMetadata metadata;
        good = draco::MetadataDecoder().DecodeGeometryMetadata(&buffer, &metadata);
    }
    uint32_t vertices = 0;
    uint32_t triangles = 0;
    if (header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING) {
        uint8_t traversal = 0;
        good = good && buffer.Decode(&traversal) && draco::DecodeVarint(&vertices, &buffer) &&
               draco::DecodeVarint(&triangles, &buffer);
    } else {
        good = good && draco::DecodeVarint(&triangles, &buffer) &&
               draco::DecodeVarint(&vertices, &buffer);
    }
    if (!good) {
        fail(user + " has a Draco stream that is cut off in its header");
    }
    if (triangles > stream.size() * kDracoFacesOfByte) {
        fail(user + " has a Draco stream of " + std::to_string(stream.size()) +
             " bytes that says it has " + std::to_string(triangles) + " triangles");
    }
    return {vertices, triangles};
}

DracoMesh::DracoMesh(std::span<const std::byte> stream,
                     std::map<std::string, int> attributes,
                     const std::string& user)
    : attributes_(std::move(attributes)) {
    draco::DecoderBuffer buffer = bufferOf(stream);
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok()) {
        fail(user +
             " has a broken Draco stream: " + printable(decoded.status().error_msg_string()));
    }
    mesh_ = std::move(decoded).value();
    if (mesh_ == nullptr) {
        fail(user + " has a Draco stream without a mesh");
    }
}

uint64_t DracoMesh::vertexCount() const {
    return mesh_->num_points();
}

uint64_t DracoMesh::triangleCount() const {
    return mesh_->num_faces();
}

DracoMesh::~DracoMesh() = default;

std::vector<uint32_t> DracoMesh::indices() const {
    std::vector<uint32_t> result;
    result.reserve(size_t{mesh_->num_faces()} * 3);
    for (draco::FaceIndex face(0); face < mesh_->num_faces(); ++face) {
        for (const draco::PointIndex& corner : mesh_->face(face)) {
            result.push_back(corner.value());
        }
    }
    return result;
}

template <int N>
std::vector<glm::vec<N, float>>
DracoMesh::vectors(const std::string& semantic, bool normalized, const std::string& user) const {
    const int id = attributes_.at(semantic);
    const draco::PointAttribute* attribute =
        mesh_->GetAttributeByUniqueId(static_cast<uint32_t>(id));
    if (attribute == nullptr || attribute->num_components() != N) {
        fail(user + " uses the Draco attribute " + std::to_string(id) +
             (attribute == nullptr ? ", which the stream does not have"
                                   : ", which does not have " + std::to_string(N) + " components"));
    }
    const bool divide = normalized && !attribute->normalized();
    std::vector<glm::vec<N, float>> result(mesh_->num_points());
    for (draco::PointIndex point(0); point < mesh_->num_points(); ++point) {
        const draco::AttributeValueIndex index = attribute->mapped_index(point);
        glm::vec<N, float>& value = result[point.value()];
        if (index >= static_cast<uint32_t>(attribute->size()) ||
            !attribute->ConvertValue<float, N>(index, &value[0])) {
            fail(user + " has a Draco attribute that cannot be read as numbers at vertex " +
                 std::to_string(point.value()));
        }
        for (int c = 0; divide && c < N; ++c) {
            value[c] = normalize(value[c], attribute->data_type());
        }
    }
    return result;
}

template std::vector<glm::vec2>
DracoMesh::vectors<2>(const std::string&, bool, const std::string&) const;
template std::vector<glm::vec3>
DracoMesh::vectors<3>(const std::string&, bool, const std::string&) const;
template std::vector<glm::vec4>
DracoMesh::vectors<4>(const std::string&, bool, const std::string&) const;

} // namespace froxel::gltf
