#include "host/vk/kernel.h"

#include <fmt/format.h>

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

Kernel::Kernel(const Device& device, std::string_view name, std::span<const std::uint32_t> spirv,
               std::span<const Binding> bindings, std::span<const Specialization> specialization,
               std::uint32_t pushConstantBytes) {
    const vk::raii::Device& handle = device.handle();
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
        setLayout_ =
            vk::raii::DescriptorSetLayout(handle, vk::DescriptorSetLayoutCreateInfo({}, layoutBindings));
        const vk::PushConstantRange range(vk::ShaderStageFlagBits::eCompute, 0, pushConstantBytes);
        const vk::DescriptorSetLayout setLayout = *setLayout_;
        vk::PipelineLayoutCreateInfo layoutCreate({}, setLayout);
        if (pushConstantBytes > 0) layoutCreate.setPushConstantRanges(range);
        layout_ = vk::raii::PipelineLayout(handle, layoutCreate);

        const vk::DescriptorPoolCreateFlags freeable = vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet;
        pool_ = vk::raii::DescriptorPool(handle, vk::DescriptorPoolCreateInfo(freeable, 1, sizes));
        set_ =
            std::move(vk::raii::DescriptorSets(handle, vk::DescriptorSetAllocateInfo(*pool_, setLayout))[0]);
        std::uint32_t element = 0;
        for (std::size_t i = 0; i < bindings.size(); ++i) {
            const Binding& b = bindings[i];
            element = i > 0 && bindings[i - 1].binding == b.binding ? element + 1 : 0;
            const vk::DescriptorType type = descriptorType(b);
            const vk::WriteDescriptorSetAccelerationStructureKHR structure(b.structure);
            vk::DescriptorBufferInfo info({}, 0, VK_WHOLE_SIZE);
            vk::BufferView view;
            vk::WriteDescriptorSet write(*set_, b.binding, element, 1, type);
            if (b.buffer == nullptr) {
                write.setPNext(&structure);
            } else if (b.buffer->view()) {
                view = b.buffer->view();
                write.setPTexelBufferView(&view);
            } else {
                info.setBuffer(b.buffer->handle());
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
        pipeline_ = vk::raii::Pipeline(handle, nullptr, vk::ComputePipelineCreateInfo({}, stage, *layout_));
    } catch (const vk::SystemError& e) {
        throw failureOn(device.info(), fmt::format("creating the pipeline of kernel '{}'", name), e);
    }
}

void Kernel::record(const vk::raii::CommandBuffer& commands, std::span<const std::byte> push,
                    std::uint32_t groups) const {
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline_);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout_, 0, *set_, {});
    commands.pushConstants<std::byte>(
        *layout_, vk::ShaderStageFlagBits::eCompute, 0,
        vk::ArrayProxy<const std::byte>(static_cast<std::uint32_t>(push.size()), push.data()));
    commands.dispatch(groups, 1, 1);
}

}  // namespace duolux
