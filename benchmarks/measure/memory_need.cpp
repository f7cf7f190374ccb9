#include "benchmarks/measure/memory_need.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <system_error>
#include <utility>

#include "benchmarks/measure/hair_cache.h"
#include "benchmarks/report/text.h"
#include "engine/error.h"
#include "engine/frame_loop.h"
#include "hair/groom/build_groom.h"
#include "hair/groom/groom.h"
#include "hair/rendering/backends.h"
#include "hair/rendering/groom_buffers.h"
#include "hair/rendering/points_pass.h"
#include "hair/rendering/renderer.h"
#include "hair/rendering/scene_meshes.h"
#include "hair/rendering/strand_plan.h"
#include "hair/simulation/probes.h"
#include "hair/simulation/simulation.h"

namespace benchmarks::measure {
namespace {

namespace fs = std::filesystem;

// ---- What files hold ----------------------------------------------------------------------------

// Ratio of device memory to file size. Vertices and triangles take no more on a device than in a
// file; a picture in it, as PNG or JPEG, takes up to eight times as much.
constexpr std::uint64_t kMeshGrowth = 8;
// B per triangle while its distance field is baked: its part of the tree, its corners and normals.
constexpr std::uint64_t kBakedTriangle = 160;
// Ratio of decoded to stored size, for pictures of few colours.
constexpr std::uint64_t kPictureGrowth = 32;
constexpr std::uint64_t kEnvironmentGrowth = 16;

// Returns 0 if the file is missing; whoever reads it reports that.
std::uint64_t fileBytes(const fs::path& directory, const std::string& name) {
    if (name.empty()) return 0;
    const auto size = [](const fs::path& path) -> std::uint64_t {
        std::error_code none;
        const std::uintmax_t bytes = fs::file_size(path, none);
        return none ? 0 : bytes;
    };
    const fs::path path = directory / name;
    if (path.extension() != ".gltf") return size(path);
    return size(path) + size(fs::path(path).replace_extension(".bin"));
}

// The mesh that the hair grows on.
const std::string& grownOn(const hair::Settings& settings) {
    const hair::GroomSettings& groom = settings.groom;
    return groom.file.empty() ? groom.grow.mesh : groom.mesh;
}

// ---- The parts of a case ------------------------------------------------------------------------

// The driver's padding of small and of large images and buffers.
constexpr std::uint64_t kSmallBuffers = std::uint64_t{512} << 10;
constexpr double kPadding = 1.1;

// The program, its libraries and pipelines. A software device compiles shaders itself.
constexpr std::uint64_t kProgram = std::uint64_t{128} << 20;
constexpr std::uint64_t kSoftwareDevice = std::uint64_t{192} << 20;

// Host memory in B: the copies of a case and of the cache, their sources, and uploads.
constexpr std::uint64_t kHostVertex = 96;  // per guide vertex
constexpr std::uint64_t kHostBalancedVertex = 256;  // per vertex if its rest shape is balanced in
                                                    // double precision
constexpr std::uint64_t kHostStrand = 224;  // per strand bound to guides
constexpr std::uint64_t kHostPoint = 96;  // per point of such a strand
constexpr std::uint64_t kHostPixel = 32;  // per pixel of the picture
constexpr std::uint64_t kHostComparedPixel = 256;  // per pixel, in double precision, for FLIP
constexpr std::uint64_t kFileCopies = 3;  // text, values, strands

// The file that plays, if one does.
const std::string& cacheFile(const hair::GroomSettings& groom) {
    return groom.cache.file.empty() ? groom.file : groom.cache.file;
}

hair::groom::GroomSize groomSize(
    const hair::Settings& settings, const fs::path& directory, const hair::groom::Groom* known) {
    if (known) return sizeOf(*known);
    hair::groom::GroomSize size = hair::groom::expectedSize(
        settings.groom, fileBytes(directory, settings.groom.file),
        fileBytes(directory, cacheFile(settings.groom)));
    // Strands that follow only the head.
    if (!settings.groom.fixed.empty() && size.bound_strands > 0) {
        hair::GroomSettings fixed;
        fixed.file = settings.groom.fixed;
        const auto more =
            hair::groom::expectedSize(fixed, fileBytes(directory, settings.groom.fixed));
        size.bound_strands += more.bound_strands;
        size.bound_points += more.bound_points;
    }
    return size;
}

hair::rendering::StrandPlan planOf(
    const engine::Device& device, const hair::Settings& settings,
    const hair::groom::GroomSize& size) {
    std::uint32_t limit = device.info().limits.maxTessellationGenerationLevel;
    hair::StrandSettings strands = settings.strands;
    std::uint64_t triangles = size.root_triangles;
    if (strands.source == hair::StrandSource::groom) {
        strands.density = static_cast<std::uint32_t>(size.bound_strands);
        triangles = limit = 1;
    }
    return hair::rendering::planStrands(
        static_cast<std::uint32_t>(triangles),
        static_cast<std::uint32_t>(size.vertices_per_guide - 1), strands, settings.lod, limit);
}

// Bytes of the comparison pictures of /run/compare_backends: backends.cpp.
std::uint64_t comparedBytes(
    const engine::Device& device, hair::Settings settings, const hair::rendering::StrandPlan& plan,
    const hair::groom::GroomSize& size) {
    using hair::rendering::Renderer;
    settings.strands.backend = hair::Backend::tessellation;
    settings.render.msaa = 4;
    settings.render.ssaa = 4;
    const std::uint64_t covered = Renderer::rows(device, settings, plan, size).bytes();
    settings.render.msaa = 1;
    settings.render.ssaa = 8;
    return std::max(covered, Renderer::rows(device, settings, plan, size).bytes());
}

// The largest buffer that is uploaded at a time, or picture that is downloaded.
std::uint64_t stagingBytes(const engine::MemoryRows& rows, const hair::RenderSettings& render) {
    std::uint64_t most = sizeof(std::uint32_t) * render.width * render.height;
    for (const auto& [row, purpose] : rows.all())
        if (purpose == "groom" || purpose == "simulation" || purpose == "meshes" ||
            purpose == "textures")
            most = std::max<std::uint64_t>(most, row.size);
    return most;
}

}  // namespace

CaseMemory caseMemory(
    const engine::Device& device, const hair::Settings& settings, const fs::path& directory,
    HairCache* cache) {
    using namespace hair::rendering;
    using namespace hair::simulation;
    const hair::groom::Groom* groom =
        cache ? cache->assets().knownGroom(settings, directory) : nullptr;
    const std::optional<hair::groom::Mesh>* read =
        cache ? cache->assets().knownMesh(settings, directory) : nullptr;
    const hair::groom::Mesh* mesh = read && *read ? &**read : nullptr;
    const hair::groom::GroomSize size = groomSize(settings, directory, groom);
    const StrandPlan plan = planOf(device, settings, size);
    hair::Settings drawn = settings;
    if (settings.render.hair)
        drawn.strands.backend = chooseBackend(device, settings, plan, {}).backend;

    const std::uint64_t mesh_file = fileBytes(directory, grownOn(settings));
    CaseMemory memory;
    engine::MemoryRows& rows = memory.rows;
    for (std::uint32_t i = 0; i < motions(settings.copies); ++i) {
        rows.add(Simulation::rows(device.info(), size, settings.simulation));
        if (settings.run.interpolate) rows.add(GuideInterpolation::rows(size.vertices()));
    }
    rows.add(GroomBuffers::rows(settings, size));
    rows.add(Renderer::rows(device, drawn, plan, size));
    // A vertex takes at least its position in a file.
    if (!settings.simulation.animation.clip.empty())
        rows.add(SkinnedHead::rows(
            mesh ? mesh->positions.size() : mesh_file / sizeof(glm::vec3), plan.strands(),
            settings.render));
    if (settings.render.head && mesh) {
        rows.add(MeshGeometry::rows(settings, *mesh, MeshGeometry::Scattering::skin));
        rows.add(MeshMaterials::rows(*mesh));
    }

    const std::uint64_t head = settings.render.head && !read ? kMeshGrowth * mesh_file : 0;
    std::uint64_t assets = head + kPictureGrowth * fileBytes(directory, settings.strands.texture) +
                           kEnvironmentGrowth * fileBytes(directory, settings.render.environment);
    for (const hair::MeshSettings& each : settings.render.meshes)
        assets += kMeshGrowth * fileBytes(directory, each.file);
    const std::uint64_t fields = Bodies::rows(settings.simulation).bytes();
    std::uint64_t baking = 0;  // the largest, since fields are baked one after another
    for (const hair::DistanceFieldSettings& each : settings.simulation.distance_fields) {
        const bool is_known = mesh && (each.mesh.empty() || each.mesh == grownOn(settings));
        baking = std::max(
            baking, is_known ? kBakedTriangle * mesh->triangles.size()
                             : kMeshGrowth * (each.mesh.empty() ? mesh_file
                                                                : fileBytes(directory, each.mesh)));
    }

    std::uint64_t all = rows.bytes() + assets;
    if (settings.run.compare_backends) all += comparedBytes(device, drawn, plan, size);
    if (hasProbes(settings.run.probes))
        all += Probes::rows(
                   size, settings.simulation.solver, settings.run.probes,
                   settings.run.warmup + settings.run.frames + 2)
                   .bytes();
    // Fields are baked before anything else is allocated.
    all = std::max(all + std::max(stagingBytes(rows, settings.render), head), fields + baking);
    report::MemoryNeed& need = memory.need;
    need.device = kSmallBuffers + static_cast<std::uint64_t>(kPadding * static_cast<double>(all));

    const bool balanced = settings.simulation.rest == hair::RestShape::balanced;
    const std::uint64_t pixel = settings.run.compare_backends || !settings.run.reference.empty()
                                    ? kHostComparedPixel
                                    : kHostPixel;
    need.host = kProgram + (device.info().type == engine::DeviceType::cpu ? kSoftwareDevice : 0) +
                size.vertices() * (balanced ? kHostBalancedVertex : kHostVertex) +
                size.bound_strands * kHostStrand + size.bound_points * kHostPoint +
                pixel * settings.render.width * settings.render.height + 2 * fields +
                kFileCopies * (assets + baking + fileBytes(directory, settings.groom.file));
    return memory;
}

// ---- How much there is --------------------------------------------------------------------------

namespace {

// Absent if the file is missing or holds no number, as for "max".
std::optional<std::uint64_t> numberIn(const fs::path& path) {
    std::ifstream file(path);
    std::uint64_t number = 0;
    if (!(file >> number)) return std::nullopt;
    return number;
}

// Returns the value after a key, from a file of lines "key value ...".
std::optional<std::uint64_t> valueIn(const fs::path& path, const std::string& key) {
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string name;
        std::uint64_t value = 0;
        if (words >> name >> value && name == key) return value;
    }
    return std::nullopt;
}

// Version 1 uses 2^63 rounded to pages for no limit.
constexpr std::uint64_t kNoLimit = std::uint64_t{1} << 62;

// File names of one version of control groups.
struct GroupFiles {
    const char* limit;
    const char* use;
    const char* reclaimable;  // in memory.stat: pages of files that can be read again
};
constexpr GroupFiles kVersion1{
    "memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file"};
constexpr GroupFiles kVersion2{"memory.max", "memory.current", "inactive_file"};

// The least memory left by a group and its ancestors. Inside a container, the process's outer path
// does not exist, and its own group is the root.
std::optional<std::uint64_t>
leastLeft(const fs::path& mount, const std::string& group, const GroupFiles& files) {
    std::optional<std::uint64_t> least;
    fs::path below = fs::path(group).relative_path();
    while (true) {
        const fs::path folder = mount / below;
        const auto limit = numberIn(folder / files.limit);
        if (limit && *limit < kNoLimit) {
            const std::uint64_t use = numberIn(folder / files.use).value_or(0);
            const std::uint64_t again =
                valueIn(folder / "memory.stat", files.reclaimable).value_or(0);
            const std::uint64_t held = use - std::min(use, again);
            const std::uint64_t left = *limit - std::min(*limit, held);
            least = std::min(left, least.value_or(left));
        }
        if (below.empty()) return least;
        below = below.parent_path();
    }
}

}  // namespace

std::optional<std::uint64_t> freeInControlGroup(const fs::path& root) {
    const fs::path mounts = root / "sys/fs/cgroup";
    std::optional<std::uint64_t> least;
    std::ifstream groups(root / "proc/self/cgroup");
    // "4:memory:/path", or "0::/path" for version 2.
    for (std::string line; std::getline(groups, line);) {
        const std::size_t first = line.find(':');
        const std::size_t second = line.find(':', first + 1);
        if (first == std::string::npos || second == std::string::npos) continue;
        const std::string controllers = line.substr(first + 1, second - first - 1);
        const std::string group = line.substr(second + 1);
        std::optional<std::uint64_t> left;
        if (controllers.empty())
            left = leastLeft(mounts, group, kVersion2);
        else if ((',' + controllers + ',').find(",memory,") != std::string::npos)
            left = leastLeft(mounts / "memory", group, kVersion1);
        if (left) least = std::min(*left, least.value_or(*left));
    }
    return least;
}

std::optional<std::uint64_t> availableMemory(const fs::path& root) {
    const auto kibibytes = valueIn(root / "proc/meminfo", "MemAvailable:");
    if (!kibibytes) return std::nullopt;
    return *kibibytes * 1024;
}

std::vector<MemoryRoom>
memoryRooms(const engine::Device& device, std::optional<std::uint64_t> most) {
    using Of = MemoryRoom::Of;
    std::vector<MemoryRoom> rooms;
    const bool is_host = device.info().type == engine::DeviceType::cpu;
    if (most) {
        if (is_host) {
            rooms.push_back({Of::both, *most, "--max-memory"});
        } else {
            rooms.push_back({Of::device, *most, "--max-memory"});
            rooms.push_back({Of::host, *most, "--max-memory"});
        }
    }
    rooms.push_back({Of::device, device.freeBytes(), "the device's budget"});
    const Of of = is_host ? Of::both : Of::host;
    if (const auto left = freeInControlGroup())
        rooms.push_back({of, *left, "the control group's limit"});
    if (const auto available = availableMemory())
        rooms.push_back({of, *available, "available memory of the host"});
    return rooms;
}

std::string whyItDoesNotFit(const report::MemoryNeed& need, const std::vector<MemoryRoom>& rooms) {
    for (const MemoryRoom& room : rooms) {
        using Of = MemoryRoom::Of;
        const std::uint64_t needed =
            (room.of == Of::host ? 0 : need.device) + (room.of == Of::device ? 0 : need.host);
        if (needed <= room.bytes) continue;
        const char* const what = room.of == Of::device ? "device memory"
                                 : room.of == Of::host ? "the host's memory"
                                                       : "memory";
        return "needs about " + report::sizeText(needed) + " of " + what + "; " +
               report::sizeText(room.bytes) + " are free (" + room.source + ')';
    }
    return {};
}

std::uint64_t parseMemorySize(const std::string& text) {
    const auto refuse = [&]() -> std::uint64_t {
        throw engine::Error("'" + text.substr(0, 40) + "' is not a size, as in 500M or 2G");
    };
    double number = 0.0;
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, number, std::chars_format::fixed);
    if (error != std::errc() || !(number > 0.0)) return refuse();
    std::string unit(rest, end);
    std::ranges::transform(
        unit, unit.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    double factor = 1.0;
    if (!unit.empty() && unit != "B") {
        constexpr std::string_view kPrefixes = "KMGT";
        const std::size_t power = kPrefixes.find(unit.front());
        const std::string suffix = unit.substr(1);
        if (power == std::string_view::npos || (!suffix.empty() && suffix != "B" && suffix != "IB"))
            return refuse();
        factor = std::pow(suffix == "B" ? 1000.0 : 1024.0, static_cast<double>(power + 1));
    }
    const double bytes = number * factor;
    if (!(bytes >= 1.0) || bytes >= 0x1p63) return refuse();
    return static_cast<std::uint64_t>(bytes);
}

}  // namespace benchmarks::measure
