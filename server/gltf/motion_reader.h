// Clips and skins of a file, for the nodes that the scene shows.
#pragma once

#include "gltf/accessor_reader.h"
#include "gltf/document.h"
#include "gltf/limits.h"
#include "gltf/node_walker.h"
#include "gltf/warnings.h"
#include "scene/motion.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace froxel::gltf {

// What of a file's motion is broken is left out with a warning; all else plays. Places are indices
// of the placed nodes. Not thread-safe.
class MotionReader {
  public:
    // Reads all clips. weight_counts: morph targets of what each placed node shows. All is
    // borrowed.
    MotionReader(const Document& document,
                 const std::vector<PlacedNode>& placed,
                 std::vector<size_t> weight_counts,
                 AccessorReader& accessors,
                 ReadMemory& memory,
                 Warnings& warnings);

    // Whether a clip moves the node or one that it hangs on.
    [[nodiscard]] bool moves(size_t place) const { return moves_[place]; }
    // Whether a clip changes its weights.
    [[nodiscard]] bool morphs(size_t place) const { return morphs_[place]; }
    // What its mesh follows instead of it: an index for DeformedMesh::skin. None: it has none that
    // can be used.
    [[nodiscard]] std::optional<uint32_t> skin(size_t place);
    [[nodiscard]] size_t jointCount(uint32_t skin) const {
        return motion_.skins[skin].joints.size();
    }

    // Nodes are places here. weights: of the targets that are kept.
    uint32_t addDeformed(scene::DeformedMesh mesh, const std::vector<double>& weights);
    void addInstance(const scene::MovedInstance& instance);
    void addLight(const scene::MovedThing& light);
    void addCamera(const scene::MovedThing& camera);

    // Null: nothing that is shown moves. Called once, at the end.
    [[nodiscard]] std::shared_ptr<const scene::Motion> finish();

  private:
    // What a warning is about.
    struct Subject {
        std::string pointer;
        std::string name;
    };
    void tell(const WarningKind& kind, const Subject& subject, const std::string& what);

    void readClip(size_t number);
    // kNone: it cannot be played.
    [[nodiscard]] uint32_t placeOf(const ChannelSource& channel, const Subject& subject);
    [[nodiscard]] std::optional<scene::ChannelPath>
    pathOf(const ChannelSource& channel, size_t place, const Subject& subject);
    [[nodiscard]] std::optional<scene::Track> readTrack(const SamplerSource& source,
                                                        scene::ChannelPath path,
                                                        size_t width,
                                                        const Subject& subject);
    void noteMoved();
    [[nodiscard]] std::optional<scene::Skin> readSkin(size_t number);
    void need(size_t place);
    [[nodiscard]] scene::Node nodeAt(size_t place) const;

    const Document& document_;
    const std::vector<PlacedNode>& placed_;
    const std::vector<size_t> weight_counts_;
    AccessorReader& accessors_;
    Warnings& warnings_;
    scene::Motion motion_;                       // nodes come last; until then all name places
    std::vector<uint32_t> place_of_node_;        // kNone: not shown
    std::vector<std::optional<uint32_t>> skins_; // of the file: in motion_; none: not read
    std::vector<bool> skins_tried_;
    std::vector<bool> moves_;
    std::vector<bool> morphs_;
    std::vector<bool> needed_;
    std::vector<std::pair<uint32_t, uint32_t>> weights_; // of each place: the first, how many
    Budget numbers_;
};

} // namespace froxel::gltf
