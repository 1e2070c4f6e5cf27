#include "host/vk/kernel.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "host/vk/handles.h"

namespace duolux {

namespace {

vk::DescriptorType descriptorType(const Binding& binding) {
    if (binding.buffer == nullptr) return vk::DescriptorType::eAccelerationStructureKHR;
    switch (binding.buffer->use()) {
        case BufferUse::kTexels:
            return vk::DescriptorType::eStorageTexelBuffer;
        case BufferUse::kUniform:
            return vk::DescriptorType::eUniformBuffer;
        case BufferUse::kStorage:
            return vk::DescriptorType::eStorageBuffer;
        case BufferUse::kUnbound:
            break;
    }
    return {};
}

}  // namespace

struct Kernel::Handles {
    vk::raii::DescriptorSetLayout setLayout{nullptr};
    vk::raii::PipelineLayout layout{nullptr};
    vk::raii::DescriptorPool pool{nullptr};
    vk::raii::DescriptorSet set{nullptr};
    vk::raii::Pipeline pipeline{nullptr};
};

Kernel::Kernel(const Device& device, std::string_view name, std::span<const std::uint32_t> spirv,
               std::span<const Binding> bindings, std::span<const Specialization> specialization,
               std::uint32_t pushConstantBytes)
    : handles_(std::make_unique<Handles>()) {
    const vk::raii::Device& handle = device.handles().device;
    auto& [setLayout, layout, pool, set, pipeline] = *handles_;
    try {
        std::vector<vk::DescriptorSetLayoutBinding> layoutBindings;
        std::vector<vk::DescriptorPoolSize> sizes;
        for (const Binding& b : bindings) {
            const vk::DescriptorType type = descriptorType(b);
            sizes.emplace_back(type, 1);
            if (!layoutBindings.empty() && layoutBindings.back().binding == b.binding) {
                ++layoutBindings.back().descriptorCount;
            } else {
                layoutBindings.emplace_back(b.binding, type, 1, vk::ShaderStageFlagBits::eCompute);
            }
        }
        setLayout =
            vk::raii::DescriptorSetLayout(handle, vk::DescriptorSetLayoutCreateInfo({}, layoutBindings));
        const vk::PushConstantRange range(vk::ShaderStageFlagBits::eCompute, 0, pushConstantBytes);
        vk::PipelineLayoutCreateInfo layoutCreate({}, *setLayout);
        if (pushConstantBytes > 0) layoutCreate.setPushConstantRanges(range);
        layout = vk::raii::PipelineLayout(handle, layoutCreate);

        const vk::DescriptorPoolCreateFlags freeable = vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet;
        pool = vk::raii::DescriptorPool(handle, vk::DescriptorPoolCreateInfo(freeable, 1, sizes));
        set =
            std::move(vk::raii::DescriptorSets(handle, vk::DescriptorSetAllocateInfo(*pool, *setLayout))[0]);
        std::uint32_t element = 0;
        for (std::size_t i = 0; i < bindings.size(); ++i) {
            const Binding& b = bindings[i];
            element = i > 0 && bindings[i - 1].binding == b.binding ? element + 1 : 0;
            const vk::DescriptorType type = descriptorType(b);
            vk::AccelerationStructureKHR tree;
            if (b.buffer == nullptr) tree = *b.structure->handles().top.structure;
            const vk::WriteDescriptorSetAccelerationStructureKHR structure(tree);
            vk::DescriptorBufferInfo info({}, 0, VK_WHOLE_SIZE);
            vk::BufferView view;
            vk::WriteDescriptorSet write(*set, b.binding, element, 1, type);
            if (b.buffer == nullptr) {
                write.setPNext(&structure);
            } else if (b.buffer->use() == BufferUse::kTexels) {
                view = *b.buffer->handles().view;
                write.setPTexelBufferView(&view);
            } else {
                info.setBuffer(*b.buffer->handles().buffer);
                write.setPBufferInfo(&info);
            }
            handle.updateDescriptorSets(write, {});
        }

        std::vector<vk::SpecializationMapEntry> entries;
        std::vector<std::uint32_t> values;
        for (const Specialization& s : specialization) {
            entries.emplace_back(s.id, static_cast<std::uint32_t>(values.size() * sizeof(std::uint32_t)),
                                 sizeof(std::uint32_t));
            values.push_back(s.value);
        }
        const vk::SpecializationInfo info(static_cast<std::uint32_t>(entries.size()), entries.data(),
                                          values.size() * sizeof(std::uint32_t), values.data());
        const vk::raii::ShaderModule module(handle,
                                            vk::ShaderModuleCreateInfo({}, spirv.size_bytes(), spirv.data()));
        const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute, *module, "main",
                                                      &info);
        pipeline = vk::raii::Pipeline(handle, nullptr, vk::ComputePipelineCreateInfo({}, stage, *layout));
    } catch (const vk::SystemError& e) {
        failOn(device.info(), fmt::format("creating the pipeline of kernel '{}'", name), e);
    }
}

Kernel::~Kernel() = default;
Kernel::Kernel(Kernel&& other) noexcept = default;
Kernel& Kernel::operator=(Kernel&& other) noexcept = default;

void Kernel::record(const Commands& commands, std::span<const std::byte> push, std::uint32_t groups) const {
    const vk::raii::CommandBuffer& vulkan = commands.handle();
    vulkan.bindPipeline(vk::PipelineBindPoint::eCompute, *handles_->pipeline);
    vulkan.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *handles_->layout, 0, *handles_->set, {});
    vulkan.pushConstants<std::byte>(
        *handles_->layout, vk::ShaderStageFlagBits::eCompute, 0,
        vk::ArrayProxy<const std::byte>(static_cast<std::uint32_t>(push.size()), push.data()));
    vulkan.dispatch(groups, 1, 1);
}

}  // namespace duolux
