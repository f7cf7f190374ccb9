// The parameters of the picture being drawn, behind the address in the push constants.
#ifndef HAIRBENCH_PICTURE_GLSL
#define HAIRBENCH_PICTURE_GLSL

#extension GL_GOOGLE_include_directive : require

#include "common/extensions.glsl"
#include "shared/environment_structs.h"
#include "shared/fragment_structs.h"
#include "shared/light_structs.h"
#include "shared/optics_structs.h"
#include "shared/overlay_structs.h"
#include "shared/shadow_structs.h"
#include "shared/strand_structs.h"

layout(buffer_reference, scalar) readonly buffer PictureReference { PictureParameters parameters; };
layout(buffer_reference, scalar) readonly buffer GuidePoints { vec4 points[]; };
layout(buffer_reference, scalar) readonly buffer RootTriangles { uint guides[]; };
layout(buffer_reference, scalar) readonly buffer RootNormals { vec3 normals[]; };

#endif
