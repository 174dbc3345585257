#include "gltf/node_walker.h"

#include "gltf/extension_value.h"
#include "gltf/failure.h"
#include "gltf/node_transform.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <string>

namespace froxel::gltf {
namespace {

constexpr int kNoParent = -1;

// Every child once: of several parents the first in the file counts, as other loaders have it.
struct Tree {
    std::vector<int> parents; // [node]: kNoParent for a root
    std::vector<std::vector<size_t>> children;
};

[[noreturn]] void failCycle(size_t node) {
    fail(thing("node", node) + " is part of a cycle of children; expected a tree");
}

// Nodes without a parent are taken away, again and again. What stays hangs on a cycle: up from any
// of it one comes around.
void checkCycles(const tinygltf::Model& model) {
    std::vector<size_t> parent_count(model.nodes.size(), 0);
    for (const tinygltf::Node& node : model.nodes) {
        for (const int child : node.children) {
            ++parent_count[static_cast<size_t>(child)];
        }
    }
    std::vector<size_t> queue;
    for (size_t i = 0; i < parent_count.size(); ++i) {
        if (parent_count[i] == 0) {
            queue.push_back(i);
        }
    }
    for (size_t next = 0; next < queue.size(); ++next) {
        for (const int child : model.nodes[queue[next]].children) {
            if (--parent_count[static_cast<size_t>(child)] == 0) {
                queue.push_back(static_cast<size_t>(child));
            }
        }
    }
    if (queue.size() == model.nodes.size()) {
        return;
    }
    std::vector<int> parent_left(model.nodes.size(), kNoParent);
    for (size_t i = 0; i < model.nodes.size(); ++i) {
        for (const int child : model.nodes[i].children) {
            if (parent_count[i] > 0) {
                parent_left[static_cast<size_t>(child)] = static_cast<int>(i);
            }
        }
    }
    const auto first = std::find_if(parent_count.begin(), parent_count.end(),
                                    [](size_t count) { return count > 0; });
    auto node = static_cast<size_t>(first - parent_count.begin());
    for (std::vector<bool> passed(model.nodes.size()); !passed[node];) {
        passed[node] = true;
        node = static_cast<size_t>(parent_left[node]);
    }
    failCycle(node);
}

Tree readTree(const tinygltf::Model& model, Warnings& warnings) {
    Tree tree{std::vector<int>(model.nodes.size(), kNoParent),
              std::vector<std::vector<size_t>>(model.nodes.size())};
    for (size_t i = 0; i < model.nodes.size(); ++i) {
        for (const int child : model.nodes[i].children) {
            const size_t index =
                checkedIndex(child, model.nodes.size(), "child node", thing("node", i));
            int& parent = tree.parents[index];
            if (parent == kNoParent) {
                parent = static_cast<int>(i);
                tree.children[i].push_back(index);
            } else if (static_cast<size_t>(parent) == i) {
                warnings.add(warning::kListedTwice, pointerTo("nodes", i) + "/children",
                             thing("node", i) + " lists node " + std::to_string(index) +
                                 " twice; it is shown once");
            } else {
                warnings.add(warning::kTwoParents, pointerTo("nodes", i) + "/children",
                             thing("node", index) + " is a child of node " +
                                 std::to_string(parent) + " and of node " + std::to_string(i) +
                                 "; it is placed under the first");
            }
        }
    }
    checkCycles(model);
    return tree;
}

// Of every node whether it is below one of `nodes`.
std::vector<bool> findBelow(std::vector<size_t> nodes, const Tree& tree) {
    std::vector<bool> below(tree.parents.size(), false);
    while (!nodes.empty()) {
        const size_t node = nodes.back();
        nodes.pop_back();
        for (const size_t child : tree.children[node]) {
            if (!below[child]) {
                below[child] = true;
                nodes.push_back(child);
            }
        }
    }
    return below;
}

// The nodes that a scene lists. One with a parent starts a tree of its own, without the transforms
// above it, unless the scene has it below another of its nodes.
std::vector<size_t>
listedRoots(const tinygltf::Model& model, size_t scene, const Tree& tree, Warnings& warnings) {
    const std::string user = thing("scene", scene);
    std::vector<bool> listed(tree.parents.size(), false);
    std::vector<size_t> nodes;
    for (const int node : model.scenes[scene].nodes) {
        const size_t index = checkedIndex(node, model.nodes.size(), "node", user);
        if (listed[index]) {
            warnings.add(warning::kListedTwice, pointerTo("scenes", scene) + "/nodes",
                         user + " lists node " + std::to_string(index) +
                             " twice; it is shown once");
            continue;
        }
        listed[index] = true;
        nodes.push_back(index);
    }
    const std::vector<bool> below = findBelow(nodes, tree);
    std::vector<size_t> roots;
    for (const size_t node : nodes) {
        if (const int parent = tree.parents[node]; parent != kNoParent) {
            warnings.add(
                warning::kListedChild, pointerTo("scenes", scene) + "/nodes",
                user + " lists node " + std::to_string(node) + ", a child of node " +
                    std::to_string(parent) +
                    (below[node] ? "; it stays there" : "; it is placed without its ancestors"));
        }
        if (!below[node]) {
            roots.push_back(node);
        }
    }
    return roots;
}

std::vector<size_t> findRoots(const tinygltf::Model& model, const Tree& tree, Warnings& warnings) {
    if (!model.scenes.empty()) {
        size_t number = model.defaultScene < 0 ? 0 : static_cast<size_t>(model.defaultScene);
        if (number >= model.scenes.size()) {
            warnings.add(warning::kUnresolved, "/scene",
                         "the file shows scene " + std::to_string(number) + "; it has " +
                             std::to_string(model.scenes.size()) +
                             ", counted from 0, of which the first is shown");
            number = 0;
        }
        return listedRoots(model, number, tree, warnings);
    }
    std::vector<size_t> roots;
    for (size_t i = 0; i < tree.parents.size(); ++i) {
        if (tree.parents[i] == kNoParent) {
            roots.push_back(i);
        }
    }
    if (!roots.empty()) {
        warnings.add(warning::kNoScene, "", "the file has no scene; all of its nodes are shown");
    }
    return roots;
}

// KHR_node_visibility; who is not visible hides all below.
bool isVisible(const tinygltf::Node& node) {
    const tinygltf::Value* extension = findExtension(node.extensions, "KHR_node_visibility");
    return extension == nullptr || !extension->Has("visible") ||
           extension->Get("visible").Get<bool>();
}

} // namespace

std::vector<PlacedNode> placeNodes(const tinygltf::Model& model, Warnings& warnings) {
    const Tree tree = readTree(model, warnings);
    const std::vector<size_t> roots = findRoots(model, tree, warnings);
    std::vector<PlacedNode> stack;
    const auto push = [&](size_t node, std::optional<size_t> place, const PlacedNode& parent) {
        const glm::dmat4 world =
            parent.world_from_node * nodeTransform(model.nodes[node], node, warnings);
        if (isUsable(world, node, warnings)) {
            stack.push_back({node, place, world, parent.visible && isVisible(model.nodes[node])});
        }
    };
    for (auto root = roots.rbegin(); root != roots.rend(); ++root) {
        push(*root, std::nullopt, PlacedNode());
    }
    std::vector<PlacedNode> placed;
    while (!stack.empty()) {
        const PlacedNode current = stack.back();
        stack.pop_back();
        placed.push_back(current);
        const std::vector<size_t>& children = tree.children[current.node];
        for (auto child = children.rbegin(); child != children.rend(); ++child) {
            push(*child, placed.size() - 1, current);
        }
    }
    return placed;
}

} // namespace froxel::gltf
