#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/device_address.h"

// Structs that the measuring shaders and C++ share: see hair/gpu_structs.h.
namespace benchmarks::measure::gpu {

using Address = engine::DeviceAddress;
using uint = std::uint32_t;

#include "shaders/shared/busy_structs.h"
#include "shaders/shared/limit_structs.h"

static_assert(offsetof(BusyPush, steps) == 8);
static_assert(offsetof(LimitPush, rounds) == 8 && sizeof(LimitPush) == 24);

}  // namespace benchmarks::measure::gpu
