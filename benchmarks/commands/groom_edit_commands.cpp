#include <algorithm>
#include <filesystem>
#include <functional>
#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/commands/commands.h"
#include "benchmarks/report/change.h"
#include "benchmarks/report/text.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/process.h"
#include "engine/shown_text.h"
#include "hair/groom/edit.h"
#include "hair/groom/files.h"
#include "hair/groom/groom.h"
#include "hair/groom/inspect.h"
#include "hair/groom/mesh/body_mesh.h"
#include "hair/groom/mesh/import_mesh.h"
#include "hair/groom/style/style.h"

namespace benchmarks::commands {
namespace {

using hair::groom::EditedStrands;
using hair::groom::StrandSet;

// Edits strands with the given number of metres per unit.
using GroomEdit = std::function<EditedStrands(StrandSet strands, double metres_per_unit)>;

double metresOf(double millimetres) { return millimetres / 1000.0; }

std::optional<double> metresOf(const std::optional<double>& millimetres) {
    if (!millimetres) return {};
    return metresOf(*millimetres);
}

std::optional<hair::groom::BodyMesh> meshOf(const EditGroomOptions& options) {
    if (options.mesh.empty()) return {};
    return hair::groom::bodyMesh(hair::groom::importMesh(options.mesh));
}

void warnOf(const std::filesystem::path& file, const std::vector<std::string>& warnings) {
    for (const std::string& each : warnings)
        std::cerr << "hairbench: " << engine::shownText(file.string() + ": " + each) << '\n';
}

void say(const char* did, const std::filesystem::path& file, const StrandSet& strands) {
    std::cout << did << ": " << engine::shownText(file.string()) << ", "
              << report::countText(strands.strandCount(), "strand") << ", "
              << report::countText(strands.points.size(), "point") << std::endl;  // flushes early
}

// Returns metres per unit of the file: from --scale, from the file, or a guess with a warning.
double unitOf(const StrandSet& strands, const EditGroomOptions& options) {
    if (options.scale) return *options.scale;
    const auto findings = hair::groom::inspect(strands, nullptr, {});
    if (!findings.unit_stated)
        warnOf(
            options.in,
            {"states no unit; lengths are taken as " + findings.unit + "; --scale sets the unit"});
    return findings.metres_per_unit;
}

// Adds the notes, each once.
void addNotes(
    std::vector<hair::groom::EditNote>& notes, const std::vector<hair::groom::EditNote>& more) {
    for (const hair::groom::EditNote& note : more) {
        const auto same = std::ranges::find(notes, note.what, &hair::groom::EditNote::what);
        if (same == notes.end())
            notes.push_back(note);
        else
            same->count += note.count;
    }
}

EditedStrands mendedOf(StrandSet strands, const EditGroomOptions& options) {
    try {
        return hair::groom::mendStrands(std::move(strands));
    } catch (const engine::Error& error) {
        throw engine::Error(options.in.string(), error.what());
    }
}

// Strands that can't be used are mended if they are `kept`.
int editGroom(
    const EditGroomOptions& options, const GroomEdit& edit,
    hair::groom::BadStrands bad = hair::groom::BadStrands::left_out) {
    const hair::groom::StrandExporter& exporter = hair::groom::strandExporterOf(options.out);
    StrandSet strands = hair::groom::importStrands(options.in, options.points_per_strand, {}, bad);
    say("read", options.in, strands);
    std::vector<hair::groom::EditNote> notes;
    if (bad == hair::groom::BadStrands::kept) {
        EditedStrands mended = mendedOf(std::move(strands), options);
        strands = std::move(mended.strands);
        notes = std::move(mended.notes);
    }
    warnOf(options.in, strands.warnings);
    engine::checkWritable(options.out);
    const double unit = unitOf(strands, options);
    if (options.scale) strands.metres_per_unit = unit;
    EditedStrands edited;
    try {
        edited = edit(std::move(strands), unit);
    } catch (const engine::Error& error) {
        throw engine::Error(options.in.string(), error.what());
    }
    addNotes(notes, edited.notes);
    for (const hair::groom::EditNote& note : notes)
        std::cout << note.what << ": " << report::countText(note.count) << '\n';
    // .hgl is the only format that is always in metres.
    if (exporter.extension == ".hgl" && edited.strands.metres_per_unit != 1.0 && unit != 1.0) {
        edited.strands = hair::groom::scaleLengths(std::move(edited.strands), unit);
        edited.strands.metres_per_unit = 1.0;
    }
    try {
        warnOf(
            options.out,
            hair::groom::exportStrands(edited.strands, options.out, engine::checkInterrupted));
    } catch (const engine::Interrupted&) {
        std::cerr << "hairbench: interrupted, " << options.out.string() << " is not written\n";
        return report::kInterrupted;
    }
    say("wrote", options.out, edited.strands);
    return report::kOk;
}

}  // namespace

int filterGroom(const EditGroomOptions& options) {
    const hair::groom::FilterSettings settings{
        .shortest = metresOf(options.shortest),
        .longest = metresOf(options.longest),
        .fewest_points = options.fewest_points,
        .most_points = options.most_points,
        .farthest_root = metresOf(options.farthest_root),
        .deepest = metresOf(options.deepest),
        .groups = options.groups};
    if ((settings.farthest_root || settings.deepest) && options.mesh.empty())
        throw engine::Error("--mesh", "is missing; --farthest-root and --deepest need it");
    if (!options.mesh.empty() && !settings.farthest_root && !settings.deepest)
        throw engine::Error("--mesh", "has no effect without --farthest-root or --deepest");
    const std::optional<hair::groom::BodyMesh> mesh = meshOf(options);
    return editGroom(options, [&](const StrandSet& strands, double unit) {
        return hair::groom::filterStrands(strands, settings, mesh ? &*mesh : nullptr, unit);
    });
}

int smoothGroom(const EditGroomOptions& options) {
    return editGroom(options, [&](StrandSet strands, double unit) {
        EditedStrands edited{
            .strands = {}, .notes = {{"smoothed: strands", strands.strandCount()}}};
        edited.strands =
            hair::groom::smoothStrands(std::move(strands), metresOf(options.smooth_length) / unit);
        return edited;
    });
}

int resampleGroom(const EditGroomOptions& options) {
    if (options.vertices.has_value() == options.spacing.has_value())
        throw engine::Error("--vertices, --spacing", "give exactly one of them");
    return editGroom(options, [&](StrandSet strands, double unit) {
        EditedStrands edited{
            .strands = {}, .notes = {{"resampled: strands", strands.strandCount()}}};
        edited.strands = options.vertices
                             ? hair::groom::resample(std::move(strands), *options.vertices)
                             : hair::groom::resampleBySpacing(
                                   std::move(strands), metresOf(*options.spacing) / unit);
        return edited;
    });
}

int fixGroom(const EditGroomOptions& options) {
    if (options.farthest_root && options.mesh.empty())
        throw engine::Error("--mesh", "is missing; --farthest-root needs it");
    constexpr double kFarthestRoot = 10.0;  // mm
    const std::optional<hair::groom::BodyMesh> mesh = meshOf(options);
    const GroomEdit edit = [&](StrandSet strands, double unit) {
        if (options.scale) {
            strands = hair::groom::scaleLengths(std::move(strands), unit);
            strands.metres_per_unit = unit = 1.0;
        }
        return hair::groom::fixStrands(
            strands, mesh ? &*mesh : nullptr, unit,
            metresOf(options.farthest_root.value_or(kFarthestRoot)));
    };
    return editGroom(options, edit, hair::groom::BadStrands::kept);
}

}  // namespace benchmarks::commands
