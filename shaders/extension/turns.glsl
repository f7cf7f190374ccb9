// A bound on the loops in functions that a scene supplies. Their conditions call hairbenchNextTurn()
// (hair/extension.cpp), so a loop that would never end costs a moment instead of the device.
#ifndef HAIRBENCH_EXTENSION_TURNS_GLSL
#define HAIRBENCH_EXTENSION_TURNS_GLSL

#if defined(HAIRBENCH_EXTENDED_SHADING) || defined(HAIRBENCH_EXTENDED_OFFSET) || \
    defined(HAIRBENCH_EXTENDED_FORCE) || defined(HAIRBENCH_EXTENDED_SOLVER) || \
    defined(HAIRBENCH_EXTENDED_CURVE)

// Turns of all loops in one call of a scene's function. lavapipe ends all loops of an invocation
// after 65,535 turns together, the program's own too, and an invocation may make several calls. A
// solver is called once.
#ifdef HAIRBENCH_EXTENDED_SOLVER
const uint kMostTurns = 32768u;
#else
const uint kMostTurns = 4096u;
#endif

uint extension_turns;

void beginTurns() { extension_turns = 0u; }

bool hairbenchNextTurn() { return ++extension_turns <= kMostTurns; }

#endif

#endif
