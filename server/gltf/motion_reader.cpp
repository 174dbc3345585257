#include "gltf/motion_reader.h"

#include "core/text.h"
#include "gltf/failure.h"
#include "gltf/node_transform.h"
#include "gltf/word_table.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace froxel::gltf {
namespace {

using scene::ChannelPath;
using scene::Interpolation;
using scene::kNone;

constexpr std::pair<const char*, ChannelPath> kPaths[] = {
    {"translation", ChannelPath::kTranslation},
    {"rotation", ChannelPath::kRotation},
    {"scale", ChannelPath::kScale},
    {"weights", ChannelPath::kWeights}};

constexpr std::pair<const char*, Interpolation> kInterpolations[] = {
    {"STEP", Interpolation::kStep},
    {"LINEAR", Interpolation::kLinear},
    {"CUBICSPLINE", Interpolation::kCubicSpline}};

bool allFinite(const std::vector<float>& numbers) {
    return std::all_of(numbers.begin(), numbers.end(), [](float n) { return std::isfinite(n); });
}

struct TrackFault {
    WarningKind kind;
    std::string what;
};

std::optional<TrackFault> faultIn(const scene::Track& track) {
    if (track.times_s.empty()) {
        return TrackFault{warning::kNoKeys, "no keys"};
    }
    if (!allFinite(track.times_s) || !allFinite(track.values)) {
        return TrackFault{warning::kNotFinite, "a number that is not finite"};
    }
    if (!std::is_sorted(track.times_s.begin(), track.times_s.end())) {
        return TrackFault{warning::kKeyOrder, "keys that go back in time"};
    }
    const size_t parts = track.interpolation == Interpolation::kCubicSpline ? 3 : 1;
    const size_t right = track.times_s.size() * parts * track.width;
    if (track.values.size() != right) {
        return TrackFault{warning::kKeyValues, std::to_string(track.values.size()) +
                                                   " numbers of output; expected " +
                                                   std::to_string(right)};
    }
    return {};
}

} // namespace

MotionReader::MotionReader(const Document& document,
                           const std::vector<PlacedNode>& placed,
                           std::vector<size_t> weight_counts,
                           AccessorReader& accessors,
                           ReadMemory& memory,
                           Warnings& warnings)
    : document_(document), placed_(placed), weight_counts_(std::move(weight_counts)),
      accessors_(accessors), warnings_(warnings),
      place_of_node_(document.model.nodes.size(), kNone), skins_(document.skins.size()),
      skins_tried_(document.skins.size()), moves_(placed.size()), morphs_(placed.size()),
      needed_(placed.size()), weights_(placed.size()),
      numbers_("numbers of animations", kMaxKeyNumbers, kKeyNumberBytes, memory) {
    for (uint32_t place = 0; place < placed.size(); ++place) {
        place_of_node_[placed[place].node] = place;
    }
    const size_t clip_count = std::min(document.clips.size(), kMaxChoices);
    for (size_t clip = 0; clip < clip_count; ++clip) {
        readClip(clip);
    }
    tellTooMany("animations", document.clips.size() - clip_count, warnings);
    noteMoved();
}

void MotionReader::tell(const WarningKind& kind, const Subject& subject, const std::string& what) {
    warnings_.add(kind, subject.pointer, subject.name + " " + what);
}

uint32_t MotionReader::placeOf(const ChannelSource& channel, const Subject& subject) {
    if (channel.node < 0) {
        return kNone; // the specification has it ignored
    }
    const auto node = static_cast<size_t>(channel.node);
    if (node >= place_of_node_.size()) {
        tell(warning::kUnresolved, subject,
             "moves node " + std::to_string(node) + "; the file has " +
                 std::to_string(place_of_node_.size()) + ", counted from 0; it is not played");
        return kNone;
    }
    return place_of_node_[node];
}

std::optional<ChannelPath>
MotionReader::pathOf(const ChannelSource& channel, size_t place, const Subject& subject) {
    const std::optional<ChannelPath> path = named(kPaths, channel.path);
    if (!path) {
        tell(warning::kUnknownName, subject,
             "has the path '" + printable(channel.path) +
                 "'; expected translation, rotation, scale or weights; it is not played");
        return std::nullopt;
    }
    const bool weights = *path == ChannelPath::kWeights;
    if (weights && weight_counts_[place] == 0) {
        tell(warning::kNoMorphs, subject,
             "moves weights of a node without morph targets; it is not played");
        return std::nullopt;
    }
    if (!weights && !document_.model.nodes[placed_[place].node].matrix.empty()) {
        tell(warning::kAnimatedMatrix, subject,
             "moves a node that has a matrix; expected one with translation, rotation and scale; "
             "it is not played");
        return std::nullopt;
    }
    return path;
}

std::optional<scene::Track> MotionReader::readTrack(const SamplerSource& source,
                                                    ChannelPath path,
                                                    size_t width,
                                                    const Subject& subject) {
    const std::string consequence = "; its targets keep their rest pose";
    const auto interpolation = named(kInterpolations, source.interpolation);
    if (!interpolation) {
        tell(warning::kUnknownName, subject,
             "has the interpolation '" + printable(source.interpolation) +
                 "'; expected STEP, LINEAR or CUBICSPLINE" + consequence);
        return std::nullopt;
    }
    const size_t components = path == ChannelPath::kWeights ? 1 : width;
    scene::Track track{*interpolation, static_cast<uint32_t>(width), {}, {}};
    try {
        numbers_.take(accessors_.count(source.input, subject.name) +
                          accessors_.count(source.output, subject.name) * components,
                      subject.name);
        track.times_s = accessors_.numbers(source.input, 1, subject.name);
        track.values = accessors_.numbers(source.output, components, subject.name);
    } catch (const Failure& failure) {
        warnings_.add(warning::kNoTrack, subject.pointer, failure.what() + consequence);
        return std::nullopt;
    }
    if (const auto fault = faultIn(track)) {
        tell(fault->kind, subject, "has " + fault->what + consequence);
        return std::nullopt;
    }
    return track;
}

void MotionReader::readClip(size_t number) {
    const ClipSource& source = document_.clips[number];
    const std::string pointer = pointerTo("animations", number);
    const std::string name = thing("animation", number);
    scene::Clip& clip = motion_.clips.emplace_back();
    clip.name = source.name;
    std::map<std::pair<int, size_t>, uint32_t> tracks; // by sampler and width; kNone: broken
    std::set<std::pair<uint32_t, ChannelPath>> taken;
    for (size_t c = 0; c < source.channels.size(); ++c) {
        const ChannelSource& channel = source.channels[c];
        const Subject subject{pointer + pointerTo("channels", c), name + " " + thing("channel", c)};
        const uint32_t place = placeOf(channel, subject);
        const auto path = place == kNone ? std::nullopt : pathOf(channel, place, subject);
        if (!path) {
            continue;
        }
        if (!taken.emplace(place, *path).second) {
            tell(warning::kAnimatedTwice, subject,
                 "moves the target of an earlier channel; it is not played");
            continue;
        }
        if (channel.sampler < 0 || static_cast<size_t>(channel.sampler) >= source.samplers.size()) {
            tell(warning::kUnresolved, subject,
                 "uses sampler " + std::to_string(channel.sampler) + " of " +
                     std::to_string(source.samplers.size()) + "; it is not played");
            continue;
        }
        const size_t width = *path == ChannelPath::kWeights    ? weight_counts_[place]
                             : *path == ChannelPath::kRotation ? 4
                                                               : 3;
        const auto [found, fresh] = tracks.try_emplace({channel.sampler, width}, kNone);
        if (fresh) {
            const auto sampler = static_cast<size_t>(channel.sampler);
            auto track = readTrack(
                source.samplers[sampler], *path, width,
                {pointer + pointerTo("samplers", sampler), name + " " + thing("sampler", sampler)});
            if (track) {
                clip.duration_s = std::max(clip.duration_s, double{track->times_s.back()});
                found->second = static_cast<uint32_t>(clip.tracks.size());
                clip.tracks.push_back(std::move(*track));
            }
        }
        if (found->second != kNone) {
            clip.channels.push_back({found->second, place, *path});
        }
    }
}

void MotionReader::noteMoved() {
    for (const scene::Clip& clip : motion_.clips) {
        for (const scene::Channel& channel : clip.channels) {
            (channel.path == ChannelPath::kWeights ? morphs_ : moves_)[channel.node] = true;
        }
    }
    for (size_t place = 0; place < placed_.size(); ++place) {
        const auto& parent = placed_[place].parent;
        moves_[place] = moves_[place] || (parent && moves_[*parent]);
    }
}

std::optional<uint32_t> MotionReader::skin(size_t place) {
    const int number = document_.model.nodes[placed_[place].node].skin;
    if (number < 0) {
        return std::nullopt;
    }
    const auto index = static_cast<size_t>(number);
    if (index >= skins_.size()) {
        const size_t node = placed_[place].node;
        tell(warning::kUnresolved, {pointerTo("nodes", node) + "/skin", thing("node", node)},
             "uses skin " + std::to_string(number) + "; the file has " +
                 std::to_string(skins_.size()) + ", counted from 0; its mesh keeps its rest pose");
        return std::nullopt;
    }
    if (!skins_tried_[index]) {
        skins_tried_[index] = true;
        if (auto skin = readSkin(index)) {
            std::for_each(skin->joints.begin(), skin->joints.end(),
                          [&](uint32_t joint) { need(joint); });
            skins_[index] = static_cast<uint32_t>(motion_.skins.size());
            motion_.skins.push_back(std::move(*skin));
        }
    }
    return skins_[index];
}

std::optional<scene::Skin> MotionReader::readSkin(size_t number) {
    const SkinSource& source = document_.skins[number];
    const Subject subject{pointerTo("skins", number), thing("skin", number)};
    const std::string consequence = "; its meshes keep their rest pose";
    const auto refuse = [&](const WarningKind& kind, const std::string& why) {
        tell(kind, subject, why + consequence);
        return std::nullopt;
    };
    scene::Skin skin{source.name, {}, {}};
    for (const int joint : source.joints) {
        const auto node = static_cast<size_t>(joint);
        if (node >= place_of_node_.size() || place_of_node_[node] == kNone) {
            return refuse(warning::kHiddenJoint, "has the joint node " + std::to_string(joint) +
                                                     ", which is not part of the scene");
        }
        skin.joints.push_back(place_of_node_[node]);
    }
    if (skin.joints.empty()) {
        return refuse(warning::kNoJoints, "has no joints");
    }
    skin.joint_from_object.assign(skin.joints.size(), glm::mat4(1));
    if (source.inverse_bind_matrices < 0) {
        return skin;
    }
    std::vector<float> numbers;
    try {
        const int accessor = source.inverse_bind_matrices;
        numbers_.take(accessors_.count(accessor, subject.name) * 16, subject.name);
        numbers = accessors_.numbers(accessor, 16, subject.name);
    } catch (const Failure& failure) {
        warnings_.add(warning::kNoBindMatrices, subject.pointer, failure.what() + consequence);
        return std::nullopt;
    }
    if (numbers.size() < skin.joints.size() * 16) {
        return refuse(warning::kFewBindMatrices, "has fewer inverse bind matrices than joints");
    }
    if (!allFinite(numbers)) {
        return refuse(warning::kNotFinite, "has inverse bind matrices that are not finite");
    }
    for (size_t joint = 0; joint < skin.joints.size(); ++joint) {
        for (int column = 0; column < 4; ++column) {
            for (int row = 0; row < 3; ++row) { // the last is (0, 0, 0, 1)
                skin.joint_from_object[joint][column][row] =
                    numbers[joint * 16 + static_cast<size_t>(column * 4 + row)];
            }
        }
    }
    return skin;
}

void MotionReader::need(size_t place) {
    for (std::optional<size_t> at = place; at && !needed_[*at]; at = placed_[*at].parent) {
        needed_[*at] = true;
    }
}

uint32_t MotionReader::addDeformed(scene::DeformedMesh mesh, const std::vector<double>& weights) {
    need(mesh.node);
    weights_[mesh.node] = {static_cast<uint32_t>(motion_.rest_weights.size()),
                           static_cast<uint32_t>(weights.size())};
    for (const double weight : weights) {
        motion_.rest_weights.push_back(static_cast<float>(weight));
    }
    motion_.deformed.push_back(std::move(mesh));
    return static_cast<uint32_t>(motion_.deformed.size() - 1);
}

void MotionReader::addInstance(const scene::MovedInstance& instance) {
    need(instance.node);
    motion_.instances.push_back(instance);
}

void MotionReader::addLight(const scene::MovedThing& light) {
    need(light.node);
    motion_.lights.push_back(light);
}

void MotionReader::addCamera(const scene::MovedThing& camera) {
    need(camera.node);
    motion_.cameras.push_back(camera);
}

scene::Node MotionReader::nodeAt(size_t place) const {
    const size_t number = placed_[place].node;
    const tinygltf::Node& source = document_.model.nodes[number];
    scene::Node node;
    if (source.matrix.empty()) {
        node.rest = nodeParts(source);
    } else {
        node.matrix = nodeMatrix(source);
    }
    return node;
}

std::shared_ptr<const scene::Motion> MotionReader::finish() {
    const bool anything = !motion_.instances.empty() || !motion_.deformed.empty() ||
                          !motion_.lights.empty() || !motion_.cameras.empty();
    if (!anything) {
        return nullptr;
    }
    std::vector<uint32_t> nodes(placed_.size(), kNone);
    for (size_t place = 0; place < placed_.size(); ++place) {
        if (needed_[place]) {
            scene::Node node = nodeAt(place);
            node.parent = placed_[place].parent ? nodes[*placed_[place].parent] : kNone;
            nodes[place] = static_cast<uint32_t>(motion_.nodes.size());
            motion_.nodes.push_back(node);
        }
    }
    for (scene::DeformedMesh& mesh : motion_.deformed) {
        scene::Node& node = motion_.nodes[nodes[mesh.node]];
        std::tie(node.first_weight, node.weight_count) = weights_[mesh.node];
        mesh.node = nodes[mesh.node];
    }
    for (scene::Skin& skin : motion_.skins) {
        for (uint32_t& joint : skin.joints) {
            joint = nodes[joint];
        }
    }
    const auto rename = [&](auto& things) {
        for (auto& thing : things) {
            thing.node = nodes[thing.node];
        }
    };
    rename(motion_.instances);
    rename(motion_.lights);
    rename(motion_.cameras);
    for (scene::Clip& clip : motion_.clips) {
        rename(clip.channels);
        std::erase_if(clip.channels,
                      [](const scene::Channel& channel) { return channel.node == kNone; });
    }
    return std::make_shared<const scene::Motion>(std::move(motion_));
}

} // namespace froxel::gltf
