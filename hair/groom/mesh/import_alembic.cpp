#include "hair/groom/mesh/import_alembic.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/files.h"
#include "hair/groom/formats/alembic_values.h"
#include "hair/groom/formats/binary_file.h"
#include "hair/groom/formats/curves.h"
#include "hair/groom/formats/ogawa.h"

namespace hair::groom {
namespace {

// The faces of one object: where their corners begin, and the corners' vertices.
struct AlembicFaces {
    std::vector<std::int32_t> counts;
    std::vector<std::int32_t> corners;
};

class AlembicMeshReader {
public:
    explicit AlembicMeshReader(std::span<const std::byte> bytes)
        : values_(bytes), unfolding_(bytes.size()) {}

    Mesh read() {
        mesh_.materials.push_back({.name = "default"});
        readObject(values_.archive().top(), "", {}, false);
        if (mesh_.triangles.empty() && hidden_ > 0)
            failAt(0, "the archive has only hidden meshes: show them, then export");
        if (mesh_.triangles.empty())
            failAt(0, "the archive has no mesh" + std::string(has_curves_ ? ", only curves" : ""));
        warnOfHidden(hidden_, mesh_);
        if (has_coordinates_)
            mesh_.texture_coordinates.resize(mesh_.positions.size(), glm::vec2(0.0f));
        return std::move(mesh_);
    }

private:
    void readObject(
        const AlembicObject& object, const std::string& path, const AffineSpace& above,
        bool is_hidden_above) {
        const AlembicContents contents = values_.archive().contentsOf(object, path);
        const bool is_hidden = isHidden(values_, contents.properties, path, is_hidden_above);
        const std::string_view schema = alembicValue(object.metadata, "schema");
        AffineSpace space = above;
        if (schema.starts_with("AbcGeom_Xform_v")) {
            const auto transform = values_.compoundOf(contents.properties, ".xform", path);
            space = alembicTransformOf(values_, transform, above).space;
        }
        has_curves_ = has_curves_ || schema.starts_with("AbcGeom_Curve_v");
        const bool is_mesh =
            schema.starts_with("AbcGeom_PolyMesh_v") || schema.starts_with("AbcGeom_SubD_v");
        if (is_mesh && is_hidden) {
            ++hidden_;
            return;
        }
        if (is_mesh) {
            readMesh(contents, std::string(object.name), path, space);
            return;
        }
        for (const AlembicObject& child : contents.children)
            readObject(child, path + '/' + std::string(child.name), space, is_hidden);
    }

    void readMesh(
        const AlembicContents& contents, const std::string& name, const std::string& path,
        const AffineSpace& space) {
        const AlembicCompound geometry = values_.compoundOf(contents.properties, ".geom", path);
        const auto points = values_.parameterOf(geometry, "P");
        const auto counts = values_.parameterOf(geometry, ".faceCounts");
        const auto indices = values_.parameterOf(geometry, ".faceIndices");
        if (!points || !counts || !indices) return;  // an object without its mesh
        share(*points, points->count() * sizeof(glm::vec3));
        share(*indices, indices->count() * sizeof(std::array<std::uint32_t, 3>));
        const std::vector<glm::vec3> positions = placed(*points, space);
        const AlembicFaces faces{values_.integersOf(*counts), values_.integersOf(*indices)};
        check(faces, *counts, *indices, positions.size());
        const std::vector<glm::vec2> coordinates =
            coordinatesOf(geometry, faces.corners.size(), positions.size());
        const std::vector<std::uint32_t> materials =
            materialsOf(contents.children, path, faces.counts.size());
        const bool mirrored = glm::determinant(space.linear) < 0.0;
        addFaces(
            positions, normalsOf(positions, faces, mirrored), coordinates, faces, materials,
            mirrored);
        mesh_.parts.push_back(name);
        mesh_.triangle_parts.resize(
            mesh_.triangles.size(), static_cast<std::uint32_t>(mesh_.parts.size() - 1));
    }

    void share(const AlembicParameter& parameter, std::uint64_t bytes) {
        try {
            unfolding_.add(bytes, "the meshes");
        } catch (const engine::Error& error) {
            parameter.fail(error.what());
        }
    }

    std::vector<glm::vec3> placed(const AlembicParameter& points, const AffineSpace& space) {
        std::vector<glm::vec3> positions = finite<glm::vec3>(points);
        if (space.isIdentity()) return positions;
        for (glm::vec3& position : positions) position = space.place(position);
        return positions;
    }

    template <class Value>
    std::vector<Value> finite(const AlembicParameter& parameter) const {
        std::vector<Value> values = values_.floatsOf<Value>(parameter);
        requireFinite(values, parameter.elements.start, parameter.path + ": value");
        return values;
    }

    static void check(
        const AlembicFaces& faces, const AlembicParameter& counts, const AlembicParameter& indices,
        std::size_t vertices) {
        std::uint64_t corners = 0;
        for (const std::int32_t count : faces.counts) {
            if (count < 0) counts.fail("a face of " + std::to_string(count) + " corners");
            corners += static_cast<std::uint64_t>(count);
        }
        if (corners != faces.corners.size())
            counts.fail(
                "the faces have " + std::to_string(corners) + " corners, but there are " +
                std::to_string(faces.corners.size()) + " indices");
        for (const std::int32_t vertex : faces.corners)
            if (vertex < 0 || static_cast<std::size_t>(vertex) >= vertices)
                indices.fail(
                    "a corner names vertex " + std::to_string(vertex) + ", but there are " +
                    std::to_string(vertices));
    }

    // Returns texture coordinates of the corners; of the vertices if there are as many of them;
    // none if the mesh has none. Alembic's v is up.
    std::vector<glm::vec2>
    coordinatesOf(const AlembicCompound& geometry, std::size_t corners, std::size_t vertices) {
        const auto parameter = values_.parameterOf(geometry, "uv");
        if (!parameter) return {};
        share(*parameter, parameter->count() * sizeof(glm::vec2));
        std::vector<glm::vec2> coordinates = finite<glm::vec2>(*parameter);
        if (coordinates.size() != corners && coordinates.size() != vertices)
            parameter->fail(
                std::to_string(coordinates.size()) + " values, expected one for each of " +
                std::to_string(corners) + " corners or " + std::to_string(vertices) + " vertices");
        for (glm::vec2& uv : coordinates) uv.y = 1.0f - uv.y;
        return coordinates;
    }

    // Returns the material of each face.
    std::vector<std::uint32_t> materialsOf(
        const std::vector<AlembicObject>& children, const std::string& path, std::size_t faces) {
        std::vector<std::uint32_t> materials(faces, 0);
        for (const AlembicObject& child : children) {
            const std::string below = path + '/' + std::string(child.name);
            const AlembicContents contents = values_.archive().contentsOf(child, below);
            if (!alembicValue(child.metadata, "schema").starts_with("AbcGeom_FaceSet_v")) continue;
            const auto set = values_.compoundOf(contents.properties, ".faceset", below);
            const auto numbers = values_.parameterOf(set, ".faces");
            if (!numbers) continue;
            const auto material = materialNamed(std::string(child.name));
            for (const std::int32_t face : values_.integersOf(*numbers)) {
                if (face < 0 || static_cast<std::size_t>(face) >= faces)
                    numbers->fail(
                        "face " + std::to_string(face) + " is named, but there are " +
                        std::to_string(faces));
                materials[static_cast<std::size_t>(face)] = material;
            }
        }
        return materials;
    }

    std::uint32_t materialNamed(const std::string& name) {
        const auto [known, is_new] =
            material_numbers_.try_emplace(name, static_cast<std::uint32_t>(mesh_.materials.size()));
        if (is_new) mesh_.materials.push_back({.name = name});
        return known->second;
    }

    // Calls `visit` with the face and the places of the corners of each triangle, counter-clockwise
    // seen from outside.
    template <class Visit>
    static void forEachTriangle(const AlembicFaces& faces, bool mirrored, const Visit& visit) {
        std::size_t first = 0;
        for (std::size_t face = 0; face < faces.counts.size(); ++face) {
            const auto count = static_cast<std::size_t>(faces.counts[face]);
            for (std::size_t k = 2; k < count; ++k) {
                std::array<std::size_t, 3> corners{first, first + k, first + k - 1};
                if (mirrored) std::swap(corners[1], corners[2]);
                visit(face, corners);
            }
            first += count;
        }
    }

    // Returns normals of the vertices, weighted by the triangles' areas; not of unit length.
    static std::vector<glm::vec3>
    normalsOf(const std::vector<glm::vec3>& positions, const AlembicFaces& faces, bool mirrored) {
        std::vector<glm::vec3> normals(positions.size(), glm::vec3(0.0f));
        forEachTriangle(faces, mirrored, [&](std::size_t, const auto& corners) {
            std::array<std::size_t, 3> vertices{};
            for (std::size_t i = 0; i < 3; ++i)
                vertices[i] = static_cast<std::size_t>(faces.corners[corners[i]]);
            const glm::vec3& start = positions[vertices[0]];
            const glm::vec3 normal =
                glm::cross(positions[vertices[1]] - start, positions[vertices[2]] - start);
            for (const std::size_t vertex : vertices) normals[vertex] += normal;
        });
        return normals;
    }

    void addFaces(
        const std::vector<glm::vec3>& positions, const std::vector<glm::vec3>& normals,
        const std::vector<glm::vec2>& coordinates, const AlembicFaces& faces,
        const std::vector<std::uint32_t>& materials, bool mirrored) {
        const std::size_t first = mesh_.positions.size();
        if (positions.size() + faces.corners.size() >
            std::numeric_limits<std::uint32_t>::max() - first)
            failAt(0, "the meshes have 2^32 vertices, or more");
        mesh_.positions.insert(mesh_.positions.end(), positions.begin(), positions.end());
        mesh_.normals.insert(mesh_.normals.end(), normals.begin(), normals.end());
        std::vector<std::uint32_t> vertices(faces.corners.size());
        for (std::size_t i = 0; i < vertices.size(); ++i)
            vertices[i] =
                static_cast<std::uint32_t>(first) + static_cast<std::uint32_t>(faces.corners[i]);
        if (!coordinates.empty()) {
            has_coordinates_ = true;
            mesh_.texture_coordinates.resize(first, glm::vec2(0.0f));
            if (coordinates.size() == positions.size() && coordinates.size() != vertices.size())
                mesh_.texture_coordinates.insert(
                    mesh_.texture_coordinates.end(), coordinates.begin(), coordinates.end());
            else
                split(vertices, coordinates);
        }
        forEachTriangle(faces, mirrored, [&](std::size_t face, const auto& corners) {
            mesh_.triangles.push_back(
                {vertices[corners[0]], vertices[corners[1]], vertices[corners[2]]});
            mesh_.triangle_materials.push_back(materials[face]);
        });
    }

    // Gives corners with other texture coordinates than their vertex one of their own.
    void split(std::vector<std::uint32_t>& vertices, const std::vector<glm::vec2>& coordinates) {
        constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
        mesh_.texture_coordinates.resize(mesh_.positions.size(), glm::vec2(kNone));
        std::map<std::pair<std::uint32_t, std::pair<float, float>>, std::uint32_t> others;
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            const std::uint32_t vertex = vertices[i];
            const glm::vec2 uv = coordinates[i];
            glm::vec2& own = mesh_.texture_coordinates[vertex];
            if (std::isnan(own.x)) own = uv;
            if (own == uv) continue;
            const auto [other, is_new] = others.try_emplace(
                {vertex, {uv.x, uv.y}}, static_cast<std::uint32_t>(mesh_.positions.size()));
            if (is_new) {
                mesh_.positions.push_back(glm::vec3(mesh_.positions[vertex]));
                mesh_.normals.push_back(glm::vec3(mesh_.normals[vertex]));
                mesh_.texture_coordinates.push_back(uv);
            }
            vertices[i] = other->second;
        }
        for (glm::vec2& uv : mesh_.texture_coordinates)
            if (std::isnan(uv.x)) uv = glm::vec2(0.0f);  // of vertices without a face
    }

    AlembicValues values_;
    ExpansionLimit unfolding_;
    Mesh mesh_;
    std::map<std::string, std::uint32_t> material_numbers_;
    bool has_coordinates_ = false;
    bool has_curves_ = false;
    std::size_t hidden_ = 0;  // meshes
};

}  // namespace

Mesh readAlembicMesh(std::span<const std::byte> bytes) { return AlembicMeshReader(bytes).read(); }

Mesh importAlembicMesh(const std::filesystem::path& path, Textures, const NamedFileCheck&) {
    engine::OpenFile file(path);
    std::vector<char> bytes(file.size());
    file.read(bytes);
    return readAlembicMesh(std::as_bytes(std::span(bytes)));
}

}  // namespace hair::groom
