// Eight independent chains of multiply-adds, enough to keep a processor's arithmetic units busy. No
// compiler knows the factors.
#ifndef HAIRBENCH_LIMITS_ARITHMETIC_GLSL
#define HAIRBENCH_LIMITS_ARITHMETIC_GLSL

#include "common/extensions.glsl"
#include "shared/limit_structs.h"

layout(push_constant, scalar) uniform Push { LimitPush push; };

float chains(float start) {
    vec4 a = start + vec4(0.0, 0.1, 0.2, 0.3);
    vec4 b = a + 0.05;
    for (uint i = 0u; i < push.rounds; ++i) {
        a = a * push.factor + push.addend;
        b = b * push.factor + push.addend;
        a = a * push.factor + push.addend;
        b = b * push.factor + push.addend;
        a = a * push.factor + push.addend;
        b = b * push.factor + push.addend;
        a = a * push.factor + push.addend;
        b = b * push.factor + push.addend;
    }
    return dot(a + b, vec4(1.0));
}

#endif
