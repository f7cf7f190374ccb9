#include "benchmarks/groom/compare.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <sstream>
#include <vector>

#include <nlohmann/json.hpp>

#include "benchmarks/report/text.h"
#include "benchmarks/scene/json.h"

namespace benchmarks::groom {
namespace {

using hair::groom::DistanceFindings;
using hair::groom::DistributionFindings;
using hair::groom::PenetrationFindings;
using hair::groom::SampledStrands;
using hair::groom::StrandDirections;

// The mean of both means, called Chamfer-L1 by Mescheder et al. 2019, Occupancy networks.
double chamfer(const hair::groom::StrandComparison& found) {
    return 0.5 * (found.first_to_second.mean + found.second_to_first.mean);
}

// The sum of both mean squares: Fan, Su and Guibas 2017, A point set generation network, eq. 1,
// with means in place of sums.
double chamferSquared(const hair::groom::StrandComparison& found) {
    return found.first_to_second.mean_square + found.second_to_first.mean_square;
}

double hausdorff(const hair::groom::StrandComparison& found) {
    return std::max(found.first_to_second.maximum, found.second_to_first.maximum);
}

// ---- JSON ---------------------------------------------------------------------------------------

scene::Json quantity(std::string_view unit, double value) {
    return {{"unit", unit}, {"value", value}};
}

scene::Json fileJson(const ComparedFile& file, const SampledStrands& sampled) {
    return {
        {"file", file.file.string()},
        {"format", file.format},
        {"unit",
         {{"name", file.unit.name}, {"metres", file.unit.metres}, {"reason", file.unit.reason}}},
        {"strands", sampled.strands},
        {"strands_without_length", sampled.without_length},
        {"samples", sampled.samples},
        {"length", quantity("m", sampled.length)}};
}

scene::Json distancesJson(const DistanceFindings& found) {
    return {
        {"unit", "m"},
        {"mean", found.mean},
        {"root_mean_square", std::sqrt(found.mean_square)},
        {"median", found.median},
        {"percentile90", found.percentile90},
        {"percentile95", found.percentile95},
        {"percentile99", found.percentile99},
        {"maximum", found.maximum}};
}

scene::Json summaryJson(const hair::groom::Summary& spread) {
    return {{"minimum", spread.minimum}, {"quartile1", spread.quartile1},
            {"median", spread.median},   {"quartile3", spread.quartile3},
            {"maximum", spread.maximum}, {"mean", spread.mean}};
}

scene::Json distributionJson(const DistributionFindings& found, std::string_view unit) {
    return {
        {"unit", unit},
        {"first", summaryJson(found.first)},
        {"second", summaryJson(found.second)},
        {"earth_movers_distance", found.earth_movers_distance},
        {"histogram_distance", found.histogram_distance},
        {"histogram",
         {{"edges", found.edges},
          {"first_shares", found.first_shares},
          {"second_shares", found.second_shares}}}};
}

scene::Json penetrationJson(const PenetrationFindings& found) {
    return {
        {"samples_inside", found.samples_inside},
        {"share", found.share},
        {"strands_inside", found.strands_inside},
        {"mean_depth", quantity("m", found.mean_depth)},
        {"deepest", quantity("m", found.deepest)}};
}

}  // namespace

std::string groomComparisonJson(const GroomComparison& comparison) {
    const hair::groom::StrandComparison& found = comparison.found;
    scene::Json object = {
        {"schema", kGroomComparisonSchema},
        {"first", fileJson(comparison.first, found.first)},
        {"second", fileJson(comparison.second, found.second)},
        {"spacing", quantity("m", comparison.settings.spacing)},
        {"curvature_step", quantity("m", comparison.settings.curvature_step)},
        {"consistency_samples", comparison.settings.consistency_samples},
        {"directions", comparison.settings.directions == StrandDirections::either_way
                           ? "either_way"
                           : "from_root_to_tip"},
        {"equal", found.equal}};
    scene::Json& scores = object["scores"] = scene::Json::array();
    for (const hair::groom::MatchScores& each : found.scores)
        scores.push_back(
            {{"distance", quantity("m", each.threshold.distance)},
             {"angle", quantity("degree", each.threshold.angle)},
             {"precision", each.precision},
             {"recall", each.recall},
             {"f1", each.f1},
             {"strand_consistency", each.strand_consistency}});
    object["distances"] = {
        {"first_to_second", distancesJson(found.first_to_second)},
        {"second_to_first", distancesJson(found.second_to_first)},
        {"chamfer", quantity("m", chamfer(found))},
        {"chamfer_squared", quantity("m2", chamferSquared(found))},
        {"hausdorff", quantity("m", hausdorff(found))}};
    object["lengths"] = distributionJson(found.lengths, "m");
    object["curvatures"] = distributionJson(found.curvatures, "1/m");
    if (found.first_inside && found.second_inside)
        object["penetration"] = {
            {"tolerance", quantity("m", hair::groom::kSurfaceTolerance)},
            {"first", penetrationJson(*found.first_inside)},
            {"second", penetrationJson(*found.second_inside)}};
    return object.dump(2, ' ', false, scene::Json::error_handler_t::replace) + '\n';
}

namespace {

// ---- Text for a terminal ------------------------------------------------------------------------

std::string tableText(const std::vector<report::Column>& columns) {
    std::string text;
    for (std::size_t row = 0; row <= columns.front().cells.size(); ++row)
        text += report::columnsLine(columns, row);
    return text;
}

// Values below a picometre are rounding errors of sums and squares.
std::string distanceText(double metres) {
    return metres < 1e-12 ? "0 m" : report::lengthText(metres);
}

std::string percentText(double share) { return report::shortNumber(100.0 * share) + " %"; }

std::string fileText(char name, const ComparedFile& file, const SampledStrands& sampled) {
    std::string text =
        std::string(1, name) + "  " + file.file.string() + ": " + std::string(file.format) + ", " +
        report::countText(sampled.strands, "strand") + ", " + report::lengthText(sampled.length) +
        " in all, in " + file.unit.name + ". " + file.unit.reason + '\n';
    if (sampled.without_length > 0)
        text += "   left out: " + report::countText(sampled.without_length, "strand") +
                " of zero length\n";
    return text;
}

std::string scoresText(const hair::groom::StrandComparison& found) {
    std::vector<report::Column> columns{
        {.title = "  found within", .numeric = false},
        {.title = "precision"},
        {.title = "recall"},
        {.title = "F1"},
        {.title = "strand consistency"}};
    for (const hair::groom::MatchScores& each : found.scores) {
        const double values[] = {each.precision, each.recall, each.f1, each.strand_consistency};
        columns[0].cells.push_back(
            "  " + report::plainNumber(1000.0 * each.threshold.distance) + " mm, " +
            report::plainNumber(each.threshold.angle) + "°");
        for (std::size_t i = 0; i < std::size(values); ++i)
            columns[i + 1].cells.push_back(percentText(values[i]));
    }
    return tableText(columns);
}

std::string distancesText(const hair::groom::StrandComparison& found) {
    std::vector<report::Column> columns{
        {.title = "  distance", .numeric = false},
        {.title = "mean"},
        {.title = "rms"},
        {.title = "median"},
        {.title = "90 %"},
        {.title = "95 %"},
        {.title = "99 %"},
        {.title = "greatest"}};
    const auto add = [&](const char* name, const DistanceFindings& each) {
        const double values[] = {each.mean,         std::sqrt(each.mean_square), each.median,
                                 each.percentile90, each.percentile95,           each.percentile99,
                                 each.maximum};
        columns[0].cells.emplace_back(name);
        for (std::size_t i = 0; i < std::size(values); ++i)
            columns[i + 1].cells.push_back(distanceText(values[i]));
    };
    add("  A to B", found.first_to_second);
    add("  B to A", found.second_to_first);
    return tableText(columns) + "  Chamfer distance " + distanceText(chamfer(found)) +
           " (mean of both means), Hausdorff distance " + distanceText(hausdorff(found)) + '\n';
}

std::string distributionsText(const hair::groom::StrandComparison& found) {
    std::vector<report::Column> columns{{.title = "", .numeric = false},
                                        {.title = "mean of A"},
                                        {.title = "of B"},
                                        {.title = "median of A"},
                                        {.title = "of B"},
                                        {.title = "earth mover's distance"},
                                        {.title = "histograms apart"}};
    const auto add = [&](const char* name, const DistributionFindings& each,
                         const std::function<std::string(double)>& text) {
        const double values[] = {
            each.first.mean, each.second.mean, each.first.median, each.second.median,
            each.earth_movers_distance};
        columns[0].cells.emplace_back(name);
        for (std::size_t i = 0; i < std::size(values); ++i)
            columns[i + 1].cells.push_back(text(values[i]));
        columns.back().cells.push_back(report::shortNumber(each.histogram_distance) + " of 2");
    };
    add("  length", found.lengths, distanceText);
    add("  curvature", found.curvatures,
        [](double value) { return report::shortNumber(value) + " /m"; });
    return tableText(columns);
}

std::string penetrationText(char name, const PenetrationFindings& found) {
    std::string text = std::string("  ") + name + " inside the mesh: " + percentText(found.share) +
                       " of its length, " + report::countText(found.strands_inside, "strand");
    if (found.samples_inside > 0)
        text += ", " + report::lengthText(found.mean_depth) + " deep on average, " +
                report::lengthText(found.deepest) + " at most";
    return text + '\n';
}

}  // namespace

std::string groomComparisonText(const GroomComparison& comparison) {
    const hair::groom::StrandComparison& found = comparison.found;
    std::string text = fileText('A', comparison.first, found.first) +
                       fileText('B', comparison.second, found.second);
    if (found.equal) text += "\n  The same strands, point for point.\n";
    text +=
        '\n' + scoresText(found) + '\n' + distancesText(found) + '\n' + distributionsText(found);
    if (found.first_inside && found.second_inside)
        text += '\n' + penetrationText('A', *found.first_inside) +
                penetrationText('B', *found.second_inside);
    return text;
}

}  // namespace benchmarks::groom
