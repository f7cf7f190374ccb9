#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hair/groom/groom.h"
#include "hair/groom/named_files.h"

// The interface of formats of strands. The tables of all formats are in files.h.
namespace hair::groom {

// Data that the importer of a program reads in addition to those that a format holds anyway.
struct ExportExtras {
    bool ids = false;  // the strands' numbers, from 0: groom_id
    bool groom_names = false;  // widths and root UVs under Unreal Engine's names too
    bool curve_uvs = false;  // root UVs as the texture coordinates of curves too
};

// A writer of strands. `write` returns a sentence for each kind of data in these strands that the
// format can't hold; everything else reads back equal to the last bit. Throws engine::Error if the
// format can't hold the strands at all.
struct StrandExporter {
    std::string_view extension;  // lower case, with the dot
    std::vector<std::string> (*write)(const StrandSet& strands, std::ostream& out);
    // Null: programs read no more from it than `write` writes.
    std::vector<std::string> (*write_with)(
        const StrandSet& strands, const ExportExtras& extras, std::ostream& out) = nullptr;
};

// A file in memory. `path` is its origin, for formats that name other files or that another program
// reads. If it is empty, no other file is opened.
struct StrandFile {
    std::span<const std::byte> bytes;
    std::filesystem::path path;
    // For formats that can leave it out, such as a PLY of points alone; 0: not known.
    std::uint32_t points_per_strand = 0;
    NamedFileCheck check{};  // for those other files
};

// The frames of an animation that is written: the first is at 0 s.
struct FrameTiming {
    std::uint32_t frames = 1;
    double frame_time = 1.0 / 60.0;  // s
};

// Strands of a file over time. Their number and their numbers of points don't change.
struct StrandSamples {
    std::vector<std::uint32_t> ends;  // [strand], index after its last point
    std::vector<double> times;  // [sample], s, ascending from 0
    std::vector<glm::vec3> points;  // [sample][point], file's unit
    std::optional<double> metres_per_unit;
};

// Bytes of the points of all samples together that are read at most.
inline constexpr std::uint64_t kMostSampleBytes = std::uint64_t{2} << 30;

// A reader of strands. Its errors begin with the place in the file, "byte N" or "line N", and don't
// name the file. It refuses files that are not exactly of the format, and checks counts against the
// file's size before it allocates memory for them. It returns strands that can't be used too, as
// usableStrands() takes them, and has no rule of its own for them unless the format has one.
struct StrandImporter {
    std::string_view name;  // for messages
    std::span<const std::string_view> extensions;  // lower case, with the dot
    std::string_view magic;  // first bytes of all such files; empty: there are none
    StrandSet (*read)(const StrandFile& file);
    bool from_memory = true;  // reads `bytes`; false: another program reads the file at `path`
    // For formats without a magic that share an extension with another one: whether a file with
    // these first bytes, up to 32, and this size may be of this format.
    bool (*looks_like)(std::span<const std::byte> head, std::uint64_t size) = nullptr;
    // Null: the format has no samples over time. Refuses strands that appear, vanish, or change
    // their numbers of points, with the time.
    StrandSamples (*read_samples)(const StrandFile& file) = nullptr;
};

// Kinds of data that a format may have, in the order of the table of formats.
enum class Fact {
    strands,
    guides,
    groups,
    widths,
    colors,
    transparencies,
    root_uvs,
    normals,
    unit,
    up,
    root_triangles,
    animation,
    count  // of them
};

// How hairbench treats a kind of data of a format.
struct FormatFact {
    Fact fact;
    bool is_read;
    bool is_written;
    std::string_view how{};  // "per point"
};

// A format, or a version of one, as people know it.
struct FormatFacts {
    std::span<const std::string_view> extensions;  // lower case, with the dot
    std::string_view name;
    std::span<const FormatFact> facts;  // kinds of data that are missing are not read or written
};

}  // namespace hair::groom
