#include "hair/groom/mesh/import_mesh.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include <glm/geometric.hpp>

#include "engine/error.h"
#include "engine/files.h"
#include "engine/pictures.h"
#include "engine/process.h"
#include "engine/run_tool.h"
#include "hair/groom/files.h"
#include "hair/groom/formats/ply.h"
#include "hair/groom/formats/usd_import.h"
#include "hair/groom/mesh/import_alembic.h"
#include "hair/groom/mesh/import_gltf.h"
#include "hair/groom/mesh/mesh.h"
#include "hair/groom/mesh/mesh_stream.h"
#include "hair/groom/other_formats.h"

namespace hair::groom {
namespace {

// ---- Import assimp ------------------------------------------------------------------------------

// Reads the formats of assimp, in a child process (mesh_reader.cpp). The faces of a PLY are checked
// before, because assimp reads past the vertices for indices out of range.
Mesh importAssimp(
    const std::filesystem::path& path, Textures textures, const NamedFileCheck& check) {
    if (lowerCaseExtension(path) == ".ply") {
        const std::string file = engine::readFile(path);
        checkPlyFaces(std::as_bytes(std::span(file)));
    }
    const std::string program = engine::helperProgram("hairbench_mesh_reader").string();
    // Limits for what a file of this size can need. Assimp's trees of text files are about 40 times
    // as large as the files, and a part with a material takes 35 kB, so that the smallest files may
    // have 3,000 of them. A vertex takes 32 bytes here and at least one byte in any format.
    const std::uintmax_t size = std::filesystem::file_size(path);
    engine::ChildLimits limits{
        .seconds = static_cast<unsigned>(8 + size / 2'000'000),
        .bytes = (std::size_t{160} << 20) + 64 * size,
        .output = (std::size_t{64} << 20) + 64 * size,
        .reads = readsOf(check)};
#ifdef HAIRBENCH_SANITIZE  // sanitizers reserve terabytes of addresses
    limits.bytes = 0;
#endif
    // An absolute path can't be taken for an option.
    std::vector<std::string> command{program, std::filesystem::absolute(path).string()};
    for (const std::filesystem::path& folder : check.folders()) command.push_back(folder.string());
    limits.reads->push_back(program);
    ReadMesh read;
    try {
        read = readMeshStream(engine::runTool(command, limits));
    } catch (const std::system_error& error) {
        if (error.code() == std::errc::no_such_file_or_directory)
            throw engine::Error("the program that reads such meshes is missing: " + program);
        throw engine::Error(
            "the program that reads such meshes can't be started: " + error.code().message());
    } catch (const engine::Error& error) {
        const std::string reason = error.what();
        if (!reason.starts_with(program)) throw;
        throw engine::Error("assimp, which reads it," + reason.substr(program.size()));
    }
    Mesh mesh = std::move(read.mesh);
    mesh.is_placed = lowerCaseExtension(path) == ".dae";
    if (textures == Textures::skipped) return mesh;
    for (std::size_t i = 0; i < mesh.materials.size(); ++i) {
        if (read.textures[i].empty()) continue;
        mesh.materials[i].base_color_texture = {
            .picture = static_cast<std::uint32_t>(mesh.pictures.size())};
        const std::filesystem::path picture = path.parent_path() / read.textures[i];
        if (check) check(picture);
        mesh.pictures.push_back(engine::readImage(picture));
    }
    return mesh;
}

// ---- Import mesh --------------------------------------------------------------------------------

constexpr std::array<std::string_view, 2> gltf_extensions{".glb", ".gltf"};
constexpr std::array<std::string_view, 6> assimp_extensions{".obj", ".ply", ".stl",
                                                            ".off", ".fbx", ".dae"};
constexpr std::array<std::string_view, 4> usd_extensions{".usd", ".usda", ".usdc", ".usdz"};
constexpr std::array<std::string_view, 1> alembic_extensions{".abc"};
constexpr std::array mesh_importers{
    MeshImporter{gltf_extensions, importGltf},
    MeshImporter{assimp_extensions, importAssimp},
    MeshImporter{usd_extensions, importUsdMesh},
    MeshImporter{alembic_extensions, importAlembicMesh},
};

const MeshImporter& importerFor(const std::filesystem::path& path) {
    const std::string extension = lowerCaseExtension(path);
    std::string known;
    for (const MeshImporter& importer : mesh_importers) {
        for (const std::string_view name : importer.extensions) {
            if (name == extension) return importer;
            known.append(known.empty() ? "" : ", ").append(name);
        }
    }
    throw engine::Error(path.string(), "unknown mesh format '" + extension + "'; known: " + known);
}

bool isFinite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void checkVertices(const Mesh& mesh) {
    const std::size_t count = mesh.positions.size();
    for (std::size_t i = 0; i < count; ++i) {
        if (isFinite(mesh.positions[i])) continue;
        throw engine::Error("the position of vertex " + std::to_string(i) + " is not finite");
    }
    assert(mesh.texture_coordinates.empty() || mesh.texture_coordinates.size() == count);
    for (std::size_t i = 0; i < mesh.texture_coordinates.size(); ++i) {
        if (isFinite({mesh.texture_coordinates[i], 0.0f})) continue;
        throw engine::Error(
            "the texture coordinate of vertex " + std::to_string(i) + " is not finite");
    }
    for (const VertexGroup& group : mesh.vertex_groups) {
        assert(group.weights.size() == count);
        for (std::size_t i = 0; i < count; ++i) {
            if (group.weights[i] >= 0.0f && group.weights[i] <= 1.0f) continue;
            throw engine::Error(
                "the weight of vertex " + std::to_string(i) + " in group '" + group.name +
                "' is outside [0, 1]");
        }
    }
}

void checkMesh(const Mesh& mesh) {
    if (mesh.triangles.empty()) throw engine::Error("the mesh has no triangles");
    for (const std::uint32_t material : mesh.triangle_materials) {
        if (material >= mesh.materials.size()) {
            throw engine::Error("no material " + std::to_string(material));
        }
    }
    assert(mesh.triangle_parts.empty() || mesh.triangle_parts.size() == mesh.triangles.size());
    for (const std::uint32_t part : mesh.triangle_parts) {
        if (part >= mesh.parts.size()) throw engine::Error("no part " + std::to_string(part));
    }
    checkVertices(mesh);
}

// Keeps the normals that the file has; the others become the sum of the vertex's triangle normals
// weighted by area.
void completeNormals(Mesh& mesh) {
    std::vector<glm::vec3> sums(mesh.positions.size(), glm::vec3(0.0f));
    for (const auto& [a, b, c] : mesh.triangles) {
        const glm::vec3 edge = mesh.positions[b] - mesh.positions[a];
        const glm::vec3 normal = glm::cross(edge, mesh.positions[c] - mesh.positions[a]);
        for (const std::uint32_t vertex : {a, b, c}) sums[vertex] += normal;
    }
    mesh.normals.resize(mesh.positions.size(), glm::vec3(0.0f));
    for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
        for (const glm::vec3 candidate : {mesh.normals[i], sums[i], glm::vec3(0.0f, 1.0f, 0.0f)}) {
            const float length = glm::length(candidate);
            if (!(length > 0.0f) || !std::isfinite(length)) continue;
            mesh.normals[i] = candidate / length;
            break;
        }
    }
}

}  // namespace

std::span<const MeshImporter> meshImporters() { return mesh_importers; }

Mesh importMesh(const std::filesystem::path& path, Textures textures, const NamedFileCheck& check) {
    const MeshImporter& importer = importerFor(path);
    const engine::Step step("reads " + path.filename().string());
    engine::OpenFile file(path);  // gives the same error for all formats if it can't be opened
    try {
        Mesh mesh = importer.import(path, textures, orOwnFolder(check, path));
        checkMesh(mesh);
        completeNormals(mesh);
        return mesh;
    } catch (const engine::Error& error) {
        std::array<char, kRecognisedBytes> bytes{};
        const auto head =
            std::span(bytes).first(std::min<std::uintmax_t>(file.size(), bytes.size()));
        file.read(head);
        const std::string_view text(head.data(), head.size());
        // A mesh of FBX is read, strands are not.
        const OtherFile* const other = recognise(text, "");
        const bool is_fbx = other && other->name.starts_with("an FBX file");
        throw engine::Error(
            path.string(),
            is_fbx ? error.what() : explained(error.what(), text, lowerCaseExtension(path)));
    }
}

}  // namespace hair::groom
