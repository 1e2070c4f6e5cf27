#include "host/device_scene/scene_trees.h"

#include <algorithm>

#include "shaders/shared/bvh_layout.h"

namespace duolux {

SceneTrees listTriangles(const Geometry& geometry, std::span<const std::uint32_t> emitters) {
    SceneTrees trees;
    trees.pairs = pairTriangles(geometry, allTriangles(geometry));
    if (emitters.empty()) return trees;
    trees.emitterRoot = 2 * static_cast<std::uint32_t>(trees.pairs.size());
    const std::vector<TrianglePair> second = pairTriangles(geometry, emitters);
    trees.pairs.insert(trees.pairs.end(), second.begin(), second.end());
    return trees;
}

AccelerationStructure buildStructure(const Device& device, const Buffer& pairs, const SceneTrees& trees) {
    const auto count = static_cast<std::uint32_t>(trees.pairs.size());
    const std::uint32_t emitters = trees.emitterRoot > 0 ? count - trees.emitterRoot / 2 : 0;
    const auto part = [](std::uint32_t firstPair, std::uint32_t pairCount, std::uint32_t mask) {
        return AccelerationStructure::Part{shared::kPairTexels * firstPair, shared::kPairTexels * pairCount,
                                           2 * pairCount, static_cast<std::uint8_t>(mask)};
    };
    std::vector<AccelerationStructure::Part> parts{part(0, count - emitters, shared::kMaskAll)};
    if (emitters > 0) parts.push_back(part(count - emitters, emitters, shared::kMaskEmitters));
    // The emitters alone may have more pairs than the rest of the scene.
    const std::uint32_t most = std::max(count - emitters, emitters);
    std::vector<std::uint32_t> indices;
    indices.reserve(std::size_t{6} * most);
    for (std::uint32_t pair = 0; pair < most; ++pair) {
        for (const std::uint32_t corner : {0u, 1u, 2u, 3u, 2u, 1u})
            indices.push_back(shared::kPairTexels * pair + corner);
    }
    return {device, pairs, indices, parts};
}

SceneTrees joinTrees(const Geometry& geometry, const WideBvh& all, std::span<const std::uint32_t> emitters) {
    SceneTrees trees{all.nodes, all.pairs, 0};
    if (emitters.empty()) return trees;
    const WideBvh second = buildWideBvh(geometry, emitters);
    trees.emitterRoot = static_cast<std::uint32_t>(trees.nodes.size());
    const auto firstPair = static_cast<std::uint32_t>(trees.pairs.size());
    for (shared::WideNode node : second.nodes) {
        node.childBase += trees.emitterRoot;
        node.pairBase += firstPair;
        trees.nodes.push_back(node);
    }
    trees.pairs.insert(trees.pairs.end(), second.pairs.begin(), second.pairs.end());
    return trees;
}

std::vector<std::uint32_t> deviceTriangles(const SceneTrees& trees, std::size_t count) {
    std::vector<std::uint32_t> places(count);
    for (std::uint32_t i = 0; i < trees.pairs.size(); ++i) {
        places[trees.pairs[i].first] = 2 * i;
        if (!trees.pairs[i].isSingle()) places[trees.pairs[i].second] = 2 * i + 1;
    }
    return places;
}

}  // namespace duolux
