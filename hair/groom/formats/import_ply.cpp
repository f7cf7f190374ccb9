#include "hair/groom/formats/import_ply.h"

#include <algorithm>
#include <array>
#include <utility>

#include "engine/error.h"
#include "hair/groom/formats/chain_edges.h"
#include "hair/groom/formats/ply_values.h"
#include "hair/groom/formats/ply_vertices.h"
#include "hair/groom/formats/text_words.h"

namespace hair {
namespace {

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
        "one 'strand', 'polyline' or 'line' with a list vertex_indices");
}

const PlyElement& strandElement(const PlyHeader& header) {
    for (const std::string_view name : kListElements) {
        const PlyElement* element = header.find(name);
        if (element && indexList(*element)) return *element;
    }
    const PlyElement* edges = header.find("edge");
    if (edges && isEdge(*edges)) return *edges;
    const PlyElement* faces = header.find(kFaces);
    if (faces && indexList(*faces)) return *faces;
    failWithoutStrands(header);
}

// Reads one file's elements, which may come in any order.
template <class Source>
class Body {
public:
    Body(const PlyHeader& header, Source source)
        : header_(header), strands_(strandElement(header)), source_(source) {}

    StrandSet read() {
        vertex_count_ = plyVertices(header_).count;
        for (const PlyElement& element : header_.elements) {
            source_.expect(element);
            if (element.name == "vertex") {
                readPlyVertices(source_, element, set_);
            } else if (&element != &strands_) {
                source_.skip(element);
                warnOf(element.count, element);
            } else {
                readStrands(element);
            }
        }
        source_.finish();
        if (!edges_.empty()) {  // not before the file is known to hold the vertices
            lines_ = chainEdges(
                edges_, vertex_count_, [this](std::size_t edge) { return placeOf(edge); });
        }
        if (lines_.ends.empty()) failWithoutStrands(header_);
        arrangePoints(set_, std::move(lines_));
        set_.comment = header_.comment;
        return std::move(set_);
    }

private:
    void warnOf(std::uint64_t count, const PlyElement& element) {
        if (count == 0) return;
        set_.warnings.push_back(
            std::to_string(count) + " of element " + inQuotes(element.name) + " are left out");
    }

    std::uint32_t takeVertex(PlyType type) {
        const double index = source_.take(type);
        if (index >= 0.0 && index < static_cast<double>(vertex_count_)) {
            return static_cast<std::uint32_t>(index);
        }
        throw engine::Error(
            Source::place(source_.position()),
            "vertex " + std::to_string(static_cast<std::int64_t>(index)) + " is named, there are " +
                std::to_string(vertex_count_));
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
        if (size == 0) throw engine::Error(place, "a strand of no points, expected 1 at least");
        if (!hasRoomFor(lines_, size))
            throw engine::Error(place, "2^32 points of strands, or more");
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
    const PlyElement& strands_;
    Source source_;
    std::uint64_t vertex_count_ = 0;
    std::vector<Edge> edges_;
    std::size_t edges_start_ = 0;  // position of the first edge
    std::size_t edges_step_ = 0;   // from one to the next
    std::vector<std::size_t> edge_positions_;  // [edge], where they are not equally far apart
    std::uint64_t polygons_ = 0;
    Polylines lines_;
    StrandSet set_;
};

}  // namespace

StrandSet importPly(const StrandFile& file) {
    const std::string_view text(
        reinterpret_cast<const char*>(file.bytes.data()), file.bytes.size());
    const PlyHeader header = readPlyHeader(text);
    switch (header.format) {
    case PlyFormat::ascii:
        return Body(header, PlyText(text.substr(header.size), header.lines)).read();
    case PlyFormat::little_endian:
        return Body(header, PlyBytes<std::endian::little>(file.bytes, header.size)).read();
    default:
        return Body(header, PlyBytes<std::endian::big>(file.bytes, header.size)).read();
    }
}

}  // namespace hair
