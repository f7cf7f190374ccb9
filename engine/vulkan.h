#pragma once

#include <volk.h>

#include <string>

#include "engine/error.h"

namespace engine {

// The specification's name of a result, such as "VK_ERROR_DEVICE_LOST".
std::string resultName(VkResult result);

// Throws Error "<what>: <result name>" unless the call succeeded.
void check(VkResult result, const char* what);

}  // namespace engine
