#include "hair/groom/formats/import_gltf_strands.h"

#include <cmath>
#include <limits>

#include <glm/mat3x3.hpp>

#include "engine/error.h"
#include "hair/groom/formats/chain_edges.h"
#include "hair/groom/mesh/gltf_accessors.h"
#include "hair/groom/mesh/gltf_scene.h"

namespace hair {
namespace {

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

// Lines without indices share no vertices. Programs that know strips write one as lines each of
// which begins where the last one ended: there, its first vertex becomes the last one's second.
void weld(std::vector<std::uint32_t>& indices, const std::vector<glm::vec3>& points) {
    for (std::size_t i = 2; i < indices.size(); i += 2)
        if (points[i] == points[i - 1]) indices[i] = indices[i - 1];
}

Polylines stripOf(std::vector<std::uint32_t> indices) {
    if (indices.size() < 2) {
        throw engine::Error(
            "a strip of " + std::to_string(indices.size()) + " points, expected 2 or more");
    }
    return {{static_cast<std::uint32_t>(indices.size())}, std::move(indices)};
}

class StrandReader {
public:
    explicit StrandReader(const tinygltf::Model& model) : model_(model) {}

    void add(const GltfPlace& place) {
        const tinygltf::Primitive& primitive = place.primitive;
        if (primitive.mode == TINYGLTF_MODE_LINE_LOOP) {
            throw engine::Error("mode 2 is a closed loop, a strand has two ends");
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
            set.warnings.clear();  // it has left out only what was there twice
        }
        join(std::move(set));
    }

    StrandSet take() {
        if (set_.ends.empty()) {
            throw engine::Error(
                "the file has no strands: expected primitives of mode 1 (LINES) or 3 (LINE_STRIP)");
        }
        if (skipped_ > 0) {
            set_.warnings.push_back(
                std::to_string(skipped_) + " primitives that are not lines are left out");
        }
        dropPartial(set_.widths, "_WIDTH");
        dropPartial(set_.transparencies, "_TRANSPARENCY, or alpha,");
        dropPartial(set_.colors, "COLOR_0");
        set_.metres_per_unit = 1.0;
        return std::move(set_);
    }

private:
    StrandSet readVertices(const tinygltf::Primitive& primitive, const glm::dmat4& transform) {
        const auto position = findAttribute(primitive, "POSITION");
        if (!position) throw engine::Error("no POSITION");
        StrandSet set;
        set.points = readVectors(model_, *position);
        const std::size_t count = set.points.size();
        if (const auto color = findAttribute(primitive, "COLOR_0")) {
            GltfColors read = readColors(model_, *color);
            set.colors.values = checked(std::move(read.colors), count, "COLOR_0");
            for (const float opacity : read.opacities)
                set.transparencies.values.push_back(1.0f - opacity);
        }
        set.widths.values = readOwn(primitive, "_WIDTH", count);
        if (findAttribute(primitive, "_TRANSPARENCY")) {
            set.transparencies.values = readOwn(primitive, "_TRANSPARENCY", count);
        }
        for (const float width : set.widths.values)
            if (width < 0.0f) throw engine::Error("_WIDTH is negative: " + std::to_string(width));
        // The identity would still make 0 of -0.
        if (transform != glm::dmat4(1.0)) place(set, transform);
        checkFinite(set);
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
        return checked(readScalars(model_, *accessor), count, name);
    }

    template <class Value>
    static std::vector<Value>
    checked(std::vector<Value> values, std::size_t count, const char* name) {
        if (values.size() != count) {
            throw engine::Error(std::string(name) + " and POSITION differ in count");
        }
        return values;
    }

    static void checkFinite(const StrandSet& set) {
        const auto check = [](const auto& values, const char* name, const auto& isFinite) {
            for (std::size_t i = 0; i < values.size(); ++i) {
                if (isFinite(values[i])) continue;
                throw engine::Error(
                    std::string(name) + " of vertex " + std::to_string(i) + " is not finite");
            }
        };
        const auto vector = [](const glm::vec3& v) {
            return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
        };
        const auto number = [](float x) { return std::isfinite(x); };
        check(set.points, "POSITION", vector);
        check(set.widths.values, "_WIDTH", number);
        check(set.transparencies.values, "_TRANSPARENCY, or alpha,", number);
        check(set.colors.values, "COLOR_0", vector);
    }

    void join(StrandSet set) {
        const std::size_t first = set_.points.size();
        if (set.points.size() > std::numeric_limits<std::uint32_t>::max() - first) {
            throw engine::Error("the strands have 2^32 points, or more");
        }
        for (std::uint32_t& end : set.ends) end += static_cast<std::uint32_t>(first);
        append(set_.ends, set.ends);
        append(set_.points, set.points);
        append(set_.widths.values, set.widths.values);
        append(set_.transparencies.values, set.transparencies.values);
        append(set_.colors.values, set.colors.values);
        append(set_.warnings, set.warnings);
    }

    // What only some primitives have.
    template <class Value>
    void dropPartial(PointAttribute<Value>& attribute, const char* name) {
        if (attribute.values.empty() || attribute.values.size() == set_.points.size()) return;
        set_.warnings.push_back(
            std::string(name) + " of some strands only is left out, the others have none");
        attribute.values.clear();
    }

    const tinygltf::Model& model_;
    StrandSet set_;
    std::size_t skipped_ = 0;
};

}  // namespace

StrandSet importGltfStrands(const StrandFile& file) {
    const tinygltf::Model model = loadGltf(file.bytes, file.path);
    StrandReader reader(model);
    forEachPrimitive(model, [&](const GltfPlace& place) { reader.add(place); });
    return reader.take();
}

}  // namespace hair
