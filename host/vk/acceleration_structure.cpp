#include "host/vk/acceleration_structure.h"

#include <fmt/format.h>

#include <array>

#include "host/base/error.h"
#include "host/vk/commands.h"
#include "host/vk/handles.h"

namespace duolux {

namespace {

using Level = AccelerationStructure::Handles::Level;

constexpr std::uint64_t kVertexBytes = 16;

vk::PhysicalDeviceAccelerationStructurePropertiesKHR limitsOf(const Device& device) {
    return device.handles()
        .physical
        .getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceAccelerationStructurePropertiesKHR>()
        .get<vk::PhysicalDeviceAccelerationStructurePropertiesKHR>();
}

Level build(const Device& device, vk::AccelerationStructureTypeKHR type,
            const vk::AccelerationStructureGeometryKHR& geometry, std::uint32_t primitives) {
    vk::AccelerationStructureBuildGeometryInfoKHR info(
        type, vk::BuildAccelerationStructureFlagBitsKHR::ePreferFastTrace,
        vk::BuildAccelerationStructureModeKHR::eBuild);
    info.setGeometries(geometry);
    const vk::AccelerationStructureBuildSizesInfoKHR sizes =
        device.handles().device.getAccelerationStructureBuildSizesKHR(
            vk::AccelerationStructureBuildTypeKHR::eDevice, info, primitives);
    Buffer memory = Buffer::device(device, BufferUse::kUnbound, sizes.accelerationStructureSize,
                                   "a tree for ray queries", TreeUse::kStorage);
    vk::raii::AccelerationStructureKHR structure(
        device.handles().device, vk::AccelerationStructureCreateInfoKHR(
                                     {}, *memory.handles().buffer, 0, sizes.accelerationStructureSize, type));
    const std::uint64_t alignment = limitsOf(device).minAccelerationStructureScratchOffsetAlignment;
    const Buffer scratch = Buffer::device(device, BufferUse::kUnbound, sizes.buildScratchSize + alignment,
                                          "building a tree for ray queries", TreeUse::kScratch);
    info.dstAccelerationStructure = *structure;
    info.scratchData = (scratch.address() + alignment - 1) / alignment * alignment;
    const vk::AccelerationStructureBuildRangeInfoKHR range(primitives, 0, 0, 0);
    runOnce(device, "building a tree for ray queries", [&](const Commands& commands) {
        commands.handle().buildAccelerationStructuresKHR(info, &range);
    });
    return {std::move(memory), std::move(structure)};
}

std::vector<Level> buildParts(const Device& device, const Buffer& vertices,
                              std::span<const std::uint32_t> indices,
                              std::span<const AccelerationStructure::Part> parts) {
    const std::uint64_t most = limitsOf(device).maxPrimitiveCount;
    const Buffer corners =
        Buffer::upload(device, BufferUse::kUnbound, indices, "indices for ray queries", TreeUse::kInput);
    std::vector<Level> levels;
    for (const AccelerationStructure::Part& part : parts) {
        if (part.triangles > most) {
            throw DeviceError(fmt::format("{} ({}): {} triangles, more than the {} that ray queries can have",
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

Level buildTop(const Device& device, const std::vector<Level>& levels,
               std::span<const AccelerationStructure::Part> parts) {
    const std::array<std::array<float, 4>, 3> rows{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
    const vk::TransformMatrixKHR identity(rows);
    std::vector<vk::AccelerationStructureInstanceKHR> instances;
    for (std::size_t i = 0; i < levels.size(); ++i) {
        instances.emplace_back(
            identity, 0, parts[i].mask, 0, vk::GeometryInstanceFlagsKHR(),
            device.handles().device.getAccelerationStructureAddressKHR(*levels[i].structure));
    }
    const Buffer memory = Buffer::upload<vk::AccelerationStructureInstanceKHR>(
        device, BufferUse::kUnbound, instances, "instances for ray queries", TreeUse::kInput);
    const vk::AccelerationStructureGeometryInstancesDataKHR data(VK_FALSE, memory.address());
    return build(device, vk::AccelerationStructureTypeKHR::eTopLevel, {vk::GeometryTypeKHR::eInstances, data},
                 static_cast<std::uint32_t>(instances.size()));
}

}  // namespace

AccelerationStructure::AccelerationStructure(const Device& device, const Buffer& vertices,
                                             std::span<const std::uint32_t> indices,
                                             std::span<const AccelerationStructure::Part> parts) try {
    std::vector<Level> levels = buildParts(device, vertices, indices, parts);
    Level top = buildTop(device, levels, parts);
    handles_ = std::make_unique<Handles>(std::move(levels), std::move(top));
} catch (const vk::SystemError& e) {
    failOn(device.info(), "building a tree for ray queries", e);
}

AccelerationStructure::~AccelerationStructure() = default;
AccelerationStructure::AccelerationStructure(AccelerationStructure&& other) noexcept = default;
AccelerationStructure& AccelerationStructure::operator=(AccelerationStructure&& other) noexcept = default;

std::uint64_t AccelerationStructure::allocated() const {
    std::uint64_t bytes = handles_->top.memory.allocated();
    for (const Level& part : handles_->parts)
        bytes += part.memory.allocated();
    return bytes;
}

}  // namespace duolux
