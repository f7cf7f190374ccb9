#version 460
// Combines a quantity of all guides in a fixed order, so that the result never varies. One work
// group per result.
#extension GL_GOOGLE_include_directive : require

#include "simulation/guides.glsl"

layout(local_size_x = kProbeGroupSize) in;

layout(push_constant, scalar) uniform Push { ProbeReducePush push; };

layout(buffer_reference, scalar) readonly buffer WantedResults { ProbeResult at[]; };
layout(buffer_reference, scalar) writeonly buffer Results { float at[]; };

shared float values[kProbeGroupSize];
shared float rests[kProbeGroupSize];
shared uint counts[kProbeGroupSize];
shared uint digit;
shared uint rank;

// A sum and what rounding left out of it: Knuth's two-sum. A million numbers lose no more than a
// few.
struct Sum {
    float value;
    float rest;
};

Sum plus(Sum sum, Sum more) {
    precise float value = sum.value + more.value;
    precise float of_more = value - sum.value;
    precise float lost = (sum.value - (value - of_more)) + (more.value - of_more);
    return Sum(value, sum.rest + more.rest + lost);
}

float valueOf(uint row, uint guide) {
    return Factors(push.rows).at[row * push.guide_count + guide];
}

// Every invocation calls these, with the same row.
float sumOf(uint row) {
    uint self = gl_LocalInvocationID.x;
    Sum sum = Sum(0.0, 0.0);
    for (uint i = self; i < push.guide_count; i += kProbeGroupSize)
        sum = plus(sum, Sum(valueOf(row, i), 0.0));
    values[self] = sum.value;
    rests[self] = sum.rest;
    for (uint half_size = kProbeGroupSize / 2u; half_size > 0u; half_size /= 2u) {
        barrier();
        if (self < half_size) {
            sum = plus(
                Sum(values[self], rests[self]),
                Sum(values[self + half_size], rests[self + half_size]));
            values[self] = sum.value;
            rests[self] = sum.rest;
        }
    }
    barrier();
    return values[0] + rests[0];
}

float greatestOf(uint row) {
    uint self = gl_LocalInvocationID.x;
    float greatest = 0.0;
    for (uint i = self; i < push.guide_count; i += kProbeGroupSize)
        greatest = max(greatest, valueOf(row, i));
    values[self] = greatest;
    for (uint half_size = kProbeGroupSize / 2u; half_size > 0u; half_size /= 2u) {
        barrier();
        if (self < half_size) values[self] = max(values[self], values[self + half_size]);
    }
    barrier();
    return values[0];
}

// The value at a rank, digit by digit of its bits. Values are at least 0, so that their bits are in
// their order.
float valueAtRank(uint row, uint wanted) {
    uint self = gl_LocalInvocationID.x;
    uint known = 0u;
    if (self == 0u) rank = wanted;
    for (uint place = 32u; place > 0u; place -= 8u) {
        counts[self] = 0u;
        barrier();
        for (uint i = self; i < push.guide_count; i += kProbeGroupSize) {
            uint bits = floatBitsToUint(valueOf(row, i));
            if (place == 32u || bits >> place == known)
                atomicAdd(counts[(bits >> (place - 8u)) & 255u], 1u);
        }
        barrier();
        if (self == 0u) {
            uint found = 0u;
            while (found < 255u && rank >= counts[found]) rank -= counts[found++];
            digit = found;
        }
        barrier();
        known = known << 8u | digit;
    }
    return uintBitsToFloat(known);
}

void main() {
    uint result = gl_WorkGroupID.x;
    ProbeResult wanted = WantedResults(push.wanted).at[result];
    float value;
    if (wanted.combined == kProbeRank)
        value = valueAtRank(wanted.row, wanted.rank);
    else if (wanted.combined == kProbeGreatest)
        value = greatestOf(wanted.row);
    else
        value = sumOf(wanted.row);
    if (wanted.combined == kProbeMean) value /= float(push.guide_count);
    if (gl_LocalInvocationID.x == 0u) Results(push.results).at[result] = value * wanted.factor;
}
