/// Compute pipelines: the descriptor set that all of them share, and one pipeline a stage.
#pragma once

#include "gpu/buffer.h"
#include "shared/bindings.h"
#include "shared/features.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>

namespace tyndall::gpu {

/// The buffers behind shaders/shared/bindings.h.
struct Bindings {
    std::array<const Buffer*, shared::TEXEL_BUFFER_COUNT>
        texel_buffers{}; ///< shared::BINDING_SCENE ... shared::BINDING_FILM
    const Buffer* control = nullptr;
    const Buffer* queues = nullptr;
    const Buffer* log = nullptr; ///< Null where no kernel keeps one.
};

/// The one descriptor set, bound once a command buffer, and the pipeline layout (with push
/// constants).
class Descriptors {
  public:
    /// Throws Error if a buffer is larger than the device can bind, and says by how much.
    Descriptors(const Context& context, const Bindings& bindings, std::uint32_t push_bytes);

    VkDescriptorSet set() const { return set_; }
    VkPipelineLayout layout() const { return layout_.get(); }
    std::uint32_t push_bytes() const { return push_bytes_; }
    /// Bit n: texel buffer n exceeds maxTexelBufferElements and is read as a storage buffer
    /// (Features::storage_fallback).
    std::uint32_t storage_fallback() const { return storage_fallback_; }
    /// Bit n: it exceeds maxStorageBufferRange and is written as texels (Features::texel_stores).
    std::uint32_t texel_stores() const { return texel_stores_; }

  private:
    Handle<VkDescriptorSetLayout, &vkDestroyDescriptorSetLayout> set_layout_;
    Handle<VkDescriptorPool, &vkDestroyDescriptorPool> pool_;
    Handle<VkPipelineLayout, &vkDestroyPipelineLayout> layout_;
    VkDescriptorSet set_ = VK_NULL_HANDLE; // owned by pool_
    std::uint32_t push_bytes_ = 0;
    std::uint32_t storage_fallback_ = 0;
    std::uint32_t texel_stores_ = 0;
};

/// One stage of the wavefront: a compute shader specialized by features.
class Stage {
  public:
    Stage(const Context& context, const Descriptors& descriptors, std::string name,
          std::span<const std::uint32_t> spirv, const shared::Features& features);

    const std::string& name() const { return name_; }
    VkPipeline pipeline() const { return pipeline_.get(); }
    std::uint32_t workgroup_size() const { return workgroup_size_; }

  private:
    std::string name_;
    std::uint32_t workgroup_size_;
    Handle<VkPipeline, &vkDestroyPipeline> pipeline_;
};

} // namespace tyndall::gpu
