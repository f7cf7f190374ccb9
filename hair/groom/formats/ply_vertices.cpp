#include "hair/groom/formats/ply_vertices.h"

#include <cmath>
#include <limits>

#include "engine/error.h"
#include "hair/groom/formats/text_words.h"

namespace hair {
namespace {

enum Slot : std::size_t { x, y, z, width, transparency, red, green, blue, slot_count };

struct Row {
    std::string_view property;
    Slot slot;
    double unit = 1.0;             // what is a width, or a transparency, of 1
    bool is_share = false;         // integers stand for 0 to 1
    std::string_view better = "";  // a property that is read instead
};

constexpr std::array kRows{
    Row{"x", x},
    Row{"y", y},
    Row{"z", z},
    Row{"width", width},
    Row{"radius", width, 0.5, false, "width"},
    Row{"transparency", transparency, 1.0, true},
    Row{"alpha", transparency, 1.0, true, "transparency"},
    Row{"red", red, 1.0, true},
    Row{"green", green, 1.0, true},
    Row{"blue", blue, 1.0, true},
};

// What is done with a property's values: divided, and for opacity taken from 1.
struct Column {
    Slot slot = slot_count;  // then it is skipped
    double divisor = 1.0;
    bool is_opacity = false;
};

double greatestValue(PlyType type) {
    if (!isInteger(type)) return 1.0;
    const bool is_signed =
        type == PlyType::int8 || type == PlyType::int16 || type == PlyType::int32;
    return std::ldexp(1.0, static_cast<int>(8 * sizeOf(type)) - (is_signed ? 1 : 0)) - 1.0;
}

Column columnOf(const PlyElement& element, const PlyProperty& property) {
    for (const Row& row : kRows) {
        if (row.property != property.name || property.count_type || element.find(row.better))
            continue;
        const double divisor = row.is_share ? greatestValue(property.type) : row.unit;
        return {row.slot, divisor, property.name == "alpha"};
    }
    return {};
}

struct Plan {
    std::vector<Column> columns;  // [property]
    std::array<bool, slot_count> known{};
};

Plan planOf(const PlyElement& element, std::vector<std::string>& warnings) {
    Plan plan;
    std::string skipped;
    bool is_double = false;
    for (const PlyProperty& property : element.properties) {
        const Column column = columnOf(element, property);
        plan.columns.push_back(column);
        if (column.slot == slot_count) {
            skipped.append(skipped.empty() ? "" : ", ").append(inQuotes(property.name));
        } else {
            plan.known[column.slot] = true;
            is_double = is_double || (column.slot <= z && property.type == PlyType::float64);
        }
    }
    if (!(plan.known[red] && plan.known[green] && plan.known[blue])) plan.known[red] = false;
    if (!skipped.empty()) warnings.push_back("the vertices' " + skipped + " are left out");
    if (is_double) warnings.push_back("the points are doubles and are rounded to floats");
    return plan;
}

void reserve(const Plan& plan, std::size_t count, StrandSet& set) {
    set.points.reserve(count);
    if (plan.known[width]) set.widths.values.reserve(count);
    if (plan.known[transparency]) set.transparencies.values.reserve(count);
    if (plan.known[red]) set.colors.values.reserve(count);
}

}  // namespace

const PlyElement& plyVertices(const PlyHeader& header) {
    const std::string place = "line " + std::to_string(header.lines);
    const PlyElement* element = header.find("vertex");
    if (!element) throw engine::Error(place, "the file has no element 'vertex'");
    for (const std::string_view name : {"x", "y", "z"}) {
        const PlyProperty* property = element->find(name);
        if (property && !property->count_type) continue;
        throw engine::Error(place, "element 'vertex' has no property " + inQuotes(name));
    }
    if (element->count > std::numeric_limits<std::uint32_t>::max()) {
        throw engine::Error(
            place, std::to_string(element->count) + " vertices, at most 2^32 - 1 are expected");
    }
    return *element;
}

template <class Source>
void readPlyVertices(Source& source, const PlyElement& element, StrandSet& set) {
    const Plan plan = planOf(element, set.warnings);
    reserve(plan, element.count, set);
    std::array<float, slot_count> values{};
    for (std::uint64_t i = 0; i < element.count; ++i) {
        source.beginElement();
        for (std::size_t j = 0; j < plan.columns.size(); ++j) {
            const PlyProperty& property = element.properties[j];
            const Column& column = plan.columns[j];
            if (column.slot == slot_count) {
                skipProperty(source, property);
                continue;
            }
            const double share = source.take(property.type) / column.divisor;
            const auto value = static_cast<float>(column.is_opacity ? 1.0 - share : share);
            const bool is_wrong_width = column.slot == width && value < 0.0f;
            if (!std::isfinite(value) || is_wrong_width) {
                throw engine::Error(
                    Source::place(source.position()),
                    inQuotes(property.name) + " of vertex " + std::to_string(i) +
                        (is_wrong_width ? " is negative" : " is not a finite float"));
            }
            values[column.slot] = value;
        }
        source.endElement();
        set.points.emplace_back(values[x], values[y], values[z]);
        if (plan.known[width]) set.widths.values.push_back(values[width]);
        if (plan.known[transparency]) set.transparencies.values.push_back(values[transparency]);
        if (plan.known[red])
            set.colors.values.emplace_back(values[red], values[green], values[blue]);
    }
}

template void readPlyVertices(PlyText&, const PlyElement&, StrandSet&);
template void readPlyVertices(PlyBytes<std::endian::little>&, const PlyElement&, StrandSet&);
template void readPlyVertices(PlyBytes<std::endian::big>&, const PlyElement&, StrandSet&);

}  // namespace hair
