#include "host/vk/acceleration_structure.h"

#include <fmt/format.h>

#include <array>

#include "host/base/error.h"
#include "host/vk/commands.h"

namespace duolux {

namespace {

using Use = vk::BufferUsageFlagBits;

constexpr std::uint64_t kVertexBytes = 16;

vk::PhysicalDeviceAccelerationStructurePropertiesKHR limitsOf(const Device& device) {
    return device.physical()
        .getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceAccelerationStructurePropertiesKHR>()
        .get<vk::PhysicalDeviceAccelerationStructurePropertiesKHR>();
}

}  // namespace

AccelerationStructure::Level AccelerationStructure::build(
    const Device& device, vk::AccelerationStructureTypeKHR type,
    const vk::AccelerationStructureGeometryKHR& geometry, std::uint32_t primitives) {
    vk::AccelerationStructureBuildGeometryInfoKHR info(
        type, vk::BuildAccelerationStructureFlagBitsKHR::ePreferFastTrace,
        vk::BuildAccelerationStructureModeKHR::eBuild);
    info.setGeometries(geometry);
    const vk::AccelerationStructureBuildSizesInfoKHR sizes =
        device.handle().getAccelerationStructureBuildSizesKHR(vk::AccelerationStructureBuildTypeKHR::eDevice,
                                                              info, primitives);
    Buffer memory = Buffer::device(device, BufferUse::kUnbound, sizes.accelerationStructureSize,
                                   Use::eAccelerationStructureStorageKHR | Use::eShaderDeviceAddress,
                                   "a tree for ray queries");
    vk::raii::AccelerationStructureKHR structure(
        device.handle(), vk::AccelerationStructureCreateInfoKHR({}, memory.handle(), 0,
                                                                sizes.accelerationStructureSize, type));
    const std::uint64_t alignment = limitsOf(device).minAccelerationStructureScratchOffsetAlignment;
    const Buffer scratch =
        Buffer::device(device, BufferUse::kUnbound, sizes.buildScratchSize + alignment,
                       Use::eStorageBuffer | Use::eShaderDeviceAddress, "building a tree for ray queries");
    info.dstAccelerationStructure = *structure;
    info.scratchData = (scratch.address() + alignment - 1) / alignment * alignment;
    const vk::AccelerationStructureBuildRangeInfoKHR range(primitives, 0, 0, 0);
    runOnce(device, "building a tree for ray queries", [&](const vk::raii::CommandBuffer& commands) {
        commands.buildAccelerationStructuresKHR(info, &range);
    });
    return {std::move(memory), std::move(structure)};
}

std::vector<AccelerationStructure::Level> AccelerationStructure::buildParts(
    const Device& device, const Buffer& vertices, std::span<const std::uint32_t> indices,
    std::span<const Part> parts) {
    const std::uint64_t most = limitsOf(device).maxPrimitiveCount;
    const Buffer corners =
        Buffer::upload(device, BufferUse::kUnbound, indices, "indices for ray queries", kInputUse);
    std::vector<Level> levels;
    for (const Part& part : parts) {
        if (part.triangles > most) {
            throw MachineError(
                fmt::format("{} ({}): {} triangles, more than the {} that ray queries can have",
                            device.info().name, device.info().driver, part.triangles, most));
        }
        const vk::DeviceAddress first = vertices.address() + kVertexBytes * part.firstVertex;
        const vk::AccelerationStructureGeometryTrianglesDataKHR data(
            vk::Format::eR32G32B32Sfloat, first, kVertexBytes, part.vertices - 1, vk::IndexType::eUint32,
            corners.address());
        levels.push_back(build(device, vk::AccelerationStructureTypeKHR::eBottomLevel,
                               {vk::GeometryTypeKHR::eTriangles, data}, part.triangles));
    }
    return levels;
}

AccelerationStructure::Level AccelerationStructure::buildTop(const Device& device,
                                                             const std::vector<Level>& levels,
                                                             std::span<const Part> parts) {
    const std::array<std::array<float, 4>, 3> rows{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
    const vk::TransformMatrixKHR identity(rows);
    std::vector<vk::AccelerationStructureInstanceKHR> instances;
    for (std::size_t i = 0; i < levels.size(); ++i) {
        instances.emplace_back(identity, 0, parts[i].mask, 0, vk::GeometryInstanceFlagsKHR(),
                               device.handle().getAccelerationStructureAddressKHR(*levels[i].structure));
    }
    const Buffer memory = Buffer::upload<vk::AccelerationStructureInstanceKHR>(
        device, BufferUse::kUnbound, instances, "instances for ray queries", kInputUse);
    const vk::AccelerationStructureGeometryInstancesDataKHR data(VK_FALSE, memory.address());
    return build(device, vk::AccelerationStructureTypeKHR::eTopLevel, {vk::GeometryTypeKHR::eInstances, data},
                 static_cast<std::uint32_t>(instances.size()));
}

AccelerationStructure::AccelerationStructure(const Device& device, const Buffer& vertices,
                                             std::span<const std::uint32_t> indices,
                                             std::span<const Part> parts) try
    : parts_(buildParts(device, vertices, indices, parts)), top_(buildTop(device, parts_, parts)) {
} catch (const vk::SystemError& e) {
    throw failureOn(device.info(), "building a tree for ray queries", e);
}

std::uint64_t AccelerationStructure::allocated() const {
    std::uint64_t bytes = top_.memory.allocated();
    for (const Level& part : parts_)
        bytes += part.memory.allocated();
    return bytes;
}

}  // namespace duolux
