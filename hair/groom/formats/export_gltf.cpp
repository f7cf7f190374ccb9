#include "hair/groom/formats/export_gltf.h"

#include <cstring>
#include <limits>

#include <glm/common.hpp>

#include "engine/error.h"
#include "hair/groom/formats/chain_edges.h"
#include "hair/groom/formats/left_out.h"
#include "hair/groom/mesh/gltf_model.h"

namespace hair {
namespace {

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

    // What is the same everywhere has an array all the same.
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

// Bytes of data, beside which there is room for the rest: a .glb file counts to 2^32, and tinygltf
// counts base 64, 4 bytes for 3, to 2^31.
std::size_t greatestData(Container container) {
    constexpr std::size_t kRest = 1 << 16;
    return container == Container::binary ? (std::size_t{1} << 32) - kRest
                                          : (std::size_t{1} << 31) / 4 * 3 - kRest;
}

std::vector<std::string> write(const StrandSet& strands, std::ostream& out, Container container) {
    std::vector<std::string> warnings =
        leftOut(strands, {Part::widths, Part::transparencies, Part::colors, Part::unit});
    if (!strands.metres_per_unit) {
        warnings.push_back("the unit of length is not known, in glTF it is the metre");
    }
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
            "the strands are " + std::to_string(size) + " bytes, the format holds " +
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

}  // namespace hair
