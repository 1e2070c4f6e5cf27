#include "host/vk/kernel.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "host/vk/handles.h"
#include "host/vk/pipeline.h"

namespace duolux {

struct Kernel::Handles {
    std::shared_ptr<const Pipeline> pipeline;
    vk::raii::DescriptorPool pool{nullptr};
    vk::raii::DescriptorSet set{nullptr};
};

Kernel::Kernel(const Device& device, std::string_view name, std::span<const std::uint32_t> spirv,
               std::span<const Binding> bindings, std::span<const Specialization> specialization,
               std::uint32_t pushConstantBytes)
    : handles_(std::make_unique<Handles>()) {
    requireDriverSpace(device.info(), fmt::format("compiling kernel '{}'", name));
    const vk::raii::Device& handle = device.handles().device;
    auto& [pipeline, pool, set] = *handles_;
    try {
        pipeline =
            device.handles().pipelines->get(handle, spirv, bindings, specialization, pushConstantBytes);
        std::vector<vk::DescriptorPoolSize> sizes;
        for (const Binding& b : bindings)
            sizes.emplace_back(descriptorType(b), 1);
        const vk::DescriptorPoolCreateFlags freeable = vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet;
        pool = vk::raii::DescriptorPool(handle, vk::DescriptorPoolCreateInfo(freeable, 1, sizes));
        set = std::move(
            vk::raii::DescriptorSets(handle, vk::DescriptorSetAllocateInfo(*pool, *pipeline->setLayout))[0]);
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
    } catch (const vk::SystemError& e) {
        failOn(device.info(), fmt::format("creating the pipeline of kernel '{}'", name), e);
    }
}

Kernel::~Kernel() = default;
Kernel::Kernel(Kernel&& other) noexcept = default;
Kernel& Kernel::operator=(Kernel&& other) noexcept = default;

void Kernel::record(const Commands& commands, std::span<const std::byte> push, std::uint32_t groups) const {
    const vk::raii::CommandBuffer& vulkan = commands.handle();
    vulkan.bindPipeline(vk::PipelineBindPoint::eCompute, *handles_->pipeline->pipeline);
    vulkan.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *handles_->pipeline->layout, 0, *handles_->set,
                              {});
    vulkan.pushConstants<std::byte>(
        *handles_->pipeline->layout, vk::ShaderStageFlagBits::eCompute, 0,
        vk::ArrayProxy<const std::byte>(static_cast<std::uint32_t>(push.size()), push.data()));
    vulkan.dispatch(groups, 1, 1);
}

}  // namespace duolux
