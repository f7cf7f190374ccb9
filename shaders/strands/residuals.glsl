// Residuals: the differences at rest between the file's strands and the curve of their guides'
// mean. They come from a table (hair/rendering/strand_offsets.h), in the axes of the groom at
// rest. They turn as the guides have turned since (strands/turns.comp).
#ifndef HAIRBENCH_STRAND_RESIDUALS_GLSL
#define HAIRBENCH_STRAND_RESIDUALS_GLSL

#include "common/picture.glsl"
#include "strands/offsets.glsl"
#include "strands/roots.glsl"

layout(buffer_reference, scalar) readonly buffer Residuals { uvec2 samples[]; };
layout(buffer_reference, scalar) readonly buffer GuideTurns { vec4 turns[]; };

// The search for a sample starts this fraction of an interval ahead of its position in even
// spacing. hair/rendering/strand_offsets.cpp uses the same value.
const float kResidualGuess = 0.25;

// A sample is four 16-bit numbers: a vector in steps, and its position along the strand.
struct ResidualSample {
    vec3 value;  // steps
    float place;  // 0 to kResidualPlaces
};

ResidualSample residualSample(Residuals table, uint index) {
    uvec2 bits = table.samples[index];
    ivec2 words = ivec2(bits);
    return ResidualSample(vec3(bitfieldExtract(words.x, 0, 16), bitfieldExtract(words.x, 16, 16),
                               bitfieldExtract(words.y, 0, 16)),
                          float(bits.y >> 16));
}

// Returns the last sample of a strand at or before a position, at most the last but one. If points
// are evenly spaced, two lookups near the expected position find it. Otherwise it takes as many
// bisections as the longest strand needs. All invocations run all of them: in a branch, lavapipe's
// evaluation stage wrongly executes a loop that invocations leave one by one.
uint residualInterval(Residuals table, BoundStrand strand, float along, float place) {
    uint low = 0u;
    uint high = strand.residuals - 1u;
    uint halvings = table.samples[0].x;
    precise float guess = along * float(high) + kResidualGuess;
    uint look = clamp(uint(guess), 1u, max(high, 2u) - 1u);
    for (uint i = 0u; i < 2u + halvings; ++i) {
        bool is_found = high - low <= 1u;
        bool is_before = float(table.samples[strand.first_residual + look].y >> 16) <= place;
        low = is_before && !is_found ? look : low;
        high = is_before || is_found ? high : look;
        uint middle = (low + high) / 2u;
        look = i > 0u ? middle : is_before ? min(low + 1u, high) : max(high, 1u) - 1u;
    }
    return low;
}

// The residual and its derivative by the position along the strand, 0 to 1, by Bessel's cubic
// interpolation: at both samples the cubic has the slope of the parabola through them and the
// sample beyond. De Boor 1978, A Practical Guide to Splines, chapter IV.
StrandOffset strandResidual(PictureParameters picture, BoundStrand strand, float along) {
    Residuals table = Residuals(picture.residuals);
    precise float place = along * kResidualPlaces;
    uint interval = residualInterval(table, strand, along, place);
    uint first = strand.first_residual + interval;
    bool is_first = interval == 0u;
    bool is_last = interval + 2u == strand.residuals;
    ResidualSample a = residualSample(table, is_first ? first : first - 1u);
    ResidualSample b = residualSample(table, first);
    ResidualSample c = residualSample(table, first + 1u);
    ResidualSample d = residualSample(table, is_last ? first + 1u : first + 2u);

    // Changes over the interval if the curve were as steep throughout as at either end.
    precise float size = c.place - b.place;
    precise vec3 change = c.value - b.value;
    precise float part_before = is_first ? 0.0 : size / (c.place - a.place);
    precise float part_behind = is_last ? 0.0 : size / (d.place - b.place);
    precise vec3 steep_before =
        is_first ? vec3(0.0) : (b.value - a.value) * (size / (b.place - a.place)) - change;
    precise vec3 steep_behind =
        is_last ? vec3(0.0) : (d.value - c.value) * (size / (d.place - c.place)) - change;
    precise vec3 bent_before = part_before * steep_before;
    precise vec3 bent_behind = part_behind * steep_behind;
    // Without a neighbour, the parabola of the other end continues.
    if (is_first) bent_before = -bent_behind;
    if (is_last) bent_behind = -bent_before;

    precise float t = clamp((place - b.place) / size, 0.0, 1.0);
    precise float s = 1.0 - t;
    precise vec3 value =
        strand.residual_step *
        (b.value + t * change + t * s * (s * bent_before - t * bent_behind));
    precise vec3 slope = strand.residual_step * kResidualPlaces / size *
                         (change + s * (1.0 - 3.0 * t) * bent_before -
                          t * (2.0 - 3.0 * t) * bent_behind);
    return StrandOffset(value, slope);
}

vec4 guideTurn(PictureParameters picture, uint guide, uint segment, float share) {
    GuideTurns guides = GuideTurns(picture.guide_turns);
    uint first = guide * picture.vertices_per_guide + segment;
    precise vec4 turn = (1.0 - share) * guides.turns[first] + share * guides.turns[first + 1u];
    return turn;
}

// Turns a vector by a unit quaternion, with the same rounding in every stage: strands/curve.glsl.
vec3 turnedBy(vec4 turn, vec3 v) {
    precise vec3 half_moved = cross(turn.xyz, v);
    precise vec3 moved = v + 2.0 * (turn.w * half_moved + cross(turn.xyz, half_moved));
    return moved;
}

// The rotation of a strand since rest at t of a segment: the mean of its guides' rotations. It is
// one step of power iteration from the heaviest guide's rotation towards Markley et al. 2007,
// Averaging Quaternions, equation (12). Signs make no difference, and the result is never 0. A
// guide half a turn away from the heaviest has no weight, so that nothing jumps.
vec4 strandTurn(PictureParameters picture, uvec3 guides, vec3 weights, uint segment, float t) {
    precise float share = t * t * (3.0 - 2.0 * t);  // makes the rotation smooth across vertices
    vec4 a = guideTurn(picture, guides.x, segment, share);
    vec4 b = guideTurn(picture, guides.y, segment, share);
    vec4 c = guideTurn(picture, guides.z, segment, share);
    uint heaviest = heaviestCorner(weights);
    vec4 most = heaviest == 0u ? a : heaviest == 1u ? b : c;
    precise vec4 mean = weights.x * dot(most, a) * a + weights.y * dot(most, b) * b +
                        weights.z * dot(most, c) * c;
    precise vec4 turn = mean * inversesqrt(max(dot(mean, mean), 1e-30));
    return turn;
}

#endif
