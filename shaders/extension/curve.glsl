// The interface for a file that /strands/curve names: docs/extending.md. This header and
// that file are compiled as one unit, so this header includes nothing.
#ifndef HAIRBENCH_EXTENSION_CURVE_GLSL
#define HAIRBENCH_EXTENSION_CURVE_GLSL

// A segment of a strand between two of its vertices, which are means of the guides' vertices, m,
// world. Beyond the root and the tip, the neighbour is mirrored at the end.
struct HairSegment {
    vec3 before;  // the vertex before `from`
    vec3 from;
    vec3 to;
    vec3 after;  // the vertex after `to`
    uint number;  // from 0 at the root
    uint count;  // of the strand's segments
};

struct HairCurvePoint {
    vec3 position;  // m
    vec3 tangent;  // d position / d t, m
};

// ---- Defined by the file ----

// Returns the strand's point at t of the segment: 0 at its start, 1 at its end. Segments should
// meet. A point is drawn no farther from mix(from, to, t) than the longest of the three edges is.
HairCurvePoint curveHair(HairSegment segment, float t);

#endif
