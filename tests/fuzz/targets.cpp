#include "tests/fuzz/targets.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <zlib.h>

#include "benchmarks/doctor/reports.h"
#include "benchmarks/report/compare.h"
#include "benchmarks/report/environment.h"
#include "benchmarks/report/exporters.h"
#include "benchmarks/report/page.h"
#include "benchmarks/report/report.h"
#include "benchmarks/run/record.h"
#include "benchmarks/run/run.h"
#include "benchmarks/scene/extensions.h"
#include "benchmarks/scene/scene.h"
#include "benchmarks/scene/settings_json.h"
#include "benchmarks/scene/sweep.h"
#include "engine/error.h"
#include "engine/float_pictures.h"
#include "engine/pictures.h"
#include "engine/png_text.h"
#include "engine/shaders.h"
#include "engine/spirv_judge.h"
#include "hair/extension.h"
#include "hair/groom/files.h"
#include "hair/groom/formats/ply.h"
#include "hair/groom/formats/usd_import.h"
#include "hair/groom/mesh/deforming_mesh.h"
#include "hair/groom/mesh/import_alembic.h"
#include "hair/groom/mesh/import_mesh.h"
#include "hair/groom/mesh/mesh_stream.h"
#include "tests/benchmarks/sample_report.h"
#include "tests/edited_document.h"
#include "tests/groom/formats/broken_promise.h"
#include "tests/temporary_folder.h"

namespace fuzz {
namespace {

namespace fs = std::filesystem;
namespace report = benchmarks::report;
namespace run = benchmarks::run;
namespace scene = benchmarks::scene;

// ---- Helpers ------------------------------------------------------------------------------------

void expect(bool holds, const std::string& promise) {
    if (!holds) throw std::logic_error("not so: " + promise);
}

// Calls an action that may refuse its input with an engine::Error.
template <class Action>
void allowRefusal(Action&& action) {
    try {
        action();
    } catch (const engine::Error&) {
    }
}

// Returns the folder for readers that take a path. It is in $TMPDIR, preferably in memory.
const TemporaryFolder& scratch() {
    static const TemporaryFolder folder;
    return folder;
}

// Splits a file into texts at record separators, as in RFC 7464 but without one before the first.
std::vector<std::string_view> textsIn(std::string_view bytes) {
    std::vector<std::string_view> texts;
    for (std::size_t begin = 0; begin <= bytes.size();) {
        const std::size_t end = std::min(bytes.find('\x1e', begin), bytes.size());
        texts.push_back(bytes.substr(begin, end - begin));
        begin = end + 1;
    }
    return texts;
}

std::span<const std::byte> asBytes(std::string_view bytes) {
    return std::as_bytes(std::span(bytes));
}

// Returns the project's folder, or the program's own folder if there is none on this machine.
fs::path projectFolder() {
    std::error_code error;
    if (const fs::path built = HAIRBENCH_SOURCE_DIR; fs::exists(built / "scenes", error))
        return built;
    return fs::read_symlink("/proc/self/exe", error).parent_path();
}

// ---- Strands ------------------------------------------------------------------------------------

void checkStrands(const hair::groom::StrandSet& set) {
    const std::string broken = hair::groom::brokenPromise(set);
    expect(broken.empty(), broken);
}

// Returns the importers that read from memory, each once: two formats may share an importer.
std::vector<const hair::groom::StrandImporter*> importers() {
    std::vector<const hair::groom::StrandImporter*> all;
    for (const hair::groom::StrandImporter& row : hair::groom::strandImporters())
        if (row.from_memory &&
            std::ranges::find(all, row.read, &hair::groom::StrandImporter::read) == all.end())
            all.push_back(&row);
    return all;
}

// Another reader of an extension has its name after "other_".
Target strandTarget(const hair::groom::StrandImporter& row) {
    const std::string_view extension = row.extensions.front();
    const auto all = importers();
    const auto first = std::ranges::find_if(all, [&](const hair::groom::StrandImporter* other) {
        return other->extensions.front() == extension;
    });
    const std::string name = (*first == &row ? "" : "other_") + std::string(extension.substr(1));
    return {
        .name = name,
        .read =
            [&row](std::string_view bytes) {
                checkStrands(hair::groom::usableStrands(row.read({.bytes = asBytes(bytes)})));
                if (row.read_samples) row.read_samples({.bytes = asBytes(bytes)});
            },
        .seeds = {{"tests/corpus/" + name, {}}}};
}

// Reads the output of usd_curves.py.
void readUsdStream(std::string_view bytes) {
    checkStrands(hair::groom::usableStrands(hair::groom::readUsdStream(asBytes(bytes))));
}

// ---- Meshes -------------------------------------------------------------------------------------

void checkMesh(const hair::groom::Mesh& mesh) {
    const std::size_t vertices = mesh.positions.size();
    for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t vertex : triangle)
            expect(vertex < vertices, "triangles name vertices");
    const std::size_t triangles = mesh.triangles.size();
    expect(mesh.triangle_materials.size() == triangles, "there is a material for each triangle");
    for (const std::uint32_t material : mesh.triangle_materials)
        expect(material < mesh.materials.size(), "triangles name materials");
    expect(
        mesh.triangle_parts.empty() || mesh.triangle_parts.size() == triangles,
        "there is a part for each triangle");
    expect(
        mesh.texture_coordinates.empty() || mesh.texture_coordinates.size() == vertices,
        "there is a texture coordinate for each vertex");
    expect(mesh.normals.size() == vertices, "there is a normal for each vertex");
    for (const hair::groom::VertexGroup& group : mesh.vertex_groups)
        expect(group.weights.size() == vertices, "there is a weight for each vertex");
    for (const glm::vec3& position : mesh.positions)
        expect(hair::groom::isFinite(position), "positions are finite");
    for (const glm::vec3& normal : mesh.normals)
        expect(std::abs(glm::length(normal) - 1.0f) < 1e-3f, "normals have unit length");
}

// A glTF mesh as scenes use it. It must not name another file.
struct GltfFile {
    fs::path path;
    hair::groom::Mesh mesh;
};

GltfFile readGltfFile(std::string_view bytes) {
    const fs::path path =
        scratch().write(bytes.starts_with("glTF") ? "mesh.glb" : "mesh.gltf", bytes);
    const auto refuse = [](const fs::path& file) {
        throw engine::Error(file.string(), "is another file");
    };
    return {path, hair::groom::importMesh(path, hair::groom::Textures::decoded, refuse)};
}

void readMesh(std::string_view bytes) { checkMesh(readGltfFile(bytes).mesh); }

// Reads the meshes of an Alembic archive as importMesh() does, before it checks their normals.
void readAlembicMeshFile(std::string_view bytes) {
    const hair::groom::Mesh mesh = hair::groom::readAlembicMesh(asBytes(bytes));
    for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t vertex : triangle)
            expect(vertex < mesh.positions.size(), "triangles name vertices");
    expect(mesh.normals.size() == mesh.positions.size(), "there is a normal for each vertex");
    expect(
        mesh.texture_coordinates.empty() ||
            mesh.texture_coordinates.size() == mesh.positions.size(),
        "there is a texture coordinate for each vertex");
    expect(
        mesh.triangle_materials.size() == mesh.triangles.size() &&
            mesh.triangle_parts.size() == mesh.triangles.size(),
        "triangles have materials and parts");
}

// Reads the skins, morph targets and keyframes of a glTF mesh.
void readAnimation(std::string_view bytes) {
    const GltfFile file = readGltfFile(bytes);
    const std::vector<std::string> clips = hair::groom::animationNames(file.path);
    if (clips.empty()) throw engine::Error("has no animation");
    hair::groom::MeshAnimation animation(file.path, clips.front());
    expect(
        animation.vertexCount() == file.mesh.positions.size(),
        "an animation has its mesh's vertices");
    const double duration = animation.duration();
    expect(std::isfinite(duration) && duration >= 0.0, "an animation has a duration");
    const hair::groom::DeformingMesh deforming(file.mesh, std::move(animation), {});
    const auto bindings = deforming.bind(std::span(file.mesh.positions).first(1));
    for (const double time : {-1.0, 0.0, 0.5 * duration, duration, 2.5 * duration}) {
        const std::vector<glm::dvec3> positions = deforming.positions(time);
        expect(positions.size() == file.mesh.positions.size(), "every vertex has a place");
        expect(deforming.normals(positions).size() == positions.size(), "vertices have normals");
        expect(deforming.motions(bindings, time).size() == 1, "what is bound moves");
    }
}

// Reads the output of the child process with assimp, or of usd_mesh.py. The output may come from a
// child that a file has taken over. Fuzzing assimp itself would only find the faults that are the
// reason for the child.
void readMeshStream(std::string_view bytes) {
    const hair::groom::ReadMesh read = hair::groom::readMeshStream(asBytes(bytes));
    const hair::groom::Mesh& mesh = read.mesh;
    for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t vertex : triangle)
            expect(vertex < mesh.positions.size(), "triangles name vertices");
    expect(mesh.normals.size() == mesh.positions.size(), "there is a normal for each vertex");
    expect(read.textures.size() == mesh.materials.size(), "materials have textures");
}

// Checks a PLY as the program does before assimp gets it.
void readPlyFaces(std::string_view bytes) { hair::groom::checkPlyFaces(asBytes(bytes)); }

// ---- Pictures -----------------------------------------------------------------------------------

std::uint32_t bigEndian(std::string_view bytes) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
    return value;
}

void putBigEndian(std::string& bytes, std::size_t at, std::uint32_t value) {
    for (std::size_t i = 0; i < 4; ++i)
        bytes[at + i] = static_cast<char>(value >> (24 - 8 * i) & 0xff);
}

// Returns the place of the deflated data's checksum and its correct value (RFC 1950), or nothing if
// the data have no end.
std::optional<std::pair<std::size_t, std::uint32_t>> adlerOf(std::string_view data) {
    constexpr std::size_t kHeader = 2;
    constexpr std::size_t kMost = std::size_t{16} << 20;
    if (data.size() < kHeader) return std::nullopt;
    z_stream stream{};
    if (inflateInit2(&stream, -MAX_WBITS) != Z_OK) return std::nullopt;
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(data.data() + kHeader));
    stream.avail_in = static_cast<uInt>(data.size() - kHeader);
    std::vector<Bytef> piece(1 << 16);
    uLong sum = adler32(0, nullptr, 0);
    int state = Z_OK;
    while (state == Z_OK && stream.total_out < kMost) {
        stream.next_out = piece.data();
        stream.avail_out = static_cast<uInt>(piece.size());
        state = inflate(&stream, Z_NO_FLUSH);
        sum = adler32(sum, piece.data(), static_cast<uInt>(piece.size()) - stream.avail_out);
    }
    const std::size_t end = kHeader + stream.total_in;
    inflateEnd(&stream);
    if (state != Z_STREAM_END) return std::nullopt;
    return std::pair{end, static_cast<std::uint32_t>(sum)};
}

// Returns the file, with correct checksums of chunks and data if it is a PNG. With wrong checksums,
// readers would refuse the file too early.
std::string withChecksums(std::string file) {
    constexpr std::size_t kSignature = 8;
    constexpr std::size_t kFrame = 12;  // bytes of a chunk without its data
    if (!engine::isPng(file)) return file;
    const std::string_view view = file;
    std::string data;
    std::vector<std::size_t> places;  // of the bytes of `data` in the file
    std::vector<std::pair<std::size_t, std::size_t>> chunks;  // start, and size of the data
    for (std::size_t at = kSignature; view.size() - at >= kFrame;) {
        const std::size_t size = bigEndian(view.substr(at));
        if (size > view.size() - at - kFrame) break;
        chunks.emplace_back(at, size);
        if (view.substr(at + 4, 4) == "IDAT")
            for (std::size_t i = 0; i < size; ++i) {
                places.push_back(at + 8 + i);
                data += view[at + 8 + i];
            }
        at += kFrame + size;
    }
    if (const auto adler = adlerOf(data)) {
        std::string sum(4, '\0');
        putBigEndian(sum, 0, adler->second);
        for (std::size_t i = 0; i < sum.size() && adler->first + i < places.size(); ++i)
            file[places[adler->first + i]] = sum[i];
    }
    for (const auto& [at, size] : chunks) {
        const auto* const begin = reinterpret_cast<const Bytef*>(file.data() + at + 4);
        putBigEndian(file, at + 8 + size, static_cast<std::uint32_t>(crc32_z(0, begin, size + 4)));
    }
    return file;
}

void readPicture(std::string_view bytes) {
    const std::string file = withChecksums(std::string(bytes));
    if (engine::isPng(file)) allowRefusal([&] { engine::pngText(file, scene::kSceneKeyword); });
    const engine::Pixels pixels = engine::decodeImage(file);
    expect(
        pixels.rgba.size() == std::size_t{4} * pixels.width * pixels.height,
        "a picture has its pixels");
}

void readFloatPicture(std::string_view bytes) {
    const engine::FloatPixels pixels = engine::decodeFloatImage(bytes);
    expect(
        pixels.rgb.size() == std::size_t{3} * pixels.width * pixels.height,
        "a picture has its pixels");
}

// ---- Scenes -------------------------------------------------------------------------------------

void copyScenes(const fs::path& from, const fs::path& to, const std::string& left_out = {}) {
    for (const auto& entry : fs::directory_iterator(from))
        if (entry.path().extension() == ".json" && entry.path().filename() != left_out)
            fs::copy(entry.path(), to);
}

// Returns a folder inside another one, both with the shipped scenes, because a scene's base may be
// beside the scene or above it.
const fs::path& sceneFolder() {
    static const fs::path folder = [] {
        const fs::path own = scratch().file("scenes/fuzzed");
        fs::create_directories(own);
        const fs::path shipped = projectFolder() / "scenes";
        copyScenes(shipped, own.parent_path());
        // scene.schema.json marks the topmost folder from which scenes may name files, so the inner
        // folder has none.
        copyScenes(shipped, own, "scene.schema.json");
        for (const char* inner : {"portraits", "truth"}) copyScenes(shipped / inner, own);
        return own;
    }();
    return folder;
}

// Returns the code of the shader that calls a scene's force. The program compiles it in a child
// with limits, which would make this slow.
engine::CompiledShader compiledForce(const hair::Extension& extension) {
    constexpr const char* kShader = "simulation/force.comp";
    static const engine::ShaderCompiler compiler;
    static const engine::ShaderSources sources = engine::shaderSources(engine::shaderCode(kShader));
    const auto read = [](const std::string& file) -> std::optional<std::string> {
        const auto found = sources.find(file);
        if (found == sources.end()) return std::nullopt;
        return found->second;
    };
    return compiler.compile(kShader, read, {extension.shader});
}

// Reads a GLSL file that a scene names, and compiles it with a shader that calls it.
void readExtension(std::string_view bytes) {
    using hair::ExtensionKind;
    for (const ExtensionKind kind :
         {ExtensionKind::shading, ExtensionKind::offset, ExtensionKind::force,
          ExtensionKind::solver, ExtensionKind::curve}) {
        const hair::Extension read = hair::parseExtension(kind, "fuzzed.glsl", std::string(bytes));
        for (const hair::ExtensionParameter& each : read.parameters)
            for (int i = 0; i < (each.is_vector ? 3 : 1); ++i)
                expect(
                    each.minimum <= double{each.original[i]} &&
                        double{each.original[i]} <= each.maximum,
                    "a parameter is in its range");
        if (kind != ExtensionKind::force) continue;
        const engine::CompiledShader compiled = compiledForce(read);
        if (!compiled.error)
            expect(
                engine::shaderBindings(compiled.code).empty(),
                "an extension has no buffer and no image");
    }
}

// Reads the SPIR-V of functions of scenes.
void readSpirv(std::string_view bytes) {
    std::vector<std::uint32_t> words(bytes.size() / sizeof(std::uint32_t));
    if (!words.empty())
        std::memcpy(words.data(), bytes.data(), words.size() * sizeof(std::uint32_t));
    const std::optional<engine::SpirvFault> fault = engine::judgeSpirv(words);
    if (fault) throw engine::Error(fault->text);
}

// A sweep may have 100,000 cases, which would take too long here.
constexpr std::size_t kMostCases = 64;

bool hasFewCases(const scene::Scene& scene) {
    std::size_t cases = 1;
    for (const scene::Axis& axis : scene.axes) {
        cases *= axis.values.size();
        if (cases > kMostCases) return false;
    }
    return true;
}

// Reads a scene, a suite or a screenshot with a scene in it, in a folder of scenes, and its cases.
void readScene(std::string_view bytes) {
    const fs::path path = sceneFolder() / "fuzzed.json";
    scratch().write("scenes/fuzzed/fuzzed.json", withChecksums(std::string(bytes)));
    for (const scene::Scene& read : scene::loadScenes(path)) {
        const scene::Document again(
            scene::writeSettings(scene::readSettings(read.resolved.json())));
        expect(again == read.resolved, "a resolved scene reads back as it is");
        if (!hasFewCases(read)) continue;
        for (const scene::CaseSpec& each : scene::expand(read)) {
            // Parameters of a file are completed by the file, which the document does not know.
            if (!scene::namedExtensions(read.settings).empty() ||
                !scene::namedExtensions(each.settings).empty())
                continue;
            scene::Json document = read.resolved.json();
            for (const scene::AxisValue& axis : each.axes)
                editDocument(document, axis.pointer, axis.value.json());
            expect(
                scene::Document(scene::writeSettings(scene::readSettings(document))) ==
                    scene::Document(scene::writeSettings(each.settings)),
                "a case's settings are its document's");
        }
    }
}

// ---- Reports ------------------------------------------------------------------------------------

bool isJson(std::string_view format) { return format != "csv" && format != "markdown"; }

// Calls everything that takes a valid report.
void useReport(const scene::Json& report) {
    for (const report::Exporter& exporter : report::exporters())
        allowRefusal([&] {
            const std::string text = report::exportReport(report, exporter.name);
            expect(text.ends_with('\n'), "a converted report ends with a newline");
            expect(
                !isJson(exporter.name) || scene::Json::accept(text),
                "what a report is converted to is JSON");
        });
    allowRefusal([&] { benchmarks::doctor::rulesText(benchmarks::doctor::judgeRules(report)); });
}

// Compares two reports.
void compareThem(const scene::Json& a, const scene::Json& b) {
    allowRefusal([&] {
        const report::ReportComparison comparison = report::compareReports(a, b, {});
        report::overallVerdict(comparison);
        report::comparisonJson(comparison, "a", "b").dump();
    });
}

// Reads a report, followed by the samples file beside it.
void readReport(std::string_view bytes) {
    const std::vector<std::string_view> texts = textsIn(bytes);
    const fs::path path = scratch().write("report.json", texts.front());
    std::error_code ignored;
    fs::remove(scratch().file("report.samples.jsonl"), ignored);
    if (texts.size() > 1) scratch().write("report.samples.jsonl", texts[1]);
    const scene::Json read = report::readReport(path);
    useReport(read);
    compareThem(read, read);
    allowRefusal([&] {
        const std::string page = report::scriptJson(report::pageData(std::array{path, path}));
        expect(page.find('<') == page.npos, "no report ends the page's script");
    });
}

// Merges the reports of a sweep's parts.
void mergeReports(std::string_view bytes) {
    constexpr std::size_t kMostParts = 4;
    std::vector<fs::path> paths;
    for (const std::string_view text : textsIn(bytes)) {
        if (paths.size() == kMostParts) break;
        paths.push_back(scratch().write("part" + std::to_string(paths.size()) + ".json", text));
    }
    const fs::path out = scratch().file("merged.json");
    std::vector<std::string> notes;
    allowRefusal([&] {
        const scene::Json merged = run::mergedReport(paths, {.out = out, .force = true}, notes);
        useReport(merged);
    });
    if (paths.size() > 1)
        allowRefusal(
            [&] { compareThem(report::readReport(paths[0]), report::readReport(paths[1])); });
    run::mergedReport(paths, {.out = out, .force = false}, notes);
}

// ---- Journals -----------------------------------------------------------------------------------

// Returns a run of four cases with the header of a made-up report.
const run::RunPlan& plan() {
    static const run::RunPlan made = [] {
        run::RunPlan plan{.name = "s", .scene = {}, .case_count = 8};
        plan.cases_hash = "0011223344556677";
        for (std::size_t i = 1; i < plan.case_count; i += 2)
            plan.cases.push_back(
                {.spec = {.name = "s/" + std::to_string(i)}, .directory = {}, .index = i});
        return plan;
    }();
    return made;
}

const report::ReportHeader& header() {
    static const report::ReportHeader made = [] {
        report::ReportHeader header = benchmarks::sampleReport();
        header.case_count = plan().case_count;
        header.shard = {.index = 2, .count = 2};
        return header;
    }();
    return made;
}

// Returns the journal with correct checksums of its lines. With wrong checksums the reader would
// stop there.
std::string withHashes(std::string_view journal) {
    constexpr std::string_view kStart = R"({"hash":")";
    constexpr std::string_view kMiddle = R"(","line":)";
    constexpr std::size_t kHash = 16;
    constexpr std::size_t kFrame = kStart.size() + kHash + kMiddle.size();
    std::string mended;
    for (std::size_t begin = 0; begin < journal.size();) {
        const std::size_t end = std::min(journal.find('\n', begin), journal.size());
        std::string line(journal.substr(begin, end - begin));
        if (line.starts_with(kStart) && line.size() > kFrame)
            line.replace(
                kStart.size(), kHash,
                report::hashText(std::string_view(line).substr(kFrame, line.size() - kFrame - 1)));
        mended += line + '\n';
        begin = end + 1;
    }
    return mended;
}

// Resumes a run from the journal, up to its report.
void resume(std::string_view journal) {
    const fs::path out = scratch().file("run.json");
    scratch().write(run::journalFile(out).filename().string(), journal);
    run::RunRecord record(plan(), header(), {.out = out, .filter = "", .resume = true});
    expect(
        record.done() + record.remaining().size() == plan().cases.size(),
        "every case is done or remains");
    for (const auto& [place, order] : record.remaining())
        record.add(
            {.name = plan().cases[place].spec.name,
             .index = plan().cases[place].index,
             .order = order});
    std::size_t cases = 0;
    record.eachCase([&](const scene::Json&) { ++cases; });
    expect(cases == plan().cases.size(), "a report has every case");
    record.write(run::RunEnd::complete);
    allowRefusal([&] { useReport(report::readReport(out)); });
}

void readJournal(std::string_view bytes) {
    allowRefusal([&] { resume(bytes); });
    resume(withHashes(bytes));
}

// ---- Table --------------------------------------------------------------------------------------

constexpr std::size_t kMostPixels = std::size_t{1} << 26;  // of any picture
constexpr std::size_t kMebibyte = std::size_t{1} << 20;

std::vector<Target> allTargets() {
    std::vector<Target> all;
    for (const hair::groom::StrandImporter* const row : importers())
        all.push_back(strandTarget(*row));
    const std::vector<std::string> gltf{".glb", ".gltf"};
    // JSON takes many bytes for little content.
    const Limits json{.length = 16384};
    // 16 kB of PNG can hold 128 megapixels of one bit. So the limit is the size of the largest
    // allowed picture, with four channels of 16 bits or three floats.
    const Limits picture{.length = 16384, .allocation = 8 * kMostPixels / kMebibyte};
    const Limits light{.length = 16384, .allocation = 12 * kMostPixels / kMebibyte};
    all.push_back({"usd_stream", readUsdStream, {{"tests/fuzz/seeds/usd_stream", {}}}});
    all.push_back(
        {"mesh",
         readMesh,
         {{"tests/corpus/gltf/trimesh_head_and_lines.glb", {}},
          {"tests/corpus/gltf/blender_draco.glb", {}},
          {"tests/fuzz/seeds/animation", {}},
          {"scenes/assets", gltf}},
         {.length = 16384}});
    all.push_back(
        {"animation",
         readAnimation,
         {{"tests/fuzz/seeds/animation", {}}, {"scenes/assets", gltf}},
         {.length = 16384}});
    all.push_back(
        {"ply_faces",
         readPlyFaces,
         {{"tests/corpus/ply", {}}, {"tests/fuzz/seeds/ply_faces", {}}}});
    all.push_back({"alembic_mesh", readAlembicMeshFile, {{"tests/fuzz/seeds/alembic_mesh", {}}}});
    all.push_back({"mesh_stream", readMeshStream, {{"tests/fuzz/seeds/mesh_stream", {}}}});
    all.push_back(
        {"picture",
         readPicture,
         {{"tests/fuzz/seeds/picture", {}},
          {"scenes/assets", {".png"}},
          {"tests/golden/pictures", {".png"}}},
         picture});
    all.push_back(
        {"float_picture",
         readFloatPicture,
         {{"tests/fuzz/seeds/float_picture", {}}, {"scenes/assets", {".exr", ".hdr"}}},
         light});
    all.push_back(
        {"scene",
         readScene,
         {{"scenes", {".json"}},
          {"scenes/papers", {".json"}},
          {"scenes/portraits", {".json"}},
          {"scenes/truth", {".json"}},
          {"tests/fuzz/seeds/scene", {}}}});
    // The program ends its compiler after 20 s of processor time; the sanitizers make it slower.
    all.push_back(
        {"extension",
         readExtension,
         {{"scenes/extended", {".glsl"}}, {"tests/fuzz/seeds/extension", {}}},
         {.seconds = 60}});
    all.push_back({"spirv", readSpirv, {{"tests/fuzz/seeds/spirv", {}}}});
    all.push_back({"report", readReport, {{"tests/fuzz/seeds/report", {}}}, json});
    all.push_back({"merge", mergeReports, {{"tests/fuzz/seeds/merge", {}}}, json});
    all.push_back({"journal", readJournal, {{"tests/fuzz/seeds/journal", {}}}, json});
    return all;
}

std::vector<fs::path> filesIn(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code ignored;
    if (fs::is_regular_file(folder, ignored)) return {folder};
    for (const auto& entry : fs::directory_iterator(folder, ignored))
        if (entry.is_regular_file()) files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

}  // namespace

std::span<const Target> targets() {
    static const std::vector<Target> all = allTargets();
    return all;
}

const Target& targetNamed(std::string_view name) {
    const auto found = std::ranges::find(targets(), name, &Target::name);
    if (found == targets().end()) throw std::out_of_range("no such target: " + std::string(name));
    return *found;
}

std::vector<fs::path> seedsOf(const Target& target) {
    std::vector<fs::path> files;
    for (const Seeds& seeds : target.seeds)
        for (const fs::path& file : filesIn(projectFolder() / seeds.folder)) {
            const bool is_wanted =
                seeds.extensions.empty() ||
                std::ranges::count(seeds.extensions, file.extension().string()) > 0;
            if (is_wanted && fs::file_size(file) <= target.limits.length) files.push_back(file);
        }
    return files;
}

std::vector<fs::path> findingsOf(const Target& target) {
    return filesIn(projectFolder() / "tests/corpus/findings" / target.name);
}

}  // namespace fuzz
