#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/groom_files.h"
#include "tests/groom/formats/alembic_files.h"
#include "tests/python.h"
#include "tests/required.h"

// Heads and hair on them in files of several formats, for `hairbench groom scene`.

// Unit and up axis of a file: metres per unit, and whether z is up, with -y as the front.
struct FileLay {
    double metres = 1.0;
    bool z_up = false;
};

struct HeadPoint {
    double x, y, z;  // m, +y up, front +z
};

// Returns a point on an ellipsoid as wide, high and deep as a head, with three different axes.
inline HeadPoint onHead(double elevation, double azimuth, double factor = 1.0) {
    const double level = std::abs(elevation) < 1.57 ? std::cos(elevation) : 0.0;  // at the poles
    return {
        factor * 0.075 * level * std::sin(azimuth), factor * 0.115 * std::sin(elevation),
        factor * 0.095 * level * std::cos(azimuth)};
}

inline std::vector<double> inFile(const HeadPoint& p, const FileLay& lay) {
    if (lay.z_up) return {p.x / lay.metres, -p.z / lay.metres, p.y / lay.metres};
    return {p.x / lay.metres, p.y / lay.metres, p.z / lay.metres};
}

inline constexpr int kRings = 40;
inline constexpr int kAround = 80;

struct HeadMesh {
    std::vector<std::vector<double>> points;
    std::vector<std::array<int, 3>> faces;  // counter-clockwise seen from outside
};

// Returns the ellipsoid. Edges are at most 1 cm long, so flat faces are off by 0.2 mm. `open`
// leaves out the lowest rings.
inline HeadMesh headMesh(const FileLay& lay, bool open = false) {
    constexpr double kPi = std::numbers::pi;
    HeadMesh head;
    for (int i = 0; i <= kRings; ++i)
        for (int k = 0; k < kAround; ++k)
            head.points.push_back(
                inFile(onHead(kPi * (i / double{kRings} - 0.5), 2 * kPi * k / kAround), lay));
    for (int i = open ? 6 : 0; i < kRings; ++i)
        for (int k = 0; k < kAround; ++k) {
            const int a = i * kAround + k;
            const int b = i * kAround + (k + 1) % kAround;
            if (i > 0) head.faces.push_back({a, b, b + kAround});
            if (i + 1 < kRings) head.faces.push_back({a, b + kAround, a + kAround});
        }
    return head;
}

inline std::string headObj(const FileLay& lay, bool open = false) {
    const HeadMesh head = headMesh(lay, open);
    std::ostringstream text;
    text.precision(9);
    for (const auto& p : head.points) text << "v " << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
    for (const auto& f : head.faces)
        text << "f " << f[0] + 1 << ' ' << f[1] + 1 << ' ' << f[2] + 1 << '\n';
    return text.str();
}

// ---- The head in formats that state a unit, or hide meshes --------------------------------------

// Lists numbers with a comma between them, and rows in brackets.
template <class Rows>
std::string listedRows(const Rows& rows, const char* open, const char* close) {
    std::ostringstream text;
    text.precision(9);
    for (const auto& row : rows) {
        text << (text.tellp() == 0 ? "" : ", ") << open;
        for (std::size_t i = 0; i < 3; ++i) text << (i == 0 ? "" : ", ") << row[i];
        text << close;
    }
    return text.str();
}

inline std::string
usdMesh(const std::string& name, const HeadMesh& head, const std::string& more = "") {
    std::string counts = "3";
    for (std::size_t i = 1; i < head.faces.size(); ++i) counts += ", 3";
    return "def Mesh \"" + name + "\" {\n    int[] faceVertexCounts = [" + counts +
           "]\n    int[] faceVertexIndices = [" + listedRows(head.faces, "", "") +
           "]\n    point3f[] points = [" + listedRows(head.points, "(", ")") + "]\n" + more + "}\n";
}

inline std::string colladaMesh(const HeadMesh& head, const std::string& asset) {
    std::string numbers = listedRows(head.points, "", "");
    std::string indices = listedRows(head.faces, "", "");
    std::ranges::replace(numbers, ',', ' ');
    std::ranges::replace(indices, ',', ' ');
    const std::string count = std::to_string(head.points.size());
    return R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" )"
           R"(version="1.4.1"><asset>)" +
           asset +
           R"(</asset><library_geometries><geometry id="g"><mesh><source id="p">)"
           R"(<float_array id="a" count=")" +
           std::to_string(3 * head.points.size()) + "\">" + numbers +
           R"(</float_array><technique_common><accessor source="#a" count=")" + count +
           R"(" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>)"
           R"(<param name="Z" type="float"/></accessor></technique_common></source>)"
           R"(<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>)"
           R"(<triangles count=")" +
           std::to_string(head.faces.size()) +
           R"("><input semantic="VERTEX" source="#v" offset="0"/><p>)" + indices +
           R"(</p></triangles></mesh></geometry></library_geometries><library_visual_scenes>)"
           R"(<visual_scene id="s"><node><instance_geometry url="#g"/></node></visual_scene>)"
           R"(</library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

template <class Value>
void appendBytes(std::string& bytes, Value value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// A .gltf with the mesh at each of the nodes, and its buffer in head.bin.
inline std::string
gltfMesh(const HeadMesh& head, const std::string& nodes, const TemporaryFolder& folder) {
    std::string data;
    for (const auto& point : head.points)
        for (const double c : point) appendBytes(data, static_cast<float>(c));
    const std::size_t positions = data.size();
    for (const auto& face : head.faces)
        for (const int vertex : face) appendBytes(data, static_cast<std::uint32_t>(vertex));
    folder.write("head.bin", data);
    const auto number = [](std::size_t n) { return std::to_string(n); };
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],"nodes":[)" + nodes +
           R"(],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)"
           R"("accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":)" +
           number(head.points.size()) +
           R"(},{"bufferView":1,"componentType":5125,"type":"SCALAR","count":)" +
           number(3 * head.faces.size()) + R"(}],"bufferViews":[{"buffer":0,"byteLength":)" +
           number(positions) + R"(},{"buffer":0,"byteOffset":)" + number(positions) +
           R"(,"byteLength":)" + number(data.size() - positions) +
           R"(}],"buffers":[{"uri":"head.bin","byteLength":)" + number(data.size()) + "}]}";
}

// Alembic's corners are clockwise seen from outside. Hides the object if asked.
inline MadeObject alembicMesh(const std::string& name, const HeadMesh& head, bool is_hidden) {
    std::vector<float> points;
    for (const auto& point : head.points)
        for (const double c : point) points.push_back(static_cast<float>(c));
    std::vector<std::int32_t> corners;
    for (const auto& face : head.faces) corners.insert(corners.end(), face.rbegin(), face.rend());
    MadeObject object{
        .name = name,
        .metadata = "schema=AbcGeom_PolyMesh_v1",
        .properties = {madeCompound(
            ".geom", {madeFloats("P", 3, points),
                      madeIntegers(".faceCounts", std::vector<std::int32_t>(head.faces.size(), 3)),
                      madeIntegers(".faceIndices", corners)})}};
    if (is_hidden)
        object.properties.push_back(
            {.name = "visible", .kind = 1, .type = 2, .samples = {std::string(1, '\0')}});
    return object;
}

// Returns 480 strands that stand off the upper and hind part of the head, as long as its radius.
inline HairFile hairFileOnHead(const FileLay& lay, const HeadPoint& moved = {0, 0, 0}) {
    HairFile file{.thickness = static_cast<float>(80e-6 / lay.metres)};
    for (int ring = 0; ring < 12; ++ring)
        for (int k = 0; k < 40; ++k) {
            const double elevation = 0.2 + 0.1 * ring;
            // From one temple over the back of the head to the other.
            const double azimuth = std::numbers::pi * (1.0 + 1.4 * (k / 39.0 - 0.5));
            file.segments.push_back(5);
            for (int vertex = 0; vertex < 6; ++vertex) {
                const HeadPoint p = onHead(elevation, azimuth, 1.0 + 0.2 * vertex);
                for (const double c : inFile({p.x + moved.x, p.y + moved.y, p.z + moved.z}, lay))
                    file.points.push_back(static_cast<float>(c));
            }
        }
    return file;
}

inline std::string hairOnHead(const FileLay& lay, const HeadPoint& moved = {0, 0, 0}) {
    return hairFileOnHead(lay, moved).text();
}

class GroomSceneCli : public GroomCli {
protected:
    Outcome scene(const std::string& options = "") const {
        return hairbench(
            "groom scene " + quoted("mine.hair") + " -o " + quoted("mine.json") + " " + options);
    }
    Outcome sceneOnHead(const std::string& options = "") const {
        return scene("--head " + quoted("head.obj") + " " + options);
    }
    nlohmann::json written() const {
        return nlohmann::json::parse(textOf(folder_.file("mine.json")));
    }
    // Runs `groom scene` on a file of hair, and on head.obj if asked.
    Outcome sceneOf(const std::string& hair, const std::string& options = "") const {
        return hairbench(
            "groom scene " + quoted(hair) + " --force -o " + quoted("mine.json") + " " + options);
    }
    // Writes the strands in a format; of the options, --scale 1 makes a format that can do so state
    // metres. Returns the name of the file.
    std::string hairIn(
        const std::string& extension, const HairFile& hair, const std::string& options = "") const {
        folder_.write("file.hair", hair.text());
        const std::string name = "mine" + extension;
        const Outcome converted = convert("file.hair", name, options);
        EXPECT_EQ(converted.status, 0) << converted.output;
        return name;
    }
};

// Tests with a file of hair in each of several formats. Reading USD needs Python.
class GroomSceneFormats : public GroomSceneCli, public testing::WithParamInterface<const char*> {
protected:
    void SetUp() override {
        if (std::string_view(GetParam()).starts_with(".usd") && pythonInterpreter().empty())
            return skipWithout(Need::python, kNoPython);
    }
};

inline std::string nameOfFormat(const testing::TestParamInfo<const char*>& format) {
    return std::string(format.param).substr(1);
}
