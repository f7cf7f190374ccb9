#include "hair/simulation/reference_ftl.h"

#include <glm/geometric.hpp>

namespace hair::reference {

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
        p += step.global_stiffness * (rest[i] - p);

        const glm::dvec3 to_follower = p - positions[i - 1];
        const double length = glm::length(to_follower);
        const glm::dvec3 direction =
            length < 1e-9 ? glm::dvec3{0.0, 1.0, 0.0} : to_follower / length;
        const glm::dvec3 projected =
            positions[i - 1] + glm::distance(rest[i], rest[i - 1]) * direction;
        corrections[i] = projected - p;
        positions[i] = push_out(projected, start[i]);
    }

    previous[0] = start[0];
    for (std::size_t i = 1; i < positions.size(); ++i) {
        // Eq. 9 has the velocity of the moved vertex; where a body pushed, the push is part of it.
        glm::dvec3 velocity = (positions[i] - start[i]) / h;
        if (i + 1 < positions.size()) velocity -= step.velocity_correction / h * corrections[i + 1];
        previous[i] = positions[i] - h * velocity;
    }
}

}  // namespace hair::reference
