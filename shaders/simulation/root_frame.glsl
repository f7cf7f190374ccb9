// The motion since rest of a strand's root, its rest shape and its follicle's directions. It is the
// head's motion or, if an animation deforms the mesh, that of the root's own triangle.
#ifndef HAIRBENCH_SIMULATION_ROOT_FRAME_GLSL
#define HAIRBENCH_SIMULATION_ROOT_FRAME_GLSL

#include "common/rigid_frame.glsl"
#include "shared/options.h"

layout(constant_id = kSkinnedRootsConstant) const bool kSkinnedRoots = false;

layout(buffer_reference, scalar) readonly buffer RootFrames { RigidFrame at[]; };

// `head` and `roots` are SubstepPush::frame and roots, or both the `_before` members.
RigidFrame rootFrame(RigidFrame head, Address roots, uint strand) {
    if (kSkinnedRoots) return RootFrames(roots).at[strand];
    return head;
}

#endif
