#include "hair/groom/formats/usd_import.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <system_error>
#include <utility>

#include "engine/error.h"
#include "engine/files.h"
#include "engine/run_tool.h"
#include "hair/groom/formats/binary_file.h"
#include "hair/groom/mesh/mesh_stream.h"

namespace hair::groom {
namespace {

// ---- The stream of curves -----------------------------------------------------------------------

struct Section {
    std::uint64_t UsdStreamHeader::* count;
    std::uint64_t size;  // bytes of an element
};

constexpr Section kSections[] = {
    {&UsdStreamHeader::strands, sizeof(std::uint32_t)},
    {&UsdStreamHeader::points, sizeof(glm::vec3)},
    {&UsdStreamHeader::widths, sizeof(float)},
    {&UsdStreamHeader::transparencies, sizeof(float)},
    {&UsdStreamHeader::colors, sizeof(glm::vec3)},
    {&UsdStreamHeader::root_uvs, sizeof(glm::vec2)},
    {&UsdStreamHeader::root_triangles, sizeof(std::array<std::uint32_t, 3>)},
    {&UsdStreamHeader::groups, sizeof(std::int32_t)},
    {&UsdStreamHeader::guides, 1},
    {&UsdStreamHeader::comment, 1},
    {&UsdStreamHeader::warnings, 1},
};

UsdStreamHeader readHeader(std::span<const std::byte> bytes) {
    if (bytes.size() < sizeof(UsdStreamHeader)) {
        failAt(bytes.size(), "truncated: the header is 112 bytes");
    }
    const auto header = valueAt<UsdStreamHeader>(bytes, 0);
    if (header.magic != UsdStreamHeader::kMagic) failAt(0, "no \"HBCURVES\"");
    if (!std::isfinite(header.metres_per_unit) || header.metres_per_unit <= 0.0) {
        failAt(8, "the unit is " + std::to_string(header.metres_per_unit) + " m");
    }
    if (header.stated > 3) failAt(104, "unknown bits of what is stated");
    std::uint64_t size = sizeof header;
    for (std::size_t i = 0; i < std::size(kSections); ++i) {
        const std::uint64_t count = header.*kSections[i].count;
        // The count is at most the size of the file, so that the sum doesn't overflow.
        if (count <= bytes.size()) size += count * kSections[i].size;
        if (count > bytes.size() || size > bytes.size()) {
            failAt(
                16 + 8 * i, "a count of " + std::to_string(count) + " in " +
                                std::to_string(bytes.size()) + " bytes");
        }
    }
    if (size != bytes.size()) failAt(size, "trailing bytes");
    if (header.points > std::numeric_limits<std::uint32_t>::max()) failAt(24, "too many points");
    return header;
}

// Takes sections in their order.
class Sections {
public:
    Sections(std::span<const std::byte> bytes, const UsdStreamHeader& header)
        : bytes_(bytes), header_(header) {}

    template <class Element>
    std::vector<Element> take() {
        const Section& section = kSections[next_++];
        start_ = end_;
        const std::uint64_t count = header_.*section.count;
        end_ += count * section.size;
        return arrayAt<Element>(bytes_, start_, count);
    }
    template <class Value>
    PointAttribute<Value> takeAttribute() {
        const std::uint64_t byte = 16 + 8 * next_;
        auto values = take<Value>();
        if (values.size() == 1) return {.everywhere = values.front(), .values = {}};
        if (!values.empty() && values.size() != header_.points) {
            failAt(byte, "a value for some of the points");
        }
        return {.everywhere = {}, .values = std::move(values)};
    }
    std::string takeText() {
        const auto bytes = take<char>();
        return {bytes.begin(), bytes.end()};
    }
    std::uint64_t start() const { return start_; }  // of the section that was taken last

private:
    std::span<const std::byte> bytes_;
    const UsdStreamHeader& header_;
    std::size_t next_ = 0;
    std::uint64_t start_ = 0;
    std::uint64_t end_ = sizeof(UsdStreamHeader);
};

std::vector<std::uint32_t> endsOf(std::vector<std::uint32_t> sizes, std::uint64_t points) {
    std::uint64_t end = 0;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        end += sizes[i];
        if (end > points) {
            failAt(sizeof(UsdStreamHeader) + 4 * i, std::to_string(sizes[i]) + " points");
        }
        sizes[i] = static_cast<std::uint32_t>(end);
    }
    if (end != points) failAt(24, "more points than the strands have");
    return sizes;
}

void requireStrands(
    const std::vector<std::array<std::uint32_t, 3>>& triangles, std::uint64_t strands,
    std::uint64_t offset) {
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        for (const std::uint32_t strand : triangles[i])
            if (strand >= strands) failAt(offset + 12 * i, "strand " + std::to_string(strand));
    }
}

std::vector<std::string> linesOf(const std::string& text) {
    std::vector<std::string> lines;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        lines.push_back(text.substr(at, end - at));
        at = end + 1;
    }
    return lines;
}

// ---- The tools ----------------------------------------------------------------------------------

enum class Samples { none, all };  // over time

// Returns limits for a stage of `size` bytes. Importing USD's libraries takes a second, and a few
// megabytes of a text stage take another. With samples over time a small file can mean much work,
// because a skeleton moves every vertex.
engine::ChildLimits limitsFor(std::uintmax_t size, Samples samples) {
    const bool is_one = samples == Samples::none;
    return {
        .seconds = static_cast<unsigned>((is_one ? 20 : 120) + size / (is_one ? 500'000 : 100'000)),
        .bytes = (std::size_t{is_one ? 4u : 8u} << 30) + 64 * size,
        .output = is_one ? (std::size_t{64} << 20) + 64 * size : std::size_t{3} << 30};
}

// Returns the folders with the interpreter's libraries: its environment and the installation that
// the environment was made from.
std::vector<std::filesystem::path> librariesOf(const std::filesystem::path& interpreter) {
    std::error_code error;
    std::vector<std::filesystem::path> all{interpreter.parent_path().parent_path()};
    const auto real = std::filesystem::canonical(interpreter, error);
    if (!error && real.parent_path().has_relative_path())
        all.push_back(real.parent_path().parent_path());
    if (const char* home = std::getenv("HOME"); home && *home)
        all.push_back(std::filesystem::path(home) / ".local/lib");
    std::erase_if(all, [](const auto& each) { return !each.has_relative_path(); });
    return all;
}

engine::Error missingEnvironment(const std::string& what, const std::string& reason) {
    return engine::Error(
        what + " needs the project's Python environment: run " +
        engine::makesPythonEnvironment("python") + " (" + reason + ')');
}

}  // namespace

void requireScripts(const std::string& what) {
    const std::filesystem::path python = engine::pythonInterpreter("python", "HAIRBENCH_PYTHON");
    // A name without a folder is looked for when it is run.
    if (python.has_parent_path() && !std::filesystem::exists(python))
        throw missingEnvironment(what, "there is no " + python.string());
}

std::vector<std::byte> runScript(
    const FormatScript& tool, const std::vector<std::string>& arguments,
    engine::ChildLimits limits) {
    // -B writes no byte code beside the tool, -E ignores environment variables of Python.
    const std::string python = engine::pythonInterpreter("python", "HAIRBENCH_PYTHON");
    const std::filesystem::path script = engine::programFile("hair/groom/formats/" + tool.script);
    std::vector<std::string> command{python, "-B", "-E", script.string()};
    command.insert(command.end(), arguments.begin(), arguments.end());
#ifdef HAIRBENCH_SANITIZE
    limits.bytes = 0;
#endif
    if (limits.reads) {
        std::ranges::move(librariesOf(python), std::back_inserter(*limits.reads));
        limits.reads->push_back(script.parent_path());
    }
    try {
        return engine::runTool(command, limits);
    } catch (const std::system_error& error) {
        if (error.code() != std::errc::no_such_file_or_directory)
            throw engine::Error(
                "the program for " + tool.what + " can't be started: " + error.code().message());
        throw missingEnvironment(tool.what, error.what());
    } catch (const engine::Error& error) {
        const std::string reason = error.what();
        if (!reason.starts_with(python)) throw;
        throw engine::Error(
            tool.library + ", the library for " + tool.what + ',' + reason.substr(python.size()));
    }
}

namespace {

// Runs usd_curves.py or usd_mesh.py on the file, and returns its output, read by `parse`.
template <class Parse>
auto readStage(
    const std::string& tool, Samples samples, const std::filesystem::path& path,
    const NamedFileCheck& check, const Parse& parse) {
    std::vector<std::string> arguments;
    if (samples == Samples::all) arguments.emplace_back("--samples");
    for (const std::filesystem::path& folder : check.folders())
        arguments.push_back("--below=" + folder.string());
    // An absolute path can't be taken for an option.
    arguments.push_back(std::filesystem::absolute(path).string());
    std::error_code unknown;
    const std::uintmax_t size = std::filesystem::file_size(path, unknown);
    engine::ChildLimits limits = limitsFor(unknown ? 0 : size, samples);
    limits.reads = readsOf(check);
    const std::vector<std::byte> bytes =
        runScript({.script = tool, .what = "USD", .library = "usd-core"}, arguments, limits);
    try {
        return parse(std::span<const std::byte>(bytes));
    } catch (const engine::Error& error) {
        throw engine::Error("the output of " + tool, error.what());
    }
}

}  // namespace

StrandSet readUsdStream(std::span<const std::byte> bytes) {
    const UsdStreamHeader header = readHeader(bytes);
    Sections sections(bytes, header);
    StrandSet set;
    if (header.stated & 1) set.metres_per_unit = header.metres_per_unit;
    if (header.stated & 2) set.up = 1;
    set.ends = endsOf(sections.take<std::uint32_t>(), header.points);
    set.points = sections.take<glm::vec3>();
    set.widths = sections.takeAttribute<float>();
    set.transparencies = sections.takeAttribute<float>();
    set.colors = sections.takeAttribute<glm::vec3>();
    set.root_uvs = sections.take<glm::vec2>();
    if (!set.root_uvs.empty() && set.root_uvs.size() != set.ends.size()) {
        failAt(offsetof(UsdStreamHeader, root_uvs), "root uvs for some of the strands");
    }
    set.root_triangles = sections.take<std::array<std::uint32_t, 3>>();
    requireStrands(set.root_triangles, header.strands, sections.start());
    const auto expectEach = [&](std::size_t count, std::uint64_t byte, const char* what) {
        if (count != 0 && count != set.ends.size())
            failAt(byte, std::string(what) + " for some of the strands");
    };
    set.groups = sections.take<std::int32_t>();
    expectEach(set.groups.size(), offsetof(UsdStreamHeader, groups), "groups");
    set.guides = sections.take<std::uint8_t>();
    expectEach(set.guides.size(), offsetof(UsdStreamHeader, guides), "guides");
    for (std::size_t i = 0; i < set.guides.size(); ++i)
        if (set.guides[i] > 1) failAt(sections.start() + i, "a guide that is neither 0 nor 1");
    set.comment = sections.takeText();
    set.warnings = linesOf(sections.takeText());
    return set;
}

StrandSet importUsd(const StrandFile& file) {
    if (file.path.empty()) throw engine::Error("USD can be read only from a file, not from memory");
    return readStage("usd_curves.py", Samples::none, file.path, file.check, readUsdStream);
}

StrandSamples importUsdCache(const StrandFile& file) {
    if (file.path.empty()) throw engine::Error("USD can be read only from a file, not from memory");
    return readStage(
        "usd_curves.py", Samples::all, file.path, file.check, [](std::span<const std::byte> bytes) {
            StrandSamples samples;
            MeshParser parser(bytes);
            double unit = 0.0;
            parser.value(unit);
            if (!std::isfinite(unit) || unit <= 0.0) failAt(0, "the unit has no length");
            samples.metres_per_unit = unit;
            parser.array(samples.ends);
            parser.array(samples.times);
            parser.array(samples.points);
            parser.end();
            std::uint64_t points = 0;
            for (std::uint32_t& size : samples.ends) {
                points += size;
                if (size == 0 || points > std::numeric_limits<std::uint32_t>::max())
                    failAt(16, "a strand without points, or too many points");
                size = static_cast<std::uint32_t>(points);
            }
            if (samples.times.empty() || samples.points.size() != samples.times.size() * points)
                failAt(bytes.size(), "points of some of the samples");
            for (std::size_t i = 0; i < samples.times.size(); ++i)
                if (!(i == 0 ? samples.times[i] == 0.0 : samples.times[i] > samples.times[i - 1]) ||
                    !std::isfinite(samples.times[i]))
                    failAt(bytes.size(), "times don't ascend from 0");
            requireFinite(samples.points, 0, "point");
            return samples;
        });
}

// ---- Meshes -------------------------------------------------------------------------------------

Mesh importUsdMesh(const std::filesystem::path& path, Textures, const NamedFileCheck& check) {
    return readStage(
        "usd_mesh.py", Samples::none, path, check,
        [](std::span<const std::byte> bytes) { return readMeshStream(bytes).mesh; });
}

UsdSamples readUsdSamples(const std::filesystem::path& path, const NamedFileCheck& check) {
    return readStage(
        "usd_mesh.py", Samples::all, path, orOwnFolder(check, path),
        [](std::span<const std::byte> bytes) {
            UsdSamples samples;
            MeshParser parser(bytes);
            parser.array(samples.times);
            parser.array(samples.positions);
            parser.end();
            const std::size_t count = samples.times.size();
            if (count == 0 ? !samples.positions.empty() : samples.positions.size() % count != 0)
                failAt(8 * count + 8, "positions of some of the vertices");
            for (std::size_t i = 0; i < count; ++i)
                if (!(i == 0 ? samples.times[i] == 0.0 : samples.times[i] > samples.times[i - 1]) ||
                    !std::isfinite(samples.times[i]))
                    failAt(8 * i + 8, "times don't ascend from 0");
            requireFinite(samples.positions, 8 * count + 16, "position");
            return samples;
        });
}

}  // namespace hair::groom
