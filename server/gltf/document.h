// A scene file, parsed: tinygltf's model and, beside it, what tinygltf must not handle itself.
#pragma once

#include "gltf/failure.h"
#include "gltf/scene_files.h"

#include <tiny_gltf.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace froxel::gltf {

struct BufferSource {
    std::string uri; // empty: the GLB's binary chunk, or a fallback without data
    uint64_t size_bytes = 0;
};

struct ImageSource {
    std::string name;
    std::string uri;
    std::string mime_type; // as the file says; what counts are the image's first bytes
    int buffer_view = -1;
};

struct SkinSource {
    std::string name;
    std::vector<int> joints;        // nodes
    int inverse_bind_matrices = -1; // an accessor
};

struct SamplerSource {
    int input = -1; // accessors
    int output = -1;
    std::string interpolation;
};

struct ChannelSource {
    int sampler = -1; // of the clip
    int node = -1;    // none: an extension's target
    std::string path;
};

struct CameraSource {
    std::string name;
    std::string type;
    double size = 0; // yfov or ymag; 0: none
    double near_m = 0;
};

struct LightSource {
    std::string name;
    std::string type;
    std::vector<double> color;
    double intensity = 1;
    double range_m = 0; // none
    double inner_cone_rad = 0;
    double outer_cone_rad = 0;
};

struct ClipSource {
    std::string name;
    std::vector<SamplerSource> samplers;
    std::vector<ChannelSource> channels;
};

// Buffers, images, strides and index accessors are kept aside: tinygltf would read files by its own
// rules, touch unchecked offsets, refuse strides that are no multiple of 4 and the accessors
// without data that compressed meshes have. It would also refuse the whole file for a camera or a
// light that lacks something.
struct Document {
    // Without buffers, images, skins, animations, cameras, lights, primitive indices, byte strides.
    tinygltf::Model model;
    std::vector<BufferSource> buffers;
    std::vector<size_t> strides; // [bufferView]: bytes between elements; 0: tightly packed
    std::vector<ImageSource> images;
    std::vector<std::vector<int>> indices; // [mesh][primitive]: an accessor, or -1
    std::vector<SkinSource> skins;
    std::vector<ClipSource> clips;
    std::vector<CameraSource> cameras;
    std::vector<LightSource> lights;            // KHR_lights_punctual
    std::vector<std::string> material_variants; // names of KHR_materials_variants
    std::vector<scene::Extension> extensions;
    Bytes file;
    std::span<const std::byte> binary_chunk; // in `file`
};

// Throws Failure, also where `memory` is not enough; std::bad_alloc.
[[nodiscard]] Document readDocument(SceneFiles& files, ReadMemory& memory, Warnings& warnings);

} // namespace froxel::gltf
