#pragma once

#include <cstdint>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "engine/device_address.h"

// Structs and constants shared by C++ and GLSL. Scalar layout on both sides: padding is always
// explicit.
namespace hair::gpu {

using Address = engine::DeviceAddress;
using glm::mat4;
using glm::uvec3;
using glm::vec2;
using glm::vec3;
using glm::vec4;
using uint = std::uint32_t;

#include "shaders/shared/distance_field_structs.h"
#include "shaders/shared/environment_structs.h"
#include "shaders/shared/fragment_structs.h"
#include "shaders/shared/light_structs.h"
#include "shaders/shared/mesh_structs.h"
#include "shaders/shared/optics_structs.h"
#include "shaders/shared/options.h"
#include "shaders/shared/overlay_structs.h"
#include "shaders/shared/points_structs.h"
#include "shaders/shared/rod_structs.h"
#include "shaders/shared/shadow_structs.h"
#include "shaders/shared/simulation_structs.h"
#include "shaders/shared/software_structs.h"
#include "shaders/shared/strand_mesh_structs.h"
#include "shaders/shared/strand_structs.h"
#include "shaders/shared/volume_structs.h"
#include "shaders/shared/watch_structs.h"

}  // namespace hair::gpu
