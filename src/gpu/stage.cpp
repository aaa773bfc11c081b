#include "gpu/stage.h"

#include "core/error.h"
#include "gpu/specialize.h"

#include <fmt/format.h>
#include <utility>
#include <vector>

namespace tyndall::gpu {
namespace {

VkDescriptorType binding_type(std::uint32_t binding) {
    if (binding == shared::BINDING_SCENE || binding == shared::BINDING_VOXELS)
        return VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
    if (binding < shared::TEXEL_BUFFER_COUNT) return VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER;
    return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
}

VkDescriptorSetLayout create_set_layout(VkDevice device) {
    std::array<VkDescriptorSetLayoutBinding, shared::BINDING_COUNT> bindings{};
    for (std::uint32_t i = 0; i < shared::BINDING_COUNT; ++i)
        bindings[i] = {.binding = i,
                       .descriptorType = binding_type(i),
                       .descriptorCount = 1,
                       .stageFlags = VK_SHADER_STAGE_COMPUTE_BIT};
    const VkDescriptorSetLayoutCreateInfo create{
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
        .bindingCount = shared::BINDING_COUNT,
        .pBindings = bindings.data()};
    VkDescriptorSetLayout layout = VK_NULL_HANDLE;
    check(vkCreateDescriptorSetLayout(device, &create, nullptr, &layout),
          "create the descriptor layout");
    return layout;
}

VkDescriptorPool create_pool(VkDevice device) {
    const std::array<VkDescriptorPoolSize, 3> sizes{{
        {VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, 2},
        {VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER, shared::TEXEL_BUFFER_COUNT - 2},
        {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, shared::BINDING_COUNT - shared::TEXEL_BUFFER_COUNT},
    }};
    const VkDescriptorPoolCreateInfo create{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                            .maxSets = 1,
                                            .poolSizeCount = sizes.size(),
                                            .pPoolSizes = sizes.data()};
    VkDescriptorPool pool = VK_NULL_HANDLE;
    check(vkCreateDescriptorPool(device, &create, nullptr, &pool), "create the descriptor pool");
    return pool;
}

void check_size(const Context& context, const Buffer& buffer, const char* what) {
    const std::uint64_t limit = context.limits().maxStorageBufferRange;
    if (buffer.bytes() > limit)
        throw Error(ExitStatus::failed,
                    fmt::format("the {} takes {}, {} more than {} can bind as one buffer ({})",
                                what, format_bytes(buffer.bytes()),
                                format_bytes(buffer.bytes() - limit), context.info().name,
                                format_bytes(limit)));
}

constexpr std::array<const char*, shared::TEXEL_BUFFER_COUNT> kTexelBufferNames{
    "scene", "state of the paths", "pieces in flight", "film", "voxels"};

} // namespace

Descriptors::Descriptors(const Context& context, const Bindings& bindings, std::uint32_t push_bytes)
    : push_bytes_(push_bytes) {
    const VkDevice device = context.device();
    set_layout_ = {device, create_set_layout(device)};
    pool_ = {device, create_pool(device)};

    const VkDescriptorSetLayout set_layout = set_layout_.get();
    const VkPushConstantRange push{VK_SHADER_STAGE_COMPUTE_BIT, 0, push_bytes};
    const VkPipelineLayoutCreateInfo layout{.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                            .setLayoutCount = 1,
                                            .pSetLayouts = &set_layout,
                                            .pushConstantRangeCount = 1,
                                            .pPushConstantRanges = &push};
    VkPipelineLayout pipeline_layout = VK_NULL_HANDLE;
    check(vkCreatePipelineLayout(device, &layout, nullptr, &pipeline_layout),
          "create the pipeline layout");
    layout_ = {device, pipeline_layout};

    const VkDescriptorSetAllocateInfo allocate{.sType =
                                                   VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                               .descriptorPool = pool_.get(),
                                               .descriptorSetCount = 1,
                                               .pSetLayouts = &set_layout};
    check(vkAllocateDescriptorSets(device, &allocate, &set_), "allocate the descriptor set");

    std::array<VkBufferView, shared::TEXEL_BUFFER_COUNT> views{};
    std::array<VkDescriptorBufferInfo, shared::BINDING_COUNT> buffers{};
    std::array<VkWriteDescriptorSet, shared::BINDING_COUNT> writes{};
    for (std::uint32_t i = 0; i < shared::BINDING_COUNT; ++i) {
        writes[i] = {.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                     .dstSet = set_,
                     .dstBinding = i,
                     .descriptorCount = 1,
                     .descriptorType = binding_type(i)};
        if (i < shared::TEXEL_BUFFER_COUNT) {
            views[i] = bindings.texel_buffers[i]->view();
            writes[i].pTexelBufferView = &views[i];
            continue;
        }
        const bool is_twin = i < shared::STORAGE_TWIN + shared::TEXEL_BUFFER_COUNT;
        const Buffer& buffer = is_twin ? *bindings.texel_buffers[i - shared::STORAGE_TWIN]
                               : i == shared::BINDING_CONTROL             ? *bindings.control
                               : i == shared::BINDING_LOG && bindings.log ? *bindings.log
                                                                          : *bindings.queues;
        const std::uint64_t limit = context.limits().maxStorageBufferRange;
        if (is_twin) {
            const std::uint32_t bit = 1u << (i - shared::STORAGE_TWIN);
            if (buffer.exceeds_view()) {
                check_size(context, buffer, kTexelBufferNames[i - shared::STORAGE_TWIN]);
                storage_fallback_ |= bit;
            } else if (buffer.bytes() > limit) {
                texel_stores_ |= bit; // and the twin is bound as far as the limit allows
            }
        }
        buffers[i] = {buffer.get(), 0, std::min<std::uint64_t>(buffer.bytes(), limit)};
        writes[i].pBufferInfo = &buffers[i];
    }
    vkUpdateDescriptorSets(device, shared::BINDING_COUNT, writes.data(), 0, nullptr);
}

Stage::Stage(const Context& context, const Descriptors& descriptors, std::string name,
             std::span<const std::uint32_t> spirv, const shared::Features& features)
    : name_(std::move(name)), workgroup_size_(features.workgroup_size) {
    const VkDevice device = context.device();
    const std::vector<std::uint32_t> code = specialize(spirv, features, name_);
    const VkShaderModuleCreateInfo create_module{.sType =
                                                     VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                                 .codeSize = code.size() * sizeof(code[0]),
                                                 .pCode = code.data()};
    VkShaderModule module = VK_NULL_HANDLE;
    check(vkCreateShaderModule(device, &create_module, nullptr, &module),
          "create the shader of stage " + name_);
    const Handle<VkShaderModule, &vkDestroyShaderModule> module_owner(device, module);

    const VkComputePipelineCreateInfo create{
        .sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
        .stage = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                  .stage = VK_SHADER_STAGE_COMPUTE_BIT,
                  .module = module,
                  .pName = "main"},
        .layout = descriptors.layout()};
    VkPipeline pipeline = VK_NULL_HANDLE;
    check(
        vkCreateComputePipelines(device, context.pipelines().get(), 1, &create, nullptr, &pipeline),
        "compile stage " + name_);
    pipeline_ = {device, pipeline};
    context.name(VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<std::uint64_t>(pipeline), name_);
}

} // namespace tyndall::gpu
