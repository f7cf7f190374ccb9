#include <cstdio>
#include <iostream>

#include <nlohmann/json.hpp>

#include "benchmarks/commands.h"
#include "benchmarks/exit_codes.h"
#include "benchmarks/picture_errors.h"
#include "engine/write_file.h"

namespace benchmarks {
namespace {

std::string figure(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.5g", value);
    return text;
}

Json toJson(const PictureErrors& errors) {
    return {{"width", errors.width}, {"height", errors.height},
            {"rmse", errors.rmse},   {"psnr_db", errors.psnr ? Json(*errors.psnr) : Json()},
            {"ssim", errors.ssim},   {"flip", errors.flip}};
}

}  // namespace

int diffPictures(const DiffOptions& options) {
    if (!options.out.empty()) engine::checkWritable(options.out);
    const PictureErrors errors = comparePictures(options.reference, options.picture, options.out);
    if (options.json) {
        std::cout << toJson(errors).dump(2) << '\n';
        return kOk;
    }
    std::cout << options.picture.string() << " against " << options.reference.string() << ", "
              << errors.width << " x " << errors.height << " px\n"
              << "RMSE  " << figure(errors.rmse) << '\n'
              << "PSNR  " << (errors.psnr ? figure(*errors.psnr) : "infinite") << " dB\n"
              << "SSIM  " << figure(errors.ssim) << '\n'
              << "FLIP  " << figure(errors.flip) << '\n';
    return kOk;
}

}  // namespace benchmarks
