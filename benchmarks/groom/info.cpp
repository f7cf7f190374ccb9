#include "benchmarks/groom/info.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <sstream>

#include <nlohmann/json.hpp>

#include "benchmarks/groom/placement.h"
#include "benchmarks/report/text.h"
#include "benchmarks/scene/json.h"
#include "engine/error.h"
#include "hair/groom/build_groom.h"
#include "hair/groom/guides/bind_strands.h"
#include "hair/groom/guides/choose_guides.h"
#include "hair/groom/guides/root_triangles.h"
#include "hair/groom/style/style.h"
#include "hair/rendering/strand_offsets.h"

namespace benchmarks::groom {
namespace {

// ---- Choice of guides ---------------------------------------------------------------------------

// Returns a length in the file, in metres if the unit is known.
std::string fileLength(double length, std::optional<double> metres_per_unit) {
    return metres_per_unit ? report::lengthText(length * *metres_per_unit)
                           : report::shortNumber(length) + " units";
}

std::string
errorText(const hair::groom::ReconstructionError& error, std::optional<double> metres_per_unit) {
    const auto length = [&](double value) { return fileLength(value, metres_per_unit); };
    return length(error.mean) + " on average (" + report::shortNumber(100.0 * error.relative) +
           " % of the mean length), " + length(error.rms) + " rms, " + length(error.percentile95) +
           " for 95 % of the strands, " + length(error.maximum) + " at most";
}

}  // namespace

GuideChoice
chooseGuides(const hair::groom::StrandSet& strands, std::uint32_t count, std::uint32_t seed) {
    if (count > strands.strandCount())
        throw engine::Error(
            "--guides", std::to_string(count) + " is more than the " +
                            std::to_string(strands.strandCount()) + " strands of the file");
    const hair::groom::Groom dense = hair::groom::toGroom(strands, 0);
    const std::vector<std::uint32_t> chosen = hair::groom::chooseGuides(dense, count, seed);
    hair::groom::Groom guides = hair::groom::pickStrands(dense, chosen);
    guides.bindings = hair::groom::bindStrands(dense, chosen);
    guides.bound_ends = strands.ends;
    guides.bound_points = strands.points;
    std::vector<std::uint32_t> all(strands.strandCount());
    std::iota(all.begin(), all.end(), 0u);
    const auto [mean, greatest] = hair::rendering::makeStrandResiduals(guides, {}, all).left;
    return {
        .guides = hair::groom::pickStrands(strands, chosen),
        .error = errorText(
            hair::groom::reconstructionError(dense, guides, guides.bindings),
            strands.metres_per_unit),
        .left = fileLength(mean, strands.metres_per_unit) + " on average, " +
                fileLength(greatest, strands.metres_per_unit) + " at most"};
}

std::vector<std::array<std::uint32_t, 3>>
rootTriangles(const hair::groom::StrandSet& strands, const hair::groom::Mesh* mesh) {
    return hair::groom::triangulateRoots(hair::groom::toGroom(strands, 0), mesh);
}

namespace {

// ---- Oddities of a groom ------------------------------------------------------------------------

// Human hair is 17 to 181 µm thick. Widths outside these limits by more than a factor of ten are in
// another unit, or are for drawing only.
constexpr double kThinnest = 1.7e-6;  // m
constexpr double kThickest = 1.81e-3;  // m

// Limits of the median strand's length: stubble and the longest hair that is worn.
constexpr double kShortest = 0.5e-3;  // m
constexpr double kLongest = 3.0;  // m

constexpr std::uint32_t kLongestGuide = 256;

class Oddities {
public:
    void add(std::string_view name, std::uint64_t count, std::string what, std::string advice) {
        if (count > 0) all_.push_back({name, count, std::move(what), std::move(advice)});
    }
    std::vector<Oddity> take() { return std::move(all_); }

private:
    std::vector<Oddity> all_;
};

void findInStrands(const hair::groom::StrandFindings& found, Oddities& odd) {
    odd.add(
        "no_strands", found.strands == 0 ? 1 : 0, "there are no strands",
        "export the hair as curves or lines, not as a mesh");
    odd.add(
        "single_point_strands", found.single_point_strands,
        report::countText(found.single_point_strands, "strand") + " of a single point",
        "leave them out in the program that makes the hair: they are not drawn");
    odd.add(
        "zero_length_strands", found.zero_length_strands,
        report::countText(found.zero_length_strands, "strand") +
            " without length, all points at one place",
        "leave them out in the program that makes the hair: they are not drawn");
    odd.add(
        "zero_length_segments", found.zero_length_segments,
        report::countText(found.zero_length_segments, "segment") + " without length",
        "space the points evenly: hairbench groom convert IN OUT --vertices N");
    odd.add(
        "duplicate_strands", found.duplicate_strands,
        report::countText(found.duplicate_strands, "strand") + " equal to another, point for point",
        "leave them out in the program that makes the hair: they cost time and show nothing");
    if (found.duplicate_roots > found.duplicate_strands) {
        const std::uint32_t more = found.duplicate_roots - found.duplicate_strands;
        odd.add(
            "duplicate_roots", more,
            report::countText(more, "strand") + " with the root of another, but not its shape",
            "harmless for drawing; among guides, only one of them can be a corner of root "
            "triangles");
    }
    const auto most = static_cast<std::uint64_t>(found.points_per_strand.maximum);
    odd.add(
        "long_strands", most > kLongestGuide ? most : 0,
        "strands of up to " + report::countText(most, "point"),
        "guides have at most 256 points and are resampled; to do this once: hairbench groom "
        "convert IN OUT "
        "--vertices 256");
}

void findInUnits(
    const hair::groom::StrandSet& strands, const hair::groom::StrandFindings& found,
    Oddities& odd) {
    const std::string scale = report::plainNumber(found.metres_per_unit);
    odd.add(
        "unit", !found.unit_stated && found.metres_per_unit != 1.0 ? 1 : 0,
        "lengths that look like " + found.unit + ", and a file that doesn't state its unit",
        "state it: --scale " + scale +
            " here and in hairbench groom convert, /groom/placement/scale " + scale +
            " in a scene");
    if (found.other_unit)
        odd.add(
            "stated_unit", 1,
            "sizes of hair in " + found.other_unit->unit.name + " (" +
                report::shortNumber(100.0 * std::min(found.other_unit->certainty, 0.999)) +
                " % certain), but the file states " + found.unit,
            "if the file is wrong: --scale " + report::plainNumber(found.other_unit->unit.metres) +
                " here, in hairbench groom convert and in hairbench groom scene");
    if (strands.up) {
        const UpGuess up = guessUp(strands);
        odd.add(
            "stated_up", up.axis != *strands.up && up.lead >= kClearLead ? 1 : 0,
            std::string("strands that leave the scalp and hang as if +") + axisName(up.axis) +
                " were up, by " + report::shortNumber(up.lead) +
                " of their length, but the file states +" + axisName(*strands.up),
            std::string("if the file is wrong: hairbench groom scene --up ") + axisName(up.axis));
    }
    odd.add(
        "strays", found.strays.size(),
        report::countText(found.strays.size(), "strand") +
            " apart from the others: " + straysText(found.strays, found.metres_per_unit),
        "leave them out in the program that makes the hair; units, the box and views do not count "
        "them");
    const double length = found.lengths.median * found.metres_per_unit;
    odd.add(
        "lengths", found.unit_stated && (length < kShortest || length > kLongest) ? 1 : 0,
        "a median strand of " + report::lengthText(length) + ", in the stated unit",
        "if this is hair, the unit is wrong: --scale overrides it here and in hairbench groom "
        "convert");
    const double width = found.widths.median * found.metres_per_unit;
    odd.add(
        "widths", strands.widths.known() && (width < kThinnest || width > kThickest) ? 1 : 0,
        "widths of " + report::lengthText(width) +
            " (median); human hair is 0.017 to 0.181 mm wide",
        "scale them to the unit of the points in the program that makes the hair, or ignore this: "
        "they affect "
        "only drawing");
}

void findOnMesh(const hair::groom::MeshFindings& found, std::uint32_t strands, Oddities& odd) {
    odd.add(
        "roots_off_surface", found.roots_off_surface,
        report::countText(found.roots_off_surface, "root") + " further than " +
            report::lengthText(found.tolerance) + " from the mesh, up to " +
            report::lengthText(found.root_distances.maximum),
        "check the units (--scale) and that the hair was made for this mesh, in the same place");
    odd.add(
        "reversed", 2 * std::uint64_t{found.tips_on_surface} > strands ? found.tips_on_surface : 0,
        report::countText(found.tips_on_surface, "strand") +
            " from tip to root: the last point is on the mesh, the first is not",
        "turn them round: hairbench groom reverse IN OUT");
    odd.add(
        "strands_inside", found.strands_inside.value_or(0),
        report::countText(found.strands_inside.value_or(0), "strand") + " deeper than " +
            report::lengthText(found.tolerance) + " inside the mesh, up to " +
            report::lengthText(found.deepest.value_or(0.0)),
        "push them out in the program that makes the hair, or let a simulation with collision do "
        "it");
    odd.add(
        "mesh_not_closed", found.closed ? 0 : 1, "a mesh that is not closed: " + found.not_closed,
        found.strands_inside
            ? "strands inside are those where the winding number is 1/2 or more; near openings "
              "depths are too large: close it for exact ones"
            : "close it, so that strands inside can be found");
}

}  // namespace

std::vector<Oddity>
findOddities(const hair::groom::StrandSet& strands, const hair::groom::StrandFindings& findings) {
    Oddities odd;
    findInStrands(findings, odd);
    if (findings.strands > 0) findInUnits(strands, findings, odd);
    if (findings.mesh) findOnMesh(*findings.mesh, findings.strands, odd);
    return odd.take();
}

namespace {

std::size_t countGroups(const hair::groom::StrandSet& strands) {
    return std::set(strands.groups.begin(), strands.groups.end()).size();
}

std::size_t countGuides(const hair::groom::StrandSet& strands) {
    return static_cast<std::size_t>(std::ranges::count(strands.guides, 1));
}

// ---- JSON ---------------------------------------------------------------------------------------

// Leaves out NaN and infinity, which JSON cannot express.
void put(scene::Json& object, const char* key, double value) {
    if (std::isfinite(value)) object[key] = value;
}

scene::Json toJson(const hair::groom::Summary& spread, std::string_view unit, double factor = 1.0) {
    scene::Json object = {{"unit", unit}};
    put(object, "minimum", spread.minimum * factor);
    put(object, "quartile1", spread.quartile1 * factor);
    put(object, "median", spread.median * factor);
    put(object, "quartile3", spread.quartile3 * factor);
    put(object, "maximum", spread.maximum * factor);
    put(object, "mean", spread.mean * factor);
    return object;
}

scene::Json toJson(const glm::vec3& point, double metres_per_unit) {
    const glm::dvec3 p = glm::dvec3(point) * metres_per_unit;
    return {p.x, p.y, p.z};
}

template <class Value>
const char* whereKnown(const hair::groom::PointAttribute<Value>& attribute) {
    if (!attribute.known()) return "none";
    return attribute.values.empty() ? "everywhere" : "points";
}

scene::Json toJson(const hair::groom::MeshFindings& mesh) {
    scene::Json object = {
        {"tolerance", {{"unit", "m"}, {"value", mesh.tolerance}}},
        {"root_distances", toJson(mesh.root_distances, "m")},
        {"roots_off_surface", mesh.roots_off_surface},
        {"tips_on_surface", mesh.tips_on_surface},
        {"closed", mesh.closed}};
    if (!mesh.not_closed.empty()) object["not_closed"] = mesh.not_closed;
    if (mesh.strands_inside) object["strands_inside"] = *mesh.strands_inside;
    if (mesh.points_inside) object["points_inside"] = *mesh.points_inside;
    if (mesh.deepest) object["deepest"] = {{"unit", "m"}, {"value", *mesh.deepest}};
    object["left_out"] = mesh.warnings;
    return object;
}

void putLengths(scene::Json& object, const GroomInfo& info) {
    const hair::groom::StrandFindings& found = info.findings;
    const double scale = found.metres_per_unit;
    object["unit"] = {
        {"name", found.unit},
        {"metres", scale},
        {"stated", found.unit_stated},
        {"reason", found.unit_reason}};
    if (found.other_unit)
        object["unit"]["sizes_suggest"] = {
            {"name", found.other_unit->unit.name},
            {"metres", found.other_unit->unit.metres},
            {"certainty", found.other_unit->certainty}};
    const UpGuess up = guessUp(info.strands);
    object["up"] = {
        {"axis", axisName(info.strands.up.value_or(up.axis))},
        {"stated", info.strands.up.has_value()},
        {"guess", axisName(up.axis)},
        {"lead", up.lead}};
    scene::Json& strays = object["strays"] = scene::Json::array();
    for (const hair::groom::Stray& stray : found.strays)
        strays.push_back(
            {{"strand", stray.strand},
             {"by", stray.by_root ? "root" : "segment"},
             {"distance", {{"unit", "m"}, {"value", stray.distance * scale}}}});
    object["bounding_box"] = {
        {"unit", "m"},
        {"minimum", toJson(found.minimum, scale)},
        {"maximum", toJson(found.maximum, scale)}};
    object["lengths"] = toJson(found.lengths, "m", scale);
    object["segment_lengths"] = toJson(found.segment_lengths, "m", scale);
    if (info.strands.widths.known()) object["widths"] = toJson(found.widths, "m", scale);
}

}  // namespace

std::string groomInfoJson(const GroomInfo& info) {
    const hair::groom::StrandFindings& found = info.findings;
    scene::Json object = {
        {"schema", kGroomSchema}, {"file", info.file.string()}, {"format", info.format}};
    if (!info.strands.comment.empty()) object["comment"] = info.strands.comment;
    object["strands"] = found.strands;
    object["points"] = found.points;
    if (found.strands > 0) {
        object["points_per_strand"] = toJson(found.points_per_strand, "count");
        putLengths(object, info);
    }
    object["has"] = {
        {"widths", whereKnown(info.strands.widths)},
        {"transparencies", whereKnown(info.strands.transparencies)},
        {"colors", whereKnown(info.strands.colors)},
        {"root_uvs", !info.strands.root_uvs.empty()},
        {"groups", countGroups(info.strands)},
        {"guides", countGuides(info.strands)},
        {"root_triangles", info.strands.root_triangles.size()}};
    object["single_point_strands"] = found.single_point_strands;
    object["zero_length_strands"] = found.zero_length_strands;
    object["zero_length_segments"] = found.zero_length_segments;
    object["duplicate_strands"] = found.duplicate_strands;
    object["duplicate_roots"] = found.duplicate_roots;
    if (found.mesh) object["mesh"] = toJson(*found.mesh);
    object["left_out"] = info.strands.warnings;
    scene::Json& odd = object["odd"] = scene::Json::array();
    for (const Oddity& each : info.oddities)
        odd.push_back(
            {{"name", each.name},
             {"count", each.count},
             {"what", each.what},
             {"advice", each.advice}});
    // Texts in files need not be UTF-8.
    return object.dump(2, ' ', false, scene::Json::error_handler_t::replace) + '\n';
}

namespace {

// ---- Text for a terminal ------------------------------------------------------------------------

constexpr std::size_t kNameWidth = 16;
constexpr std::size_t kLineWidth = 100;

// Returns a name and its text, wrapped into lines below the text.
std::string line(const std::string& name, const std::string& text) {
    std::string all =
        "  " + name + std::string(kNameWidth - std::min(kNameWidth, name.size()), ' ');
    std::size_t width = all.size();
    std::istringstream words(text);
    for (std::string word; words >> word; width += word.size() + 1) {
        if (width + word.size() > kLineWidth) {
            all.back() = '\n';
            all += std::string(kNameWidth + 2, ' ');
            width = kNameWidth + 2;
        }
        all += word + ' ';
    }
    all.back() = '\n';
    return all;
}

std::string pointsText(const hair::groom::StrandFindings& found) {
    std::string text = report::countText(found.points);
    const hair::groom::Summary& each = found.points_per_strand;
    if (found.strands == 0) return text;
    if (each.minimum == each.maximum)
        return text + ", " + report::plainNumber(each.minimum) + "  per strand";
    return text + ", " + report::plainNumber(each.minimum) + " to " +
           report::plainNumber(each.maximum) + " per strand, median " +
           report::plainNumber(each.median);
}

std::string numbers(const glm::dvec3& v) {
    return report::shortNumber(v.x) + ", " + report::shortNumber(v.y) + ", " +
           report::shortNumber(v.z);
}

// Returns the bounding box in the unit that fits its longest side.
std::string boxText(const hair::groom::StrandFindings& found) {
    const glm::dvec3 low = glm::dvec3(found.minimum) * found.metres_per_unit;
    const glm::dvec3 high = glm::dvec3(found.maximum) * found.metres_per_unit;
    const glm::dvec3 size = high - low;
    const report::LengthUnit unit = report::readableUnit(std::max({size.x, size.y, size.z}));
    return report::shortNumber(size.x / unit.metres) + " x " +
           report::shortNumber(size.y / unit.metres) + " x " +
           report::shortNumber(size.z / unit.metres) + ' ' + std::string(unit.symbol) + ", from (" +
           numbers(low / unit.metres) + ") to (" + numbers(high / unit.metres) + ')';
}

template <class Value, class Text>
std::string attributeText(const hair::groom::PointAttribute<Value>& attribute, Text&& text) {
    if (!attribute.known()) return "none";
    return attribute.values.empty() ? text(*attribute.everywhere) + " everywhere"
                                    : "for each point";
}

std::string attributes(const hair::groom::StrandSet& strands, double metres_per_unit) {
    std::string text = line("widths", attributeText(strands.widths, [&](float width) {
                                return report::lengthText(width * metres_per_unit);
                            }));
    text += line("transparency", attributeText(strands.transparencies, [](float value) {
                     return report::plainNumber(value);
                 }));
    text += line("colour", attributeText(strands.colors, [](const glm::vec3& color) {
                     return report::plainNumber(color.x) + ' ' + report::plainNumber(color.y) +
                            ' ' + report::plainNumber(color.z);
                 }));
    text += line("root UVs", strands.root_uvs.empty() ? "none" : "for each strand");
    text +=
        line("groups", strands.groups.empty() ? "none" : report::countText(countGroups(strands)));
    text += line(
        "guides", strands.guides.empty() ? "not stated" : report::countText(countGuides(strands)));
    const std::size_t triangles = strands.root_triangles.size();
    return text + line("root triangles", triangles == 0 ? "none" : report::countText(triangles));
}

// A row for each quantity, in the unit that fits it.
class SummaryTable {
public:
    void add(const std::string& name, const hair::groom::Summary& spread, double metres) {
        const report::LengthUnit unit = report::readableUnit(
            spread.median > 0.0 ? spread.median * metres : spread.maximum * metres);
        const double factor = metres / unit.metres;
        columns_.front().cells.push_back("  " + name);
        const double values[] = {spread.minimum,   spread.quartile1, spread.median,
                                 spread.quartile3, spread.maximum,   spread.mean};
        for (std::size_t i = 0; i < std::size(values); ++i)
            columns_[i + 1].cells.push_back(report::shortNumber(values[i] * factor));
        columns_.back().cells.emplace_back(unit.symbol);
    }

    std::string text() const {
        std::string text;
        for (std::size_t row = 0; row <= columns_.front().cells.size(); ++row)
            text += report::columnsLine(columns_, row);
        return text;
    }

private:
    std::vector<report::Column> columns_{
        {.title = "  ", .numeric = false},
        {.title = "least"},
        {.title = "25 %"},
        {.title = "median"},
        {.title = "75 %"},
        {.title = "greatest"},
        {.title = "mean"},
        {.title = "", .numeric = false}};
};

std::string summaries(const GroomInfo& info) {
    const hair::groom::StrandFindings& found = info.findings;
    SummaryTable table;
    table.add("length", found.lengths, found.metres_per_unit);
    table.add("segment", found.segment_lengths, found.metres_per_unit);
    if (!info.strands.widths.values.empty())
        table.add("width", found.widths, found.metres_per_unit);
    if (found.mesh) table.add("root to mesh", found.mesh->root_distances, 1.0);
    return table.text();
}

std::string upText(const hair::groom::StrandSet& strands) {
    if (strands.up) return std::string("+") + axisName(*strands.up) + ". The file states it.";
    const UpGuess up = guessUp(strands);
    return std::string("+") + axisName(up.axis) +
           ", a guess: strands leave the scalp toward it and hang down from it, by " +
           report::shortNumber(up.lead) + " of their length more than for the next axis.";
}

std::string straysLeftOut(const hair::groom::StrandFindings& found) {
    if (found.strays.empty()) return {};
    return ", without " + report::countText(found.strays.size(), "stray strand");
}

std::string insideText(const hair::groom::MeshFindings& mesh) {
    if (!mesh.strands_inside) return "not known, because the mesh bounds no body";
    std::string text = report::countText(*mesh.strands_inside, "strand");
    if (mesh.points_inside) text += ", " + report::countText(*mesh.points_inside, "point");
    if (mesh.deepest && *mesh.deepest > 0.0)
        text += ", up to " + report::lengthText(*mesh.deepest) + " deep";
    return text;
}

}  // namespace

std::string groomInfoText(const GroomInfo& info) {
    const hair::groom::StrandFindings& found = info.findings;
    std::string text =
        engine::shownText(info.file.string()) + ": " + std::string(info.format) + '\n';
    if (!info.strands.comment.empty())
        text += line("comment", engine::shownText(info.strands.comment));
    text += line("strands", report::countText(found.strands));
    text += line("points", pointsText(found));
    if (found.strands > 0) {
        text += line("unit", found.unit + ". " + found.unit_reason);
        text += line("up", upText(info.strands));
        text += line("box", boxText(found) + straysLeftOut(found));
    }
    text += attributes(info.strands, found.metres_per_unit);
    if (found.mesh) {
        text += line("off the mesh", report::countText(found.mesh->roots_off_surface, "root"));
        text += line("inside the mesh", insideText(*found.mesh));
    }
    if (found.strands > 0) text += '\n' + summaries(info);
    std::vector<std::string> warnings = info.strands.warnings;
    if (found.mesh)
        for (const std::string& warning : found.mesh->warnings)
            warnings.push_back("the mesh: " + warning);
    if (!warnings.empty()) text += "\nleft out:\n";
    for (const std::string& warning : warnings) text += "  " + engine::shownText(warning) + '\n';
    if (info.oddities.empty()) return text + "\nnothing odd\n";
    text += "\nodd:\n";
    for (const Oddity& each : info.oddities)
        text += "  " + engine::shownText(each.what) + "\n      " + engine::shownText(each.advice) +
                '\n';
    return text;
}

}  // namespace benchmarks::groom
