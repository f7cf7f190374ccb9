#pragma once

#include <cstddef>
#include <cstdint>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "engine/error.h"
#include "hair/groom/formats/binary_file.h"
#include "hair/groom/mesh/mesh.h"

// The stream of a mesh from the program that reads it to its parent: little-endian arrays, each
// with its number of elements before it, without padding. The parent trusts nothing in it, because
// the file may have taken over the program.
namespace hair::groom {

// A mesh without pictures.
struct ReadMesh {
    Mesh mesh;
    std::vector<std::string> textures;  // [material]: file of the base colour's texture, or empty
};

// Writes or reads a mesh: `stream` is a MeshWriter or a MeshParser.
template <class Stream, class MeshOrConst>
void streamMesh(Stream& stream, MeshOrConst& mesh) {
    stream.array(mesh.positions);
    stream.array(mesh.normals);
    stream.array(mesh.texture_coordinates);
    stream.array(mesh.triangles);
    stream.array(mesh.triangle_materials);
    stream.array(mesh.triangle_parts);
    stream.each(mesh.parts, [&](auto& name) { stream.array(name); });
    stream.each(mesh.vertex_groups, [&](auto& group) {
        stream.array(group.name);
        stream.array(group.weights);
    });
    stream.each(mesh.materials, [&](auto& material) {
        stream.array(material.name);
        stream.value(material.base_color);
    });
    stream.flag(mesh.is_placed);
    stream.each(mesh.warnings, [&](auto& warning) { stream.array(warning); });
}

class MeshWriter {
public:
    explicit MeshWriter(std::ostream& out) : out_(out) {}

    template <class Value>
    void value(const Value& value) {
        writeValue(out_, value);
    }
    void flag(bool is_set) { value(std::uint8_t{is_set}); }
    template <class Array>
    void array(const Array& elements) {
        writeValue(out_, std::uint64_t{elements.size()});
        out_.write(
            reinterpret_cast<const char*>(elements.data()),
            static_cast<std::streamsize>(elements.size() * sizeof(elements[0])));
    }
    template <class Elements, class Write>
    void each(const Elements& elements, const Write& write) {
        writeValue(out_, std::uint64_t{elements.size()});
        for (const auto& element : elements) write(element);
    }

private:
    std::ostream& out_;
};

class MeshParser {
public:
    explicit MeshParser(std::span<const std::byte> bytes) : bytes_(bytes) {}

    template <class Value>
    void value(Value& value) {
        require(1, sizeof value);
        value = valueAt<Value>(bytes_, at_);
        at_ += sizeof value;
    }
    void flag(bool& is_set) {
        std::uint8_t byte = 0;
        value(byte);
        if (byte > 1) failAt(at_ - 1, "a flag that is neither 0 nor 1");
        is_set = byte == 1;
    }
    template <class Array>
    void array(Array& elements) {
        const std::uint64_t count = takeCount();
        constexpr std::size_t kSize = sizeof(typename Array::value_type);
        require(count, kSize);
        const auto values = arrayAt<typename Array::value_type>(bytes_, at_, count);
        elements.assign(values.begin(), values.end());
        at_ += count * kSize;
    }
    template <class Elements, class Read>
    void each(Elements& elements, const Read& read) {
        const std::uint64_t count = takeCount();
        require(count, sizeof(std::uint64_t));  // each has at least the length of a name
        elements.resize(count);
        for (auto& element : elements) read(element);
    }
    void end() const {
        if (at_ != bytes_.size()) failAt(at_, "bytes after the mesh");
    }

private:
    std::uint64_t takeCount() {
        std::uint64_t count = 0;
        value(count);
        return count;
    }
    void require(std::uint64_t count, std::size_t size) const {
        if (count > (bytes_.size() - at_) / size) failAt(at_, "the mesh ends too early");
    }

    std::span<const std::byte> bytes_;
    std::uint64_t at_ = 0;
};

inline void writeMeshStream(std::ostream& out, const ReadMesh& read) {
    MeshWriter writer(out);
    streamMesh(writer, read.mesh);
    writer.each(read.textures, [&](const std::string& name) { writer.array(name); });
}

// Refuses malformed streams, arrays with sizes that disagree, and indices out of range. Throws
// engine::Error "byte N: reason".
inline ReadMesh readMeshStream(std::span<const std::byte> bytes) {
    ReadMesh read;
    MeshParser parser(bytes);
    streamMesh(parser, read.mesh);
    parser.each(read.textures, [&](std::string& name) { parser.array(name); });
    parser.end();
    const Mesh& mesh = read.mesh;
    const std::size_t vertices = mesh.positions.size();
    const std::size_t triangles = mesh.triangles.size();
    bool agree =
        mesh.normals.size() == vertices && mesh.triangle_materials.size() == triangles &&
        (mesh.texture_coordinates.empty() || mesh.texture_coordinates.size() == vertices) &&
        (mesh.triangle_parts.empty() || mesh.triangle_parts.size() == triangles) &&
        read.textures.size() == mesh.materials.size();
    for (const VertexGroup& group : mesh.vertex_groups)
        agree = agree && group.weights.size() == vertices;
    for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t vertex : triangle) agree = agree && vertex < vertices;
    if (!agree) failAt(bytes.size(), "the mesh's arrays don't fit each other");
    return read;
}

}  // namespace hair::groom
