#include "benchmarks/groom/placement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <ostream>
#include <span>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "benchmarks/report/text.h"
#include "benchmarks/scene/json.h"
#include "engine/error.h"
#include "hair/groom/groom.h"
#include "hair/groom/inspect.h"
#include "hair/groom/mesh/body_mesh.h"
#include "hair/groom/mesh/depth.h"
#include "hair/groom/style/style.h"

namespace benchmarks::groom {
namespace {

using hair::groom::Mesh;
using hair::groom::StrandSet;

std::string shareText(std::size_t part, std::size_t all) {
    return report::shortNumber(100.0 * static_cast<double>(part) / static_cast<double>(all)) + " %";
}

// Returns at most `most` strands, evenly spaced by index.
StrandSet someOf(const StrandSet& strands, std::uint32_t most) {
    if (strands.strandCount() <= most) return strands;
    std::vector<std::uint32_t> indices(most);
    for (std::uint32_t i = 0; i < most; ++i)
        indices[i] = static_cast<std::uint32_t>(std::uint64_t{i} * strands.strandCount() / most);
    return hair::groom::pickStrands(strands, indices);
}

// ---- Guides -------------------------------------------------------------------------------------

constexpr std::uint32_t kFewestGuides = 400;
constexpr std::uint32_t kMostGuides = 2000;
constexpr std::uint32_t kStrandsPerGuide = 10;

// With fewer strands, a file holds guides rather than hair, and new strands grow between them.
constexpr std::uint32_t kFewestStrandsOfHair = 3000;
constexpr std::uint32_t kFewestForTriangles = 10;
constexpr double kDrawnBetweenGuides = 20000.0;

std::uint32_t guideCount(std::uint32_t strands) {
    return std::min(strands, std::clamp(strands / kStrandsPerGuide, kFewestGuides, kMostGuides));
}

// Returns the distance of a point from a polyline.
double distanceFrom(std::span<const glm::vec3> line, const glm::dvec3& point) {
    double least = glm::distance(glm::dvec3(line[0]), point);
    for (std::size_t k = 1; k < line.size(); ++k) {
        const glm::dvec3 start = line[k - 1];
        const glm::dvec3 along = glm::dvec3(line[k]) - start;
        const double square = glm::dot(along, along);
        const double where =
            square > 0.0 ? std::clamp(glm::dot(point - start, along) / square, 0.0, 1.0) : 0.0;
        least = std::min(least, glm::distance(start + where * along, point));
    }
    return least;
}

// Returns the loss of 95 % of the strands, in m, if each has only `vertices` vertices: the largest
// distance of its points from the polyline through the vertices.
double lossOf(const StrandSet& strands, std::uint32_t vertices) {
    const StrandSet coarse = hair::groom::resample(strands, vertices);
    std::vector<float> losses(strands.strandCount(), 0.0f);
    for (std::uint32_t i = 0; i < strands.strandCount(); ++i)
        for (const glm::vec3& point : strands.strand(i))
            losses[i] = std::max(
                losses[i], static_cast<float>(distanceFrom(coarse.strand(i), glm::dvec3(point))));
    return hair::groom::quantileOf(losses, 0.95);
}

constexpr std::array kVertices{8u, 12u, 16u, 24u, 32u, 48u, 64u};
constexpr double kMostLoss = 1e-3;  // m: above this it is visible

struct VertexChoice {
    std::uint32_t vertices;
    double loss;  // m
};

VertexChoice vertexChoice(const StrandSet& strands) {
    const StrandSet some = someOf(strands, 200);
    const std::uint32_t most = std::max(2u, hair::groom::greatestSize(strands));
    VertexChoice choice{};
    for (const std::uint32_t vertices : kVertices) {
        choice.vertices = std::min(vertices, most);
        choice.loss = lossOf(some, choice.vertices);
        if (choice.loss <= kMostLoss || choice.vertices == most) break;
    }
    return choice;
}

void chooseStrands(const StrandSet& strands, GroomScene& scene) {
    hair::Settings& settings = scene.settings;
    const std::uint32_t count = strands.strandCount();
    const std::size_t flagged = hair::groom::flaggedGuides(strands).size();
    settings.groom.guides = flagged > 0 ? 0 : guideCount(count);
    scene.choices.push_back(
        {"guides", flagged > 0
                       ? report::countText(flagged) + ", the strands that the file flags as guides"
                       : report::countText(settings.groom.guides) + " of " +
                             report::countText(count, "strand") +
                             ": a tenth, at least 400 and at most 2,000, which two cores can "
                             "simulate"});

    const VertexChoice choice = vertexChoice(strands);
    settings.groom.vertices = choice.vertices;
    scene.choices.push_back(
        {"vertices", std::to_string(choice.vertices) + " a guide: 95 % of the strands lose " +
                         report::lengthText(choice.loss) + " of their shape at most"});

    hair::StrandSettings& drawn = settings.strands;
    const bool is_hair = count >= kFewestStrandsOfHair || count < kFewestForTriangles ||
                         (flagged > 0 && flagged < count);
    drawn.source = is_hair ? hair::StrandSource::groom : hair::StrandSource::root_triangles;
    drawn.curve = hair::Curve::catmull_rom;
    drawn.tessellation = std::clamp(64u / std::max(1u, choice.vertices - 1), 1u, 8u);
    if (is_hair) {
        scene.choices.push_back({"strands", "the file's own, each moved by its guides"});
        return;
    }
    // A triangulation has about two triangles per vertex.
    const double triangles = 2.0 * (flagged > 0 ? static_cast<double>(flagged)
                                                : static_cast<double>(settings.groom.guides));
    drawn.density = static_cast<std::uint32_t>(
        std::clamp(std::round(kDrawnBetweenGuides / triangles), 1.0, 512.0));
    scene.choices.push_back(
        {"strands", std::to_string(drawn.density) +
                        " in each triangle between guides, some 20,000: the file has guides rather "
                        "than hair"});
}

// ---- Simulation ---------------------------------------------------------------------------------

struct FieldChoice {
    std::uint32_t resolution;
    double cell;  // m
    std::string reason;
};

// Cells of this size show ears and the nape.
constexpr double kFieldCell = 3e-3;  // m

// Returns the resolution of the head's distance field. A whole body needs more cells along its
// longest side than a head, but most of its box is narrow.
FieldChoice fieldChoice(const Mesh& head) {
    constexpr double kRounded = 1e-3;  // cells; positions are rounded to floats
    constexpr double kFewestCells = 96.0;
    constexpr double kMostCells = 256.0;  // the greatest that /simulation/distance_fields permits
    const Box box = boxOf(head.positions);
    const double side = box.longestSide();
    const double cells =
        std::clamp(std::ceil(side / kFieldCell - kRounded), kFewestCells, kMostCells);
    const glm::dvec3 counts = (box.high - box.low) * (cells / side) + 3.0;
    FieldChoice choice{
        .resolution = static_cast<std::uint32_t>(cells),
        .cell = side / cells,
        .reason = "a distance field of " + report::plainNumber(cells) + " cells of " +
                  report::lengthText(side / cells)};
    if (cells == kFewestCells) return choice;
    const double megabytes = sizeof(float) * counts.x * counts.y * counts.z * 1e-6;
    choice.reason += ", because the mesh is " + report::lengthText(side) +
                     " long and a head needs cells of 3 mm" +
                     (cells == kMostCells && side / cells > kFieldCell
                          ? " (256 is the greatest number; a mesh of the head alone is finer)"
                          : "") +
                     "; it takes " + report::shortNumber(megabytes) + " MB";
    return choice;
}

// Cuts triangles off at the sides of a box. Neighbouring triangles are cut at the same points.
class MeshCut {
public:
    MeshCut(const Mesh& mesh, const Box& box) : mesh_(mesh), box_(box) {}

    // Returns the part in the box, without materials.
    Mesh take() {
        for (const auto& triangle : mesh_.triangles) {
            std::vector<Corner> corners;
            for (const std::uint32_t vertex : triangle)
                corners.push_back({mesh_.positions[vertex], mesh_.normals[vertex]});
            for (int axis = 0; axis < 3; ++axis) {
                corners = cut(corners, axis, static_cast<float>(box_.low[axis]), 1.0f);
                corners = cut(corners, axis, static_cast<float>(box_.high[axis]), -1.0f);
            }
            add(corners);
        }
        return std::move(part_);
    }

private:
    struct Corner {
        glm::vec3 position;
        glm::vec3 normal;
    };

    static Corner between(const Corner& a, const Corner& b, int axis, float at) {
        // From the same end, in whichever order two triangles have them.
        const bool is_first = a.position[axis] < b.position[axis];
        const Corner& from = is_first ? a : b;
        const Corner& to = is_first ? b : a;
        const float share = (at - from.position[axis]) / (to.position[axis] - from.position[axis]);
        Corner corner{
            glm::mix(from.position, to.position, share), glm::mix(from.normal, to.normal, share)};
        corner.position[axis] = at;
        return corner;
    }

    // Keeps the part of a convex polygon on one side of a plane (Sutherland and Hodgman 1974).
    static std::vector<Corner>
    cut(const std::vector<Corner>& corners, int axis, float at, float side) {
        std::vector<Corner> kept;
        const auto isIn = [&](const Corner& each) {
            return side * each.position[axis] >= side * at;
        };
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const Corner& here = corners[i];
            const Corner& next = corners[(i + 1) % corners.size()];
            if (isIn(here)) kept.push_back(here);
            if (isIn(here) != isIn(next)) kept.push_back(between(here, next, axis, at));
        }
        return kept;
    }

    void add(const std::vector<Corner>& corners) {
        const auto first = static_cast<std::uint32_t>(part_.positions.size());
        for (const Corner& corner : corners) {
            part_.positions.push_back(corner.position);
            part_.normals.push_back(corner.normal);
        }
        for (std::uint32_t i = 2; i < corners.size(); ++i) {
            const glm::dvec3 a(corners[0].position), b(corners[i - 1].position);
            const glm::dvec3 c(corners[i].position);
            if (glm::cross(b - a, c - a) == glm::dvec3(0.0)) continue;
            part_.triangles.push_back({first, first + i - 1, first + i});
            part_.triangle_materials.push_back(0);
        }
    }

    const Mesh& mesh_;
    Box box_;
    Mesh part_;
};

// Returns the part of a long mesh round the hair, if its field has finer cells. Hair moves less
// than 10 cm beyond where it hangs unless the head moves a lot.
std::optional<Mesh> partRound(const StrandSet& strands, const Mesh& head) {
    constexpr double kRound = 0.1;  // m
    if (fieldChoice(head).cell <= 1.001 * kFieldCell) return {};  // positions are floats
    Box box = boxOf(strands.points);
    box.low -= kRound;
    box.high += kRound;
    Mesh part = MeshCut(head, box).take();
    if (part.triangles.empty() || fieldChoice(part).cell > 0.9 * fieldChoice(head).cell) return {};
    try {
        hair::groom::bodyMesh(part);
    } catch (const engine::Error&) {
        return {};
    }
    return part;
}

void chooseSimulation(const StrandSet& strands, const Mesh* head, GroomScene& scene) {
    hair::SimulationSettings& simulation = scene.settings.simulation;
    simulation.solver = hair::Solver::rod;
    simulation.rest = hair::RestShape::balanced;
    scene.choices.push_back(
        {"simulation",
         "rod, which has the material of hair and nothing to tune; rest balanced, so that hair "
         "hangs as it is groomed"});
    if (!head) return;
    try {
        const std::string warning = hair::groom::bodyWarning(hair::groom::bodyMesh(*head));
        if (!warning.empty()) scene.warnings.push_back("the head: " + warning);
    } catch (const engine::Error& error) {
        scene.warnings.push_back(
            std::string("the head can't be a body, so hair does not collide with it: ") +
            error.what());
        return;
    }
    simulation.collision = {.margin = 0.002f, .friction = 3.0f};
    scene.body = partRound(strands, *head);
    const FieldChoice field = fieldChoice(scene.body ? *scene.body : *head);
    simulation.distance_fields = {{.resolution = field.resolution}};
    scene.settings.strands.collision = hair::StrandCollision::push_out;
    scene.choices.push_back(
        {"body",
         (scene.body ? "the part of the mesh up to 10 cm beyond the hair, " : "the head, ") +
             field.reason + ", margin 2 mm"});
}

// ---- Light and colour ---------------------------------------------------------------------------

// A head has about 100,000 hairs, 0.08 mm wide. Fewer strands cover as much if they are wider.
constexpr double kHairs = 100000.0;
constexpr double kHairWidth = 80e-6;  // m
constexpr double kNarrowest = 60e-6;  // m
constexpr double kWidest = 600e-6;  // m
constexpr double kWidestOfFile = 1e-3;
constexpr double kNarrowestOfFile = 17e-6;  // the finest human hair

void chooseWidths(const StrandSet& strands, GroomScene& scene) {
    hair::StrandSettings& drawn = scene.settings.strands;
    if (strands.widths.known() && drawn.source == hair::StrandSource::groom) {
        std::vector<float> widths = strands.widths.values;
        if (widths.empty()) widths = {*strands.widths.everywhere};
        const double median = hair::groom::quantileOf(widths, 0.5);
        if (median >= kNarrowestOfFile && median <= kWidestOfFile) {
            drawn.width = hair::WidthSource::groom;
            scene.choices.push_back({"widths", "the file's, median " + report::lengthText(median)});
            return;
        }
        scene.warnings.push_back(
            "widths of " + report::lengthText(median) +
            " (median) in the file are not those of hair, and are left out; /strands/width groom "
            "draws them nevertheless");
    }
    const double count =
        drawn.source == hair::StrandSource::groom ? strands.strandCount() : kDrawnBetweenGuides;
    const double width = std::clamp(kHairWidth * kHairs / count, kNarrowest, kWidest);
    drawn.root_width = static_cast<float>(1e-6 * std::round(1e6 * width));
    drawn.tip_width = static_cast<float>(1e-6 * std::round(0.4e6 * width));
    scene.choices.push_back(
        {"widths", report::lengthText(drawn.root_width) + " to " +
                       report::lengthText(drawn.tip_width) +
                       ": as much coverage as 100,000 hairs of 0.08 mm, 0.6 mm at most"});
}

void chooseColor(const StrandSet& strands, GroomScene& scene) {
    glm::vec3& color = scene.settings.shading.color;
    color = {0.45f, 0.29f, 0.18f};
    if (!strands.colors.known()) {
        scene.choices.push_back({"colour", "brown: the file has no colours"});
        return;
    }
    glm::dvec3 sum(0.0);
    for (const glm::vec3& value : strands.colors.values) sum += glm::dvec3(value);
    const glm::dvec3 mean = strands.colors.values.empty()
                                ? glm::dvec3(*strands.colors.everywhere)
                                : sum / static_cast<double>(strands.colors.values.size());
    if (std::max({mean.x, mean.y, mean.z}) < 0.02 || std::min({mean.x, mean.y, mean.z}) > 0.98) {
        scene.choices.push_back(
            {"colour", "brown: the file's colour is black or white throughout"});
        return;
    }
    for (int i = 0; i < 3; ++i)
        color[i] = static_cast<float>(0.001 * std::round(1e3 * std::clamp(mean[i], 0.02, 0.98)));
    scene.choices.push_back({"colour", "the mean of the file's colours"});
}

// ---- View ---------------------------------------------------------------------------------------

struct Front {
    glm::dvec3 direction{0.0, 0.0, 1.0};  // horizontal, along an axis
    std::string reason = "+z, as most files have it";
};

std::vector<glm::dvec3> rootsOf(const StrandSet& strands) {
    std::vector<glm::dvec3> roots;
    for (std::uint32_t i = 0; i < strands.strandCount(); ++i)
        roots.emplace_back(strands.strand(i)[0]);
    return roots;
}

double lowestRoot(const StrandSet& strands) {
    std::vector<float> heights;
    for (const glm::dvec3& root : rootsOf(strands)) heights.push_back(static_cast<float>(root.y));
    return hair::groom::quantileOf(heights, 0.05);
}

// The scalp lies behind the middle of the head, so the direction from the middle of the roots to
// the middle of the head, at the height of the roots, points to the front.
Front frontOf(const StrandSet& strands, const Mesh* head) {
    if (!head) return {};
    constexpr double kLeastOffset = 3e-3;  // m; smaller offsets are inconclusive
    const double floor = lowestRoot(strands);
    glm::dvec3 low(std::numeric_limits<double>::infinity());
    glm::dvec3 high = -low;
    for (const glm::vec3& position : head->positions) {
        if (double{position.y} < floor) continue;
        low = glm::min(low, glm::dvec3(position));
        high = glm::max(high, glm::dvec3(position));
    }
    const std::vector<glm::dvec3> roots = rootsOf(strands);
    glm::dvec3 middle(0.0);
    for (const glm::dvec3& root : roots) middle += root / static_cast<double>(roots.size());
    const glm::dvec3 offset = 0.5 * (low + high) - middle;
    const int axis = std::abs(offset.x) > std::abs(offset.z) ? 0 : 2;
    if (!(std::abs(offset[axis]) >= kLeastOffset)) return {};
    Front front;
    front.direction = glm::dvec3(0.0);
    front.direction[axis] = offset[axis] > 0.0 ? 1.0 : -1.0;
    front.reason = std::string(offset[axis] > 0.0 ? "+" : "-") + (axis == 0 ? "x" : "z") +
                   ", as the middle of the roots is " + report::lengthText(std::abs(offset[axis])) +
                   " behind that of the head";
    return front;
}

glm::vec3 rounded(const glm::dvec3& point) { return glm::vec3(glm::round(1e3 * point) * 1e-3); }

// Returns points of all hair, and of the head down to below the lowest roots.
std::vector<glm::dvec3> shownPoints(const StrandSet& strands, const Mesh* head) {
    std::vector<glm::dvec3> points;
    for (const glm::vec3& point : someOf(strands, 2000).points) points.emplace_back(point);
    if (!head) return points;
    constexpr double kBelowRoots = 0.08;  // m, to the chin
    const double floor = lowestRoot(strands) - kBelowRoots;
    for (const glm::vec3& position : head->positions)
        if (double{position.y} >= floor) points.emplace_back(position);
    return points;
}

constexpr double kFieldOfView = 30.0;  // deg
constexpr double kNearestCamera = 0.02;  // m: twice the default near plane
constexpr double kFilled = 0.88;  // share of the picture

// Returns the nearest camera that shows all points, looking from `toward`: of unit length and not
// vertical.
hair::CameraSettings cameraFrom(const std::vector<glm::dvec3>& points, const glm::dvec3& toward) {
    glm::dvec3 low = points.front();
    glm::dvec3 high = low;
    for (const glm::dvec3& point : points) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    const glm::dvec3 centre = 0.5 * (low + high);
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0.0, 1.0, 0.0), toward));
    const glm::dvec3 upward = glm::cross(toward, right);
    const double slope = kFilled * std::tan(glm::radians(0.5 * kFieldOfView));
    double distance = kNearestCamera;
    for (const glm::dvec3& point : points) {
        const glm::dvec3 from = point - centre;
        const double off =
            std::max(std::abs(glm::dot(from, right)), std::abs(glm::dot(from, upward)));
        distance = std::max(distance, glm::dot(from, toward) + off / slope);
    }
    hair::CameraSettings camera{
        .position = rounded(centre + distance * toward),
        .target = rounded(centre),
        .field_of_view = static_cast<float>(kFieldOfView)};
    // The farthest point is at most twice as far as the camera from the centre.
    if (2.0 * distance > double{camera.far_plane}) {
        camera.far_plane = static_cast<float>(std::ceil(2.0 * distance));
        camera.near_plane = 1e-4f * camera.far_plane;
    }
    return camera;
}

void chooseView(const StrandSet& strands, const Mesh* head, GroomScene& scene) {
    constexpr double kAside = 30.0;  // deg
    constexpr double kAbove = 8.0;  // deg
    const Front front = frontOf(strands, head);
    const glm::dvec3 up(0.0, 1.0, 0.0);
    const glm::dvec3 aside = glm::cross(up, front.direction);  // the head's left
    const glm::dvec3 level =
        std::cos(glm::radians(kAside)) * front.direction + std::sin(glm::radians(kAside)) * aside;
    const std::vector<glm::dvec3> points = shownPoints(strands, head);
    for (const glm::dvec3& toward : {front.direction, aside, -front.direction, -aside})
        scene.views.push_back(cameraFrom(points, toward));

    hair::Settings& settings = scene.settings;
    settings.camera = cameraFrom(
        points, std::cos(glm::radians(kAbove)) * level + std::sin(glm::radians(kAbove)) * up);
    settings.render.width = settings.render.height = 960;
    settings.render.ssaa = 2;
    settings.render.tone_map = hair::ToneMap::agx;
    settings.render.background = {0.3f, 0.31f, 0.34f};
    scene.choices.push_back(
        {"camera", "a three-quarter view of all hair; the front is " + front.reason});

    hair::ShadingSettings& shading = settings.shading;
    shading.model = hair::ShadingModel::dual_scattering;
    shading.shadows = {.meshes = true, .hair = hair::HairShadows::deep_shadow};
    const glm::dvec3 centre = settings.camera.target;
    shading.lights = {
        {.position = rounded(centre + 3.0 * front.direction + 3.0 * up + 2.0 * aside),
         .strength = 2.2f},
        {.position = rounded(centre + 2.0 * front.direction + 0.5 * up - 3.0 * aside),
         .strength = 0.8f},
        {.position = rounded(centre - 3.0 * front.direction + 3.0 * up - 1.0 * aside),
         .strength = 1.2f}};
    scene.choices.push_back(
        {"light",
         "dual_scattering with deep_shadow, a key light, a weaker one and one from behind"});
}

// ---- Warnings -----------------------------------------------------------------------------------

constexpr double kShortestHair = 3e-3;  // m
constexpr double kLongestHair = 1.5;  // m

void findLengths(const StrandSet& strands, GroomScene& scene) {
    std::vector<float> lengths;
    for (std::uint32_t i = 0; i < strands.strandCount(); ++i)
        lengths.push_back(static_cast<float>(hair::groom::arcLength(strands.strand(i))));
    const double median = hair::groom::quantileOf(lengths, 0.5);
    if (median >= kShortestHair && median <= kLongestHair) return;
    scene.warnings.push_back(
        "the median strand is " + report::lengthText(median) +
        " long; if that is wrong, the unit is wrong: --scale sets it");
}

void findOnHead(
    const StrandSet& strands, const Mesh& head, const LayGuess& guess, GroomScene& scene) {
    const StrandSet some = someOf(strands, 5000);
    std::optional<hair::groom::DepthInside> depth;
    try {
        depth.emplace(hair::groom::bodyMesh(head));
    } catch (const engine::Error&) {  // no body: chooseSimulation() warns
    }
    const hair::groom::NearestSurface surface(head.positions, head.triangles);
    const std::size_t count = some.strandCount();
    std::size_t off = 0;
    std::size_t inside = 0;
    double farthest = 0.0;
    double deepest = 0.0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto points = some.strand(i);
        const double distance = surface(glm::dvec3(points[0])).distance;
        if (distance > hair::groom::kSurfaceTolerance) ++off;
        farthest = std::max(farthest, distance);
        if (!depth) continue;
        double deep = 0.0;
        for (const glm::vec3& point : points) deep = std::max(deep, (*depth)(glm::dvec3(point)));
        if (deep > hair::groom::kSurfaceTolerance) ++inside;
        deepest = std::max(deepest, deep);
    }
    const bool can_be_mended = guess.hair.rotation() == glm::dmat3(1.0);
    const std::string mend =
        (can_be_mended ? "" : "make +y the upward axis in the program that makes the hair, then ") +
        ("hairbench groom fix HAIR OUT --scale " + report::plainNumber(guess.hair.metres_per_unit) +
         " --mesh HEAD");
    if (off > 0)
        scene.warnings.push_back(
            shareText(off, count) + " of the roots are more than 1 mm off the head, up to " +
            report::lengthText(farthest) + "; up to 10 mm can be repaired: " + mend);
    if (inside > 0)
        scene.warnings.push_back(
            shareText(inside, count) +
            " of the strands are deeper than 1 mm inside the head, up to " +
            report::lengthText(deepest) + "; this moves their points onto it: " + mend);
}

void findPlacement(const LayGuess& guess, GroomScene& scene) {
    for (const std::string& doubt : guess.doubts) scene.warnings.push_back(doubt);
    if (!guess.best) return;
    const RootFit& best = guess.best->fit;
    const auto percent = [](double share) { return report::shortNumber(100.0 * share) + " %"; };
    if (guess.reversed) {
        scene.warnings.push_back(
            "strands run from tip to root: " + percent(guess.reversed->fit.share) +
            " of their last points are within 5 mm of the head, and " + percent(best.share) +
            " of their first ones; hairbench groom reverse HAIR OUT turns them round");
        return;
    }
    if (guess.against) {
        scene.warnings.push_back(
            "as the file states, " + layText(guess.best->hair) + ", " + percent(best.share) +
            " of the roots are within 5 mm of the head, but " + percent(guess.against->fit.share) +
            " would be " + layText(guess.against->hair) + "; if the file is wrong: --scale " +
            report::plainNumber(guess.against->hair.metres_per_unit) + " --up " +
            axisName(guess.against->hair.up));
        return;
    }
    if (!guess.fits) {
        scene.warnings.push_back(
            "the hair does not fit the head in any unit or orientation: at best " +
            percent(best.share) + " of the roots are within 5 mm of it, the median one " +
            report::lengthText(best.median) + " away (" + layText(guess.best->hair) +
            "); is it the head of this hair, in the same place? Each is placed by itself: --scale, "
            "--up and /groom/placement place the hair");
        return;
    }
    if (!guess.runner_up || guess.runner_up->fit.share < best.share - 0.1) return;
    scene.warnings.push_back(
        "the hair fits nearly as well in another way, " + layText(guess.runner_up->hair) + ": " +
        percent(guess.runner_up->fit.share) + " of the roots within 5 mm instead of " +
        percent(best.share) + "; look at the picture: --scale and --up set the unit and the axis");
}

}  // namespace

StrandSet placed(StrandSet strands, const Lay& lay) {
    const glm::dmat3 matrix = lay.rotation();
    for (glm::vec3& point : strands.points)
        point = glm::vec3(matrix * (lay.metres_per_unit * glm::dvec3(point)));
    for (float& width : strands.widths.values)
        width = static_cast<float>(width * lay.metres_per_unit);
    if (strands.widths.everywhere)
        *strands.widths.everywhere =
            static_cast<float>(*strands.widths.everywhere * lay.metres_per_unit);
    strands.metres_per_unit = 1.0;
    strands.up = 1;
    return strands;
}

Mesh placed(Mesh head, const Lay& lay) {
    const glm::dmat3 matrix = lay.rotation();
    for (glm::vec3& position : head.positions)
        position = glm::vec3(matrix * (lay.metres_per_unit * glm::dvec3(position)));
    for (glm::vec3& normal : head.normals) normal = glm::vec3(matrix * glm::dvec3(normal));
    return head;
}

void writeObj(const Mesh& mesh, std::ostream& out) {
    out << "# metres, +y up\n";
    for (const glm::vec3& position : mesh.positions)
        out << "v " << scene::decimalTexts(position, " ") << '\n';
    for (const glm::vec3& normal : mesh.normals)
        out << "vn " << scene::decimalTexts(normal, " ") << '\n';
    for (const glm::vec2& coordinate : mesh.texture_coordinates)  // v is up in OBJ
        out << "vt " << scene::decimalText(coordinate.x) << ' '
            << scene::decimalText(1.0 - double{coordinate.y}) << '\n';
    for (const auto& triangle : mesh.triangles) {
        out << 'f';
        for (const std::uint32_t corner : triangle) {
            const std::string number = std::to_string(corner + 1);
            out << ' ' << number << '/' << (mesh.texture_coordinates.empty() ? "" : number) << '/'
                << number;
        }
        out << '\n';
    }
}

GroomScene sceneOf(const StrandSet& strands, const Mesh* head, const LayGuess& guess) {
    GroomScene scene;
    hair::FilePlacementSettings& placement = scene.settings.groom.placement;
    placement.rotation = guess.hair.eulerAngles();
    findPlacement(guess, scene);
    const std::vector<hair::groom::Stray> strays = hair::groom::findStrays(strands);
    if (!strays.empty())
        scene.warnings.push_back(
            report::countText(strays.size(), "strand") +
            " apart from the others, which the view does not count: " + straysText(strays, 1.0) +
            "; leave them out in the program that makes the hair");
    findLengths(strands, scene);
    chooseStrands(strands, scene);
    chooseSimulation(
        strays.empty()
            ? strands
            : hair::groom::pickStrands(strands, hair::groom::strandsBut(strands, strays)),
        head, scene);
    if (head) findOnHead(strands, *head, guess, scene);
    chooseWidths(strands, scene);
    chooseColor(strands, scene);
    if (strays.empty()) {
        chooseView(strands, head, scene);
    } else {
        chooseView(
            hair::groom::pickStrands(strands, hair::groom::strandsBut(strands, strays)), head,
            scene);
    }
    return scene;
}

}  // namespace benchmarks::groom
