#include <iostream>
#include <optional>

#include "benchmarks/commands.h"
#include "benchmarks/exit_codes.h"
#include "benchmarks/groom_guides.h"
#include "benchmarks/interrupt.h"
#include "benchmarks/quantity_text.h"
#include "engine/error.h"
#include "engine/write_file.h"
#include "hair/groom/exporters.h"
#include "hair/groom/importers.h"
#include "hair/groom/inspect.h"
#include "hair/groom/mesh/import_mesh.h"
#include "hair/groom/resample.h"
#include "hair/groom/style/followers.h"
#include "hair/groom/style/strand_edits.h"

namespace benchmarks {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kMostPoints = 65536;      // of a strand: what .hair can count
constexpr std::uint32_t kMostGuideVertices = 256;  // of .hgl

// The thesis's guide file: metres, root triangles, at most 256 vertices.
bool isGuideFile(const hair::StrandExporter& exporter) { return exporter.extension == ".hgl"; }

void warn(const fs::path& path, const std::vector<std::string>& warnings) {
    for (const std::string& each : warnings)
        std::cerr << "hairbench: " << path.string() << ": " << each << '\n';
}

void say(const std::string& text) { std::cout << text << std::endl; }  // work may follow

std::string contents(const hair::StrandSet& strands) {
    std::string text = countText(strands.strandCount(), "strand") + ", " +
                       countText(strands.points.size(), "point");
    if (!strands.root_triangles.empty())
        text += ", " + countText(strands.root_triangles.size(), "root triangle");
    return text;
}

void checkOptions(const GroomConvertOptions& options, const hair::StrandExporter& exporter) {
    const std::uint32_t most = isGuideFile(exporter) ? kMostGuideVertices : kMostPoints;
    if (options.vertices && (*options.vertices < 2 || *options.vertices > most))
        throw engine::Error(
            "--vertices", std::to_string(*options.vertices) + " is outside [2, " +
                              std::to_string(most) + "] for " + std::string(exporter.extension));
    if (!options.mesh.empty() && !isGuideFile(exporter))
        throw engine::Error(
            "--mesh", "it is for root triangles, which " + std::string(exporter.extension) +
                          " doesn't hold; .hgl does");
    if (options.followers == 0 && options.follower_radius > 0.0)
        throw engine::Error("--follower-radius", "there are no followers without --followers");
    if (options.followers > 0 && options.follower_radius == 0.0)
        throw engine::Error(
            "--followers", "without --follower-radius they are all where their strand is");
}

// The factor that takes lengths to metres, where they are to be; absent where they stay.
std::optional<double> scaleOf(const hair::StrandSet& strands, const GroomConvertOptions& options) {
    if (options.scale || !isGuideFile(hair::strandExporterOf(options.out))) return options.scale;
    if (strands.metres_per_unit) return strands.metres_per_unit;
    const double guess = hair::inspect(strands, nullptr, {}).metres_per_unit;
    if (guess != 1.0)
        warn(
            options.in, {"the lengths are taken as metres, but don't look like it; is --scale " +
                         plainNumber(guess) + " meant?"});
    return {};
}

hair::StrandSet toMetres(hair::StrandSet strands, double factor) {
    strands.metres_per_unit = 1.0;
    if (factor == 1.0) return strands;
    say("scaled: by " + plainNumber(factor) + ", to metres");
    return hair::scaleLengths(std::move(strands), factor);
}

hair::StrandSet edited(hair::StrandSet strands, const GroomConvertOptions& options) {
    const std::optional<double> scale = scaleOf(strands, options);
    if (scale) strands = toMetres(std::move(strands), *scale);
    if (options.followers > 0) {
        const std::uint32_t before = strands.strandCount();
        const double radius = options.follower_radius * scale.value_or(1.0);
        strands = hair::addFollowers(
            strands, options.followers, static_cast<float>(radius),
            static_cast<float>(options.tip_separation), options.seed);
        say("added: " + countText(strands.strandCount() - before, "follower"));
    }
    if (options.vertices) {
        strands = hair::resample(std::move(strands), *options.vertices);
        say("resampled: to " + countText(*options.vertices, "point") + " a strand");
    }
    if (options.guides) {
        GuideChoice choice = chooseGuides(strands, *options.guides, options.seed);
        say("chose: " + countText(*options.guides, "guide") + " of " +
            countText(strands.strandCount(), "strand"));
        say("error: of the strands made from them " + choice.error);
        strands = std::move(choice.guides);
    }
    return strands;
}

}  // namespace

int convertGroom(const GroomConvertOptions& options) {
    const hair::StrandExporter& exporter = hair::strandExporterOf(options.out);
    checkOptions(options, exporter);
    std::optional<hair::Mesh> mesh;
    if (!options.mesh.empty()) mesh = hair::importMesh(options.mesh);

    hair::StrandSet strands = hair::importStrands(options.in);
    say("read: " + options.in.string() + ", " +
        std::string(hair::strandImporterOf(options.in).name) + ", " + contents(strands));
    warn(options.in, strands.warnings);
    engine::checkWritable(options.out);
    strands = edited(std::move(strands), options);
    if (isGuideFile(exporter) && (mesh || strands.root_triangles.empty())) {
        strands.root_triangles = rootTriangles(strands, mesh ? &*mesh : nullptr);
        say("joined: the roots by " + countText(strands.root_triangles.size(), "triangle") +
            (mesh ? " on the mesh" : ", from the roots alone"));
    }
    try {
        catchInterrupts();  // so that nothing half done is left
        warn(options.out, hair::exportStrands(strands, options.out, checkInterrupted));
    } catch (const Interrupted&) {
        std::cerr << "hairbench: interrupted, " << options.out.string() << " is not written\n";
        return kInterrupted;
    }
    std::error_code no_size;  // of a pipe
    const std::uintmax_t size = fs::file_size(options.out, no_size);
    say("wrote: " + options.out.string() + ", " + contents(strands) +
        (no_size ? "" : ", " + sizeText(size)));
    return kOk;
}

}  // namespace benchmarks
