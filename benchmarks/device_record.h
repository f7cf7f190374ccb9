#pragma once

#include "benchmarks/report.h"
#include "engine/device.h"

namespace benchmarks {

// What a report says of a device. Its limits are Vulkan's, and, where a driver is right only up to
// fewer vertices in a tessellated draw than they allow, "maxTessellatedVertices".
DeviceRecord describeDevice(const engine::Device& device);

}  // namespace benchmarks
