#include "hair/groom/formats/formats.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

#include <glm/common.hpp>
#include <glm/mat3x3.hpp>

#include "engine/error.h"
#include "hair/groom/formats/binary_file.h"
#include "hair/groom/formats/polylines.h"
#include "hair/groom/formats/text.h"
#include "hair/groom/mesh/gltf_model.h"

namespace hair::groom {
namespace {

// ---- Export gltf --------------------------------------------------------------------------------

// Builds a file of one primitive and one buffer, arrays one after the other.
class LinesFile {
public:
    LinesFile() {
        model_.asset.version = "2.0";
        model_.asset.generator = "hairbench";
        model_.buffers.emplace_back();
    }

    // `type` is tinygltf's. Returns the accessor's number.
    template <class Element>
    int add(const std::vector<Element>& elements, int target, int type, int component) {
        std::vector<unsigned char>& data = model_.buffers[0].data;
        const std::size_t size = elements.size() * sizeof(Element);
        tinygltf::BufferView view;
        view.buffer = 0;
        view.byteOffset = data.size();
        view.byteLength = size;
        view.target = target;
        model_.bufferViews.push_back(view);
        data.resize(data.size() + size);
        std::memcpy(data.data() + view.byteOffset, elements.data(), size);

        tinygltf::Accessor accessor;
        accessor.bufferView = static_cast<int>(model_.bufferViews.size() - 1);
        accessor.componentType = component;
        accessor.count = elements.size();
        accessor.type = type;
        model_.accessors.push_back(accessor);
        return static_cast<int>(model_.accessors.size() - 1);
    }

    template <class Value>
    void addAttribute(const std::string& name, const std::vector<Value>& values) {
        constexpr int kType =
            sizeof(Value) == sizeof(float) ? TINYGLTF_TYPE_SCALAR : TINYGLTF_TYPE_VEC3;
        primitive_.attributes[name] =
            add(values, TINYGLTF_TARGET_ARRAY_BUFFER, kType, TINYGLTF_COMPONENT_TYPE_FLOAT);
    }

    // A value that is the same everywhere also gets an array.
    template <class Value>
    void addAttribute(
        const std::string& name, const PointAttribute<Value>& attribute, std::size_t count) {
        if (!attribute.values.empty()) {
            addAttribute(name, attribute.values);
        } else if (attribute.everywhere) {
            addAttribute(name, std::vector(count, *attribute.everywhere));
        }
    }

    void addPositions(const std::vector<glm::vec3>& points) {
        addAttribute("POSITION", points);
        glm::dvec3 least(std::numeric_limits<double>::infinity());
        glm::dvec3 greatest = -least;
        for (const glm::vec3& point : points) {
            least = glm::min(least, glm::dvec3(point));
            greatest = glm::max(greatest, glm::dvec3(point));
        }
        model_.accessors.back().minValues = {least.x, least.y, least.z};
        model_.accessors.back().maxValues = {greatest.x, greatest.y, greatest.z};
    }

    void addLines(const std::vector<Edge>& edges) {
        static_assert(sizeof(Edge) == 2 * sizeof(std::uint32_t));
        primitive_.indices =
            add(edges, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER, TINYGLTF_TYPE_SCALAR,
                TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT);
        model_.accessors.back().count = 2 * edges.size();
        primitive_.mode = TINYGLTF_MODE_LINE;
    }

    tinygltf::Model finish(double metres_per_unit) {
        tinygltf::Mesh mesh;
        mesh.name = "strands";
        mesh.primitives.push_back(primitive_);
        model_.meshes.push_back(mesh);
        tinygltf::Node node;
        node.name = "strands";
        node.mesh = 0;
        if (metres_per_unit != 1.0) node.scale.assign(3, metres_per_unit);
        model_.nodes.push_back(node);
        tinygltf::Scene scene;
        scene.nodes = {0};
        model_.scenes.push_back(scene);
        model_.defaultScene = 0;
        return std::move(model_);
    }

private:
    tinygltf::Model model_;
    tinygltf::Primitive primitive_;
};

enum class Container { text, binary };

// Most bytes of data that leave room for the rest: a .glb file counts to 2^32, and tinygltf counts
// base 64, 4 bytes for 3, to 2^31.
std::size_t greatestData(Container container) {
    constexpr std::size_t kRest = 1 << 16;
    return container == Container::binary ? (std::size_t{1} << 32) - kRest
                                          : (std::size_t{1} << 31) / 4 * 3 - kRest;
}

std::vector<std::string> write(const StrandSet& strands, std::ostream& out, Container container) {
    std::vector<std::string> warnings =
        leftOut(strands, {Part::widths, Part::transparencies, Part::colors, Part::unit});
    if (!strands.metres_per_unit) {
        warnings.push_back("the unit of length is not known; in glTF it is the metre");
    }
    if (strands.up.value_or(1) != 1)
        throw engine::Error("glTF has +y up, but the strands have another axis up: use --up y");
    LinesFile file;
    const std::size_t count = strands.points.size();
    file.addLines(edgesOf(strands, warnings));
    file.addPositions(strands.points);
    file.addAttribute("_WIDTH", strands.widths, count);
    file.addAttribute("_TRANSPARENCY", strands.transparencies, count);
    file.addAttribute("COLOR_0", strands.colors, count);
    const tinygltf::Model model = file.finish(strands.metres_per_unit.value_or(1.0));
    const std::size_t size = model.buffers[0].data.size();
    if (size > greatestData(container)) {
        throw engine::Error(
            "the strands are " + std::to_string(size) + " bytes; the format holds " +
            std::to_string(greatestData(container)));
    }
    const bool is_binary = container == Container::binary;
    if (!tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, out, !is_binary, is_binary)) {
        throw engine::Error("can't be written as glTF");
    }
    return warnings;
}

}  // namespace

std::vector<std::string> exportGltf(const StrandSet& strands, std::ostream& out) {
    return write(strands, out, Container::text);
}

std::vector<std::string> exportGlb(const StrandSet& strands, std::ostream& out) {
    return write(strands, out, Container::binary);
}

namespace {

// ---- Import gltf strands ------------------------------------------------------------------------

template <class Value>
void append(std::vector<Value>& values, const std::vector<Value>& more) {
    values.insert(values.end(), more.begin(), more.end());
}

Polylines chainsOf(const std::vector<std::uint32_t>& indices, std::size_t vertex_count) {
    if (indices.size() % 2 != 0) {
        throw engine::Error(std::to_string(indices.size()) + " indices are not whole lines");
    }
    std::vector<Edge> edges(indices.size() / 2);
    for (std::size_t i = 0; i < edges.size(); ++i) edges[i] = {indices[2 * i], indices[2 * i + 1]};
    return chainEdges(
        edges, vertex_count, [](std::size_t edge) { return "line " + std::to_string(edge); });
}

// Lines without indices share no vertices. Programs that know strips write a strip as lines that
// each begin where the previous one ended. There, the second vertex of the previous line is used as
// the first vertex of a line.
void weld(std::vector<std::uint32_t>& indices, const std::vector<glm::vec3>& points) {
    for (std::size_t i = 2; i < indices.size(); i += 2)
        if (points[i] == points[i - 1]) indices[i] = indices[i - 1];
}

Polylines stripOf(std::vector<std::uint32_t> indices) {
    if (indices.empty()) throw engine::Error("a strip of no points, expected 2 or more");
    return {{static_cast<std::uint32_t>(indices.size())}, std::move(indices)};
}

// Returns a whole number of an object's `extras`, where Blender writes its custom properties.
std::optional<std::int32_t> extraOf(const tinygltf::Value& extras, const std::string& name) {
    if (!extras.IsObject() || !extras.Has(name)) return {};
    const tinygltf::Value& value = extras.Get(name);
    if (value.IsBool()) return value.Get<bool>() ? 1 : 0;
    const double number = value.IsNumber() ? value.GetNumberAsDouble() : std::nan("");
    if (!(std::abs(number) <= std::numeric_limits<std::int32_t>::max()) ||
        number != std::trunc(number))
        throw engine::Error(inQuotes(name) + " in extras is not an int32");
    return static_cast<std::int32_t>(number);
}

class StrandReader {
public:
    explicit StrandReader(const tinygltf::Model& model) : model_(model) {}

    void add(const GltfPlace& place) {
        const tinygltf::Primitive& primitive = place.primitive;
        if (primitive.mode == TINYGLTF_MODE_LINE_LOOP) {
            throw engine::Error("mode 2 is a closed loop, but a strand has two ends");
        }
        if (primitive.mode != TINYGLTF_MODE_LINE && primitive.mode != TINYGLTF_MODE_LINE_STRIP) {
            ++skipped_;
            return;
        }
        StrandSet set = readVertices(primitive, place.transform);
        std::vector<std::uint32_t> indices = readIndices(model_, primitive, set.points.size());
        if (primitive.mode == TINYGLTF_MODE_LINE_STRIP) {
            arrangePoints(set, stripOf(std::move(indices)));
        } else if (primitive.indices >= 0) {
            arrangePoints(set, chainsOf(indices, set.points.size()));
        } else {
            weld(indices, set.points);
            arrangePoints(set, chainsOf(indices, set.points.size()));
            set.warnings.clear();  // only repeated vertices were left out
        }
        if (place.is_hidden) {
            hidden_ += set.strandCount();
            return;
        }
        if (const auto group = extraAt(place, "groom_group_id"))
            set.groups.assign(set.strandCount(), *group);
        if (const auto guide = extraAt(place, "groom_guide"))
            set.guides.assign(set.strandCount(), *guide != 0 ? 1 : 0);
        join(std::move(set));
    }

    StrandSet take() {
        if (set_.ends.empty() && hidden_ > 0)
            throw engine::Error("the file has only hidden strands: show them, then export");
        if (set_.ends.empty()) {
            throw engine::Error(
                "the file has no strands: expected primitives of mode 1 (LINES) or 3 (LINE_STRIP)");
        }
        if (skipped_ > 0) {
            set_.warnings.push_back(
                std::to_string(skipped_) + " primitives that are not lines are left out");
        }
        warnOfStrands(hidden_, "of hidden nodes", set_);
        if (!set_.guides.empty()) set_.guides.resize(set_.ends.size(), 0);
        completeGroups(set_, without_group_);
        completeWidths(set_, without_width_);
        completeTransparencies(set_, without_transparency_);
        completeColors(set_, without_color_);
        set_.metres_per_unit = 1.0;
        set_.up = 1;
        return std::move(set_);
    }

private:
    StrandSet readVertices(const tinygltf::Primitive& primitive, const glm::dmat4& transform) {
        StrandSet set;
        set.points = readPositions(model_, primitive);
        const std::size_t count = set.points.size();
        if (const auto color = findAttribute(primitive, "COLOR_0")) {
            GltfColors read = readColors(model_, *color);
            set.colors.values = matching(std::move(read.colors), count, "COLOR_0");
            for (const float opacity : read.opacities)
                set.transparencies.values.push_back(1.0f - opacity);
        }
        set.widths.values = readOwn(primitive, "_WIDTH", count);
        if (findAttribute(primitive, "_TRANSPARENCY")) {
            set.transparencies.values = readOwn(primitive, "_TRANSPARENCY", count);
        }
        // Even the identity would turn -0 into 0.
        if (transform != glm::dmat4(1.0)) place(set, transform);
        return set;
    }

    static void place(StrandSet& set, const glm::dmat4& transform) {
        for (glm::vec3& point : set.points) point = transform * glm::dvec4(point, 1.0);
        const double scale = std::cbrt(std::abs(glm::determinant(glm::dmat3(transform))));
        for (float& width : set.widths.values) width = static_cast<float>(scale * width);
    }

    std::vector<float>
    readOwn(const tinygltf::Primitive& primitive, const char* name, std::size_t count) const {
        const auto accessor = findAttribute(primitive, name);
        if (!accessor) return {};
        return matching(readScalars(model_, *accessor), count, name);
    }

    void join(StrandSet set) {
        const std::size_t first = set_.points.size();
        if (set.points.size() > std::numeric_limits<std::uint32_t>::max() - first) {
            throw engine::Error("the strands have 2^32 points, or more");
        }
        const std::size_t first_strand = set_.ends.size();
        appendPart(set_.groups, set.groups, first_strand, set.ends.size(), without_group_);
        if (!set.guides.empty()) {
            set_.guides.resize(first_strand, 0);
            append(set_.guides, set.guides);
        }
        for (std::uint32_t& end : set.ends) end += static_cast<std::uint32_t>(first);
        append(set_.ends, set.ends);
        append(set_.points, set.points);
        const std::size_t added = set.points.size();
        appendPart(set_.widths.values, set.widths.values, first, added, without_width_);
        appendPart(
            set_.transparencies.values, set.transparencies.values, first, added,
            without_transparency_);
        appendPart(set_.colors.values, set.colors.values, first, added, without_color_);
        append(set_.warnings, set.warnings);
    }

    // Returns a number of the extras of the node, or else of its mesh.
    std::optional<std::int32_t> extraAt(const GltfPlace& place, const std::string& name) const {
        const tinygltf::Node& node = model_.nodes[static_cast<std::size_t>(place.node)];
        const auto own = extraOf(node.extras, name);
        return own ? own : extraOf(model_.meshes[static_cast<std::size_t>(node.mesh)].extras, name);
    }

    // Appends a part of `added` points, or strands, after `first`. `without` has those that lack
    // it, once any has it.
    template <class Value>
    static void appendPart(
        std::vector<Value>& values, const std::vector<Value>& more, std::size_t first,
        std::size_t added, std::vector<PointRange>& without) {
        if (values.empty() && more.empty()) return;
        if (values.empty() && first > 0) without.push_back({0, first});
        if (more.empty()) without.push_back({first, added});
        values.resize(first);
        append(values, more);
        values.resize(first + added);
    }

    const tinygltf::Model& model_;
    StrandSet set_;
    std::size_t hidden_ = 0;  // strands
    std::vector<StrandRange> without_group_;
    std::vector<PointRange> without_width_;
    std::vector<PointRange> without_transparency_;
    std::vector<PointRange> without_color_;
    std::size_t skipped_ = 0;
};

}  // namespace

StrandSet importGltfStrands(const StrandFile& file) {
    const tinygltf::Model model =
        loadGltf(file.bytes, file.path, GltfImages::skipped, GltfMotion::skipped, file.check);
    StrandReader reader(model);
    forEachPrimitive(model, [&](const GltfPlace& place) { reader.add(place); });
    return reader.take();
}

}  // namespace hair::groom
