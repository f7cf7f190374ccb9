#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <functional>
#include <iomanip>
#include <iostream>
#include <optional>
#include <ostream>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "benchmarks/commands/commands.h"
#include "benchmarks/groom/convert.h"
#include "benchmarks/groom/info.h"
#include "benchmarks/report/change.h"
#include "benchmarks/report/text.h"
#include "benchmarks/scene/json.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/process.h"
#include "hair/groom/compare.h"
#include "hair/groom/edit.h"
#include "hair/groom/files.h"
#include "hair/groom/groom.h"
#include "hair/groom/inspect.h"
#include "hair/groom/mesh/body_mesh.h"
#include "hair/groom/mesh/import_mesh.h"
#include "hair/groom/style/style.h"

namespace benchmarks::commands {

// ---- hairbench groom edit and its relatives -----------------------------------------------------

namespace {

using hair::groom::EditedStrands;
using hair::groom::StrandSet;

// Edits strands with the given number of metres per unit.
using GroomEdit = std::function<EditedStrands(StrandSet strands, double metres_per_unit)>;

double metresOf(double millimetres) { return millimetres / 1000.0; }

std::optional<double> metresOf(const std::optional<double>& millimetres) {
    if (!millimetres) return {};
    return metresOf(*millimetres);
}

std::optional<hair::groom::BodyMesh> bodyOf(const std::filesystem::path& mesh) {
    if (mesh.empty()) return {};
    return hair::groom::bodyMesh(meshOf(mesh));
}

void warnOf(const std::filesystem::path& file, const std::vector<std::string>& warnings) {
    for (const std::string& each : warnings)
        std::cerr << "hairbench: " << engine::shownText(file.string() + ": " + each) << '\n';
}

void say(const char* did, const std::filesystem::path& file, const StrandSet& strands) {
    std::cout << did << ": " << engine::shownText(file.string()) << ", "
              << report::countText(strands.strandCount(), "strand") << ", "
              << report::countText(strands.points.size(), "point") << std::endl;  // flushes early
}

// Returns metres per unit of the file: from --scale, from the file, or a guess with a warning.
double unitOf(const StrandSet& strands, const EditGroomOptions& options) {
    if (options.scale) return *options.scale;
    const auto findings = hair::groom::inspect(strands, nullptr, {});
    if (!findings.unit_stated)
        warnOf(
            options.in,
            {"states no unit; lengths are taken as " + findings.unit + "; --scale sets the unit"});
    return findings.metres_per_unit;
}

// Adds the notes, each once.
void addNotes(
    std::vector<hair::groom::EditNote>& notes, const std::vector<hair::groom::EditNote>& more) {
    for (const hair::groom::EditNote& note : more) {
        const auto same = std::ranges::find(notes, note.what, &hair::groom::EditNote::what);
        if (same == notes.end())
            notes.push_back(note);
        else
            same->count += note.count;
    }
}

EditedStrands mendedOf(StrandSet strands, const EditGroomOptions& options) {
    try {
        return hair::groom::mendStrands(std::move(strands));
    } catch (const engine::Error& error) {
        throw engine::Error(options.in.string(), error.what());
    }
}

void print(const std::vector<hair::groom::EditNote>& notes) {
    for (const hair::groom::EditNote& note : notes)
        std::cout << note.what << ": " << report::countText(note.count) << '\n';
}

// Writes the strands, and returns the exit status.
int writeGroom(const StrandSet& strands, const std::filesystem::path& out) {
    try {
        warnOf(out, hair::groom::exportStrands(strands, out, engine::checkInterrupted));
    } catch (const engine::Interrupted&) {
        std::cerr << "hairbench: interrupted, " << out.string() << " is not written\n";
        return report::kInterrupted;
    }
    say("wrote", out, strands);
    return report::kOk;
}

// Strands that can't be used are mended if they are `kept`.
int editGroom(
    const EditGroomOptions& options, const GroomEdit& edit,
    hair::groom::BadStrands bad = hair::groom::BadStrands::left_out) {
    const hair::groom::StrandExporter& exporter = hair::groom::strandExporterOf(options.out);
    StrandSet strands = hair::groom::importStrands(options.in, options.points_per_strand, {}, bad);
    say("read", options.in, strands);
    std::vector<hair::groom::EditNote> notes;
    if (bad == hair::groom::BadStrands::kept) {
        EditedStrands mended = mendedOf(std::move(strands), options);
        strands = std::move(mended.strands);
        notes = std::move(mended.notes);
    }
    warnOf(options.in, strands.warnings);
    engine::checkWritable(options.out);
    const double unit = unitOf(strands, options);
    if (options.scale) strands.metres_per_unit = unit;
    EditedStrands edited;
    try {
        edited = edit(std::move(strands), unit);
    } catch (const engine::Error& error) {
        throw engine::Error(options.in.string(), error.what());
    }
    addNotes(notes, edited.notes);
    print(notes);
    // .hgl is the only format that is always in metres.
    if (exporter.extension == ".hgl" && edited.strands.metres_per_unit != 1.0 && unit != 1.0) {
        edited.strands = hair::groom::scaleLengths(std::move(edited.strands), unit);
        edited.strands.metres_per_unit = 1.0;
    }
    return writeGroom(edited.strands, options.out);
}

// ---- Groups -------------------------------------------------------------------------------------

hair::groom::GroupChange groupChange(const std::string& text) {
    hair::groom::GroupChange change;
    const char* const end = text.data() + text.size();
    const auto from = std::from_chars(text.data(), end, change.from);
    if (from.ec == std::errc() && from.ptr != end && *from.ptr == '=') {
        const auto to = std::from_chars(from.ptr + 1, end, change.to);
        if (to.ec == std::errc() && to.ptr == end) return change;
    }
    throw engine::Error("--renumber", "'" + text + "' is not OLD=NEW, such as 3=0");
}

nlohmann::ordered_json jsonOf(const std::vector<hair::groom::StrandGroup>& groups) {
    auto all = nlohmann::ordered_json::array();
    for (const hair::groom::StrandGroup& group : groups) {
        auto& each = all.emplace_back(nlohmann::ordered_json::object());
        if (group.number) each["group"] = *group.number;
        each["strands"] = group.strands;
        each["guides"] = group.guides;
        each["points"] = group.points;
        each["mean_length"] = group.mean_length;
    }
    return all;
}

void printGroups(const std::vector<hair::groom::StrandGroup>& groups) {
    const auto row = [](const auto&... cells) {
        ((std::cout << std::setw(12) << cells), ...);
        std::cout << '\n';
    };
    row("group", "strands", "guides", "points", "mean length");
    for (const hair::groom::StrandGroup& group : groups)
        row(group.number ? std::to_string(*group.number) : "none", group.strands, group.guides,
            group.points, report::plainNumber(group.mean_length));
}

}  // namespace

int reverseGroom(const EditGroomOptions& options) {
    return editGroom(options, [](StrandSet strands, double) {
        EditedStrands edited{
            .strands = {}, .notes = {{"reversed: strands", strands.strandCount()}}};
        edited.strands = hair::groom::reverseStrands(std::move(strands));
        return edited;
    });
}

int transformGroom(const TransformGroomOptions& options) {
    const auto unitNamed = [](const std::string& name) -> std::optional<double> {
        if (name.empty()) return {};
        return hair::groom::metresOf(name);
    };
    hair::groom::TransformSettings settings{
        .from_metres_per_unit = unitNamed(options.from_unit),
        .metres_per_unit = unitNamed(options.unit),
        .from_up = groom::axisOf(options.from_up),
        .up = groom::axisOf(options.up),
        .mirror = groom::axisOf(options.mirror),
        .scale = options.scale};
    if (!options.translation.empty())
        settings.translation = {
            options.translation[0], options.translation[1], options.translation[2]};
    if (settings.from_metres_per_unit && !settings.metres_per_unit)
        throw engine::Error("--from-unit", "has no effect without --unit");
    if (settings.from_up && !settings.up)
        throw engine::Error("--from-up", "has no effect without --up");
    StrandSet strands = hair::groom::importStrands(options.in, options.points_per_strand);
    say("read", options.in, strands);
    warnOf(options.in, strands.warnings);
    if (settings.metres_per_unit && !settings.from_metres_per_unit && !strands.metres_per_unit)
        throw engine::Error(options.in.string(), "states no unit: give --from-unit");
    if (settings.up && !settings.from_up && !strands.up)
        throw engine::Error(options.in.string(), "states no upward axis: give --from-up");
    engine::checkWritable(options.out);
    EditedStrands edited;
    try {
        edited = hair::groom::transformStrands(std::move(strands), settings);
    } catch (const engine::Error& error) {
        throw engine::Error(options.in.string(), error.what());
    }
    print(edited.notes);
    return writeGroom(edited.strands, options.out);
}

int groomGroups(const GroomGroupsOptions& options) {
    std::vector<hair::groom::GroupChange> changes;
    for (const std::string& each : options.renumber) changes.push_back(groupChange(each));
    if (options.json && !options.out.empty())
        throw engine::Error("--json", "is for the list of groups, without OUT");
    if (changes.empty() != options.out.empty())
        throw engine::Error(
            "--renumber", changes.empty() ? "is missing: OUT would be equal to IN"
                                          : "needs a file to write, OUT");
    StrandSet strands = hair::groom::importStrands(options.in, options.points_per_strand);
    warnOf(options.in, strands.warnings);
    EditedStrands edited;
    try {
        edited = hair::groom::renumberGroups(std::move(strands), changes);
    } catch (const engine::Error& error) {
        throw engine::Error(options.in.string(), error.what());
    }
    const auto groups = hair::groom::groupsOf(edited.strands);
    if (options.json) {
        std::cout << jsonOf(groups).dump(2) << '\n';
    } else {
        print(edited.notes);
        printGroups(groups);
    }
    if (options.out.empty()) return report::kOk;
    engine::checkWritable(options.out);
    return writeGroom(edited.strands, options.out);
}

int filterGroom(const EditGroomOptions& options) {
    const hair::groom::FilterSettings settings{
        .shortest = metresOf(options.shortest),
        .longest = metresOf(options.longest),
        .fewest_points = options.fewest_points,
        .most_points = options.most_points,
        .farthest_root = metresOf(options.farthest_root),
        .deepest = metresOf(options.deepest),
        .groups = options.groups};
    if ((settings.farthest_root || settings.deepest) && options.mesh.empty())
        throw engine::Error("--mesh", "is missing; --farthest-root and --deepest need it");
    if (!options.mesh.empty() && !settings.farthest_root && !settings.deepest)
        throw engine::Error("--mesh", "has no effect without --farthest-root or --deepest");
    const std::optional<hair::groom::BodyMesh> mesh = bodyOf(options.mesh);
    return editGroom(options, [&](const StrandSet& strands, double unit) {
        return hair::groom::filterStrands(strands, settings, mesh ? &*mesh : nullptr, unit);
    });
}

int smoothGroom(const EditGroomOptions& options) {
    return editGroom(options, [&](StrandSet strands, double unit) {
        EditedStrands edited{
            .strands = {}, .notes = {{"smoothed: strands", strands.strandCount()}}};
        edited.strands =
            hair::groom::smoothStrands(std::move(strands), metresOf(options.smooth_length) / unit);
        return edited;
    });
}

int resampleGroom(const EditGroomOptions& options) {
    if (options.vertices.has_value() == options.spacing.has_value())
        throw engine::Error("--vertices, --spacing", "give exactly one of them");
    return editGroom(options, [&](StrandSet strands, double unit) {
        EditedStrands edited{
            .strands = {}, .notes = {{"resampled: strands", strands.strandCount()}}};
        edited.strands = options.vertices
                             ? hair::groom::resample(std::move(strands), *options.vertices)
                             : hair::groom::resampleBySpacing(
                                   std::move(strands), metresOf(*options.spacing) / unit);
        return edited;
    });
}

int fixGroom(const EditGroomOptions& options) {
    if (options.farthest_root && options.mesh.empty())
        throw engine::Error("--mesh", "is missing; --farthest-root needs it");
    constexpr double kFarthestRoot = 10.0;  // mm
    const std::optional<hair::groom::BodyMesh> mesh = bodyOf(options.mesh);
    const GroomEdit edit = [&](StrandSet strands, double unit) {
        if (options.scale) {
            strands = hair::groom::scaleLengths(std::move(strands), unit);
            strands.metres_per_unit = unit = 1.0;
        }
        return hair::groom::fixStrands(
            strands, mesh ? &*mesh : nullptr, unit,
            metresOf(options.farthest_root.value_or(kFarthestRoot)));
    };
    return editGroom(options, edit, hair::groom::BadStrands::kept);
}

// ---- hairbench groom compare --------------------------------------------------------------------

namespace {

using hair::groom::DistanceFindings;
using hair::groom::DistributionFindings;
using hair::groom::PenetrationFindings;
using hair::groom::SampledStrands;
using hair::groom::StrandDirections;

constexpr std::string_view kGroomComparisonSchema = "hairbench-groom-comparison/1.0.0";

// A compared file.
struct ComparedFile {
    std::filesystem::path file;
    std::string_view format;
    hair::groom::Unit unit;  // original unit of its lengths
    hair::groom::StrandSet strands{};  // in metres
};

struct GroomComparison {
    const ComparedFile& first;  // the reference
    const ComparedFile& second;
    const hair::groom::CompareSettings& settings;
    const hair::groom::StrandComparison& found;
};

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

// The comparison as JSON.

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

// Lengths are in metres, shares from 0 to 1, angles in degrees.
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

// The comparison as text for a terminal.

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

// Reads a file and converts its strands to metres, by `scale` or the unit that the file states or
// suggests.
ComparedFile readCompared(
    const std::filesystem::path& path, std::optional<double> scale,
    std::uint32_t points_per_strand) {
    hair::groom::StrandSet strands = hair::groom::importStrands(path, points_per_strand);
    hair::groom::Unit unit{};
    if (scale) {
        unit = hair::groom::statedUnit(*scale);
        unit.reason = "An option states it.";
    } else {
        const auto findings = hair::groom::inspect(strands, nullptr, {});
        unit = {findings.unit, findings.metres_per_unit, findings.unit_reason};
        if (!findings.unit_stated && findings.metres_per_unit != 1.0)
            std::cerr << "hairbench: " << engine::shownText(path.string())
                      << ": states no unit; lengths are taken as " << findings.unit << '\n';
    }
    ComparedFile file{
        .file = path, .format = hair::groom::strandImporterOf(path).name, .unit = unit};
    file.strands = unit.metres == 1.0 ? std::move(strands)
                                      : hair::groom::scaleLengths(std::move(strands), unit.metres);
    return file;
}

// "2/20": 2 mm, 20 degrees.
hair::groom::MatchThreshold parsedThreshold(const std::string& text) {
    try {
        std::size_t used = 0;
        const double distance = std::stod(text, &used);
        if (used < text.size() && text[used] == '/') {
            const std::string rest = text.substr(used + 1);
            const double angle = std::stod(rest, &used);
            if (used == rest.size()) return {distance / 1000.0, angle};
        }
    } catch (const std::exception&) {  // not a number: see below
    }
    throw engine::Error(
        "--threshold", "'" + text + "' is not MM/DEGREES, as in 2/20 for 2 mm and 20 degrees");
}

}  // namespace

int compareGrooms(const CompareGroomsOptions& options) {
    hair::groom::CompareSettings settings{
        .spacing = options.spacing / 1000.0,
        .curvature_step = options.curvature_step / 1000.0,
        .consistency_samples = options.consistency_samples,
        .directions = options.undirected ? hair::groom::StrandDirections::either_way
                                         : hair::groom::StrandDirections::from_root_to_tip,
        .threads = options.threads};
    if (!options.thresholds.empty()) settings.thresholds.clear();
    for (const std::string& text : options.thresholds)
        settings.thresholds.push_back(parsedThreshold(text));
    const std::optional<hair::groom::BodyMesh> mesh = bodyOf(options.mesh);
    const ComparedFile first =
        readCompared(options.first, options.first_scale, options.first_points_per_strand);
    const ComparedFile second =
        readCompared(options.second, options.second_scale, options.second_points_per_strand);
    if (!options.out.empty()) engine::checkWritable(options.out);

    const hair::groom::StrandComparison found = hair::groom::compareStrands(
        first.strands, second.strands, mesh ? &*mesh : nullptr, settings);
    const GroomComparison comparison{first, second, settings, found};
    const std::string json = groomComparisonJson(comparison);
    if (!options.out.empty())
        engine::writeFileAtomically(options.out, [&](std::ostream& file) { file << json; });
    std::cout << (options.json ? json : groomComparisonText(comparison));
    return report::kOk;
}

// ---- hairbench groom convert --------------------------------------------------------------------

int convertGroom(const groom::ConvertOptions& options) {
    const groom::ConvertLog log{
        .say =
            [](const std::string& line) {
                std::cout << engine::shownText(line) << std::endl;  // flushes early
            },
        .warn =
            [](const std::filesystem::path& file, const std::string& warning) {
                std::cerr << "hairbench: " << engine::shownText(file.string() + ": " + warning)
                          << '\n';
            }};
    try {
        groom::convert(options, log);
    } catch (const engine::Interrupted&) {
        std::cerr << "hairbench: interrupted, " << options.out.string() << " is not written\n";
        return report::kInterrupted;
    }
    return report::kOk;
}

// ---- hairbench groom info -----------------------------------------------------------------------

hair::groom::StrandSet chosenGroups(
    hair::groom::StrandSet strands, const std::vector<std::int32_t>& groups,
    const std::filesystem::path& file) {
    if (groups.empty()) return strands;
    try {
        return hair::groom::keepGroups(std::move(strands), groups);
    } catch (const engine::Error& error) {
        throw engine::Error(file.string() + ": --group", error.what());
    }
}

hair::groom::Mesh meshOf(const std::filesystem::path& file) {
    hair::groom::Mesh mesh = hair::groom::importMesh(file);
    warnOf(file, mesh.warnings);
    return mesh;
}

int printGroomFormats(const GroomFormatsOptions& options) {
    if (options.markdown) {
        std::cout << hair::groom::formatsMarkdown();
        return report::kOk;
    }
    std::vector<report::Column> columns;
    for (const std::vector<std::string>& row : hair::groom::formatsTable()) {
        const bool is_header = columns.empty();
        if (is_header) columns.resize(row.size());
        for (std::size_t i = 0; i < row.size(); ++i) {
            std::string cell = row[i];
            std::erase(cell, '`');
            if (is_header)
                columns[i] = {.title = cell, .numeric = false};
            else
                columns[i].cells.push_back(cell);
        }
    }
    for (std::size_t row = 0; row <= columns.front().cells.size(); ++row)
        std::cout << report::columnsLine(columns, row);
    return report::kOk;
}

int inspectGroom(const GroomInfoOptions& options) {
    std::optional<hair::groom::Mesh> mesh;
    if (!options.mesh.empty()) mesh = hair::groom::importMesh(options.mesh);
    hair::groom::StrandSet strands = hair::groom::importStrands(
        options.file, options.points_per_strand, {}, hair::groom::badStrands(options.strict));
    strands = chosenGroups(std::move(strands), options.groups, options.file);
    hair::groom::StrandFindings findings =
        hair::groom::inspect(strands, mesh ? &*mesh : nullptr, options.scale);
    if (options.scale) {
        findings.unit = hair::groom::statedUnit(*options.scale).name;
        findings.unit_stated = true;
        findings.unit_reason = "--scale states it.";
        findings.metres_per_unit = *options.scale;
    }
    const groom::GroomInfo info{
        .file = options.file,
        .format = hair::groom::strandImporterOf(options.file).name,
        .strands = strands,
        .findings = findings,
        .oddities = groom::findOddities(strands, findings)};
    std::cout << (options.json ? groom::groomInfoJson(info) : groom::groomInfoText(info));
    return report::kOk;
}

}  // namespace benchmarks::commands
