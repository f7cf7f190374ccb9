// Decodes compressed parts of glTF files by Draco and meshoptimizer. Both read bytes that nothing
// has checked, so they run in a fork with limits.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <draco/compression/decode.h>
#include <meshoptimizer.h>

#include "engine/error.h"
#include "engine/run_tool.h"
#include "hair/groom/formats/binary_file.h"
#include "hair/groom/mesh/gltf_model.h"

namespace hair::groom {
namespace {

using Bytes = std::span<const unsigned char>;

// An array of decoded data.
struct Array {
    int component_type = 0;  // tinygltf's
    std::size_t components = 1;  // of an element
    std::uint64_t count = 0;  // elements
    std::uint32_t attribute = 0;  // Draco's id

    std::uint64_t size() const {
        const auto type = static_cast<std::uint32_t>(component_type);
        return count * components *
               static_cast<std::uint64_t>(tinygltf::GetComponentSizeInBytes(type));
    }
};

// Compressed bytes, and what they are decoded to. Everything in it has been checked.
struct Part {
    std::string name;  // for messages
    Bytes bytes;
    std::uint64_t size = 0;  // decoded
    std::function<void(const Part& part, std::string& decoded)> decode;  // appends `size` bytes
};

Bytes bytesOf(
    const tinygltf::Model& model, int index, std::uint64_t offset, std::uint64_t length,
    const std::string& name) {
    const tinygltf::Buffer& buffer = at(model.buffers, index, "buffer");
    if (offset > buffer.data.size() || length > buffer.data.size() - offset)
        throw engine::Error(name, "its compressed data lie outside their buffer");
    return Bytes(buffer.data).subspan(offset, length);
}

// ---- meshoptimizer ------------------------------------------------------------------------------

// A mode of EXT_meshopt_compression, its decoder, and the strides that it may have.
struct Mode {
    std::string_view name;
    int (*decode)(
        void* result, std::size_t count, std::size_t stride, const unsigned char* bytes,
        std::size_t size);
    bool (*takes)(std::uint64_t count, std::uint64_t stride);
};

constexpr std::array kModes{
    Mode{
        "ATTRIBUTES", meshopt_decodeVertexBuffer,
        [](std::uint64_t, std::uint64_t stride) {
            return stride > 0 && stride <= 256 && stride % 4 == 0;
        }},
    Mode{
        "TRIANGLES", meshopt_decodeIndexBuffer,
        [](std::uint64_t count, std::uint64_t stride) {
            return count % 3 == 0 && (stride == 2 || stride == 4);
        }},
    Mode{"INDICES", meshopt_decodeIndexSequence, [](std::uint64_t, std::uint64_t stride) {
             return stride == 2 || stride == 4;
         }}};

struct Filter {
    std::string_view name;
    void (*decode)(void* elements, std::size_t count, std::size_t stride);  // null: nothing to do
    bool (*takes)(std::uint64_t stride);
};

constexpr std::array kFilters{
    Filter{"NONE", nullptr, [](std::uint64_t) { return true; }},
    Filter{
        "OCTAHEDRAL", meshopt_decodeFilterOct,
        [](std::uint64_t stride) { return stride == 4 || stride == 8; }},
    Filter{
        "QUATERNION", meshopt_decodeFilterQuat, [](std::uint64_t stride) { return stride == 8; }},
    Filter{"EXPONENTIAL", meshopt_decodeFilterExp, [](std::uint64_t stride) {
               return stride % 4 == 0;
           }}};

Part partOf(const tinygltf::Model& model, const GltfCompression::View& view) {
    constexpr std::uint64_t kMost = std::uint64_t{1} << 32;
    const std::string name = numbered("buffer view", view.view);
    const auto mode = std::ranges::find(kModes, view.mode, &Mode::name);
    if (mode == kModes.end())
        throw engine::Error(name, "the unknown mode of compression '" + view.mode + "'");
    const auto filter = std::ranges::find(kFilters, view.filter, &Filter::name);
    if (filter == kFilters.end())
        throw engine::Error(name, "the filter '" + view.filter + "' is not supported");
    if (view.count > kMost || !mode->takes(view.count, view.stride) || !filter->takes(view.stride))
        throw engine::Error(
            name, std::to_string(view.count) + " elements of " + std::to_string(view.stride) +
                      " bytes don't fit its mode of compression and filter");
    return {
        .name = name,
        .bytes = bytesOf(model, view.buffer, view.offset, view.length, name),
        .size = view.count * view.stride,
        .decode = [mode, filter, view](const Part& part, std::string& decoded) {
            const std::size_t start = decoded.size();
            decoded.resize(start + part.size);
            const int error = mode->decode(
                decoded.data() + start, view.count, view.stride, part.bytes.data(),
                part.bytes.size());
            if (error != 0)
                throw engine::Error(
                    part.name,
                    "meshoptimizer can't decode it: it is damaged, or of a later version");
            if (filter->decode) filter->decode(decoded.data() + start, view.count, view.stride);
        }};
}

// ---- Draco --------------------------------------------------------------------------------------

template <class Number>
void appendAttribute(
    const draco::Mesh& mesh, const Array& array, const std::string& name, std::string& decoded) {
    const draco::PointAttribute* const attribute = mesh.GetAttributeByUniqueId(array.attribute);
    if (!attribute)
        throw engine::Error(
            name, "the compressed data have no attribute " + std::to_string(array.attribute));
    std::vector<Number> element(array.components);
    for (draco::PointIndex point(0); point < mesh.num_points(); ++point) {
        if (!attribute->ConvertValue(
                attribute->mapped_index(point), static_cast<std::int8_t>(array.components),
                element.data()))
            throw engine::Error(name, "an attribute has values that its accessor can't hold");
        decoded.append(
            reinterpret_cast<const char*>(element.data()), element.size() * sizeof(Number));
    }
}

void appendAttribute(
    const draco::Mesh& mesh, const Array& array, const std::string& name, std::string& decoded) {
    switch (array.component_type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return appendAttribute<std::int8_t>(mesh, array, name, decoded);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return appendAttribute<std::uint8_t>(mesh, array, name, decoded);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return appendAttribute<std::int16_t>(mesh, array, name, decoded);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return appendAttribute<std::uint16_t>(mesh, array, name, decoded);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return appendAttribute<std::uint32_t>(mesh, array, name, decoded);
    default:
        return appendAttribute<float>(mesh, array, name, decoded);
    }
}

// Appends the vertices of the triangles, then each attribute.
void appendMesh(
    const Part& part, const Array& indices, const std::vector<Array>& attributes,
    std::string& decoded) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(part.bytes.data()), part.bytes.size());
    draco::Decoder decoder;
    const auto result = decoder.DecodeMeshFromBuffer(&buffer);
    if (!result.ok())
        throw engine::Error(
            part.name, "Draco can't decode it: " + result.status().error_msg_string());
    const draco::Mesh& mesh = *result.value();
    const auto require = [&](std::uint64_t expected, std::uint64_t count, const char* what) {
        if (count == expected) return;
        throw engine::Error(
            part.name, "the compressed data have " + std::to_string(count) + what +
                           ", but the file says " + std::to_string(expected));
    };
    require(indices.count, 3 * std::uint64_t{mesh.num_faces()}, " corners of triangles");
    for (const Array& array : attributes) require(array.count, mesh.num_points(), " vertices");
    for (draco::FaceIndex face(0); face < mesh.num_faces(); ++face)
        for (const draco::PointIndex& corner : mesh.face(face)) {
            const std::uint32_t vertex = corner.value();
            decoded.append(reinterpret_cast<const char*>(&vertex), sizeof vertex);
        }
    for (const Array& array : attributes) appendAttribute(mesh, array, part.name, decoded);
}

// The accessors of a decoded primitive, in the order of the data.
struct Decoded {
    std::vector<int*> accessors;  // the numbers of them in the primitive
    std::vector<Array> arrays;
};

Part partOf(
    tinygltf::Model& model, const GltfCompression::Primitive& compressed, Decoded& decoded) {
    const std::string name =
        numbered("mesh", compressed.mesh) + ", primitive " + std::to_string(compressed.primitive);
    auto& mesh = model.meshes.at(static_cast<std::size_t>(compressed.mesh));
    auto& primitive = mesh.primitives.at(static_cast<std::size_t>(compressed.primitive));
    if (primitive.mode != TINYGLTF_MODE_TRIANGLES || primitive.indices < 0)
        throw engine::Error(name, "is compressed by Draco, but is no list of triangles");
    const auto add = [&](int& accessor, Array array) {
        const tinygltf::Accessor& source = at(model.accessors, accessor, "accessor");
        array.count = source.count;
        if (array.count >= std::uint64_t{1} << 32)
            throw engine::Error(numbered("accessor", accessor), "2^32 elements or more");
        decoded.accessors.push_back(&accessor);
        decoded.arrays.push_back(array);
    };
    add(primitive.indices, {.component_type = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT});
    for (const auto& [attribute, id] : compressed.attributes) {
        const auto found = primitive.attributes.find(attribute);
        if (found == primitive.attributes.end()) continue;
        const tinygltf::Accessor& source = at(model.accessors, found->second, "accessor");
        const int components =
            tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(source.type));
        const int size =
            tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(source.componentType));
        if (components <= 0 || components > 4 || size <= 0 || size > 4 ||
            source.componentType == TINYGLTF_COMPONENT_TYPE_INT)
            throw engine::Error(
                numbered("accessor", found->second), "of a type that Draco doesn't compress");
        add(found->second, {.component_type = source.componentType,
                            .components = static_cast<std::size_t>(components),
                            .attribute = id});
    }
    const tinygltf::BufferView& view = at(model.bufferViews, compressed.view, "buffer view");
    Part part{
        .name = name,
        .bytes = bytesOf(model, view.buffer, view.byteOffset, view.byteLength, name),
        .decode = [indices = decoded.arrays.front(),
                   attributes = std::vector(decoded.arrays.begin() + 1, decoded.arrays.end())](
                      const Part& self, std::string& result) {
            appendMesh(self, indices, attributes, result);
        }};
    for (const Array& array : decoded.arrays) part.size += array.size();
    return part;
}

// ---- Both ---------------------------------------------------------------------------------------

constexpr char kDone = 'D';
constexpr char kFailed = 'F';

// Returns the decoded data of all parts, each of the size that it states.
std::string decodeApart(const std::vector<Part>& parts, std::uint64_t file_size) {
    ExpansionLimit limit(file_size);
    std::uint64_t size = 0;
    for (const Part& part : parts) {
        limit.add(part.size, "the compressed parts");
        size += part.size;
    }
    const auto decode = [&]() -> std::string {
        std::string decoded(1, kDone);
        decoded.reserve(1 + size);
        try {
            for (const Part& part : parts) part.decode(part, decoded);
        } catch (const engine::Error& error) {
            return kFailed + std::string(error.what());
        }
        return decoded;
    };
    // Draco's tables of a mesh are about eight times as large as the mesh.
    const engine::ChildLimits limits{
        .seconds = static_cast<unsigned>(8 + (file_size + size) / 2'000'000),
        .bytes = (std::size_t{160} << 20) + 16 * size,
        .output = (std::size_t{1} << 16) + size};
    std::string result;
    try {
        result = engine::runApart(decode, limits);
    } catch (const engine::Error& error) {
        throw engine::Error(
            "the program that decompresses it " + std::string(error.what()) +
            ": the compressed data may be damaged");
    }
    if (result.starts_with(kFailed)) throw engine::Error(result.substr(1));
    if (result.size() != 1 + size)
        throw engine::Error("the compressed parts have another size than the file says");
    return result.erase(0, 1);
}

}  // namespace

void decompress(tinygltf::Model& model, const GltfCompression& compression) {
    if (compression.views.empty() && compression.primitives.empty()) return;
    std::uint64_t file_size = 0;
    for (const tinygltf::Buffer& buffer : model.buffers) file_size += buffer.data.size();
    std::vector<Part> parts;
    for (const GltfCompression::View& view : compression.views)
        parts.push_back(partOf(model, view));
    std::vector<Decoded> primitives;
    primitives.reserve(compression.primitives.size());
    for (const GltfCompression::Primitive& primitive : compression.primitives)
        parts.push_back(partOf(model, primitive, primitives.emplace_back()));
    const std::string data = decodeApart(parts, file_size);

    const auto buffer = static_cast<int>(model.buffers.size());
    model.buffers.emplace_back();
    model.buffers.back().name = kDecompressed;
    model.buffers.back().data.assign(data.begin(), data.end());
    std::uint64_t offset = 0;
    for (const GltfCompression::View& view : compression.views) {
        auto& target = model.bufferViews.at(static_cast<std::size_t>(view.view));
        target.buffer = buffer;
        target.byteOffset = offset;
        target.byteLength = view.count * view.stride;
        offset += target.byteLength;
    }
    // Each array gets an accessor and a view of its own: primitives may share accessors.
    for (const Decoded& decoded : primitives) {
        for (std::size_t i = 0; i < decoded.arrays.size(); ++i) {
            int& number = *decoded.accessors[i];
            tinygltf::BufferView view;
            view.buffer = buffer;
            view.byteOffset = offset;
            view.byteLength = decoded.arrays[i].size();
            offset += view.byteLength;
            tinygltf::Accessor accessor = model.accessors.at(static_cast<std::size_t>(number));
            accessor.bufferView = static_cast<int>(model.bufferViews.size());
            accessor.byteOffset = 0;
            accessor.componentType = decoded.arrays[i].component_type;
            number = static_cast<int>(model.accessors.size());
            model.bufferViews.push_back(std::move(view));
            model.accessors.push_back(std::move(accessor));
        }
    }
}

}  // namespace hair::groom
