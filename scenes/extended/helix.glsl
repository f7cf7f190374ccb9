// Strands of helices: each segment is an arc of the helix through its four vertices, so that few
// vertices make smooth curls of the right width.
//
// Vertices that are evenly spaced on a helix of radius r, which turns by theta and rises by h from
// one to the next, have second differences of 2 (1 - cos theta) r toward its axis. Two successive
// ones enclose theta, and their cross product lies along the axis. Other vertices have such a helix
// too, which leaves the segment's end beside the vertex; the rest is added smoothly. Where there is
// hardly a turn, or almost half of one, the helix is not determined and the strand is a Catmull-Rom
// curve.
// docs/extending.md says what a curve is given.

// @parameter least_turn 3 [0.5, 60] deg: turns below this between vertices are of no helix
// @parameter most_turn 120 [90, 170] deg: nor are turns above this

vec3 turned(vec3 v, vec3 axis, float angle) {
    return mix(dot(v, axis) * axis, v, cos(angle)) + sin(angle) * cross(axis, v);
}

HairCurvePoint catmullRom(HairSegment s, float t) {
    vec3 slope = 0.5 * (s.to - s.before);
    vec3 square = 0.5 * (2.0 * s.before - 5.0 * s.from + 4.0 * s.to - s.after);
    vec3 cube = 0.5 * (3.0 * (s.from - s.to) + s.after - s.before);
    return HairCurvePoint(
        s.from + t * (slope + t * (square + t * cube)),
        slope + t * (2.0 * square + 3.0 * t * cube));
}

HairCurvePoint curveHair(HairSegment s, float t) {
    HairCurvePoint curve = catmullRom(s, t);
    vec3 edge = s.to - s.from;
    vec3 inward = s.before - 2.0 * s.from + s.to;  // at the segment's start
    vec3 inward_after = s.from - 2.0 * s.to + s.after;  // at its end
    float size = length(inward), size_after = length(inward_after);
    float least = 1e-3 * length(edge);
    // At a strand's end the mirrored vertex leaves no difference: a circle goes on.
    vec3 axis;
    float angle;
    if (max(size, size_after) < least) return curve;
    if (min(size, size_after) < least) {
        bool at_root = size < size_after;
        vec3 first = at_root ? edge : s.from - s.before;
        vec3 second = at_root ? s.after - s.to : edge;
        axis = cross(first, second);
        angle = atan(length(axis), dot(first, second));
        axis = axis / max(length(axis), 1e-30);
        if (at_root) inward = turned(inward_after, axis, -angle);
    } else {
        axis = cross(inward, inward_after);
        angle = atan(length(axis), dot(inward, inward_after));
        axis = axis / max(length(axis), 1e-30);
    }
    float turns = degrees(angle);
    float share = smoothstep(least_turn, 2.0 * least_turn, turns) *
                  (1.0 - smoothstep(0.75 * most_turn, most_turn, turns));
    if (share == 0.0) return curve;

    vec3 to_axis = inward / (2.0 * (1.0 - cos(angle)));
    float rise = dot(edge, axis);
    vec3 center = s.from + to_axis + t * rise * axis;
    vec3 spoke = turned(-to_axis, axis, t * angle);
    vec3 end = s.from + to_axis + rise * axis + turned(-to_axis, axis, angle);
    vec3 rest = s.to - end;
    vec3 position = center + spoke + t * t * (3.0 - 2.0 * t) * rest;
    vec3 tangent = rise * axis + angle * cross(axis, spoke) + 6.0 * t * (1.0 - t) * rest;
    return HairCurvePoint(
        mix(curve.position, position, share), mix(curve.tangent, tangent, share));
}
