#include "benchmarks/reference/picture_errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <system_error>

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include "benchmarks/scene/json.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/pictures.h"
#include "engine/run_tool.h"

namespace benchmarks::reference {

// ---- FLIP ---------------------------------------------------------------------------------------

namespace {

using std::numbers::pi;

constexpr double kPixelsPerDegree = 3840.0 * pi / 180.0;  // a display 0.7 m wide seen from 0.7 m

// One channel of a picture.
struct Plane {
    int width;
    int height;
    std::vector<double> values;  // [row][column]

    double at(int x, int y) const {
        return values
            [static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
             static_cast<std::size_t>(x)];
    }
};

using Planes = std::array<Plane, 3>;

// ---- Colours ------------------------------------------------------------------------------------

// Converts linear RGB with sRGB's primaries to XYZ relative to white; each row sums to 1.
glm::dmat3 whiteRelative() {
    const glm::dmat3 to_xyz = glm::transpose(glm::dmat3(
        10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794,  //
        2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897,  //
        1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382));
    const glm::dvec3 white = to_xyz * glm::dvec3(1.0);
    glm::dmat3 scale(0.0);
    for (int i = 0; i < 3; ++i) scale[i][i] = 1.0 / white[i];
    return scale * to_xyz;
}

double linearOf(double display) {
    return display <= 0.04045 ? display / 12.92 : std::pow((display + 0.055) / 1.055, 2.4);
}

// A linear version of CIELAB: brightness, red-green and blue-yellow.
glm::dvec3 toOpponent(const glm::dvec3& xyz) {
    return {116.0 * xyz.y - 16.0, 500.0 * (xyz.x - xyz.y), 200.0 * (xyz.y - xyz.z)};
}

glm::dvec3 fromOpponent(const glm::dvec3& color) {
    const double y = (color.x + 16.0) / 116.0;
    return {y + color.y / 500.0, y, y - color.z / 200.0};
}

// CIELAB with Hunt's effect: darker colours are less different.
glm::dvec3 huntLab(const glm::dvec3& xyz) {
    constexpr double kDelta = 6.0 / 29.0;
    const auto root = [](double t) {
        return t > kDelta * kDelta * kDelta ? std::cbrt(t)
                                            : t / (3.0 * kDelta * kDelta) + 4.0 / 29.0;
    };
    const double l = 116.0 * root(xyz.y) - 16.0;
    return {
        l, 0.01 * l * 500.0 * (root(xyz.x) - root(xyz.y)),
        0.01 * l * 200.0 * (root(xyz.y) - root(xyz.z))};
}

// Distance of Abasi, Amani Tehran and Fairchild 2020.
double hyab(const glm::dvec3& a, const glm::dvec3& b) {
    return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

Planes opponentPlanes(std::span<const std::uint8_t> rgba, int width, int height) {
    const glm::dmat3 to_xyz = whiteRelative();
    std::array<double, 256> linear{};
    for (std::size_t i = 0; i < linear.size(); ++i)
        linear[i] = linearOf(static_cast<double>(i) / 255.0);
    Planes planes;
    for (Plane& plane : planes) plane = {width, height, std::vector<double>(rgba.size() / 4)};
    for (std::size_t i = 0; i < rgba.size() / 4; ++i) {
        const glm::dvec3 color = toOpponent(
            to_xyz *
            glm::dvec3(linear[rgba[4 * i]], linear[rgba[4 * i + 1]], linear[rgba[4 * i + 2]]));
        for (int channel = 0; channel < 3; ++channel)
            planes[static_cast<std::size_t>(channel)].values[i] = color[channel];
    }
    return planes;
}

// ---- Filters ------------------------------------------------------------------------------------

// Weights at -n ... n.
using Kernel = std::vector<double>;

Kernel kernelOf(int radius, const std::function<double(double)>& weight) {
    Kernel kernel;
    for (int i = -radius; i <= radius; ++i) kernel.push_back(weight(i));
    return kernel;
}

double total(const Kernel& kernel) {
    double sum = 0.0;
    for (const double weight : kernel) sum += weight;
    return sum;
}

// Pixels beyond the edge repeat the edge pixels. `step` is {1, 0} along rows, {0, 1} along columns.
Plane filteredAlong(const Plane& plane, const Kernel& kernel, std::array<int, 2> step) {
    const int radius = static_cast<int>(kernel.size()) / 2;
    Plane result{plane.width, plane.height, {}};
    result.values.reserve(plane.values.size());
    for (int y = 0; y < plane.height; ++y) {
        engine::checkInterrupted();
        for (int x = 0; x < plane.width; ++x) {
            double sum = 0.0;
            for (int i = -radius; i <= radius; ++i)
                sum += kernel[static_cast<std::size_t>(i + radius)] *
                       plane.at(
                           std::clamp(x + i * step[0], 0, plane.width - 1),
                           std::clamp(y + i * step[1], 0, plane.height - 1));
            result.values.push_back(sum);
        }
    }
    return result;
}

Plane filtered(const Plane& plane, const Kernel& across, const Kernel& down) {
    return filteredAlong(filteredAlong(plane, across, {1, 0}), down, {0, 1});
}

// A channel's contrast sensitivity as a filter: one or two Gaussians, a sqrt(pi / b)
// exp(-pi^2 x^2 / b) with x in degrees; paper, table 1.
struct Sensitivity {
    std::array<double, 2> a;
    std::array<double, 2> b;
};
constexpr std::array<Sensitivity, 3> kSensitivities{
    {{{1.0, 0.0}, {0.0047, 1e-5}}, {{1.0, 0.0}, {0.0053, 1e-5}}, {{34.1, 13.5}, {0.04, 0.025}}}};

Plane filterByContrastSensitivity(const Plane& plane, const Sensitivity& sensitivity) {
    constexpr double kWidest = 0.04;  // greatest b of all channels
    static const int radius =
        static_cast<int>(std::ceil(3.0 * std::sqrt(kWidest / (2.0 * pi * pi)) * kPixelsPerDegree));
    Plane sum{plane.width, plane.height, std::vector<double>(plane.values.size(), 0.0)};
    double whole = 0.0;
    for (std::size_t k = 0; k < 2; ++k) {
        if (sensitivity.a[k] == 0.0) continue;
        const double b = sensitivity.b[k];
        const Kernel gauss = kernelOf(radius, [&](double x) {
            const double degrees = x / kPixelsPerDegree;
            return std::exp(-pi * pi * degrees * degrees / b);
        });
        const double weight = sensitivity.a[k] * std::sqrt(pi / b);
        const Plane part = filtered(plane, gauss, gauss);
        for (std::size_t i = 0; i < sum.values.size(); ++i)
            sum.values[i] += weight * part.values[i];
        whole += weight * total(gauss) * total(gauss);
    }
    for (double& value : sum.values) value /= whole;
    return sum;
}

// ---- Differences --------------------------------------------------------------------------------

std::vector<glm::dvec3> filteredColors(const Planes& opponent) {
    static const glm::dmat3 to_rgb = glm::inverse(whiteRelative());
    static const glm::dmat3 to_xyz = whiteRelative();
    Planes seen;
    for (std::size_t channel = 0; channel < 3; ++channel)
        seen[channel] = filterByContrastSensitivity(opponent[channel], kSensitivities[channel]);
    std::vector<glm::dvec3> colors;
    colors.reserve(seen[0].values.size());
    for (std::size_t i = 0; i < seen[0].values.size(); ++i) {
        const glm::dvec3 rgb =
            to_rgb * fromOpponent({seen[0].values[i], seen[1].values[i], seen[2].values[i]});
        colors.push_back(huntLab(to_xyz * glm::clamp(rgb, glm::dvec3(0.0), glm::dvec3(1.0))));
    }
    return colors;
}

// Returns 0 to 1. Large differences are compressed, because beyond some difference more hardly
// matters.
double colorError(const glm::dvec3& a, const glm::dvec3& b) {
    constexpr double kPower = 0.7;
    constexpr double kBendAt = 0.4;  // as a share of the greatest error
    constexpr double kBendTo = 0.95;
    static const double greatest = std::pow(
        hyab(
            huntLab(whiteRelative() * glm::dvec3(0.0, 1.0, 0.0)),
            huntLab(whiteRelative() * glm::dvec3(0.0, 0.0, 1.0))),
        kPower);
    const double error = std::pow(hyab(a, b), kPower);
    const double bend = kBendAt * greatest;
    return error < bend ? kBendTo / bend * error
                        : kBendTo + (error - bend) / (greatest - bend) * (1.0 - kBendTo);
}

// Normalises positive weights to a sum of 1 and negative ones to -1.
Kernel normalized(Kernel kernel) {
    double positive = 0.0;
    double negative = 0.0;
    for (const double weight : kernel) (weight > 0.0 ? positive : negative) += weight;
    for (double& weight : kernel) weight /= weight > 0.0 ? positive : -negative;
    return kernel;
}

// Magnitudes of the gradients from a kernel applied along both axes.
std::vector<double>
gradientMagnitudes(const Plane& plane, const Kernel& change, const Kernel& gauss) {
    const Plane across = filtered(plane, change, gauss);
    const Plane down = filtered(plane, gauss, change);
    std::vector<double> lengths;
    for (std::size_t i = 0; i < across.values.size(); ++i)
        lengths.push_back(std::hypot(across.values[i], down.values[i]));
    return lengths;
}

// Error of each pixel, 0 to 1: edges and points that only one of the pictures has.
std::vector<double> featureErrors(const Plane& reference, const Plane& picture) {
    const double sigma = 0.5 * 0.082 * kPixelsPerDegree;
    const int radius = static_cast<int>(std::ceil(3.0 * sigma));
    const auto bell = [&](double x) { return std::exp(-x * x / (2.0 * sigma * sigma)); };
    Kernel gauss = kernelOf(radius, bell);
    const double sum = total(gauss);
    for (double& weight : gauss) weight /= sum;
    const Kernel edge = normalized(kernelOf(radius, [&](double x) { return -x * bell(x); }));
    const Kernel point = normalized(
        kernelOf(radius, [&](double x) { return (x * x / (sigma * sigma) - 1.0) * bell(x); }));
    std::vector<double> errors(reference.values.size(), 0.0);
    for (const Kernel* const kernel : {&edge, &point}) {
        const std::vector<double> a = gradientMagnitudes(reference, *kernel, gauss);
        const std::vector<double> b = gradientMagnitudes(picture, *kernel, gauss);
        for (std::size_t i = 0; i < errors.size(); ++i)
            errors[i] = std::max(errors[i], std::abs(a[i] - b[i]));
    }
    for (double& error : errors) error = std::sqrt(error / std::numbers::sqrt2);
    return errors;
}

// Values from 0 to 1.
Plane brightness(const Plane& opponent) {
    Plane result = opponent;
    for (double& value : result.values) value = (value + 16.0) / 116.0;
    return result;
}

}  // namespace

double flipError(
    std::span<const std::uint8_t> reference, std::span<const std::uint8_t> picture,
    std::uint32_t width, std::uint32_t height) {
    const std::size_t pixels = std::size_t{width} * height;
    if (pixels == 0 || reference.size() != 4 * pixels || picture.size() != 4 * pixels)
        throw engine::Error("FLIP", "the pictures are empty or of different sizes");
    const int w = static_cast<int>(width);
    const int h = static_cast<int>(height);
    const Planes a = opponentPlanes(reference, w, h);
    const Planes b = opponentPlanes(picture, w, h);
    const std::vector<glm::dvec3> colors_a = filteredColors(a);
    const std::vector<glm::dvec3> colors_b = filteredColors(b);
    const std::vector<double> features = featureErrors(brightness(a[0]), brightness(b[0]));
    double sum = 0.0;
    for (std::size_t i = 0; i < pixels; ++i)
        sum += std::pow(colorError(colors_a[i], colors_b[i]), 1.0 - features[i]);
    return sum / static_cast<double>(pixels);
}

// ---- Errors of pictures -------------------------------------------------------------------------

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
