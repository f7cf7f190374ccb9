#include "benchmarks/groom_info.h"

#include <algorithm>
#include <sstream>

#include "benchmarks/columns.h"
#include "benchmarks/quantity_text.h"
#include "benchmarks/table.h"

namespace benchmarks {
namespace {

constexpr std::size_t kNameWidth = 16;
constexpr std::size_t kLineWidth = 100;

// A name and its text, which goes on below itself where the line is full.
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

// What a file says of itself may hold anything.
std::string printable(std::string text) {
    std::ranges::replace_if(
        text, [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; }, ' ');
    return text;
}

std::string pointsText(const hair::StrandFindings& found) {
    std::string text = countText(found.points);
    const hair::Spread& each = found.points_per_strand;
    if (found.strands == 0) return text;
    if (each.minimum == each.maximum) return text + ", " + plainNumber(each.minimum) + " a strand";
    return text + ", " + plainNumber(each.minimum) + " to " + plainNumber(each.maximum) +
           " a strand, median " + plainNumber(each.median);
}

std::string numbers(const glm::dvec3& v) {
    return shortNumber(v.x) + ", " + shortNumber(v.y) + ", " + shortNumber(v.z);
}

// In one unit, that of its longest side.
std::string boxText(const hair::StrandFindings& found) {
    const glm::dvec3 low = glm::dvec3(found.minimum) * found.metres_per_unit;
    const glm::dvec3 high = glm::dvec3(found.maximum) * found.metres_per_unit;
    const glm::dvec3 size = high - low;
    const LengthUnit unit = readableUnit(std::max({size.x, size.y, size.z}));
    return shortNumber(size.x / unit.metres) + " x " + shortNumber(size.y / unit.metres) + " x " +
           shortNumber(size.z / unit.metres) + ' ' + std::string(unit.symbol) + ", from (" +
           numbers(low / unit.metres) + ") to (" + numbers(high / unit.metres) + ')';
}

template <class Value, class Text>
std::string attributeText(const hair::PointAttribute<Value>& attribute, Text&& text) {
    if (!attribute.known()) return "none";
    return attribute.values.empty() ? text(*attribute.everywhere) + " everywhere"
                                    : "for each point";
}

std::string attributes(const hair::StrandSet& strands, double metres_per_unit) {
    std::string text = line("widths", attributeText(strands.widths, [&](float width) {
                                return lengthText(width * metres_per_unit);
                            }));
    text += line("transparency", attributeText(strands.transparencies, [](float value) {
                     return plainNumber(value);
                 }));
    text += line("colour", attributeText(strands.colors, [](const glm::vec3& color) {
                     return plainNumber(color.x) + ' ' + plainNumber(color.y) + ' ' +
                            plainNumber(color.z);
                 }));
    text += line("root UVs", strands.root_uvs.empty() ? "none" : "for each strand");
    const std::size_t triangles = strands.root_triangles.size();
    return text + line("root triangles", triangles == 0 ? "none" : countText(triangles));
}

// A row for each quantity, in the unit that fits it.
class SpreadTable {
public:
    void add(const std::string& name, const hair::Spread& spread, double metres) {
        const LengthUnit unit =
            readableUnit(spread.median > 0.0 ? spread.median * metres : spread.maximum * metres);
        const double factor = metres / unit.metres;
        columns_.front().cells.push_back("  " + name);
        const double values[] = {spread.minimum,   spread.quartile1, spread.median,
                                 spread.quartile3, spread.maximum,   spread.mean};
        for (std::size_t i = 0; i < std::size(values); ++i)
            columns_[i + 1].cells.push_back(shortNumber(values[i] * factor));
        columns_.back().cells.emplace_back(unit.symbol);
    }

    std::string text() const {
        std::string text;
        for (std::size_t row = 0; row <= columns_.front().cells.size(); ++row)
            text += columnsLine(columns_, row);
        return text;
    }

private:
    std::vector<Column> columns_{
        {.title = "  ", .numeric = false},
        {.title = "least"},
        {.title = "25 %"},
        {.title = "median"},
        {.title = "75 %"},
        {.title = "greatest"},
        {.title = "mean"},
        {.title = "", .numeric = false}};
};

std::string spreads(const GroomInfo& info) {
    const hair::StrandFindings& found = info.findings;
    SpreadTable table;
    table.add("length", found.lengths, found.metres_per_unit);
    table.add("segment", found.segment_lengths, found.metres_per_unit);
    if (!info.strands.widths.values.empty())
        table.add("width", found.widths, found.metres_per_unit);
    if (found.mesh) table.add("root to mesh", found.mesh->root_distances, 1.0);
    return table.text();
}

std::string insideText(const hair::MeshFindings& mesh) {
    if (!mesh.strands_inside) return "not known, the mesh is not closed";
    std::string text = countText(*mesh.strands_inside, "strand");
    if (mesh.points_inside) text += ", " + countText(*mesh.points_inside, "point");
    if (mesh.deepest && *mesh.deepest > 0.0)
        text += ", up to " + lengthText(*mesh.deepest) + " deep";
    return text;
}

}  // namespace

std::string groomInfoText(const GroomInfo& info) {
    const hair::StrandFindings& found = info.findings;
    std::string text = info.file.string() + ": " + std::string(info.format) + '\n';
    if (!info.strands.comment.empty()) text += line("comment", printable(info.strands.comment));
    text += line("strands", countText(found.strands));
    text += line("points", pointsText(found));
    if (found.strands > 0) {
        text += line("unit", found.unit + ". " + found.unit_reason);
        text += line("box", boxText(found));
    }
    text += attributes(info.strands, found.metres_per_unit);
    if (found.mesh) {
        text += line("off the mesh", countText(found.mesh->roots_off_surface, "root"));
        text += line("inside the mesh", insideText(*found.mesh));
    }
    if (found.strands > 0) text += '\n' + spreads(info);
    if (!info.strands.warnings.empty()) text += "\nleft out:\n";
    for (const std::string& warning : info.strands.warnings)
        text += "  " + printable(warning) + '\n';
    if (info.oddities.empty()) return text + "\nnothing odd\n";
    text += "\nodd:\n";
    for (const Oddity& each : info.oddities)
        text += "  " + each.what + "\n      " + each.advice + '\n';
    return text;
}

}  // namespace benchmarks
