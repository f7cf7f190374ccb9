#include "benchmarks/groom/convert.h"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <system_error>
#include <utility>

#include "benchmarks/groom/info.h"
#include "benchmarks/report/text.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/process.h"
#include "hair/groom/edit.h"
#include "hair/groom/files.h"
#include "hair/groom/groom.h"
#include "hair/groom/inspect.h"
#include "hair/groom/mesh/import_mesh.h"
#include "hair/groom/style/style.h"

namespace benchmarks::groom {
namespace {

constexpr std::uint32_t kMostPoints = 65536;  // per strand, the limit of .hair
constexpr std::uint32_t kMostGuideVertices = 256;  // limit of .hgl

// A .hgl file, the thesis's guide format: metres, root triangles, at most 256 vertices.
bool isGuideFile(const hair::groom::StrandExporter& exporter) {
    return exporter.extension == ".hgl";
}

std::string contents(const hair::groom::StrandSet& strands) {
    std::string text = report::countText(strands.strandCount(), "strand") + ", " +
                       report::countText(strands.points.size(), "point");
    if (!strands.root_triangles.empty())
        text += ", " + report::countText(strands.root_triangles.size(), "root triangle");
    return text;
}

// ---- Presets ------------------------------------------------------------------------------------

// A program with the data that its importer expects, by its documentation.
struct Program {
    std::string_view name;
    const char* unit;
    const char* up;
    hair::groom::ExportExtras extras;
    bool needs_widths;  // it takes another width than that of hair if there are none
};

constexpr Program kPrograms[] = {
    // Epic: "Using Alembic for Grooms" 1.5. Lengths are centimetres and +z is up.
    {"unreal", "cm", "z", {.ids = true, .groom_names = true}, true},
    // Unity's importer multiplies by its Scale Factor, 0.01, and has +y up. It reads the texture
    // coordinates of curves.
    {"unity", "cm", "y", {.ids = true, .curve_uvs = true}, false},
    // Blender's Alembic importer takes units as metres and turns +y up to its +z. In USD the file
    // states both.
    {"blender", "m", "y", {.ids = true}, false},
    // Houdini has metres and +y up.
    {"houdini", "m", "y", {.ids = true}, false},
};

const Program* programOf(const ConvertOptions& options) {
    if (options.program.empty()) return nullptr;
    const auto* const program = std::ranges::find(kPrograms, options.program, &Program::name);
    if (program == std::end(kPrograms))
        throw engine::Error("--for", "no preset for '" + options.program + "'");
    return program;
}

// Adds the preset's unit and axis where the options leave them open.
ConvertOptions withPreset(ConvertOptions options) {
    const Program* const program = programOf(options);
    if (!program) return options;
    const std::string extension = hair::groom::lowerCaseExtension(options.out);
    if (extension != ".abc" && extension != ".usda")
        throw engine::Error(
            "--for", "'" + options.program + "' is to read '" + extension +
                         "', but presets are for .abc and .usda");
    if (options.unit.empty()) options.unit = program->unit;
    if (options.up.empty()) options.up = program->up;
    return options;
}

// Numbers groups from 0, in their order, if one is negative.
void renumberNegative(hair::groom::StrandSet& strands, const ConvertLog& log) {
    if (strands.groups.empty() || std::ranges::min(strands.groups) >= 0) return;
    std::vector<hair::groom::GroupChange> changes;
    for (const hair::groom::StrandGroup& group : hair::groom::groupsOf(strands))
        changes.push_back({*group.number, static_cast<std::int32_t>(changes.size())});
    hair::groom::EditedStrands edited = hair::groom::renumberGroups(std::move(strands), changes);
    strands = std::move(edited.strands);
    for (const hair::groom::EditNote& note : edited.notes)
        log.say("renumbered: " + note.what + ": " + report::countText(note.count));
}

hair::groom::StrandSet
forProgram(hair::groom::StrandSet strands, const ConvertOptions& options, const ConvertLog& log) {
    if (!options.unit.empty() || !options.up.empty()) {
        hair::groom::TransformSettings settings;
        if (!options.unit.empty()) settings.metres_per_unit = hair::groom::metresOf(options.unit);
        settings.from_up = axisOf(options.from_up);
        settings.up = axisOf(options.up);
        if (settings.metres_per_unit && !strands.metres_per_unit)
            throw engine::Error(
                options.in.string(),
                "states no unit, which --unit needs: give --scale, the metres per unit; --scale " +
                    report::plainNumber(
                        hair::groom::inspect(strands, nullptr, {}).metres_per_unit) +
                    " would be plausible");
        if (settings.up && !settings.from_up && !strands.up)
            throw engine::Error(
                options.in.string(),
                "states no upward axis, which --up needs: give --from-up x, y or z; 'hairbench "
                "groom scene' guesses it");
        hair::groom::EditedStrands edited =
            hair::groom::transformStrands(std::move(strands), settings);
        strands = std::move(edited.strands);
        for (const hair::groom::EditNote& note : edited.notes)
            log.say(note.what + ": " + report::countText(note.count));
    }
    if (const Program* const program = programOf(options)) {
        renumberNegative(strands, log);
        if (program->needs_widths && !strands.widths.known())
            log.warn(
                options.out, "the strands have no widths, and " + options.program +
                                 " takes them as 1 cm wide: set the width there");
    }
    return strands;
}

void checkOptions(const ConvertOptions& options, const hair::groom::StrandExporter& exporter) {
    const std::uint32_t most = isGuideFile(exporter) ? kMostGuideVertices : kMostPoints;
    if (options.vertices && (*options.vertices < 2 || *options.vertices > most))
        throw engine::Error(
            "--vertices", std::to_string(*options.vertices) + " is outside [2, " +
                              std::to_string(most) + "] for " + std::string(exporter.extension));
    if (!options.mesh.empty() && !isGuideFile(exporter))
        throw engine::Error(
            "--mesh", "has no effect: it is for root triangles, which " +
                          std::string(exporter.extension) + " can't hold; .hgl can");
    if (!options.from_up.empty() && options.up.empty())
        throw engine::Error("--from-up", "has no effect without --up or --for");
    if (isGuideFile(exporter) && !options.unit.empty() && options.unit != "m")
        throw engine::Error("--unit", "has no effect: .hgl is always in metres");
    if (options.followers == 0 && options.follower_radius > 0.0)
        throw engine::Error("--follower-radius", "has no effect without --followers");
    if (options.followers > 0 && options.follower_radius == 0.0)
        throw engine::Error(
            "--followers", "needs --follower-radius: without it all followers lie on their strand");
}

// Returns the factor that converts lengths to metres; nothing if lengths stay as they are.
std::optional<double> scaleOf(
    const hair::groom::StrandSet& strands, const ConvertOptions& options, const ConvertLog& log) {
    if (options.scale || !isGuideFile(hair::groom::strandExporterOf(options.out)))
        return options.scale;
    if (strands.metres_per_unit) return strands.metres_per_unit;
    const double guess = hair::groom::inspect(strands, nullptr, {}).metres_per_unit;
    if (guess != 1.0)
        log.warn(
            options.in,
            "the lengths are taken as metres, but do not look like metres: did you mean --scale " +
                report::plainNumber(guess) + "?");
    return {};
}

hair::groom::StrandSet
toMetres(hair::groom::StrandSet strands, double factor, const ConvertLog& log) {
    strands.metres_per_unit = 1.0;
    if (factor == 1.0) return strands;
    log.say("scaled: by " + report::plainNumber(factor) + ", to metres");
    return hair::groom::scaleLengths(std::move(strands), factor);
}

hair::groom::StrandSet
edited(hair::groom::StrandSet strands, const ConvertOptions& options, const ConvertLog& log) {
    const std::optional<double> scale = scaleOf(strands, options, log);
    if (scale) strands = toMetres(std::move(strands), *scale, log);
    if (options.followers > 0) {
        const std::uint32_t before = strands.strandCount();
        const double radius = options.follower_radius * scale.value_or(1.0);
        strands = hair::groom::addFollowers(
            strands, options.followers, static_cast<float>(radius),
            static_cast<float>(options.tip_separation), options.seed);
        log.say("added: " + report::countText(strands.strandCount() - before, "follower"));
    }
    if (options.vertices) {
        strands = hair::groom::resample(std::move(strands), *options.vertices);
        log.say("resampled: to " + report::countText(*options.vertices, "point") + " per strand");
    }
    if (options.guides) {
        GuideChoice choice = chooseGuides(strands, *options.guides, options.seed);
        log.say(
            "chose: " + report::countText(*options.guides, "guide") + " of " +
            report::countText(strands.strandCount(), "strand"));
        log.say("error of the strands made from them: " + choice.error);
        log.say(
            "error of the file's strands, as /strands/source groom draws them with these guides: " +
            choice.left);
        strands = std::move(choice.guides);
    }
    return strands;
}

void warnAll(
    const ConvertLog& log, const std::filesystem::path& file,
    const std::vector<std::string>& warnings) {
    for (const std::string& each : warnings) log.warn(file, each);
}

}  // namespace

std::vector<std::string> programNames() {
    std::vector<std::string> names;
    for (const Program& program : kPrograms) names.emplace_back(program.name);
    return names;
}

std::optional<std::uint8_t> axisOf(const std::string& name) {
    if (name.empty()) return {};
    return static_cast<std::uint8_t>(name[0] - 'x');
}

void convert(const ConvertOptions& given, const ConvertLog& log) {
    const ConvertOptions options = withPreset(given);
    const hair::groom::StrandExporter& exporter = hair::groom::strandExporterOf(options.out);
    checkOptions(options, exporter);
    std::optional<hair::groom::Mesh> mesh;
    if (!options.mesh.empty()) {
        mesh = hair::groom::importMesh(options.mesh);
        warnAll(log, options.mesh, mesh->warnings);
    }

    hair::groom::StrandSet strands = hair::groom::importStrands(
        options.in, options.points_per_strand, {}, hair::groom::badStrands(options.strict));
    log.say(
        "read: " + options.in.string() + ", " +
        std::string(hair::groom::strandImporterOf(options.in).name) + ", " + contents(strands));
    warnAll(log, options.in, strands.warnings);
    engine::checkWritable(options.out);
    strands = edited(std::move(strands), options, log);
    if (isGuideFile(exporter) && (mesh || strands.root_triangles.empty())) {
        strands.root_triangles = rootTriangles(strands, mesh ? &*mesh : nullptr);
        log.say(
            "joined: the roots by " + report::countText(strands.root_triangles.size(), "triangle") +
            (mesh ? " on the mesh" : ", from the roots alone"));
    }
    strands = forProgram(std::move(strands), options, log);
    const Program* const program = programOf(options);
    warnAll(
        log, options.out,
        hair::groom::exportStrands(
            strands, options.out, engine::checkInterrupted,
            program ? program->extras : hair::groom::ExportExtras{}));
    std::error_code no_size;  // for a pipe
    const std::uintmax_t size = std::filesystem::file_size(options.out, no_size);
    log.say(
        "wrote: " + options.out.string() + ", " + contents(strands) +
        (no_size ? "" : ", " + report::sizeText(size)));
}

}  // namespace benchmarks::groom
