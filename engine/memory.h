#pragma once

#include "engine/instance.h"

// VulkanMemoryAllocator, set up for volk. Only engine's own .cpp files include this.
#define VMA_STATIC_VULKAN_FUNCTIONS 0
#define VMA_DYNAMIC_VULKAN_FUNCTIONS 1
#include <vk_mem_alloc.h>
