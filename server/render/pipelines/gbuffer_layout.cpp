#include "render/pipelines/gbuffer_layout.h"

#include "interface/gbuffer_io.h"

namespace froxel::render {

namespace {

using settings::NormalEncoding;
using settings::PositionSource;

static_assert(io::kNormalSpheremap16 == static_cast<uint32_t>(NormalEncoding::kSpheremap16));
static_assert(io::kPositionFp16 == static_cast<uint32_t>(PositionSource::kFp16));

// Halves of a word that packLayout() (shaders/lib/gbuffer.glsl) fills.
uint32_t layoutHalves(const settings::GbufferLayout& layout) {
    const uint32_t z = layout.normal == NormalEncoding::kXyz16 ? 1 : 0;
    switch (layout.position) {
    case PositionSource::kDepth:
        return z;
    case PositionSource::kStoredDepth:
        return 2 + z;
    case PositionSource::kFp32:
        return 6 + z;
    case PositionSource::kFp16:
        return 3 + z;
    }
    return 0;
}

// What dielectrics reflect takes the next whole word.
uint32_t extraHalves(const settings::GbufferLayout& layout, bool specular) {
    const uint32_t halves = layoutHalves(layout);
    return specular ? (halves + 1) / 2 * 2 + 2 : halves;
}

} // namespace

bool holdsSpecular(const settings::GbufferLayout& layout) {
    return extraHalves(layout, true) <= 8;
}

uint32_t layoutFlags(const settings::GbufferLayout& layout) {
    return static_cast<uint32_t>(layout.normal) << io::kOutputNormalShift |
           static_cast<uint32_t>(layout.position) << io::kOutputPositionShift;
}

vk::Format extraFormat(const settings::GbufferLayout& layout, bool specular) {
    const uint32_t halves = extraHalves(layout, specular);
    // Three words are no colour target anywhere: the fourth stays empty.
    return halves == 0   ? vk::Format::eUndefined
           : halves == 1 ? vk::Format::eR16Uint
           : halves == 2 ? vk::Format::eR32Uint
           : halves <= 4 ? vk::Format::eR32G32Uint
                         : vk::Format::eR32G32B32A32Uint;
}

vk::Format extraFormat(uint32_t output_flags) {
    return extraFormat(
        settings::GbufferLayout{
            .normal = static_cast<NormalEncoding>(output_flags >> io::kOutputNormalShift & 7U),
            .position = static_cast<PositionSource>(output_flags >> io::kOutputPositionShift & 3U)},
        (output_flags & io::kOutputSpecular) != 0);
}

uint32_t extraBytes(vk::Format format) {
    switch (format) {
    case vk::Format::eR16Uint:
        return 2;
    case vk::Format::eR32Uint:
        return 4;
    case vk::Format::eR32G32Uint:
        return 8;
    case vk::Format::eR32G32B32A32Uint:
        return 16;
    default:
        return 0;
    }
}

uint32_t gbufferBytesPerPixel(const settings::GbufferLayout& layout, bool wide, bool specular) {
    return (wide ? 16U : 8U) + extraBytes(extraFormat(layout, specular));
}

} // namespace froxel::render
