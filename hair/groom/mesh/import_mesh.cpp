#include "hair/groom/mesh/import_mesh.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "engine/error.h"
#include "engine/files.h"
#include "engine/pictures.h"
#include "engine/process.h"
#include "engine/run_tool.h"
#include "hair/groom/files.h"
#include "hair/groom/formats/ply.h"
#include "hair/groom/formats/usd_import.h"
#include "hair/groom/mesh/gltf_model.h"
#include "hair/groom/mesh/import_alembic.h"
#include "hair/groom/mesh/mesh.h"
#include "hair/groom/mesh/mesh_stream.h"
#include "hair/groom/other_formats.h"

namespace hair::groom {
namespace {

// ---- glTF's images ------------------------------------------------------------------------------

std::string_view bytesOfView(const tinygltf::Model& model, int index) {
    const tinygltf::BufferView& view = at(model.bufferViews, index, "buffer view");
    const tinygltf::Buffer& buffer = at(model.buffers, view.buffer, "buffer");
    const std::size_t available = buffer.data.size();
    if (view.byteOffset > available || view.byteLength > available - view.byteOffset)
        throw engine::Error(numbered("buffer view", index), "lies outside its buffer");
    return {reinterpret_cast<const char*>(buffer.data.data()) + view.byteOffset, view.byteLength};
}

// Decodes the data of a URI in base 64: RFC 2397.
std::string bytesOfDataUri(std::string_view uri) {
    constexpr std::string_view kMark = ";base64,";
    const std::size_t mark = uri.find(kMark);
    if (mark == std::string_view::npos) throw engine::Error("its data are not in base 64");
    std::optional<std::string> bytes = decodeBase64(uri.substr(mark + kMark.size()));
    if (!bytes) throw engine::Error("its base 64 is damaged");
    return *std::move(bytes);
}

// Decodes percent signs, "%20" to a space: RFC 3986, section 2.1.
std::string decodePercents(std::string_view uri) {
    std::string decoded;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        unsigned char byte = 0;
        const char* digits = uri.data() + i + 1;
        if (uri[i] == '%' && i + 2 < uri.size() &&
            std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2) {
            decoded += static_cast<char>(byte);
            i += 2;
        } else {
            decoded += uri[i];
        }
    }
    return decoded;
}

// Decodes image `index` of a model that was loaded with GltfImages::named: a PNG or JPEG in a
// buffer, in base 64, or in a file of `folder`. Throws engine::Error "image 2 'skin': reason".
engine::Pixels decodeGltfImage(
    const tinygltf::Model& model, int index, const std::filesystem::path& folder,
    const NamedFileCheck& check) {
    const tinygltf::Image& image = at(model.images, index, "image");
    const std::string name = image.name.empty() ? "" : " '" + image.name + "'";
    try {
        if (image.bufferView >= 0) return engine::decodeImage(bytesOfView(model, image.bufferView));
        if (image.uri.empty()) throw engine::Error("has neither a bufferView nor a uri");
        if (image.uri.starts_with("data:")) return engine::decodeImage(bytesOfDataUri(image.uri));
        const std::filesystem::path file = folder / decodePercents(image.uri);
        if (check) check(file);
        return engine::readImage(file);
    } catch (const engine::Error& error) {
        throw engine::Error(numbered("image", index) + name, error.what());
    }
}

// ---- glTF's materials ---------------------------------------------------------------------------

struct GltfMaterials {
    std::vector<Material> materials;  // the default one, then the file's
    std::vector<engine::Pixels> pictures;
};

constexpr std::size_t kMostPixels = std::size_t{1} << 27;

// Encodes glTF's linear factors as display RGB; IEC 61966-2-1.
float encodeSrgb(double linear) {
    return static_cast<float>(
        linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055);
}

float share(double value, const char* name) {
    if (value >= 0.0 && value <= 1.0) return static_cast<float>(value);
    throw engine::Error(name, "is outside [0, 1]");
}

Wrap toWrap(int mode) {
    switch (mode) {
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
        return Wrap::clamp;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
        return Wrap::mirror;
    default:
        return Wrap::repeat;
    }
}

class MaterialReader {
public:
    MaterialReader(
        const tinygltf::Model& model, Textures textures, const std::filesystem::path& folder,
        const NamedFileCheck& check)
        : model_(model), textures_(textures), folder_(folder), check_(check) {}

    Material read(const tinygltf::Material& source) {
        const tinygltf::PbrMetallicRoughness& surface = source.pbrMetallicRoughness;
        Material material{
            .name = source.name,
            .metallic = share(surface.metallicFactor, "metallicFactor"),
            .roughness = share(surface.roughnessFactor, "roughnessFactor"),
            .normal_scale = static_cast<float>(source.normalTexture.scale),
            .cutoff = {},
            .double_sided = source.doubleSided,
            .base_color_texture = texture(surface.baseColorTexture, "baseColorTexture"),
            .metallic_roughness_texture =
                texture(surface.metallicRoughnessTexture, "metallicRoughnessTexture"),
            .normal_texture = texture(source.normalTexture, "normalTexture")};
        const std::vector<double>& color = surface.baseColorFactor;
        if (color.size() >= 3)
            material.base_color = {
                encodeSrgb(color[0]), encodeSrgb(color[1]), encodeSrgb(color[2])};
        if (color.size() >= 4) material.opacity = share(color[3], "baseColorFactor");
        if (source.alphaMode == "MASK") material.cutoff = static_cast<float>(source.alphaCutoff);
        if (source.alphaMode == "BLEND") material.cutoff = 0.5f;
        return material;
    }

    std::vector<engine::Pixels> takePictures() { return std::move(pictures_); }

private:
    template <class Info>
    std::optional<MaterialTexture> texture(const Info& info, const char* name) {
        if (info.index < 0 || textures_ == Textures::skipped) return {};
        try {
            return textureOf(info);
        } catch (const engine::Error& error) {
            throw engine::Error(name, error.what());
        }
    }

    template <class Info>
    MaterialTexture textureOf(const Info& info) {
        if (info.texCoord != 0) {
            throw engine::Error(
                "TEXCOORD_" + std::to_string(info.texCoord) +
                " is not supported; only TEXCOORD_0 is");
        }
        if (info.extensions.contains("KHR_texture_transform"))
            throw engine::Error("KHR_texture_transform is not supported");
        const tinygltf::Texture& source = at(model_.textures, info.index, "texture");
        MaterialTexture texture{.picture = picture(source.source)};
        if (source.sampler >= 0) {
            const tinygltf::Sampler& sampler = at(model_.samplers, source.sampler, "sampler");
            texture.horizontal = toWrap(sampler.wrapS);
            texture.vertical = toWrap(sampler.wrapT);
            texture.is_smooth = sampler.magFilter != TINYGLTF_TEXTURE_FILTER_NEAREST;
        }
        return texture;
    }

    // Decodes each image once.
    std::uint32_t picture(int image) {
        const auto [known, is_new] =
            numbers_.try_emplace(image, static_cast<std::uint32_t>(pictures_.size()));
        if (!is_new) return known->second;
        const engine::Pixels& added =
            pictures_.emplace_back(decodeGltfImage(model_, image, folder_, check_));
        pixels_ += added.rgba.size() / 4;
        if (pixels_ > kMostPixels)
            throw engine::Error("the images have more than 2^27 pixels in all");
        return known->second;
    }

    const tinygltf::Model& model_;
    Textures textures_;
    const std::filesystem::path& folder_;
    const NamedFileCheck& check_;
    std::map<int, std::uint32_t> numbers_;  // [image], index into pictures_
    std::vector<engine::Pixels> pictures_;
    std::size_t pixels_ = 0;
};

// Reads materials of glTF 2.0, section 3.9: base colour, metallic, roughness, normals, alpha mode,
// double sided. Other parts and extensions of materials are ignored. BLEND is read as MASK at one
// half. Triangles without a material are matt grey. Textures, if read, must be on TEXCOORD_0
// without KHR_texture_transform. Throws engine::Error that names the material and the image.
GltfMaterials readMaterials(
    const tinygltf::Model& model, Textures textures, const std::filesystem::path& folder,
    const NamedFileCheck& check) {
    MaterialReader reader(model, textures, folder, check);
    std::vector<Material> materials{{.name = "default"}};
    for (std::size_t i = 0; i < model.materials.size(); ++i) {
        try {
            materials.push_back(reader.read(model.materials[i]));
        } catch (const engine::Error& error) {
            throw engine::Error("material " + std::to_string(i), error.what());
        }
    }
    return {std::move(materials), reader.takePictures()};
}

// ---- glTF ---------------------------------------------------------------------------------------

using Corners = std::array<std::size_t, 3>;  // positions in the list of indices

// The corners of triangle `i`: glTF 2.0, section 3.7.2.1.
Corners cornersOf(int mode, std::size_t i) {
    switch (mode) {
    case TINYGLTF_MODE_TRIANGLE_STRIP:
        return {i, i + 1 + i % 2, i + 2 - i % 2};
    case TINYGLTF_MODE_TRIANGLE_FAN:
        return {i + 1, i + 2, 0};
    default:
        return {3 * i, 3 * i + 1, 3 * i + 2};
    }
}

std::size_t triangleCount(int mode, std::size_t index_count) {
    if (mode != TINYGLTF_MODE_TRIANGLES) return index_count < 3 ? 0 : index_count - 2;
    if (index_count % 3 != 0) {
        throw engine::Error(std::to_string(index_count) + " indices are not whole triangles");
    }
    return index_count / 3;
}

// Returns the group's weights; none if the group is new.
std::vector<float>& weightsOf(Mesh& mesh, const std::string& name) {
    const auto group = std::ranges::find(mesh.vertex_groups, name, &VertexGroup::name);
    if (group != mesh.vertex_groups.end()) return group->weights;
    return mesh.vertex_groups.emplace_back(VertexGroup{name, {}}).weights;
}

std::string groupName(std::string_view attribute) {
    std::string name(attribute.substr(1));
    for (char& c : name)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return name;
}

bool isWeight(float number) { return number >= 0.0f && number <= 1.0f; }

class MeshReader {
public:
    explicit MeshReader(const tinygltf::Model& model) : model_(model) {}

    void add(const GltfPlace& place) {
        const tinygltf::Primitive& primitive = place.primitive;
        if (!hasTriangles(primitive)) return;
        if (place.is_hidden) {
            hidden_.insert(place.node);
            return;
        }
        const std::size_t first = mesh_.positions.size();
        const std::size_t count = addVertices(primitive, place.transform);
        addGroups(primitive, first, count);
        const bool mirrored = glm::determinant(glm::dmat3(place.transform)) < 0.0;
        addTriangles(primitive, static_cast<std::uint32_t>(first), count, mirrored);
        addPart(place);
    }

    Mesh take() {
        if (mesh_.triangles.empty() && !hidden_.empty())
            throw engine::Error("the file has only hidden meshes: show them, then export");
        const std::size_t vertices = mesh_.positions.size();
        if (has_texture_coordinates_) mesh_.texture_coordinates.resize(vertices, glm::vec2(0.0f));
        for (VertexGroup& group : mesh_.vertex_groups) group.weights.resize(vertices, 0.0f);
        std::erase_if(mesh_.vertex_groups, [](const VertexGroup& group) {
            return !std::ranges::all_of(group.weights, isWeight);
        });
        warnOfHidden(hidden_.size(), mesh_);
        return std::move(mesh_);
    }

private:
    // Returns the number of added vertices.
    std::size_t addVertices(const tinygltf::Primitive& primitive, const glm::dmat4& transform) {
        const std::vector<glm::vec3> positions = readPositions(model_, primitive);
        const std::size_t count = positions.size();
        const std::size_t first = mesh_.positions.size();
        if (count > std::numeric_limits<std::uint32_t>::max() - first) {
            throw engine::Error("the meshes have 2^32 vertices, or more");
        }
        std::vector<glm::vec3> normals(count, glm::vec3(0.0f));
        if (const auto normal = findAttribute(primitive, "NORMAL")) {
            normals = matching(readVectors(model_, *normal), count, "NORMAL");
        }
        const glm::dmat3 normal_transform = glm::transpose(glm::inverse(glm::dmat3(transform)));
        for (std::size_t i = 0; i < count; ++i) {
            mesh_.positions.emplace_back(transform * glm::dvec4(positions[i], 1.0));
            mesh_.normals.emplace_back(normal_transform * glm::dvec3(normals[i]));
        }
        if (const auto accessor = findAttribute(primitive, "TEXCOORD_0")) {
            const auto coordinates =
                matching(readTextureCoordinates(model_, *accessor), count, "TEXCOORD_0");
            // Earlier vertices without coordinates get 0.
            mesh_.texture_coordinates.resize(first, glm::vec2(0.0f));
            mesh_.texture_coordinates.insert(
                mesh_.texture_coordinates.end(), coordinates.begin(), coordinates.end());
            has_texture_coordinates_ = true;
        }
        return count;
    }

    void addGroups(const tinygltf::Primitive& primitive, std::size_t first, std::size_t count) {
        for (const auto& [name, index] : primitive.attributes) {
            if (!name.starts_with('_')) continue;
            const tinygltf::Accessor& accessor = at(model_.accessors, index, "accessor");
            if (accessor.type != TINYGLTF_TYPE_SCALAR ||
                accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT)
                continue;
            const auto added = matching(readScalars(model_, index), count, name.c_str());
            std::vector<float>& weights = weightsOf(mesh_, groupName(name));
            weights.resize(first, 0.0f);
            weights.insert(weights.end(), added.begin(), added.end());
        }
    }

    void addTriangles(
        const tinygltf::Primitive& primitive, std::uint32_t first, std::size_t vertex_count,
        bool mirrored) {
        const std::vector<std::uint32_t> indices = readIndices(model_, primitive, vertex_count);
        std::uint32_t material = 0;  // glTF's default material
        if (primitive.material >= 0) {
            at(model_.materials, primitive.material, "material");
            material = static_cast<std::uint32_t>(primitive.material) + 1;
        }
        const std::size_t count = triangleCount(primitive.mode, indices.size());
        for (std::size_t i = 0; i < count; ++i) {
            const auto [one, two, three] = cornersOf(primitive.mode, i);
            std::array corners{first + indices[one], first + indices[two], first + indices[three]};
            if (mirrored) std::swap(corners[1], corners[2]);
            mesh_.triangles.push_back(corners);
            mesh_.triangle_materials.push_back(material);
        }
    }

    void addPart(const GltfPlace& place) {
        if (mesh_.parts.empty() || place.node != part_node_) mesh_.parts.push_back(place.name);
        part_node_ = place.node;
        mesh_.triangle_parts.resize(
            mesh_.triangles.size(), static_cast<std::uint32_t>(mesh_.parts.size() - 1));
    }

    const tinygltf::Model& model_;
    Mesh mesh_;
    bool has_texture_coordinates_ = false;
    std::set<int> hidden_;  // nodes
    int part_node_ = -1;
};

// Reads glTF 2.0, .glb or .gltf, with the node transforms of the default scene applied. Reads
// triangle lists, strips and fans with POSITION, NORMAL, TEXCOORD_0 and indices. Reads materials'
// base colour, metallic, roughness, normal map, alpha mode and double sided. Parts are the nodes,
// with their own names or else those of their meshes. Vertex groups are the application's own
// attributes of float scalars from 0 to 1, `_SCALP` as "scalp". Other primitives are skipped, and
// meshes of hidden nodes (KHR_node_visibility) are counted in a warning; animation.h reads skins
// and animations. Refuses sparse accessors and required extensions that change the geometry.
Mesh importGltf(const std::filesystem::path& path, Textures textures, const NamedFileCheck& check) {
    engine::OpenFile file(path);
    std::vector<char> bytes(file.size());
    file.read(bytes);
    const tinygltf::Model model = loadGltf(
        std::as_bytes(std::span(bytes)), path,
        textures == Textures::decoded ? GltfImages::named : GltfImages::skipped,
        GltfMotion::skipped, check);
    MeshReader reader(model);
    forEachPrimitive(model, [&](const GltfPlace& place) { reader.add(place); });
    Mesh mesh = reader.take();
    mesh.is_placed = true;
    GltfMaterials materials = readMaterials(model, textures, path.parent_path(), check);
    mesh.materials = std::move(materials.materials);
    mesh.pictures = std::move(materials.pictures);
    return mesh;
}

// ---- Formats of assimp --------------------------------------------------------------------------

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

// ---- Meshes of any format -----------------------------------------------------------------------

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
