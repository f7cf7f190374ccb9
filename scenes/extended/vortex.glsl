// A whirl of air about a vertical axis, with an updraught in its core: a Rankine vortex, of solid
// rotation within the core and of 1 / distance outside. It grows and then stays.
// docs/extending.md says what a force is given.

// @parameter axis (0, 0, 0) [-10, 10] m: a point on the axis
// @parameter core 0.08 [0.001, 10] m: radius of the core
// @parameter speed 6 [0, 100] m/s: of the air at the edge of the core
// @parameter updraught 2.5 [0, 100] m/s: of the air on the axis
// @parameter drag 4 [0, 100] 1/s: acceleration by how much faster than the hair the air is
// @parameter rise 0.5 [0.01, 100] s: time in which the whirl grows

vec3 accelerateGuide(GuidePoint point) {
    vec3 out_of_axis = point.position - axis;
    out_of_axis.y = 0.0;
    float distance_to_axis = max(length(out_of_axis), 1e-6);
    vec3 outward = out_of_axis / distance_to_axis;
    vec3 around = vec3(outward.z, 0.0, -outward.x);
    float part = distance_to_axis / core;
    float whirl = speed * (part < 1.0 ? part : 1.0 / part);
    vec3 air = whirl * around + vec3(0.0, updraught * exp(-part * part), 0.0);
    return smoothstep(0.0, rise, point.time) * drag * (air - point.velocity);
}
