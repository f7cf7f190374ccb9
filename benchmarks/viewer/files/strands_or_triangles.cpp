#include "benchmarks/viewer/files/strands_or_triangles.h"

#include <fstream>
#include <string>

#include <nlohmann/json.hpp>

#include "benchmarks/json_fwd.h"
#include "engine/error.h"
#include "engine/read_file.h"
#include "hair/groom/file_extension.h"
#include "hair/groom/formats/ply_header.h"
#include "hair/groom/mesh/glb_file.h"

namespace benchmarks {

namespace {

Holds inObj(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    bool lines = false;
    for (std::string line; std::getline(file, line);) {
        const std::size_t first = line.find_first_not_of(" \t");
        if (first == std::string::npos || first + 1 >= line.size()) continue;
        if (line[first + 1] != ' ' && line[first + 1] != '\t') continue;  // "vn", "fo"
        if (line[first] == 'f') return Holds::triangles;
        lines = lines || line[first] == 'l';
    }
    return lines ? Holds::strands : Holds::triangles;
}

Holds inPly(const std::filesystem::path& path) {
    constexpr std::streamsize kLongestHeader = 1 << 20;  // bytes
    std::string head(kLongestHeader, '\0');
    std::ifstream file(path, std::ios::binary);
    file.read(head.data(), kLongestHeader);
    head.resize(static_cast<std::size_t>(file.gcount()));
    const hair::PlyHeader header = hair::readPlyHeader(head);
    for (const char* name : {"strand", "polyline", "line"})
        if (header.find(name)) return Holds::strands;
    const hair::PlyElement* const faces = header.find("face");
    const bool has_faces = faces && faces->count > 0;
    return header.find("edge") && !has_faces ? Holds::strands : Holds::triangles;
}

Holds inGltf(const std::filesystem::path& path) {
    constexpr int kFirstOfTriangles = 4;  // glTF 2.0, mesh.primitive.mode: 0 to 3 points and lines
    const std::string file = engine::readFile(path);
    const Json document = Json::parse(
        hair::isGlb(file) ? hair::glbChunks(file).json : std::string_view(file), nullptr, false);
    bool lines = false;
    for (const Json& mesh : document.value("meshes", Json::array()))
        for (const Json& primitive : mesh.value("primitives", Json::array())) {
            if (primitive.value("mode", kFirstOfTriangles) >= kFirstOfTriangles)
                return Holds::triangles;
            lines = true;
        }
    return lines ? Holds::strands : Holds::triangles;
}

}  // namespace

Holds strandsOrTriangles(const std::filesystem::path& file) {
    const std::string extension = hair::lowerCaseExtension(file);
    try {
        if (extension == ".obj") return inObj(file);
        if (extension == ".ply") return inPly(file);
        return inGltf(file);
    } catch (const engine::Error&) {
        return Holds::triangles;
    } catch (const Json::exception&) {  // JSON, but no glTF
        return Holds::triangles;
    }
}

}  // namespace benchmarks
