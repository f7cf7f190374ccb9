// Masses on springs, one explicit step in each substep: springs to the next vertex keep lengths, to
// the second one resist bending and to the third one torsion. Selle, Lentine and Fedkiw 2008, A
// mass spring model for hair simulation, without its springs to altitudes and its implicit step.
// docs/extending.md says what a solver is given.

// @parameter stretch_modulus 1e6 [0, 1e10] Pa: of springs to the next vertex
// @parameter bend_modulus 2e5 [0, 1e10] Pa: of springs to the second vertex
// @parameter twist_modulus 2e5 [0, 1e10] Pa: of springs to the third vertex
// @parameter damping 5e-5 [0, 1] s: this times the rate of strain is added to the strain
// @parameter longest_substep 0.0005 [0.00002, 0.1] s: for /simulation/substeps 0

const uint kReach = 3u;

// The file's memory of a vertex.
const uint kVelocity = 0u;  // m/s; w: 1 once it is known
const uint kLeft = 1u;  // where the file left the vertex, m
const uint kLengths = 2u;  // of the springs to the vertices before, m; w: 1 once they are known
const uint kNewVelocity = 3u;  // that kVelocity becomes once all vertices have moved

// The velocity with which the file left the vertex. If it is elsewhere, it met a body.
vec3 velocityOf(uint v) {
    vec4 known = guideMemory(v, kVelocity);
    if (known.w == 0.0 || guideMemory(v, kLeft).xyz != guideBefore(v)) return guideVelocity(v);
    return known.xyz;
}

// The length at rest of the spring from a vertex to the d-th one before, m.
float lengthOf(uint v, uint d) {
    vec4 known = guideMemory(v, kLengths);
    if (known.w == 0.0) {
        for (uint i = 0u; i < min(v, kReach); ++i)
            known[i] = distance(guideRest(v), guideRest(v - i - 1u));
        known.w = 1.0;
        setGuideMemory(v, kLengths, known);
    }
    return known[d - 1u];
}

float modulusOf(uint d) {
    return d == 1u ? stretch_modulus : d == 2u ? bend_modulus : twist_modulus;
}

// The force on a vertex of the spring from it to the d-th one before, N.
vec3 springForce(uint v, uint d, float h) {
    uint above = v - d;
    vec3 edge = guideBefore(above) - guideBefore(v);
    float len = length(edge), rest = lengthOf(v, d);
    if (len < 1e-9 || rest < 1e-9) return vec3(0.0);
    vec3 direction = edge / len;
    float radius = guideMaterial().radius;
    float stiffness = modulusOf(d) * 3.14159265 * radius * radius / rest;
    // A motion of w rad/s is stable while (h^2 + 2 h damping) w^2 < 4, and the springs of a vertex
    // together have w^2 of at most 4 times the sum of their k / m, by Gershgorin's circles.
    float share = modulusOf(d) / (stretch_modulus + bend_modulus + twist_modulus);
    float most = 0.9 * share * min(guideMass(v), guideMass(above)) / (h * h + 2.0 * h * damping);
    float rate = dot(velocityOf(above) - velocityOf(v), direction);
    return min(stiffness, most) * (len - rest + damping * rate) * direction;
}

void solveGuide(Guide guide) {
    float h = guide.seconds;
    for (uint v = 1u; v < guide.vertices; ++v) {
        vec3 force = vec3(0.0);
        for (uint d = 1u; d <= kReach; ++d) {
            if (v >= d && modulusOf(d) > 0.0) force += springForce(v, d, h);
            if (v + d < guide.vertices && modulusOf(d) > 0.0) force -= springForce(v + d, d, h);
        }
        vec3 moved = guideDrift(v, velocityOf(v)) +
                     guideYield(v) * (h * h / max(guideMass(v), 1e-30)) * force;
        setGuidePosition(v, guideBefore(v) + moved);
        setGuideMemory(v, kNewVelocity, vec4(moved / h, 1.0));
    }
    for (uint v = 1u; v < guide.vertices; ++v) {
        setGuideMemory(v, kVelocity, guideMemory(v, kNewVelocity));
        setGuideMemory(v, kLeft, vec4(guidePosition(v), 0.0));
    }
}
