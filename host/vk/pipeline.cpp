#include "host/vk/pipeline.h"

#include <algorithm>
#include <vector>

#include "host/base/hash.h"

namespace duolux {

namespace {

constexpr std::size_t kMostPipelines = 16;

std::uint64_t keyOf(std::span<const std::uint32_t> spirv, std::span<const Binding> bindings,
                    std::span<const Specialization> specialization, std::uint32_t pushConstantBytes) {
    Hasher hasher;
    hasher.add(std::as_bytes(spirv));
    hasher.add(bindings.size());
    for (const Binding& b : bindings) {
        hasher.add(b.binding);
        hasher.add(static_cast<std::uint32_t>(descriptorType(b)));
    }
    for (const Specialization& s : specialization) {
        hasher.add(s.id);
        hasher.add(s.value);
    }
    hasher.add(pushConstantBytes);
    return hasher.digest();
}

std::shared_ptr<const Pipeline> create(const vk::raii::Device& device, std::span<const std::uint32_t> spirv,
                                       std::span<const Binding> bindings,
                                       std::span<const Specialization> specialization,
                                       std::uint32_t pushConstantBytes) {
    std::vector<vk::DescriptorSetLayoutBinding> layoutBindings;
    for (const Binding& b : bindings) {
        if (!layoutBindings.empty() && layoutBindings.back().binding == b.binding) {
            ++layoutBindings.back().descriptorCount;
        } else {
            layoutBindings.emplace_back(b.binding, descriptorType(b), 1, vk::ShaderStageFlagBits::eCompute);
        }
    }
    auto made = std::make_shared<Pipeline>();
    made->setLayout =
        vk::raii::DescriptorSetLayout(device, vk::DescriptorSetLayoutCreateInfo({}, layoutBindings));
    const vk::PushConstantRange range(vk::ShaderStageFlagBits::eCompute, 0, pushConstantBytes);
    vk::PipelineLayoutCreateInfo layoutCreate({}, *made->setLayout);
    if (pushConstantBytes > 0) layoutCreate.setPushConstantRanges(range);
    made->layout = vk::raii::PipelineLayout(device, layoutCreate);

    std::vector<vk::SpecializationMapEntry> entries;
    std::vector<std::uint32_t> values;
    for (const Specialization& s : specialization) {
        entries.emplace_back(s.id, static_cast<std::uint32_t>(values.size() * sizeof(std::uint32_t)),
                             sizeof(std::uint32_t));
        values.push_back(s.value);
    }
    const vk::SpecializationInfo info(static_cast<std::uint32_t>(entries.size()), entries.data(),
                                      values.size() * sizeof(std::uint32_t), values.data());
    const vk::raii::ShaderModule module(device,
                                        vk::ShaderModuleCreateInfo({}, spirv.size_bytes(), spirv.data()));
    const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute, *module, "main",
                                                  &info);
    made->pipeline =
        vk::raii::Pipeline(device, nullptr, vk::ComputePipelineCreateInfo({}, stage, *made->layout));
    return made;
}

}  // namespace

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

std::shared_ptr<const Pipeline> Pipelines::get(const vk::raii::Device& device,
                                               std::span<const std::uint32_t> spirv,
                                               std::span<const Binding> bindings,
                                               std::span<const Specialization> specialization,
                                               std::uint32_t pushConstantBytes) {
    const std::uint64_t key = keyOf(spirv, bindings, specialization, pushConstantBytes);
    const std::lock_guard lock(mutex_);
    const auto found = std::ranges::find(entries_, key, &Entry::key);
    if (found != entries_.end()) {
        entries_.splice(entries_.begin(), entries_, found);
    } else {
        entries_.push_front({key, create(device, spirv, bindings, specialization, pushConstantBytes)});
        if (entries_.size() > kMostPipelines) entries_.pop_back();
    }
    return entries_.front().pipeline;
}

}  // namespace duolux
