#include <cstdio>
#include <iostream>

#include <nlohmann/json.hpp>

#include "benchmarks/commands/commands.h"
#include "benchmarks/reference/picture_errors.h"
#include "benchmarks/report/change.h"
#include "engine/files.h"
#include "engine/shown_text.h"

namespace benchmarks::commands {
namespace {

std::string figure(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.5g", value);
    return text;
}

scene::Json toJson(const reference::PictureErrors& errors) {
    return {{"width", errors.width},
            {"height", errors.height},
            {"rmse", errors.rmse},
            {"psnr_db", errors.psnr ? scene::Json(*errors.psnr) : scene::Json()},
            {"ssim", errors.ssim},
            {"flip", errors.flip}};
}

}  // namespace

int diffPictures(const DiffOptions& options) {
    if (!options.out.empty()) engine::checkWritable(options.out);
    const reference::PictureErrors errors =
        reference::comparePictures(options.reference, options.picture, options.out);
    if (options.json) {
        std::cout << toJson(errors).dump(2) << '\n';
        return report::kOk;
    }
    std::cout << engine::shownText(options.picture.string()) << " against "
              << engine::shownText(options.reference.string()) << ", " << errors.width << " x "
              << errors.height << " px\n"
              << "RMSE  " << figure(errors.rmse) << '\n'
              << "PSNR  " << (errors.psnr ? figure(*errors.psnr) : "infinite") << " dB\n"
              << "SSIM  " << figure(errors.ssim) << '\n'
              << "FLIP  " << figure(errors.flip) << '\n';
    return report::kOk;
}

}  // namespace benchmarks::commands
