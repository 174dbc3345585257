// What the loader says when it does not have to give up: the one list of a scene's warnings, and of
// their kinds.
#pragma once

#include "scene/scene.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace froxel::gltf {

struct WarningKind {
    const char* code;
    scene::Severity severity;
    size_t most = 10; // that are kept
};

// Codes are the Khronos validator's where it has one for the thing (its ISSUES.md).
namespace warning {

inline constexpr auto kWarning = scene::Severity::kWarning;
inline constexpr auto kInformation = scene::Severity::kInformation;

// The file as a whole.
inline constexpr WarningKind kNameLength{"NAME_TOO_LONG", kInformation};
inline constexpr WarningKind kTooMany{"TOO_MANY_TO_CHOOSE", kWarning};
inline constexpr WarningKind kUnsupportedExtension{"UNSUPPORTED_EXTENSION", kWarning, 100};
inline constexpr WarningKind kUnsupportedMetadata{"UNSUPPORTED_EXTENSION", kInformation};
inline constexpr WarningKind kType{"TYPE_MISMATCH", kWarning};
inline constexpr WarningKind kByteOrderMark{"BYTE_ORDER_MARK", kInformation};
inline constexpr WarningKind kGlbLength{"GLB_LENGTH_MISMATCH", kInformation};
// Nodes and scenes.
inline constexpr WarningKind kNoScene{"NO_SCENE", kInformation};
inline constexpr WarningKind kNothingDrawn{"NOTHING_DRAWN", kWarning};
inline constexpr WarningKind kListedChild{"SCENE_NON_ROOT_NODE", kInformation};
inline constexpr WarningKind kListedTwice{"DUPLICATE_ELEMENTS", kInformation};
inline constexpr WarningKind kTwoParents{"NODE_PARENT_OVERRIDE", kWarning};
inline constexpr WarningKind kRotationLength{"NODE_ROTATION_NON_UNIT", kInformation};
inline constexpr WarningKind kRotationZero{"NODE_ROTATION_NON_UNIT", kWarning};
inline constexpr WarningKind kLastRow{"NODE_MATRIX_NON_TRS", kWarning};
inline constexpr WarningKind kFarAway{"NODE_TRANSFORM_RANGE", kWarning};
inline constexpr WarningKind kShear{"NODE_MATRIX_NON_TRS", kInformation};
// Accessors and primitives.
inline constexpr WarningKind kByteStride{"VALUE_NOT_IN_RANGE", kInformation};
inline constexpr WarningKind kAlignment{"ACCESSOR_TOTAL_OFFSET_ALIGNMENT", kInformation};
inline constexpr WarningKind kNotFinite{"ACCESSOR_INVALID_FLOAT", kWarning};
inline constexpr WarningKind kLengthZero{"ACCESSOR_NON_UNIT", kWarning};
inline constexpr WarningKind kNoPosition{"MESH_PRIMITIVE_NO_POSITION", kWarning};
inline constexpr WarningKind kNoStream{"VERTEX_STREAM_NOT_READ", kWarning};
inline constexpr WarningKind kNoTriangles{"MODE_NOT_DRAWN", kWarning};
inline constexpr WarningKind kUnknownMode{"VALUE_NOT_IN_LIST", kWarning};
inline constexpr WarningKind kCountOff{"MESH_PRIMITIVE_INCOMPATIBLE_MODE", kWarning};
inline constexpr WarningKind kNoTexcoord{"MESH_PRIMITIVE_TOO_FEW_TEXCOORDS", kWarning};
inline constexpr WarningKind kDracoCounts{"DRACO_COUNTS_NOT_THE_ACCESSORS", kWarning};
// Skins and animations.
inline constexpr WarningKind kUnresolved{"UNRESOLVED_REFERENCE", kWarning};
inline constexpr WarningKind kWeightSum{"ACCESSOR_WEIGHTS_NON_NORMALIZED", kInformation};
inline constexpr WarningKind kNoWeights{"ACCESSOR_WEIGHTS_NON_NORMALIZED", kWarning};
inline constexpr WarningKind kNoJoints{"EMPTY_ENTITY", kWarning};
inline constexpr WarningKind kHiddenJoint{"NODE_SKIN_NO_SCENE", kWarning};
inline constexpr WarningKind kFewBindMatrices{"INVALID_IBM_ACCESSOR_COUNT", kWarning};
inline constexpr WarningKind kNoBindMatrices{"SKIN_NOT_READ", kWarning};
inline constexpr WarningKind kSkinnedInstances{"SKIN_WITH_INSTANCES", kWarning};
inline constexpr WarningKind kUnknownName{"VALUE_NOT_IN_LIST", kWarning};
inline constexpr WarningKind kNoMorphs{"ANIMATION_CHANNEL_TARGET_NODE_WEIGHTS_NO_MORPHS", kWarning};
inline constexpr WarningKind kAnimatedMatrix{"ANIMATION_CHANNEL_TARGET_NODE_MATRIX", kWarning};
inline constexpr WarningKind kAnimatedTwice{"ANIMATION_DUPLICATE_TARGETS", kWarning};
inline constexpr WarningKind kNoTrack{"ANIMATION_NOT_READ", kWarning};
inline constexpr WarningKind kNoKeys{"ANIMATION_SAMPLER_INPUT_ACCESSOR_TOO_FEW_ELEMENTS", kWarning};
inline constexpr WarningKind kKeyOrder{"ACCESSOR_ANIMATION_INPUT_NON_INCREASING", kWarning};
inline constexpr WarningKind kKeyValues{"ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_COUNT",
                                        kWarning};
// Cameras and lights.
inline constexpr WarningKind kCameraValue{"VALUE_NOT_IN_RANGE", kWarning};
inline constexpr WarningKind kLightValue{"VALUE_NOT_IN_RANGE", kWarning};
inline constexpr WarningKind kConeAngles{"KHR_LIGHTS_PUNCTUAL_LIGHT_SPOT_ANGLES", kWarning};
inline constexpr WarningKind kNoDirection{"NODE_SCALE_ZERO", kWarning};
// Materials, textures and images.
inline constexpr WarningKind kNoIndex{"UNDEFINED_PROPERTY", kWarning};
inline constexpr WarningKind kVariantTwice{"DUPLICATE_ELEMENTS", kWarning};
inline constexpr WarningKind kSamplerValue{"VALUE_NOT_IN_LIST", kWarning};
inline constexpr WarningKind kUri{"INVALID_URI", kWarning};
inline constexpr WarningKind kFactorRange{"VALUE_NOT_IN_RANGE", kWarning};
inline constexpr WarningKind kThirdTexcoord{"TEXCOORD_NOT_READ", kWarning};
inline constexpr WarningKind kNoSource{"TEXTURE_WITHOUT_IMAGE", kWarning};
inline constexpr WarningKind kMissingFile{"FILE_NOT_FOUND", kWarning};
inline constexpr WarningKind kBrokenImage{"IMAGE_DATA_INVALID", kWarning};
inline constexpr WarningKind kImageFormat{"IMAGE_UNRECOGNIZED_FORMAT", kWarning};
inline constexpr WarningKind kMimeType{"IMAGE_MIME_TYPE_INVALID", kInformation};

} // namespace warning

// Bounded: a few of each kind are kept, the others counted. So a file of a thousand broken
// primitives still says what else is wrong with it. Not thread-safe.
class Warnings {
  public:
    // `message` is one printable line; the same place and words count once while they are kept.
    void add(const WarningKind& kind, std::string pointer, std::string message);

    // To those of `scene.warnings`, the gravest first.
    void moveInto(scene::Scene& scene);

  private:
    std::vector<scene::Warning> kept_;
    std::set<std::pair<std::string, std::string>> known_; // place and words of what is kept
    std::map<std::pair<std::string_view, scene::Severity>, size_t> kept_of_kind_;
    uint64_t left_out_count_ = 0;
};

// That so many of what people choose by name were left out; nothing where none was.
void tellTooMany(const std::string& things, size_t left_out, Warnings& warnings);

// "/meshes/3": what pointers to elements of the file's arrays begin with.
[[nodiscard]] inline std::string pointerTo(const char* array, size_t index) {
    return "/" + std::string(array) + "/" + std::to_string(index);
}

} // namespace froxel::gltf
