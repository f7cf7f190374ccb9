#pragma once

#include <vector>

#include "hair/simulation/reference_rod.h"
#include "hair/simulation/reference_solver.h"

namespace hair::reference {

// The rods of reference_rod.h as a solver of a Reference.
class RodSolver : public Solver {
public:
    RodSolver(const Groom& groom, const SimulationSettings& settings, const Step& step);

    void step(const Substep& substep) override;
    void adopt(const Substep& substep) override;

private:
    SimulationSettings settings_;
    Step step_;
    std::vector<RodRest> rests_;    // [strand]
    std::vector<RodState> states_;  // [strand]
};

}  // namespace hair::reference
