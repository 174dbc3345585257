// Where the vertex attributes of one primitive come from: accessors, or a Draco stream.
#pragma once

#include "gltf/accessor_reader.h"
#include "gltf/document.h"
#include "gltf/draco_mesh.h"

#include <set>
#include <string>

namespace froxel::gltf {

class VertexSource {
  public:
    // `draco` is borrowed and null where the primitive is not compressed.
    VertexSource(const tinygltf::Primitive& primitive,
                 AccessorReader& accessors,
                 const DracoMesh* draco,
                 std::string user)
        : primitive_(primitive), accessors_(accessors), draco_(draco), user_(std::move(user)) {}

    [[nodiscard]] bool has(const std::string& semantic) const {
        return primitive_.attributes.contains(semantic) && !left_out_.contains(semantic);
    }
    // From now on it is not there.
    void leaveOut(const std::string& semantic) { left_out_.insert(semantic); }
    [[nodiscard]] int accessor(const std::string& semantic) const {
        return primitive_.attributes.at(semantic);
    }

    // `count` elements of N components, finite or not. Throws Failure where the attribute has
    // another count.
    template <int N>
    [[nodiscard]] std::vector<glm::vec<N, float>> vectors(const std::string& semantic,
                                                          size_t count) {
        const int index = accessor(semantic);
        const std::string user = user_ + " " + semantic;
        if (draco_ != nullptr && draco_->has(semantic)) {
            return draco_->vectors<N>(semantic, accessors_.normalized(index, user), user);
        }
        if (accessors_.count(index, user) != count) {
            fail(user + " has " + std::to_string(accessors_.count(index, user)) +
                 " elements; expected " + std::to_string(count) + ", as POSITION has");
        }
        return accessors_.vectors<N>(index, user, NotFinite::kKept);
    }

  private:
    const tinygltf::Primitive& primitive_;
    AccessorReader& accessors_;
    const DracoMesh* draco_;
    std::string user_;
    std::set<std::string> left_out_;
};

} // namespace froxel::gltf
