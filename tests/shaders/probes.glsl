// The structs of probes and their dependencies.
#include "common/extensions.glsl"
#include "shared/distance_field_structs.h"
#include "probe_structs.h"
