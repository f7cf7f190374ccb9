#include <iostream>
#include <optional>

#include "benchmarks/commands/commands.h"
#include "benchmarks/groom/info.h"
#include "benchmarks/report/change.h"
#include "benchmarks/report/text.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/process.h"
#include "hair/groom/build_groom.h"
#include "hair/groom/files.h"
#include "hair/groom/inspect.h"
#include "hair/groom/mesh/import_mesh.h"
#include "hair/groom/style/style.h"

namespace benchmarks::commands {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kMostPoints = 65536;      // of a strand: what .hair can count
constexpr std::uint32_t kMostGuideVertices = 256;  // of .hgl

// The thesis's guide file: metres, root triangles, at most 256 vertices.
bool isGuideFile(const hair::groom::StrandExporter& exporter) {
    return exporter.extension == ".hgl";
}

void warn(const fs::path& path, const std::vector<std::string>& warnings) {
    for (const std::string& each : warnings)
        std::cerr << "hairbench: " << path.string() << ": " << each << '\n';
}

void say(const std::string& text) { std::cout << text << std::endl; }  // work may follow

std::string contents(const hair::groom::StrandSet& strands) {
    std::string text = report::countText(strands.strandCount(), "strand") + ", " +
                       report::countText(strands.points.size(), "point");
    if (!strands.root_triangles.empty())
        text += ", " + report::countText(strands.root_triangles.size(), "root triangle");
    return text;
}

void checkOptions(const GroomConvertOptions& options, const hair::groom::StrandExporter& exporter) {
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
std::optional<double>
scaleOf(const hair::groom::StrandSet& strands, const GroomConvertOptions& options) {
    if (options.scale || !isGuideFile(hair::groom::strandExporterOf(options.out)))
        return options.scale;
    if (strands.metres_per_unit) return strands.metres_per_unit;
    const double guess = hair::groom::inspect(strands, nullptr, {}).metres_per_unit;
    if (guess != 1.0)
        warn(
            options.in, {"the lengths are taken as metres, but don't look like it; is --scale " +
                         report::plainNumber(guess) + " meant?"});
    return {};
}

hair::groom::StrandSet toMetres(hair::groom::StrandSet strands, double factor) {
    strands.metres_per_unit = 1.0;
    if (factor == 1.0) return strands;
    say("scaled: by " + report::plainNumber(factor) + ", to metres");
    return hair::groom::scaleLengths(std::move(strands), factor);
}

hair::groom::StrandSet edited(hair::groom::StrandSet strands, const GroomConvertOptions& options) {
    const std::optional<double> scale = scaleOf(strands, options);
    if (scale) strands = toMetres(std::move(strands), *scale);
    if (options.followers > 0) {
        const std::uint32_t before = strands.strandCount();
        const double radius = options.follower_radius * scale.value_or(1.0);
        strands = hair::groom::addFollowers(
            strands, options.followers, static_cast<float>(radius),
            static_cast<float>(options.tip_separation), options.seed);
        say("added: " + report::countText(strands.strandCount() - before, "follower"));
    }
    if (options.vertices) {
        strands = hair::groom::resample(std::move(strands), *options.vertices);
        say("resampled: to " + report::countText(*options.vertices, "point") + " a strand");
    }
    if (options.guides) {
        groom::GuideChoice choice = groom::chooseGuides(strands, *options.guides, options.seed);
        say("chose: " + report::countText(*options.guides, "guide") + " of " +
            report::countText(strands.strandCount(), "strand"));
        say("error: of the strands made from them " + choice.error);
        strands = std::move(choice.guides);
    }
    return strands;
}

}  // namespace

int convertGroom(const GroomConvertOptions& options) {
    const hair::groom::StrandExporter& exporter = hair::groom::strandExporterOf(options.out);
    checkOptions(options, exporter);
    std::optional<hair::groom::Mesh> mesh;
    if (!options.mesh.empty()) mesh = hair::groom::importMesh(options.mesh);

    hair::groom::StrandSet strands = hair::groom::importStrands(options.in);
    say("read: " + options.in.string() + ", " +
        std::string(hair::groom::strandImporterOf(options.in).name) + ", " + contents(strands));
    warn(options.in, strands.warnings);
    engine::checkWritable(options.out);
    strands = edited(std::move(strands), options);
    if (isGuideFile(exporter) && (mesh || strands.root_triangles.empty())) {
        strands.root_triangles = groom::rootTriangles(strands, mesh ? &*mesh : nullptr);
        say("joined: the roots by " + report::countText(strands.root_triangles.size(), "triangle") +
            (mesh ? " on the mesh" : ", from the roots alone"));
    }
    try {
        engine::catchInterrupts();  // so that nothing half done is left
        warn(
            options.out,
            hair::groom::exportStrands(strands, options.out, engine::checkInterrupted));
    } catch (const engine::Interrupted&) {
        std::cerr << "hairbench: interrupted, " << options.out.string() << " is not written\n";
        return report::kInterrupted;
    }
    std::error_code no_size;  // of a pipe
    const std::uintmax_t size = fs::file_size(options.out, no_size);
    say("wrote: " + options.out.string() + ", " + contents(strands) +
        (no_size ? "" : ", " + report::sizeText(size)));
    return report::kOk;
}

}  // namespace benchmarks::commands
