#include "hair/groom/formats/ply.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <utility>

#include "engine/error.h"
#include "hair/groom/formats/binary_file.h"
#include "hair/groom/formats/polylines.h"
#include "hair/groom/formats/text.h"

namespace hair::groom {
namespace {

// ---- Writing ------------------------------------------------------------------------------------

constexpr std::size_t kBlock = 4096;  // vertices or edges that are written at once

std::string headerOf(const StrandSet& strands, std::size_t edge_count) {
    std::string header = "ply\nformat binary_little_endian 1.0\n";
    header += commentLines(strands.comment, "comment ");
    header += "element vertex " + std::to_string(strands.points.size()) + '\n';
    const auto addProperties = [&](std::initializer_list<const char*> names) {
        for (const char* name : names) header.append("property float ").append(name).append("\n");
    };
    addProperties({"x", "y", "z"});
    if (strands.widths.known()) addProperties({"width"});
    if (strands.transparencies.known()) addProperties({"transparency"});
    if (strands.colors.known()) addProperties({"red", "green", "blue"});
    return header + "element edge " + std::to_string(edge_count) +
           "\nproperty uint vertex1\nproperty uint vertex2\nend_header\n";
}

void writeVertices(const StrandSet& strands, std::ostream& out) {
    std::vector<float> values;
    for (std::size_t i = 0; i < strands.points.size(); ++i) {
        const glm::vec3& point = strands.points[i];
        values.insert(values.end(), {point.x, point.y, point.z});
        if (strands.widths.known()) values.push_back(strands.widths.at(i));
        if (strands.transparencies.known()) values.push_back(strands.transparencies.at(i));
        if (strands.colors.known()) {
            const glm::vec3& color = strands.colors.at(i);
            values.insert(values.end(), {color.r, color.g, color.b});
        }
        if (i % kBlock != kBlock - 1 && i + 1 != strands.points.size()) continue;
        writeArray(out, values);
        values.clear();
    }
}

// ---- The header ---------------------------------------------------------------------------------

struct TypeRow {
    PlyType type;
    std::string_view name;  // in the format's description
    std::string_view other_name;  // written by later programs
    std::size_t size;
};

constexpr std::array kTypes{
    TypeRow{PlyType::int8, "char", "int8", 1},
    TypeRow{PlyType::uint8, "uchar", "uint8", 1},
    TypeRow{PlyType::int16, "short", "int16", 2},
    TypeRow{PlyType::uint16, "ushort", "uint16", 2},
    TypeRow{PlyType::int32, "int", "int32", 4},
    TypeRow{PlyType::uint32, "uint", "uint32", 4},
    TypeRow{PlyType::float32, "float", "float32", 4},
    TypeRow{PlyType::float64, "double", "float64", 8},
};

std::string_view textOf(std::span<const std::byte> file) {
    return {reinterpret_cast<const char*>(file.data()), file.size()};
}

std::size_t sizeOf(PlyType type) { return kTypes[static_cast<std::size_t>(type)].size; }

bool isInteger(PlyType type) { return type < PlyType::float32; }

struct FormatRow {
    PlyFormat format;
    std::string_view name;
};

constexpr std::array kFormats{
    FormatRow{PlyFormat::ascii, "ascii"},
    FormatRow{PlyFormat::little_endian, "binary_little_endian"},
    FormatRow{PlyFormat::big_endian, "binary_big_endian"},
};

PlyType typeNamed(std::string_view name) {
    for (const TypeRow& row : kTypes)
        if (row.name == name || row.other_name == name) return row.type;
    throw engine::Error("unknown type " + inQuotes(name) + "; expected one such as float or uchar");
}

PlyFormat formatNamed(std::string_view name) {
    for (const FormatRow& row : kFormats)
        if (row.name == name) return row.format;
    throw engine::Error(
        "unknown format " + inQuotes(name) +
        "; expected ascii, binary_little_endian or binary_big_endian");
}

// Takes a line, without its end, of Unix or of Windows.
std::string_view takeLine(std::string_view& rest) {
    const std::size_t end = rest.find('\n');
    if (end == std::string_view::npos) {
        throw engine::Error("the file ends here, expected a header up to 'end_header'");
    }
    std::string_view line = rest.substr(0, end);
    rest.remove_prefix(end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
}

PlyElement readElement(std::string_view rest) {
    const std::string_view name = takeWord(rest);
    const std::string_view text = takeWord(rest);
    const auto count = integerFrom(text);
    if (name.empty() || !count || *count < 0) {
        throw engine::Error(inQuotes(text) + " is not a count: expected 'element NAME COUNT'");
    }
    return {std::string(name), static_cast<std::uint64_t>(*count), {}};
}

PlyProperty readProperty(std::string_view rest) {
    PlyProperty property{};
    std::string_view type = takeWord(rest);
    if (type == "list") {
        property.count_type = typeNamed(takeWord(rest));
        if (!isInteger(*property.count_type)) {
            throw engine::Error("a list's length must be of an integer type");
        }
        type = takeWord(rest);
    }
    property.type = typeNamed(type);
    property.name = takeWord(rest);
    if (property.name.empty()) throw engine::Error("the property has no name");
    return property;
}

void checkElements(const std::vector<PlyElement>& elements) {
    for (const PlyElement& element : elements) {
        const std::string name = "element " + inQuotes(element.name);
        if (element.properties.empty()) throw engine::Error(name + " has no properties");
        if (std::ranges::count(elements, element.name, &PlyElement::name) > 1) {
            throw engine::Error(name + " appears twice");
        }
    }
}

class HeaderReader {
public:
    // Takes a line after the first; returns true at the last.
    bool read(std::string_view line) {
        std::string_view rest = line;
        const std::string_view keyword = takeWord(rest);
        std::vector<PlyElement>& elements = header_.elements;
        if (keyword == "end_header") {
            if (!has_format_) throw engine::Error("the header has no line 'format'");
            checkElements(elements);
            return true;
        }
        if (keyword == "format") {
            header_.format = formatNamed(takeWord(rest));
            has_format_ = true;
        } else if (keyword == "element") {
            elements.push_back(readElement(rest));
        } else if (keyword == "property") {
            if (elements.empty()) throw engine::Error("a property before the first element");
            elements.back().properties.push_back(readProperty(rest));
        } else if (keyword == "comment") {
            header_.comment.append(has_comment_ ? "\n" : "").append(rest, rest.empty() ? 0 : 1);
            has_comment_ = true;
        } else if (keyword != "obj_info") {
            throw engine::Error("unknown keyword " + inQuotes(keyword) + " in the header");
        }
        return false;
    }

    PlyHeader take() { return std::move(header_); }

private:
    PlyHeader header_{};
    bool has_format_ = false;
    bool has_comment_ = false;
};

// ---- Values as text and as bytes ----------------------------------------------------------------

// Sources of the values of a PLY file's elements one after the other, from text and from bytes. A
// value is a double, which holds each of the format's types. A position is the beginning of the
// value that was taken last; place() gives it in words.

class PlyText {
public:
    PlyText(std::string_view body, std::size_t lines_before) : rest_(body), line_(lines_before) {}

    // Throw if the file is too short for the element's values, or for the list's.
    void expect(const PlyElement& element) const;
    void expectList(double length, PlyType type) const;

    void beginElement();  // each is a line
    double take(PlyType type);
    void endElement();
    void skip(const PlyElement& element);  // all of the element
    void finish() const;

    std::size_t position() const { return line_; }
    std::size_t nextPosition() const { return line_ + 1; }
    // The distance of positions from one element without lists to the next.
    std::size_t stepOf(const PlyElement&) const { return 1; }
    static std::string place(std::size_t position) { return "line " + std::to_string(position); }

private:
    std::string_view rest_;  // of the file
    std::string_view line_rest_;
    std::size_t line_;
};

template <std::endian order>
class PlyBytes {
public:
    PlyBytes(std::span<const std::byte> file, std::size_t start)
        : file_(file), next_(start), position_(start) {}

    void expect(const PlyElement& element) const;
    void expectList(double length, PlyType type) const;

    void beginElement() {}
    double take(PlyType type);
    void endElement() {}
    void skip(const PlyElement& element);
    void finish() const;

    std::size_t position() const { return position_; }
    std::size_t nextPosition() const { return next_; }
    std::size_t stepOf(const PlyElement& element) const { return element.leastSize(); }
    static std::string place(std::size_t position) { return "byte " + std::to_string(position); }

private:
    std::size_t room() const { return file_.size() - next_; }

    template <class Value>
    double load() const {
        std::array<std::byte, sizeof(Value)> bytes;
        std::memcpy(bytes.data(), file_.data() + position_, sizeof(Value));
        if constexpr (order != std::endian::native) std::ranges::reverse(bytes);
        return static_cast<double>(std::bit_cast<Value>(bytes));
    }

    std::span<const std::byte> file_;
    std::size_t next_;
    std::size_t position_;
};

// Takes a list's length. Throws if the file is too short for the list.
template <class Source>
std::size_t takeLength(Source& source, const PlyProperty& list) {
    const double length = source.take(*list.count_type);
    source.expectList(length, list.type);
    return static_cast<std::size_t>(length);
}

template <class Source>
void skipProperty(Source& source, const PlyProperty& property) {
    const std::size_t values = property.count_type ? takeLength(source, property) : 1;
    for (std::size_t i = 0; i < values; ++i) source.take(property.type);
}

// Throws if the value that was taken last is not the index of a vertex.
template <class Source>
void checkVertex(const Source& source, double index, std::uint64_t vertices) {
    if (index >= 0.0 && index < static_cast<double>(vertices)) return;
    throw engine::Error(
        Source::place(source.position()),
        "vertex " + std::to_string(static_cast<std::int64_t>(index)) + " is named, but there are " +
            std::to_string(vertices));
}

std::string truncated(const PlyElement& element, std::size_t room) {
    return "truncated: " + std::to_string(element.count) + " of element " + inQuotes(element.name) +
           " are expected, but " + std::to_string(room) + " bytes are left";
}

void checkLength(const std::string& place, double length, std::size_t most) {
    if (length < 0.0) {
        throw engine::Error(
            place, "the list's length is " + std::to_string(static_cast<std::int64_t>(length)) +
                       ", which is negative");
    }
    if (length > static_cast<double>(most)) {
        throw engine::Error(
            place, "truncated: a list of " + std::to_string(static_cast<std::int64_t>(length)) +
                       " values is expected, but there is room for " + std::to_string(most));
    }
}

// Floats are read as floats, because a detour through double could round them twice.
std::optional<double> valueFrom(std::string_view word, PlyType type) {
    switch (type) {
    case PlyType::float32:
        return floatFrom(word);
    case PlyType::float64:
        return doubleFrom(word);
    default:
        const auto integer = integerFrom(word);
        if (!integer) return {};
        return static_cast<double>(*integer);
    }
}

// A line has a character for each value and one after it; the last may be missing at the file's
// end.
void PlyText::expect(const PlyElement& element) const {
    if (element.count <= (rest_.size() + 1) / (2 * element.properties.size())) return;
    throw engine::Error(place(line_ + 1), truncated(element, rest_.size()));
}

void PlyText::expectList(double length, PlyType) const {
    checkLength(place(line_), length, line_rest_.size() / 2);
}

void PlyText::beginElement() {
    ++line_;
    if (rest_.empty()) throw engine::Error(place(line_), "truncated: the file ends here");
    line_rest_ = rest_.substr(0, rest_.find('\n'));
    rest_.remove_prefix(std::min(rest_.size(), line_rest_.size() + 1));
}

double PlyText::take(PlyType type) {
    const std::string_view word = takeWord(line_rest_);
    const auto value = valueFrom(word, type);
    if (value) return *value;
    if (word.empty())
        throw engine::Error(place(line_), "the line ends, but more numbers are expected");
    throw engine::Error(
        place(line_), inQuotes(word) + " is not " + (isInteger(type) ? "an integer" : "a number"));
}

void PlyText::endElement() {
    const std::string_view word = takeWord(line_rest_);
    if (word.empty()) return;
    throw engine::Error(place(line_), inQuotes(word) + " is one value more than the header says");
}

void PlyText::skip(const PlyElement& element) {
    for (std::uint64_t i = 0; i < element.count; ++i) beginElement();
}

void PlyText::finish() const {
    std::string_view rest = rest_;
    const std::string_view word = takeWord(rest);
    if (word.empty()) return;
    throw engine::Error(
        place(line_ + 1), inQuotes(word) + " after the last element; the file should end there");
}

template <std::endian order>
void PlyBytes<order>::expect(const PlyElement& element) const {
    if (element.count <= room() / element.leastSize()) return;
    throw engine::Error(place(next_), truncated(element, room()));
}

template <std::endian order>
void PlyBytes<order>::expectList(double length, PlyType type) const {
    checkLength(place(position_), length, room() / sizeOf(type));
}

template <std::endian order>
double PlyBytes<order>::take(PlyType type) {
    const std::size_t size = sizeOf(type);
    if (size > room()) {
        throw engine::Error(
            place(file_.size()),
            "truncated: a value of " + std::to_string(size) + " bytes is expected");
    }
    position_ = next_;
    next_ += size;
    switch (type) {
    case PlyType::int8:
        return load<std::int8_t>();
    case PlyType::uint8:
        return load<std::uint8_t>();
    case PlyType::int16:
        return load<std::int16_t>();
    case PlyType::uint16:
        return load<std::uint16_t>();
    case PlyType::int32:
        return load<std::int32_t>();
    case PlyType::uint32:
        return load<std::uint32_t>();
    case PlyType::float32:
        return load<float>();
    default:
        return load<double>();
    }
}

template <std::endian order>
void PlyBytes<order>::skip(const PlyElement& element) {
    if (!element.hasLists()) {
        next_ += element.count * element.leastSize();
        return;
    }
    for (std::uint64_t i = 0; i < element.count; ++i)
        for (const PlyProperty& property : element.properties) skipProperty(*this, property);
}

template <std::endian order>
void PlyBytes<order>::finish() const {
    if (room() == 0) return;
    throw engine::Error(
        place(next_), std::to_string(room()) + " trailing bytes after the last element");
}

// ---- Vertices -----------------------------------------------------------------------------------

enum Slot : std::size_t { x, y, z, width, transparency, red, green, blue, slot_count };

struct VertexRow {
    std::string_view property;
    Slot slot;
    double unit = 1.0;  // value that stands for a width, or a transparency, of 1
    bool is_share = false;  // integers stand for 0 to 1
    std::string_view better = "";  // a property that is read instead
};

constexpr std::array kVertexRows{
    VertexRow{"x", x},
    VertexRow{"y", y},
    VertexRow{"z", z},
    VertexRow{"width", width},
    VertexRow{"radius", width, 0.5, false, "width"},
    VertexRow{"transparency", transparency, 1.0, true},
    VertexRow{"alpha", transparency, 1.0, true, "transparency"},
    VertexRow{"red", red, 1.0, true},
    VertexRow{"green", green, 1.0, true},
    VertexRow{"blue", blue, 1.0, true},
};

// How a property's values are converted: divided, and for opacity subtracted from 1.
struct Column {
    Slot slot = slot_count;  // slot_count: skipped
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
    for (const VertexRow& row : kVertexRows) {
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

// Returns the element `vertex`. Throws engine::Error "line N: reason" if it isn't there, has no
// coordinates, or more vertices than 32 bits can number.
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
            place, std::to_string(element->count) + " vertices; at most 2^32 - 1 are expected");
    }
    return *element;
}

// Reads the element's points, widths, colours and transparencies to `set`, and warns of its other
// properties. The source must be at the element. Throws engine::Error "place: reason".
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

// ---- Strands ------------------------------------------------------------------------------------

constexpr std::array<std::string_view, 3> kListElements{"strand", "polyline", "line"};
constexpr std::string_view kFaces = "face";
constexpr std::array<std::string_view, 2> kListProperties{"vertex_indices", "vertex_index"};
constexpr std::array<std::string_view, 2> kEdgeProperties{"vertex1", "vertex2"};

const PlyProperty* indexList(const PlyElement& element) {
    for (const std::string_view name : kListProperties) {
        const PlyProperty* property = element.find(name);
        if (property && property->count_type && isInteger(property->type)) return property;
    }
    return nullptr;
}

bool isEdge(const PlyElement& element) {
    return std::ranges::all_of(kEdgeProperties, [&](std::string_view name) {
        const PlyProperty* property = element.find(name);
        return property && !property->count_type && isInteger(property->type);
    });
}

[[noreturn]] void failWithoutStrands(const PlyHeader& header) {
    throw engine::Error(
        "line " + std::to_string(header.lines),
        "the file has no strands: expected an element 'edge' with integers vertex1 and vertex2, or "
        "one 'strand', 'polyline' or 'line' with a list vertex_indices; if the points of a strand "
        "follow one another, give their number (--points-per-strand, /groom/points_per_strand)");
}

// Returns the element that lists the vertices of strands; null if strands are runs of consecutive
// vertices.
const PlyElement* strandElement(const PlyHeader& header, std::uint32_t points_per_strand) {
    for (const std::string_view name : kListElements) {
        const PlyElement* element = header.find(name);
        if (element && indexList(*element)) return element;
    }
    const PlyElement* edges = header.find("edge");
    if (edges && isEdge(*edges) && (edges->count > 0 || points_per_strand == 0)) return edges;
    if (points_per_strand > 0) return nullptr;  // faces belong to a mesh beside the hair
    const PlyElement* faces = header.find(kFaces);
    if (faces && indexList(*faces)) return faces;
    failWithoutStrands(header);
}

// Reads one file's elements, which may come in any order.
template <class Source>
class Body {
public:
    Body(const PlyHeader& header, std::uint32_t points_per_strand, Source source)
        : header_(header), points_per_strand_(points_per_strand),
          strands_(strandElement(header, points_per_strand)), source_(source) {}

    StrandSet read() {
        vertex_count_ = plyVertices(header_).count;
        if (!strands_) expectWholeStrands();
        for (const PlyElement& element : header_.elements) {
            source_.expect(element);
            if (element.name == "vertex") {
                readPlyVertices(source_, element, set_);
            } else if (&element != strands_) {
                source_.skip(element);
                warnOf(element.count, element);
            } else {
                readStrands(element);
            }
        }
        source_.finish();
        if (!edges_.empty()) {  // only once the whole file is known to be valid
            lines_ = chainEdges(
                edges_, vertex_count_, [this](std::size_t edge) { return placeOf(edge); });
        }
        if (!strands_) {
            set_.ends = uniformEnds(
                static_cast<std::uint32_t>(vertex_count_ / points_per_strand_), points_per_strand_);
        } else {
            if (lines_.ends.empty()) failWithoutStrands(header_);
            arrangePoints(set_, std::move(lines_));
        }
        set_.comment = header_.comment;
        return std::move(set_);
    }

private:
    void expectWholeStrands() const {
        if (vertex_count_ > 0 && vertex_count_ % points_per_strand_ == 0) return;
        throw engine::Error(
            "line " + std::to_string(header_.lines),
            std::to_string(vertex_count_) + " vertices do not divide into strands of " +
                std::to_string(points_per_strand_) + " points");
    }

    void warnOf(std::uint64_t count, const PlyElement& element) {
        if (count == 0) return;
        set_.warnings.push_back(
            std::to_string(count) + " of element " + inQuotes(element.name) + " are left out");
    }

    std::uint32_t takeVertex(PlyType type) {
        const double index = source_.take(type);
        checkVertex(source_, index, vertex_count_);
        return static_cast<std::uint32_t>(index);
    }

    void readStrands(const PlyElement& element) {
        const PlyProperty* list = indexList(element);
        edges_start_ = source_.nextPosition();
        edges_step_ = source_.stepOf(element);
        if (!list) edges_.reserve(element.count);
        for (std::uint64_t i = 0; i < element.count; ++i) {
            source_.beginElement();
            if (!list) {
                readEdge(element);
            } else {
                readLists(element, *list);
            }
            source_.endElement();
        }
        warnOf(polygons_, element);
    }

    void readEdge(const PlyElement& element) {
        Edge edge{};
        if (element.hasLists()) edge_positions_.push_back(source_.nextPosition());
        for (const PlyProperty& property : element.properties) {
            const auto end = std::ranges::find(kEdgeProperties, property.name);
            if (end == kEdgeProperties.end()) {
                skipProperty(source_, property);
            } else {
                edge[static_cast<std::size_t>(end - kEdgeProperties.begin())] =
                    takeVertex(property.type);
            }
        }
        edges_.push_back(edge);
    }

    void readLists(const PlyElement& element, const PlyProperty& list) {
        for (const PlyProperty& property : element.properties) {
            if (&property != &list) {
                skipProperty(source_, property);
            } else if (element.name == kFaces) {
                readFace(property);
            } else {
                readStrand(property);
            }
        }
    }

    void readStrand(const PlyProperty& list) {
        const std::size_t size = takeLength(source_, list);
        const std::string place = Source::place(source_.position());
        if (!hasRoomFor(lines_, size)) throw engine::Error(place, "2^32 strand points or more");
        for (std::size_t i = 0; i < size; ++i) lines_.vertices.push_back(takeVertex(list.type));
        lines_.ends.push_back(static_cast<std::uint32_t>(lines_.vertices.size()));
    }

    // A face of two vertices is an edge.
    void readFace(const PlyProperty& list) {
        const std::size_t size = takeLength(source_, list);
        if (size != 2) {
            for (std::size_t i = 0; i < size; ++i) source_.take(list.type);
            ++polygons_;
            return;
        }
        edge_positions_.push_back(source_.position());
        const std::uint32_t first = takeVertex(list.type);
        edges_.push_back({first, takeVertex(list.type)});
    }

    std::string placeOf(std::size_t edge) const {
        if (!edge_positions_.empty()) return Source::place(edge_positions_[edge]);
        return Source::place(edges_start_ + edge * edges_step_);
    }

    const PlyHeader& header_;
    std::uint32_t points_per_strand_;
    const PlyElement* strands_;  // null: strands are runs of consecutive vertices
    Source source_;
    std::uint64_t vertex_count_ = 0;
    std::vector<Edge> edges_;
    std::size_t edges_start_ = 0;  // position of the first edge
    std::size_t edges_step_ = 0;  // from one edge to the next
    std::vector<std::size_t> edge_positions_;  // [edge], if distances differ
    std::uint64_t polygons_ = 0;
    Polylines lines_;
    StrandSet set_;
};

// ---- Faces --------------------------------------------------------------------------------------

constexpr std::string_view kStrips = "tristrips";

template <class Source>
void checkCorners(Source& source, const PlyProperty& list, std::uint64_t vertices, bool is_strip) {
    const std::size_t size = takeLength(source, list);
    const auto refuse = [&](const std::string& reason) {
        throw engine::Error(Source::place(source.position()), reason);
    };
    if (size == 0) refuse("a face has no corners");
    if (!isInteger(list.type)) refuse("a face's corners are not integers");
    for (std::size_t i = 0; i < size; ++i) {
        const double index = source.take(list.type);
        if (is_strip && index == -1.0) continue;  // another strip begins
        checkVertex(source, index, vertices);
    }
}

template <class Source>
void checkFaces(const PlyHeader& header, Source source) {
    const std::uint64_t vertices = plyVertices(header).count;
    for (const PlyElement& element : header.elements) {
        source.expect(element);
        const bool is_strip = element.name == kStrips;
        if (!is_strip && element.name != kFaces) {
            source.skip(element);
            continue;
        }
        for (std::uint64_t i = 0; i < element.count; ++i) {
            source.beginElement();
            for (const PlyProperty& property : element.properties)
                if (property.count_type && std::ranges::count(kListProperties, property.name) > 0)
                    checkCorners(source, property, vertices, is_strip);
                else
                    skipProperty(source, property);
            source.endElement();
        }
    }
}

// Calls `use` with a source of the values after the header.
template <class Use>
auto withValues(const PlyHeader& header, std::span<const std::byte> file, const Use& use) {
    switch (header.format) {
    case PlyFormat::ascii:
        return use(PlyText(textOf(file).substr(header.size), header.lines));
    case PlyFormat::little_endian:
        return use(PlyBytes<std::endian::little>(file, header.size));
    default:
        return use(PlyBytes<std::endian::big>(file, header.size));
    }
}

}  // namespace

std::vector<std::string> exportPly(const StrandSet& strands, std::ostream& out) {
    std::vector<std::string> warnings =
        leftOut(strands, {Part::widths, Part::transparencies, Part::colors, Part::comment});
    const std::vector<Edge> edges = edgesOf(strands, warnings);
    const std::string header = headerOf(strands, edges.size());
    out.write(header.data(), static_cast<std::streamsize>(header.size()));
    writeVertices(strands, out);
    writeArray(out, edges);
    return warnings;
}

const PlyProperty* PlyElement::find(std::string_view property) const {
    const auto at = std::ranges::find(properties, property, &PlyProperty::name);
    return at == properties.end() ? nullptr : &*at;
}

bool PlyElement::hasLists() const {
    return std::ranges::any_of(
        properties, [](const PlyProperty& property) { return property.count_type.has_value(); });
}

std::size_t PlyElement::leastSize() const {
    std::size_t size = 0;
    for (const PlyProperty& property : properties)
        size += sizeOf(property.count_type.value_or(property.type));
    return size;
}

const PlyElement* PlyHeader::find(std::string_view element) const {
    const auto at = std::ranges::find(elements, element, &PlyElement::name);
    return at == elements.end() ? nullptr : &*at;
}

PlyHeader readPlyHeader(std::string_view file) {
    HeaderReader reader;
    std::string_view rest = file;
    std::size_t line = 1;
    try {
        if (takeLine(rest) != "ply") throw engine::Error("not a PLY file, which begins with 'ply'");
        do ++line;
        while (!reader.read(takeLine(rest)));
    } catch (const engine::Error& error) {
        throw engine::Error("line " + std::to_string(line), error.what());
    }
    PlyHeader header = reader.take();
    header.lines = line;
    header.size = file.size() - rest.size();
    return header;
}

StrandSet importPly(const StrandFile& file) {
    const PlyHeader header = readPlyHeader(textOf(file.bytes));
    return withValues(header, file.bytes, [&](const auto& values) {
        return Body(header, file.points_per_strand, values).read();
    });
}

void checkPlyFaces(std::span<const std::byte> file) {
    const PlyHeader header = readPlyHeader(textOf(file));
    withValues(header, file, [&](const auto& values) { checkFaces(header, values); });
}

}  // namespace hair::groom
