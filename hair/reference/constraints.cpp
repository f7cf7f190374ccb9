#include "hair/reference/constraints.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace hair::reference {

glm::dvec3 sideways(const glm::dvec3& v) {
    int least = 0;
    for (int i = 1; i < 3; ++i)
        if (std::abs(v[i]) < std::abs(v[least])) least = i;
    glm::dvec3 axis{0.0};
    axis[least] = 1.0;
    const glm::dvec3 normal = glm::cross(v, axis);
    if (glm::length(normal) == 0.0) return {0.0, 1.0, 0.0};
    return glm::normalize(normal);
}

namespace {

// Rodrigues' formula.
glm::dmat3 turn(const glm::dvec3& axis, double sine, double cosine) {
    const glm::dmat3 k{{0.0, axis.z, -axis.y}, {-axis.z, 0.0, axis.x}, {axis.y, -axis.x, 0.0}};
    return glm::dmat3(1.0) + sine * k + (1.0 - cosine) * (k * k);
}

glm::dmat3 smallestRotation(const glm::dvec3& from, const glm::dvec3& to) {
    const glm::dvec3 normal = glm::cross(from, to);
    const double sine = glm::length(normal);
    const double cosine = glm::dot(from, to);
    if (cosine < 0.0 && sine < 1e-6) return turn(sideways(from), 0.0, -1.0);
    if (sine == 0.0) return glm::dmat3(1.0);
    return turn(normal / sine, sine, cosine);
}

double weight(std::size_t vertex) { return vertex == 0 ? 0.0 : 1.0; }

double inverseMassOf(InverseMasses inverse_masses, std::size_t vertex) {
    return inverse_masses.empty() ? 1.0 : inverse_masses[vertex];
}

// Calls `correct(i)` for every segment of a strand in red-black order.
template <class Correct>
void redBlack(std::size_t vertices, Correct correct) {
    for (std::size_t first : {std::size_t{1}, std::size_t{2}})
        for (std::size_t i = first; i < vertices; i += 2) correct(i);
}

double pullOn(double stiffness, double inverse_mass) {
    if (stiffness == 1.0) return 1.0;
    const double spring = inverse_mass * stiffness / (1.0 - stiffness);
    return spring / (1.0 + spring);
}

glm::dvec3 handAt(const std::vector<PullKey>& path, double time) {
    glm::dvec3 place = path.front().position;
    for (std::size_t i = 1; i < path.size(); ++i) {
        const double start = path[i - 1].time;
        const double end = path[i].time;
        if (time <= start) break;
        const glm::dvec3 way = glm::dvec3(path[i].position) - glm::dvec3(path[i - 1].position);
        place =
            glm::dvec3(path[i - 1].position) + std::fmin(1.0, (time - start) / (end - start)) * way;
    }
    return place;
}

bool pullsIn(const std::vector<PullKey>& path, double from, double to) {
    if (path.empty()) return false;
    const double middle = (from + to) / 2.0;
    return double{path.front().time} <= middle && middle <= double{path.back().time};
}

}  // namespace

// ---- Constraints --------------------------------------------------------------------------------

void integrate(
    Points positions, Points previous, ConstPoints accelerations, double velocity_kept,
    double substep) {
    for (std::size_t i = 1; i < positions.size(); ++i) {
        const glm::dvec3 now = positions[i];
        positions[i] =
            now + velocity_kept * (now - previous[i]) + accelerations[i] * (substep * substep);
        previous[i] = now;
    }
}

glm::dvec3
withDrag(const glm::dvec3& velocity, const glm::dmat3& rate, const glm::dvec3& air, double h) {
    return glm::inverse(glm::dmat3(1.0) + h * rate) * (velocity + h * rate * air);
}

double inverseMassIn(const glm::dmat3& rate, double h) {
    return 1.0 / (1.0 + h * (rate[0][0] + rate[1][1] + rate[2][2]) / 2.0);
}

void pullToRest(
    Points positions, ConstPoints rest, double stiffness, InverseMasses inverse_masses) {
    for (std::size_t i = 1; i < positions.size(); ++i)
        positions[i] +=
            pullOn(stiffness, inverseMassOf(inverse_masses, i)) * (rest[i] - positions[i]);
}

std::vector<glm::dmat3>
segmentFrames(ConstPoints positions, ConstPoints rest, const glm::dmat3& root_frame) {
    std::vector<glm::dmat3> frames{root_frame};
    glm::dvec3 rest_tangent{0.0, 1.0, 0.0};  // of the segment before
    glm::dvec3 tangent{0.0};
    for (std::size_t i = 1; i < positions.size(); ++i) {
        const glm::dvec3 rest_edge = rest[i] - rest[i - 1];
        const glm::dvec3 edge = positions[i] - positions[i - 1];
        const bool has_rest_direction = glm::length(rest_edge) >= kShortest;
        const glm::dvec3 next_rest = has_rest_direction ? glm::normalize(rest_edge) : rest_tangent;
        if (i == 1) {
            rest_tangent = next_rest;
            tangent = root_frame * next_rest;
        }
        const bool has_direction = has_rest_direction && glm::length(edge) >= kShortest;
        const glm::dvec3 next = has_direction ? glm::normalize(edge) : tangent;

        const glm::dmat3 bend = smallestRotation(tangent, next);
        const glm::dmat3 rest_bend = smallestRotation(rest_tangent, next_rest);
        frames.push_back(bend * frames.back() * glm::transpose(rest_bend));
        tangent = next;
        rest_tangent = next_rest;
    }
    return frames;
}

void pullToShape(
    Points positions, ConstPoints rest, double stiffness, const glm::dmat3& root_frame,
    InverseMasses inverse_masses) {
    const auto frames = segmentFrames(positions, rest, root_frame);
    redBlack(positions.size(), [&](std::size_t i) {
        const glm::dvec3 goal = positions[i - 1] + frames[i - 1] * (rest[i] - rest[i - 1]);
        const glm::dvec3 d = goal - positions[i];
        const double sum = weight(i - 1) + weight(i);
        positions[i - 1] -=
            inverseMassOf(inverse_masses, i - 1) * weight(i - 1) / sum * stiffness * d;
        positions[i] += inverseMassOf(inverse_masses, i) * weight(i) / sum * stiffness * d;
    });
}

void projectLengths(Points positions, ConstPoints rest, InverseMasses inverse_masses) {
    redBlack(positions.size(), [&](std::size_t i) {
        const double rest_length = glm::length(rest[i] - rest[i - 1]);
        const glm::dvec3 edge = positions[i] - positions[i - 1];
        const double length = glm::length(edge);
        const glm::dvec3 n = length < kShortest ? glm::dvec3{0.0, 1.0, 0.0} : edge / length;
        const double stretch = length - rest_length;
        const double above = inverseMassOf(inverse_masses, i - 1) * weight(i - 1);
        const double below = inverseMassOf(inverse_masses, i) * weight(i);
        positions[i - 1] += above / (above + below) * stretch * n;
        positions[i] -= below / (above + below) * stretch * n;
    });
}

void solveLengths(
    Points positions, ConstPoints rest, std::uint32_t passes, InverseMasses inverse_masses,
    std::span<const VertexContact> met) {
    if (passes == 0) return;
    const std::size_t count = positions.size();
    const std::vector<glm::dvec3> predicted(positions.begin(), positions.end());
    std::vector<glm::dvec3> directions(count, glm::dvec3(0.0));  // of segments
    const auto metAt = [&](std::size_t i) { return met.empty() ? VertexContact{} : met[i]; };
    // Yielding of a vertex on a body: across the surface 0.01 of its free yielding, along it 1
    // minus 0.99 of the fraction that friction holds.
    const auto light = [&](std::size_t i) {
        return (1.0 - 0.99 * metAt(i).held) * weight(i) * inverseMassOf(inverse_masses, i);
    };
    const auto restLength = [&](std::size_t i) { return glm::distance(rest[i], rest[i - 1]); };
    // Returns how far vertex i moves along b under a force along a; `cosine` is that of their
    // angle.
    const auto compliance = [&](std::size_t i, const glm::dvec3& a, const glm::dvec3& b,
                                double cosine) {
        if (!metAt(i).touches) return light(i) * cosine;
        const glm::dvec3 n = metAt(i).normal;
        const double across = 0.01 * weight(i) * inverseMassOf(inverse_masses, i);
        return light(i) * cosine - (light(i) - across) * glm::dot(a, n) * glm::dot(n, b);
    };
    const auto place = [&](std::size_t i, const glm::dvec3& wanted) {
        const glm::dvec3 edge = wanted - positions[i - 1];
        const double length = glm::length(edge);
        directions[i] = length < kShortest ? glm::dvec3{0.0, 1.0, 0.0} : edge / length;
        glm::dvec3& d = directions[i];
        const glm::dvec3 n = metAt(i).normal;
        double height = metAt(i).height - glm::dot(n, positions[i - 1]);
        height /= std::fmax(restLength(i), kShortest);
        if (n != glm::dvec3(0.0) && glm::dot(n, d) < height) {
            height = std::clamp(height, -1.0, 1.0);
            const glm::dvec3 across = d - glm::dot(d, n) * n;
            const double sine = std::sqrt(std::fmax(1.0 - height * height, 0.01));
            d = glm::normalize(height * n + sine / std::fmax(glm::length(across), 0.05) * across);
        }
        if (restLength(i) < kShortest) d = directions[i - 1];
        positions[i] = positions[i - 1] + restLength(i) * directions[i];
    };
    for (std::size_t i = 1; i < count; ++i) place(i, predicted[i]);

    std::vector<double> stretches(count), diagonal(count), off_diagonal(count),
        densities(count + 1);
    std::vector<glm::dvec3> pulls(count);
    for (std::uint32_t pass = 0; pass < passes; ++pass) {
        // The tensions, row by row from the tip up; off_diagonal[i] is between i and i + 1.
        for (std::size_t i = 1; i < count; ++i) {
            const glm::dvec3& d = directions[i];
            diagonal[i] = compliance(i - 1, d, d, 1.0) + compliance(i, d, d, 1.0);
            if (i + 1 < count)
                off_diagonal[i] =
                    -compliance(i, d, directions[i + 1], glm::dot(d, directions[i + 1]));
            stretches[i] = glm::dot(directions[i], predicted[i] - predicted[i - 1]) - restLength(i);
        }
        for (std::size_t i = count - 1; i > 1; --i) {
            const double factor = off_diagonal[i - 1] / diagonal[i];
            diagonal[i - 1] -= factor * off_diagonal[i - 1];
            stretches[i - 1] -= factor * stretches[i];
        }
        double tension = 0.0;
        for (std::size_t i = 1; i < count; ++i) {
            tension = (stretches[i] - (i > 1 ? off_diagonal[i - 1] : 0.0) * tension) / diagonal[i];
            densities[i] = std::max(
                tension / std::max(restLength(i), kShortest), -0.2 / (light(i - 1) + light(i)));
        }
        // The positions, each from those above it.
        for (std::size_t i = count - 1; i > 0; --i) {
            diagonal[i] = 1.0 / light(i) + densities[i] + densities[i + 1];
            pulls[i] = predicted[i] / light(i);
            if (i + 1 == count) continue;
            const double factor = densities[i + 1] / diagonal[i + 1];
            diagonal[i] -= factor * densities[i + 1];
            pulls[i] += factor * pulls[i + 1];
        }
        for (std::size_t i = 1; i < count; ++i)
            place(i, (pulls[i] + densities[i] * positions[i - 1]) / diagonal[i]);
    }
}

CapsuleGap capsuleGap(const glm::dvec3& point, const Collider& collider, double margin) {
    const glm::dvec3 a = collider.a;
    const glm::dvec3 axis = glm::dvec3(collider.b) - a;
    double along = 0.0;
    if (glm::dot(axis, axis) > 0.0)
        along = std::clamp(glm::dot(point - a, axis) / glm::dot(axis, axis), 0.0, 1.0);
    const glm::dvec3 nearest = a + along * axis;
    const double distance = glm::distance(point, nearest);
    return {
        .gap = distance - double{collider.radius} - margin,
        .normal = distance < kShortest ? sideways(axis) : (point - nearest) / distance};
}

std::optional<std::pair<glm::dvec3, CapsuleGap>>
entryInto(const Collider& collider, const glm::dvec3& from, const glm::dvec3& to) {
    constexpr int kParts = 512;  // of the path, to search for a crossing
    const auto at = [&](double t) { return capsuleGap(glm::mix(from, to, t), collider, 0.0); };
    if (at(0.0).gap <= 0.0) return {};
    // Farther away than the path is long: it can't be reached.
    if (at(1.0).gap >= glm::distance(from, to)) return {};
    for (int part = 1; part <= kParts; ++part) {
        double outside = static_cast<double>(part - 1) / kParts;
        double inside = static_cast<double>(part) / kParts;
        if (at(inside).gap > 0.0) continue;
        for (int i = 0; i < 60; ++i) {
            const double middle = (outside + inside) / 2.0;
            (at(middle).gap > 0.0 ? outside : inside) = middle;
        }
        return std::pair(glm::mix(from, to, inside), at(inside));
    }
    return {};
}

// ---- Stiffness at any step ----------------------------------------------------------------------

double keptFactor(const SimulationSettings& settings, const Step& step) {
    const double kept = 1.0 - double{settings.friction};
    if (settings.stiffness_scaling == StiffnessScaling::thesis) return kept;
    return std::pow(kept, step.sub * 60.0);
}

double globalFactor(const SimulationSettings& settings, const Step& step) {
    const double k = settings.global.stiffness;
    if (settings.stiffness_scaling == StiffnessScaling::thesis || k == 1.0) return k;
    const double steps = step.sub * 60.0;
    const double c = k / (1.0 - k) * steps * steps;
    return c / (1.0 + c);
}

double localFactor(const SimulationSettings& settings, const Step& step, double segment_length) {
    const double k = std::min(double{settings.local.stiffness}, 0.95);
    if (settings.stiffness_scaling == StiffnessScaling::thesis || k == 0.0) return k;
    if (segment_length == 0.0) return 0.95;
    const double steps = step.sub * 60.0;
    const double left = std::pow(1.0 - k, 10.0);  // fraction of an error that is left after a
                                                  // reference step
    const double left_by_step =
        std::pow(left, steps * steps * std::pow(0.15 / 7.0 / segment_length, 4.0));
    return std::min(1.0 - std::pow(left_by_step, 1.0 / settings.local.iterations), 0.95);
}

double bendFactor(const SimulationSettings& settings, const Step& step, double segment_length) {
    // Sag of the tip of the thesis's level hair by each joint, under a moment (`bending`) and under
    // a force (`pulling`). At the root the force moves only the lower vertex, by twice as much.
    double bending = 0.0;
    double pulling = 0.0;
    for (int below = 1; below <= 7; ++below) {
        bending += below * below * (below + 1) / 2.0;
        pulling += below * below * (below == 7 ? 0.5 : 1.0);
    }
    const double left = std::log(1.0 - std::min(double{settings.local.stiffness}, 0.95));
    if (settings.stiffness_scaling == StiffnessScaling::thesis)
        return -bending / pulling * settings.local.iterations * left / 2.0;
    const double steps = step.sub * 60.0;
    return -bending / pulling * 10.0 * left / 2.0 * steps * steps *
           std::pow(0.15 / 7.0 / std::fmax(segment_length, 1e-5), 4.0);
}

// ---- Follow the leader --------------------------------------------------------------------------

void stepFtl(
    Points positions, Points previous, ConstPoints rest, const FtlStep& step,
    const PushOut& push_out) {
    const std::vector<glm::dvec3> start(positions.begin(), positions.end());
    const double h = step.substep;
    std::vector<glm::dvec3> corrections(positions.size(), glm::dvec3(0.0));  // d_i of the paper

    positions[0] = rest[0];
    for (std::size_t i = 1; i < positions.size(); ++i) {
        glm::dvec3 p = start[i] + step.velocity_kept * (start[i] - previous[i]) +
                       h * h * step.accelerations[i];
        double inverse_mass = 1.0;
        if (!step.drag.empty()) {
            p = start[i] + h * withDrag((p - start[i]) / h, step.drag[i], step.air[i], h);
            inverse_mass = inverseMassIn(step.drag[i], h);
        }
        p += pullOn(step.global_stiffness, inverse_mass) * (rest[i] - p);

        const glm::dvec3 to_follower = p - positions[i - 1];
        const double length = glm::length(to_follower);
        const glm::dvec3 direction =
            length < 1e-9 ? glm::dvec3{0.0, 1.0, 0.0} : to_follower / length;
        const glm::dvec3 projected =
            positions[i - 1] + glm::distance(rest[i], rest[i - 1]) * direction;
        corrections[i] = projected - p;
        positions[i] = push_out(projected, start[i]).position;
    }

    previous[0] = start[0];
    for (std::size_t i = 1; i < positions.size(); ++i) {
        // Eq. 9 has the velocity of the moved vertex, including a body's push.
        glm::dvec3 velocity = (positions[i] - start[i]) / h;
        if (i + 1 < positions.size()) velocity -= step.velocity_correction / h * corrections[i + 1];
        previous[i] = positions[i] - h * velocity;
    }
}

// ---- Hands --------------------------------------------------------------------------------------

// The held vertex's velocity at the end of the step solves
//   v' = v + dt f + dt (k (h' - x - dt v') + c (w - v')).
// The hand's part is the remainder after f.
void addPulls(
    std::span<const PullSettings> pulls, const PulledHair& hair,
    std::span<glm::dvec3> accelerations) {
    const double dt = hair.to - hair.from;
    for (const PullSettings& pull : pulls) {
        if (!pullsIn(pull.path, hair.from, hair.to)) continue;
        const std::size_t held = pull.guide * hair.vertices + pull.vertex;
        const double k = pull.stiffness;
        const double c = 2.0 * std::sqrt(k);
        const glm::dvec3 hand = handAt(pull.path, hair.to);
        const glm::dvec3 w = (hand - handAt(pull.path, hair.from)) / dt;
        const glm::dvec3 x = hair.positions[held];
        const glm::dvec3 v = (x - hair.previous[held]) / hair.substep;
        const glm::dvec3 f = accelerations[held];
        const glm::dvec3 end =
            (v + dt * f + dt * k * (hand - x) + dt * c * w) / (1.0 + dt * c + dt * dt * k);
        const glm::dvec3 acceleration = (end - v) / dt - f;
        for (std::size_t i = 0; i < accelerations.size(); ++i) {
            if (i % hair.vertices == 0) continue;
            const double d = glm::distance(hair.rest[i], hair.rest[held]);
            const double r = pull.radius;
            if (i == held)
                accelerations[i] += acceleration;
            else if (r > 0.0)
                accelerations[i] += std::exp(-(d * d) / (r * r)) * acceleration;
        }
    }
}

}  // namespace hair::reference
