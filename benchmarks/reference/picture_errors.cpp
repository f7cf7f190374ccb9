#include "benchmarks/reference/picture_errors.h"

#include <string>
#include <system_error>

#include <nlohmann/json.hpp>

#include "benchmarks/scene/json.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/pictures.h"
#include "engine/process.h"
#include "engine/program_files.h"
#include "engine/run_tool.h"

namespace benchmarks::reference {
namespace {

// ---- The Python tools ---------------------------------------------------------------------------

void run(
    const std::vector<std::string>& arguments,
    const std::function<void(std::string_view line)>& each_line) {
    // -B -E: writes no byte code beside the tool and ignores Python environment variables.
    std::vector<std::string> all{
        engine::pythonInterpreter("reference", "HAIRBENCH_REFERENCE_PYTHON"), "-B", "-E"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    try {
        engine::runTool(all, each_line, engine::checkInterrupted);
    } catch (const std::system_error& error) {
        throw engine::Error(
            "this needs the project's Python environment for references: run " +
            engine::makesPythonEnvironment("reference") + " (" + error.what() + ')');
    } catch (const engine::Error&) {
        engine::checkInterrupted();  // the interrupt ends the tool too
        throw;
    }
}

}  // namespace

void runReferenceTool(
    const std::string& script, const std::vector<std::string>& arguments,
    const std::function<void(std::string_view line)>& each_line) {
    const engine::Step step("runs " + script);
    std::vector<std::string> all{engine::programFile("benchmarks/reference/" + script).string()};
    all.insert(all.end(), arguments.begin(), arguments.end());
    run(all, each_line);
}

void checkReferenceTool() {
    const engine::Step step("looks for Mitsuba");
    run({"-c", "import mitsuba"}, [](std::string_view) {});
}

// ---- Picture errors -----------------------------------------------------------------------------

PictureErrors comparePictures(
    const std::filesystem::path& reference, const std::filesystem::path& picture,
    const std::filesystem::path& map) {
    const engine::ScratchFolder folder;
    const std::filesystem::path drawn = folder.path() / "map.png";
    std::vector<std::string> arguments;
    for (const std::filesystem::path& path : {reference, picture})
        arguments.push_back(std::filesystem::absolute(path).string());
    if (!map.empty()) arguments.push_back(drawn.string());
    std::string text;
    runReferenceTool("compare.py", arguments, [&](std::string_view line) { text += line; });
    if (!map.empty()) engine::writeFileAtomically(map, engine::readFile(drawn));
    const scene::Json figures = scene::parseJson(text, "the output of compare.py");
    PictureErrors errors{
        .width = figures.at("width"),
        .height = figures.at("height"),
        .rmse = figures.at("rmse"),
        .ssim = figures.at("ssim"),
        .flip = figures.at("flip")};
    if (const scene::Json& psnr = figures.at("psnr_db"); !psnr.is_null()) errors.psnr = psnr;
    if (const scene::Json& ratio = figures.at("light_ratio"); !ratio.is_null())
        errors.light_ratio = ratio;
    return errors;
}

void ReferenceComparison::add(
    const std::filesystem::path& reference, std::uint32_t width, std::uint32_t height,
    std::span<const std::uint8_t> rgba, report::CaseResult& result) {
    if (!isPossible(result)) return;
    const std::filesystem::path picture = folder_.path() / "picture.png";
    engine::writePng(picture, width, height, rgba);
    const PictureErrors errors = comparePictures(reference, picture, {});
    const auto add_metric = [&](report::Measured what, double value) {
        result.metrics.push_back({report::ofImage(what), {value}});
    };
    add_metric(report::Measured::rmse, errors.rmse);
    if (errors.psnr) add_metric(report::Measured::psnr, *errors.psnr);
    add_metric(report::Measured::ssim, errors.ssim);
    add_metric(report::Measured::flip, errors.flip);
}

bool ReferenceComparison::isPossible(report::CaseResult& result) {
    if (possible_) return *possible_;
    possible_ = true;
    try {
        checkReferenceTool();
    } catch (const engine::Error& error) {
        possible_ = false;
        result.trust.warnings.push_back(
            std::string("no case is compared with /run/reference: ") + error.what());
    }
    return *possible_;
}

}  // namespace benchmarks::reference
