#include "gltf/node_walker.h"

#include "gltf/failure.h"
#include "gltf/node_transform.h"

#include <tiny_gltf.h>

#include <string>

namespace froxel::gltf {
namespace {

constexpr int kNoParent = -1;

std::vector<int> findParents(const tinygltf::Model& model) {
    std::vector<int> parents(model.nodes.size(), kNoParent);
    for (size_t i = 0; i < model.nodes.size(); ++i) {
        for (const int child : model.nodes[i].children) {
            const size_t index =
                checkedIndex(child, model.nodes.size(), "child node", thing("node", i));
            if (parents[index] != kNoParent) {
                fail(thing("node", index) + " is a child of node " +
                     std::to_string(parents[index]) + " and of node " + std::to_string(i) +
                     "; right is one parent");
            }
            parents[index] = static_cast<int>(i);
        }
    }
    return parents;
}

// With one parent each, a node that no root reaches hangs on a cycle.
void checkCycles(const tinygltf::Model& model, const std::vector<int>& parents) {
    std::vector<size_t> queue;
    std::vector<bool> reached(parents.size(), false);
    for (size_t i = 0; i < parents.size(); ++i) {
        if (parents[i] == kNoParent) {
            queue.push_back(i);
        }
    }
    for (size_t next = 0; next < queue.size(); ++next) {
        reached[queue[next]] = true;
        for (const int child : model.nodes[queue[next]].children) {
            queue.push_back(static_cast<size_t>(child));
        }
    }
    for (size_t i = 0; i < reached.size(); ++i) {
        if (!reached[i]) {
            fail(thing("node", i) + " is part of a cycle of children; right is a tree");
        }
    }
}

std::vector<size_t> findRoots(const tinygltf::Model& model, const std::vector<int>& parents) {
    std::vector<size_t> roots;
    if (model.scenes.empty() && model.defaultScene < 0) {
        for (size_t i = 0; i < parents.size(); ++i) {
            if (parents[i] == kNoParent) {
                roots.push_back(i);
            }
        }
        return roots;
    }
    const int number = model.defaultScene < 0 ? 0 : model.defaultScene;
    const size_t scene = checkedIndex(number, model.scenes.size(), "scene", "the file");
    const std::string user = thing("scene", scene);
    std::vector<bool> listed(parents.size(), false);
    for (const int node : model.scenes[scene].nodes) {
        const size_t index = checkedIndex(node, model.nodes.size(), "node", user);
        if (parents[index] != kNoParent) {
            fail(user + " lists node " + std::to_string(index) + ", a child of node " +
                 std::to_string(parents[index]) + "; right are nodes without a parent");
        }
        if (listed[index]) {
            fail(user + " lists node " + std::to_string(index) + " twice");
        }
        listed[index] = true;
        roots.push_back(index);
    }
    return roots;
}

} // namespace

std::vector<PlacedNode> placeNodes(const tinygltf::Model& model) {
    const std::vector<int> parents = findParents(model);
    checkCycles(model, parents);
    const std::vector<size_t> roots = findRoots(model, parents);
    std::vector<PlacedNode> stack;
    const auto push = [&](size_t node, const glm::dmat4& world_from_parent) {
        const std::string name = thing("node", node);
        const glm::dmat4 world = world_from_parent * nodeTransform(model.nodes[node], name);
        checkFinite(world, name);
        stack.push_back({node, world});
    };
    for (auto root = roots.rbegin(); root != roots.rend(); ++root) {
        push(*root, glm::dmat4(1));
    }
    std::vector<PlacedNode> placed;
    while (!stack.empty()) {
        const PlacedNode current = stack.back();
        stack.pop_back();
        placed.push_back(current);
        const std::vector<int>& children = model.nodes[current.node].children;
        for (auto child = children.rbegin(); child != children.rend(); ++child) {
            push(static_cast<size_t>(*child), current.world_from_node);
        }
    }
    return placed;
}

} // namespace froxel::gltf
