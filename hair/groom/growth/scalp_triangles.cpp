#include "hair/groom/growth/scalp_triangles.h"

#include <algorithm>
#include <span>

#include "engine/error.h"

namespace hair {
namespace {

constexpr float kMember = 0.5f;          // weight from which a vertex belongs to its group
constexpr std::size_t kMostNames = 30;  // that an error lists

std::vector<std::string> materialNames(const Mesh& mesh) {
    std::vector<std::string> names;
    for (const Material& material : mesh.materials) names.push_back(material.name);
    return names;
}

std::vector<std::string> groupNames(const Mesh& mesh) {
    std::vector<std::string> names;
    for (const VertexGroup& group : mesh.vertex_groups) names.push_back(group.name);
    return names;
}

std::string list(const char* kind, const std::vector<std::string>& names) {
    std::string text = std::string("; ") + kind + ": ";
    if (names.empty()) return text + "none";
    for (std::size_t i = 0; i < std::min(names.size(), kMostNames); ++i)
        text += (i == 0 ? "'" : ", '") + names[i] + "'";
    if (names.size() > kMostNames)
        text += " and " + std::to_string(names.size() - kMostNames) + " more";
    return text;
}

// Triangles whose index names the name.
std::vector<std::uint32_t> withIndex(
    std::span<const std::uint32_t> indices, const std::vector<std::string>& names,
    const std::string& name) {
    std::vector<std::uint32_t> triangles;
    for (std::uint32_t i = 0; i < indices.size(); ++i) {
        if (names[indices[i]] == name) triangles.push_back(i);
    }
    return triangles;
}

std::vector<std::uint32_t> inGroup(const Mesh& mesh, const std::string& name) {
    std::vector<float> weights(mesh.positions.size(), 0.0f);
    for (const VertexGroup& group : mesh.vertex_groups) {
        if (group.name != name) continue;
        for (std::size_t i = 0; i < weights.size(); ++i)
            weights[i] = std::max(weights[i], group.weights[i]);
    }
    std::vector<std::uint32_t> triangles;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        if (std::ranges::all_of(
                mesh.triangles[i], [&](std::uint32_t v) { return weights[v] >= kMember; }))
            triangles.push_back(i);
    }
    return triangles;
}

}  // namespace

std::vector<std::uint32_t> scalpTriangles(const Mesh& mesh, const std::string& name) {
    std::vector<std::uint32_t> triangles;
    if (name == "*") {
        for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) triangles.push_back(i);
        if (triangles.empty()) throw engine::Error("the mesh has no triangles");
        return triangles;
    }
    const std::vector<std::string> materials = materialNames(mesh);
    const std::vector<std::string> groups = groupNames(mesh);
    const auto has = [&](const std::vector<std::string>& names) {
        return std::ranges::find(names, name) != names.end();
    };
    if (has(materials)) triangles = withIndex(mesh.triangle_materials, materials, name);
    if (triangles.empty() && has(mesh.parts))
        triangles = withIndex(mesh.triangle_parts, mesh.parts, name);
    if (triangles.empty() && has(groups)) triangles = inGroup(mesh, name);
    if (!triangles.empty()) return triangles;
    const bool known = has(materials) || has(mesh.parts) || has(groups);
    throw engine::Error(
        (known ? "no triangle belongs to '" : "nothing in the mesh is named '") + name + "'" +
        list("materials", materials) + list("parts", mesh.parts) + list("vertex groups", groups));
}

}  // namespace hair
