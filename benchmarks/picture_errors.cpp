#include "benchmarks/picture_errors.h"

#include <string>

#include <nlohmann/json.hpp>

#include "benchmarks/json_text.h"
#include "benchmarks/reference_tool.h"
#include "engine/error.h"
#include "engine/image_file.h"

namespace benchmarks {

PictureErrors comparePictures(
    const std::filesystem::path& reference, const std::filesystem::path& picture,
    const std::filesystem::path& map) {
    std::vector<std::string> arguments;
    for (const std::filesystem::path& path : {reference, picture, map})
        if (!path.empty()) arguments.push_back(std::filesystem::absolute(path).string());
    std::string text;
    runReferenceTool("compare.py", arguments, [&](std::string_view line) { text += line; });
    const Json figures = parseJson(text, "what compare.py wrote");
    PictureErrors errors{
        .width = figures.at("width"),
        .height = figures.at("height"),
        .rmse = figures.at("rmse"),
        .ssim = figures.at("ssim"),
        .flip = figures.at("flip")};
    if (const Json& psnr = figures.at("psnr_db"); !psnr.is_null()) errors.psnr = psnr;
    return errors;
}

void ReferenceComparison::add(
    const std::filesystem::path& reference, std::uint32_t width, std::uint32_t height,
    std::span<const std::uint8_t> rgba, CaseResult& result) {
    if (!isPossible(result)) return;
    const std::filesystem::path picture = folder_.path() / "picture.png";
    engine::writePng(picture, width, height, rgba);
    const PictureErrors errors = comparePictures(reference, picture, {});
    const auto add_metric = [&](Measured what, double value) {
        result.metrics.push_back({ofImage(what), {value}});
    };
    add_metric(Measured::rmse, errors.rmse);
    if (errors.psnr) add_metric(Measured::psnr, *errors.psnr);
    add_metric(Measured::ssim, errors.ssim);
    add_metric(Measured::flip, errors.flip);
}

bool ReferenceComparison::isPossible(CaseResult& result) {
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

}  // namespace benchmarks
