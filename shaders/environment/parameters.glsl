#ifndef HAIRBENCH_ENVIRONMENT_PARAMETERS_GLSL
#define HAIRBENCH_ENVIRONMENT_PARAMETERS_GLSL

#include "shared/environment_structs.h"

layout(buffer_reference, scalar) readonly buffer EnvironmentReference {
    EnvironmentParameters parameters;
};

#endif
