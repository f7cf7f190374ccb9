#include "benchmarks/groom/convert.h"

#include <system_error>
#include <utility>

#include "benchmarks/groom/info.h"
#include "benchmarks/report/text.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/process.h"
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

void convert(const ConvertOptions& options, const ConvertLog& log) {
    const hair::groom::StrandExporter& exporter = hair::groom::strandExporterOf(options.out);
    checkOptions(options, exporter);
    std::optional<hair::groom::Mesh> mesh;
    if (!options.mesh.empty()) mesh = hair::groom::importMesh(options.mesh);

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
    warnAll(
        log, options.out,
        hair::groom::exportStrands(strands, options.out, engine::checkInterrupted));
    std::error_code no_size;  // for a pipe
    const std::uintmax_t size = std::filesystem::file_size(options.out, no_size);
    log.say(
        "wrote: " + options.out.string() + ", " + contents(strands) +
        (no_size ? "" : ", " + report::sizeText(size)));
}

}  // namespace benchmarks::groom
