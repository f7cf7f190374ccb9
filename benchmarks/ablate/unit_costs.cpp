#include "benchmarks/ablate/unit_costs.h"

namespace benchmarks {

namespace {

struct Unit {
    const char* name;
    std::optional<std::uint64_t> count;
    std::string note{};
};

// What a stage handles one by one.
Unit ownUnit(Stop rung, const WorkCounts& work) {
    switch (rung) {
    case Stop::vertex:
        return {"patch", work.patches};
    case Stop::tessellation_1:
        return {"evaluation", work.evaluations_1};
    case Stop::tessellation:
        if (!work.evaluations) break;
        return {"evaluation", *work.evaluations - work.evaluations_1.value_or(0)};
    case Stop::raster:
    case Stop::fragment:
        return {"fragment", work.fragments, work.fragments_note};
    case Stop::msaa:
        return {"sample", work.samples};
    default:
        break;
    }
    return {"", std::nullopt};
}

}  // namespace

std::vector<UnitCost> unitCosts(const std::vector<RungCost>& rungs, const WorkCounts& work) {
    std::vector<UnitCost> costs;
    for (const RungCost& rung : rungs) {
        if (rung.stop == Stop::empty) continue;
        for (const Unit& unit :
             {Unit{"strand", work.strands}, Unit{"segment", work.segments},
              ownUnit(rung.stop, work)}) {
            if (unit.count.value_or(0) == 0) continue;
            const double each = 1e6 * rung.marginal.estimate / static_cast<double>(*unit.count);
            costs.push_back({rung.stop, unit.name, *unit.count, each, unit.note});
        }
    }
    return costs;
}

}  // namespace benchmarks
