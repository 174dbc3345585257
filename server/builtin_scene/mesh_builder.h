// Collects triangles by surface into a scene::Mesh. Metres; counter-clockwise faces look outward;
// u runs right and v down as seen from outside, so that normal maps need no mirrored frame.
#pragma once

#include "builtin_scene/surface.h"
#include "core/math.h"
#include "scene/scene.h"

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace froxel::builtin_scene {

struct Vertex {
    glm::vec3 position{0};
    glm::vec3 normal{0, 1, 0};
    glm::vec2 uv{0};
};

// Faces of a box, as bits of a set.
enum BoxFace : uint32_t {
    kLeft = 1U,   // -x
    kRight = 2U,  // +x
    kBottom = 4U, // -y
    kTop = 8U,    // +y
    kBack = 16U,  // -z
    kFront = 32U, // +z
};

class MeshBuilder {
  public:
    explicit MeshBuilder(Surface surface) { use(surface); }

    // Surface of what is added from now on.
    void use(Surface surface);
    // An empty builder with the surface in use here.
    [[nodiscard]] MeshBuilder fresh() const { return MeshBuilder(parts_[current_].surface); }

    uint32_t vertex(const Vertex& vertex);
    void triangle(uint32_t a, uint32_t b, uint32_t c);
    void quad(uint32_t a, uint32_t b, uint32_t c, uint32_t d);

    // A flat polygon, convex, counter-clockwise; uv in metres by the dominant axis of its normal.
    void polygon(const std::vector<glm::vec3>& corners);

    // A sheet of columns x rows quads; at(i, j) with i to the right and j upward, seen from
    // outside.
    void
    sheet(uint32_t columns, uint32_t rows, const std::function<Vertex(uint32_t i, uint32_t j)>& at);

    // A box whose edges are chamfered and shaded round. Towards the faces in `omit` (BoxFace bits)
    // it runs on unseen: no face, no chamfer. Faces in `joints` are left out but keep their
    // chamfers, which make the groove between two stones.
    void box(glm::vec3 min, glm::vec3 max, float bevel_m, uint32_t omit = 0, uint32_t joints = 0);

    // Adds another builder's triangles, placed; a mirroring transform turns the faces over.
    void append(const MeshBuilder& part, const glm::mat4& this_from_part);

    // Bends everything added so far; normals follow by the map's derivative.
    void warp(const std::function<glm::vec3(glm::vec3)>& map);

    [[nodiscard]] scene::Mesh build(std::string name) const;

  private:
    struct Part {
        Surface surface = Surface::kLimestone;
        std::vector<Vertex> vertices;
        std::vector<uint32_t> indices;
    };
    Part& current() { return parts_[current_]; }

    std::vector<Part> parts_;
    size_t current_ = 0;
};

// Metric uv of a point on a plane with this normal; right-handed as the class comment says.
[[nodiscard]] glm::vec2 planarUv(glm::vec3 position, glm::vec3 normal);

// Placement helpers.
[[nodiscard]] glm::mat4 moved(float x, float y, float z);
[[nodiscard]] glm::mat4 turnedX(float angle_rad);
[[nodiscard]] glm::mat4 turnedY(float angle_rad);
[[nodiscard]] glm::mat4 turnedZ(float angle_rad);

} // namespace froxel::builtin_scene
