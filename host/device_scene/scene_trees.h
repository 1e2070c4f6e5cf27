#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "host/bvh/wide_bvh.h"
#include "host/scene/scene.h"
#include "host/vk/acceleration_structure.h"
#include "host/vk/buffer.h"
#include "host/vk/device.h"

namespace duolux {

/// The tree over all triangles, followed by the tree over copies of the emitters if there is one.
struct SceneTrees {
    std::vector<shared::WideNode> nodes;  ///< empty where the driver builds the trees
    std::vector<TrianglePair> pairs;      ///< in the order of the leaves
    std::uint32_t emitterRoot = 0;        ///< as in shared::PathParams; 0: there is no tree over the emitters
};

/// `all`: the tree over all triangles. `emitters`: the triangles of the second tree, which is built.
SceneTrees joinTrees(const Geometry& geometry, const WideBvh& all, std::span<const std::uint32_t> emitters);

/// The input of the driver's trees: all triangles, followed by copies of the emitters.
SceneTrees listTriangles(const Geometry& geometry, std::span<const std::uint32_t> emitters);

/// The driver's trees. `pairs`: the records of listTriangles on the device.
AccelerationStructure buildStructure(const Device& device, const Buffer& pairs, const SceneTrees& trees);

/// For each of the scene's `count` triangles, its index in device memory (or that of a copy).
std::vector<std::uint32_t> deviceTriangles(const SceneTrees& trees, std::size_t count);

}  // namespace duolux
