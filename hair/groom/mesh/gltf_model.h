#pragma once

// tinygltf's classes depend on these macros.
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#include <tiny_gltf.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "engine/error.h"
#include "hair/groom/named_files.h"

namespace hair::groom {

// Decodes base 64 text (RFC 4648, section 4), padded to whole groups of 4 characters; absent for
// other text.
std::optional<std::string> decodeBase64(std::string_view text);

// The chunks of a binary glTF file (glTF 2.0, section 4.4).
struct GlbChunks {
    std::string_view json;
    std::string_view binary;  // empty if there is none
};

bool isGlb(std::string_view file);

// Throws engine::Error "byte N: reason" for a header and chunks that don't match the file's size.
GlbChunks glbChunks(std::string_view file);

// How much of a file's images is read.
enum class GltfImages {
    skipped,
    // Name, bufferView and uri, with data in it, as in the file; textures and samplers, too.
    named,
};

// Whether skins and animations are read, or left out without a check.
enum class GltfMotion { skipped, read };

// Reads glTF 2.0: .gltf or, by its first bytes, .glb. Buffers in files of their own are read from
// the folder of `path` after a call of `check`, or refused if `path` is empty. Sections that
// nothing here needs are left out, and compressed parts are decompressed. Refuses other required
// extensions that change the geometry. Throws engine::Error without naming the file.
tinygltf::Model loadGltf(
    std::span<const std::byte> bytes, const std::filesystem::path& path,
    GltfImages images = GltfImages::skipped, GltfMotion motion = GltfMotion::skipped,
    const NamedFileCheck& check = {});

// Parts of a file that are compressed, with numbers as they are in the file.
struct GltfCompression {
    // A buffer view by EXT_meshopt_compression.
    struct View {
        int view = -1;  // the view that has the data once they are decoded
        int buffer = -1;
        std::uint64_t offset = 0;  // bytes of the compressed data in the buffer
        std::uint64_t length = 0;
        std::uint64_t stride = 0;  // bytes of an element
        std::uint64_t count = 0;  // elements
        std::string mode;
        std::string filter;
    };
    // A primitive by KHR_draco_mesh_compression.
    struct Primitive {
        int mesh = -1;
        int primitive = -1;
        int view = -1;  // of the compressed data
        std::map<std::string, std::uint32_t> attributes;  // Draco's ids, which are unique
    };

    std::vector<View> views;
    std::vector<Primitive> primitives;
};

// The name of the buffer with decompressed data, the model's last.
inline constexpr std::string_view kDecompressed = "decompressed";

// Decodes these parts into a new buffer of the model. The libraries run in a fork of this process
// with limits on time and memory. Throws engine::Error with the part at fault.
void decompress(tinygltf::Model& model, const GltfCompression& compression);

// Access to the elements of a glTF file, with checks of every index and range. Errors begin with
// the element at fault: "accessor 2: ...".

inline std::string numbered(const char* kind, int index) {
    return kind + (" " + std::to_string(index));
}

template <class Element>
const Element& at(const std::vector<Element>& elements, int index, const char* kind) {
    if (index < 0 || static_cast<std::size_t>(index) >= elements.size()) {
        throw engine::Error(
            "the file names " + numbered(kind, index) + ", but it has " +
            std::to_string(elements.size()));
    }
    return elements[static_cast<std::size_t>(index)];
}

// The accessor of a primitive's attribute.
std::optional<int> findAttribute(const tinygltf::Primitive& primitive, const std::string& name);

// Accessors of float; vectors may also be of integers where the file uses KHR_mesh_quantization.
std::vector<float> readScalars(const tinygltf::Model& model, int accessor);
std::vector<glm::vec3> readVectors(const tinygltf::Model& model, int accessor);

// The numbers of an accessor of any kind, sparse ones included.
struct GltfNumbers {
    std::size_t components = 0;  // of an element
    std::vector<double> values;  // [element][component]
};

// Whether integers that are not normalized are refused or read as they are. Normalized ones stand
// for 0 to 1, signed ones for -1 to 1 (glTF 2.0, section 3.11).
enum class GltfIntegers { normalized, whole };

GltfNumbers readNumbers(const tinygltf::Model& model, int accessor, GltfIntegers integers);

// Whether a primitive is a triangle list, strip or fan.
bool hasTriangles(const tinygltf::Primitive& primitive);

// POSITION, which every primitive needs.
std::vector<glm::vec3>
readPositions(const tinygltf::Model& model, const tinygltf::Primitive& primitive);

// Returns `values` of the attribute `name`. Throws engine::Error unless there are `count`, the
// number of positions.
template <class Value>
std::vector<Value> matching(std::vector<Value> values, std::size_t count, const std::string& name) {
    if (values.size() == count) return values;
    throw engine::Error(name + " and POSITION differ in count");
}

// Accessors of float, or of normalized unsigned bytes or shorts, or quantized as above.
std::vector<glm::vec2> readTextureCoordinates(const tinygltf::Model& model, int accessor);

struct GltfColors {
    std::vector<glm::vec3> colors;
    std::vector<float> opacities;  // empty if the accessor is a VEC3
};
GltfColors readColors(const tinygltf::Model& model, int accessor);

// Returns the vertices that a primitive names, all of them below `vertex_count`; 0, 1, 2 ... if it
// has no indices.
std::vector<std::uint32_t> readIndices(
    const tinygltf::Model& model, const tinygltf::Primitive& primitive, std::size_t vertex_count);

// A primitive where it stands in the scene.
struct GltfPlace {
    const tinygltf::Primitive& primitive;
    const glm::dmat4& transform;  // to the scene, metres
    const std::string& name;  // of the node, or else of the mesh
    int node;
    bool is_hidden;  // KHR_node_visibility hides the node, or one above it
};

// Visits the primitives of the default scene's meshes. Errors, also those of `visit`, begin with
// the mesh and primitive if there is one. Throws engine::Error also if the scene's nodes are not a
// tree.
void forEachPrimitive(
    const tinygltf::Model& model, const std::function<void(const GltfPlace& place)>& visit);

}  // namespace hair::groom
