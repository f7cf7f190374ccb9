#include "benchmarks/viewer/picture/difference_text.h"

#include "benchmarks/table.h"

namespace benchmarks {

std::string differenceText(const DifferenceFigures& figures) {
    if (figures.different == 0) return "identical";
    return "at most " + std::to_string(figures.most) + " of 255, on average " +
           shortNumber(figures.mean()) + "; " + shortNumber(100.0 * figures.share()) +
           " % of the pixels differ";
}

}  // namespace benchmarks
