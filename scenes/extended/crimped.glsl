// Crimped hair: every strand is bent to and fro in a plane, with sharp edges, ever more closely
// toward the tip. docs/extending.md says what an offset is given.

// @parameter reach 0.02 [0, 0.1] m: no offset is longer
// @parameter amplitude 0.0035 [0, 0.05] m: of the bends at the tip
// @parameter bends 22 [0, 200] count: edges of a strand
// @parameter crowding 0.7 [0, 1] 1: how much closer edges are at the tip than at the root
// @parameter start 0.25 [0, 1] 1: part of the strand over which bends grow from none
// @parameter disorder 0.12 [0, 1] 1: how far strands are out of step, in bends

// A triangle wave with sharp edges: from -1 to 1 and back over a length of 2.
float zigzag(float x) { return 4.0 * abs(fract(0.5 * x + 0.25) - 0.5) - 1.0; }

vec3 offsetHair(HairPlace place) {
    float along = mix(place.along, place.along * place.along, 0.5 * crowding);
    float phase = disorder * (2.0 * hairRandom(place, 0u) - 1.0);
    float size = amplitude * smoothstep(0.0, max(start, 1e-3), place.along);
    return vec3(size * zigzag(bends * along + phase), 0.0, 0.0);
}
