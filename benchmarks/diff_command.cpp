#include <cstdio>
#include <iostream>

#include <nlohmann/json.hpp>

#include "benchmarks/commands.h"
#include "benchmarks/exit_codes.h"
#include "benchmarks/json_text.h"
#include "benchmarks/reference_tool.h"
#include "engine/write_file.h"

namespace benchmarks {
namespace {

std::string figure(const Json& value) {
    if (value.is_null()) return "infinite";
    char text[32];
    std::snprintf(text, sizeof text, "%.5g", value.get<double>());
    return text;
}

}  // namespace

int diffPictures(const DiffOptions& options) {
    const auto absolute = [](const std::filesystem::path& path) {
        return std::filesystem::absolute(path).string();
    };
    std::vector<std::string> arguments{absolute(options.reference), absolute(options.picture)};
    if (!options.out.empty()) {
        engine::checkWritable(options.out);
        arguments.push_back(absolute(options.out));
    }
    std::string text;
    runReferenceTool("compare.py", arguments, [&](std::string_view line) { text += line; });
    const Json figures = parseJson(text, "what compare.py wrote");
    if (options.json) {
        std::cout << figures.dump(2) << '\n';
        return kOk;
    }
    std::cout << options.picture.string() << " against " << options.reference.string() << ", "
              << figures.at("width") << " x " << figures.at("height") << " px\n"
              << "RMSE  " << figure(figures.at("rmse")) << '\n'
              << "PSNR  " << figure(figures.at("psnr_db")) << " dB\n"
              << "SSIM  " << figure(figures.at("ssim")) << '\n'
              << "FLIP  " << figure(figures.at("flip")) << '\n';
    return kOk;
}

}  // namespace benchmarks
