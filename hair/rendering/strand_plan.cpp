#include "hair/rendering/strand_plan.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include <glm/geometric.hpp>

#include "engine/error.h"
#include "hair/gpu_structs.h"
#include "hair/random.h"

namespace hair::rendering {
namespace {

// A body moves points inside it to its surface, however far that is.
constexpr float kAnywhere = 1e6f;  // m

// Mean width over the strands, m.
double meanWidth(const groom::Groom& groom, const StrandSettings& settings) {
    if (settings.width == WidthSource::groom) {
        const double sum = std::accumulate(groom.widths.begin(), groom.widths.end(), 0.0);
        return sum / static_cast<double>(groom.widths.size());
    }
    const double tapered = 0.5 * (double{settings.root_width} + double{settings.tip_width});
    return std::lerp(tapered, double{settings.root_width}, double{settings.taper_start});
}

// Root mean square distance of guide points from their mean, m. For points on a sphere, its radius.
double radius(const groom::Groom& groom) {
    glm::dvec3 sum(0.0);
    double squares = 0.0;
    for (const glm::vec3& point : groom.points) {
        sum += glm::dvec3(point);
        squares += glm::dot(glm::dvec3(point), glm::dvec3(point));
    }
    const auto count = static_cast<double>(groom.points.size());
    const glm::dvec3 mean = sum / count;
    return std::sqrt(std::max(squares / count - glm::dot(mean, mean), 0.0));
}

std::uint32_t smallestFactor(std::uint32_t number) {
    for (std::uint32_t factor = 2; factor * factor <= number; ++factor)
        if (number % factor == 0) return factor;
    return number;
}

// Lines have no width to divide, and the other pictures of /render/show show whole strands.
bool drawsMergedHairs(const Settings& settings) {
    const LodSettings& lod = settings.lod;
    return lod.merged == MergedStrands::hairs &&
           (lod.mode != LodMode::forced || lod.level > 0.0f) &&
           settings.render.show == Show::shading && settings.strands.backend != Backend::lines;
}

// Equals the number in strands/lod.glsl to the last bit.
float scaledCount(std::uint32_t count, float scale) {
    return std::max(static_cast<float>(count) * scale, 1.0f);
}

// Throws engine::Error if nothing bounds how far the strands of a cluster are from one another.
void checkClusters(const Settings& settings) {
    if (settings.lod.mode != LodMode::cluster) return;
    const StrandSettings& strands = settings.strands;
    const auto refuse = [](const char* why) {
        throw engine::Error("/lod/mode", std::string("is cluster, but ") + why);
    };
    if (strands.source == StrandSource::groom)
        refuse(
            "/strands/source is groom, whose strands have shapes of their own; they take distance");
    if (strands.curve == Curve::extension)
        refuse("nothing bounds the bends of a curve from a file; it takes distance");
    if (strands.collision == StrandCollision::push_out)
        refuse("/strands/collision moves strands by any distance; they take distance");
}

// Thesis program 2.3: fract(sin(dot(co, (12.9898, 78.233))) * 43758.5453).
float thesisRandom(double x, double y) {
    const double wide = std::sin(12.9898 * x + 78.233 * y) * 43758.5453;
    const double fraction = wide - std::floor(wide);
    return static_cast<float>(std::floor(fraction * 0x1p24)) * 0x1p-24f;
}

// The level at a distance from the camera, m: 0 up to near_distance, then linear in the distance's
// logarithm up to maximum_level at far_distance.
double levelAtDistance(const LodSettings& lod, double distance) {
    const double octaves = std::log2(distance / lod.near_distance);
    const double all = std::log2(double{lod.far_distance} / lod.near_distance);
    return lod.maximum_level * std::clamp(octaves / all, 0.0, 1.0);
}

}  // namespace

// ---- How wide levels of detail may make strands -------------------------------------------------

float greatestWidthScale(const groom::Groom& groom, const StrandSettings& settings) {
    const double width = groom.points.empty() ? 0.0 : meanWidth(groom, settings);
    if (width == 0.0) return std::numeric_limits<float>::infinity();
    return static_cast<float>(1.0 + double{kOutlineGrowth} * radius(groom) / width);
}

// ---- Strands, patches and draws -----------------------------------------------------------------

std::uint32_t drawnStrands(std::uint32_t density, float scale) {
    return static_cast<std::uint32_t>(std::ceil(scaledCount(density, scale)));
}

DrawnPieces drawnPieces(std::uint32_t tessellation, float scale) {
    const float wanted = scaledCount(tessellation, scale);
    std::uint32_t count = tessellation;
    while (count > 1) {
        const std::uint32_t fewer = count / smallestFactor(count);
        if (wanted > static_cast<float>(fewer)) break;
        count = fewer;
    }
    return {.count = count, .morphs = wanted < static_cast<float>(count)};
}

StrandPlan planStrands(
    std::uint32_t triangles, std::uint32_t segments, const StrandSettings& strands,
    const LodSettings& lod, std::uint32_t isoline_limit) {
    StrandPlan plan;
    plan.triangles = triangles;
    plan.segments = segments;
    plan.density = strands.density;
    plan.tessellation = strands.tessellation;
    plan.lod_mode = lod.mode;
    plan.forced_level = lod.mode == LodMode::forced ? lod.level : 0.0f;
    plan.forced_scale = std::exp2(-plan.forced_level);
    const DrawnPieces pieces = drawnPieces(strands.tessellation, plan.forced_scale);
    plan.forced_density = drawnStrands(strands.density, plan.forced_scale);
    plan.forced_tessellation = pieces.count;
    plan.morphs = lod.mode != LodMode::forced || pieces.morphs;
    plan.patches_per_triangle =
        isoline_limit == 0 ? 1 : divideUp(plan.forced_density, isoline_limit);
    plan.strands_per_patch = divideUp(plan.forced_density, plan.patches_per_triangle);
    return plan;
}

StrandPlan
planStrands(const StrandView& view, const Settings& settings, std::uint32_t isoline_limit) {
    if (settings.strands.collision_rule && view.contacts == 0)
        throw engine::Error(
            "/strands/collision_rule", "is set, but it is not known where guides touch bodies");
    const bool pushed = settings.strands.collision == StrandCollision::push_out;
    if (pushed && view.bodies == 0)
        throw engine::Error(
            "/strands/collision", "is push_out, but it is not known what strands collide with");
    checkClusters(settings);
    const std::uint32_t segments = view.vertices_per_guide - 1;
    StrandSettings strands = settings.strands;
    std::uint32_t triangles = view.triangle_count;
    if (strands.source == StrandSource::groom) {
        strands.density = view.bound_strand_count;
        triangles = isoline_limit = 1;
    }
    StrandPlan plan = planStrands(triangles, segments, strands, settings.lod, isoline_limit);
    plan.reach = pushed ? kAnywhere : view.offset_reach;
    plan.residuals = strands.source == StrandSource::groom && view.residuals != 0;
    plan.skinned = view.deforming != nullptr;
    plan.merged_hairs = drawsMergedHairs(settings);
    // The scene's own shading model may ask for its place on the strand, as strand colours do.
    plan.own_colors = settings.shading.strand_variation > 0.0f ||
                      settings.shading.tip_lightening > 0.0f ||
                      settings.shading.model == ShadingModel::extension;
    plan.greatest_width = view.greatest_width * (plan.merged_hairs ? gpu::kMostMergedSpread : 1.0f);
    return plan;
}

std::uint32_t StrandPlan::verticesPerPatch() const {
    return strands_per_patch * (forced_tessellation + 1);
}

std::uint64_t StrandPlan::strands() const { return std::uint64_t{triangles} * forced_density; }

std::uint64_t StrandPlan::drawnSegments() const {
    return strands() * segments * forced_tessellation;
}

ExpectedCounts expectedCounts(const StrandPlan& plan) {
    ExpectedCounts counts{.tessellation_control_patches = plan.patches()};
    if (plan.lod_mode != LodMode::forced) return counts;
    counts.tessellation_evaluation_invocations =
        plan.strands() * plan.segments * (plan.forced_tessellation + 1);
    counts.geometry_invocations = plan.drawnSegments();
    counts.geometry_primitives = 2 * plan.drawnSegments();  // a quad is a strip of two triangles
    return counts;
}

std::vector<engine::Draw>
planDraws(const StrandPlan& plan, Submission submission, std::uint32_t max_vertices) {
    const std::uint32_t patches_per_draw = max_vertices / plan.verticesPerPatch();
    assert(patches_per_draw > 0);
    const bool instanced = submission == Submission::instanced;
    const std::uint32_t patches = instanced ? plan.segments : plan.patches();
    const std::uint32_t instances = instanced ? plan.triangles * plan.patches_per_triangle : 1;
    std::vector<engine::Draw> draws;
    for (std::uint32_t first = 0; first < patches; first += patches_per_draw) {
        draws.push_back(
            {.vertices = std::min(patches_per_draw, patches - first),
             .instances = instances,
             .first_vertex = first});
        if (patches - first <= patches_per_draw)
            break;  // first may overflow on devices with no limit
    }
    return draws;
}

// ---- Levels by distance -------------------------------------------------------------------------

std::uint32_t mostStrands(
    const StrandPlan& plan, const LodSettings& lod, const StrandView& view, const glm::vec3& eye) {
    // Rounding on the device may give a root a level that is finer by less than this.
    constexpr double kRounding = 1e-4;
    const glm::dvec3 centre = glm::dmat4(view.head) * glm::dvec4(view.centre, 1.0);
    const double nearest = glm::distance(centre, glm::dvec3(eye)) - double{view.radius};
    // An animation moves roots out of the sphere.
    if (view.deforming || nearest <= double{lod.near_distance}) return plan.density;
    const double level = levelAtDistance(lod, nearest) - kRounding;
    const float least = view.greatest_width_scale > 0.0f ? 1.0f / view.greatest_width_scale : 0.0f;
    const float scale = std::max(static_cast<float>(std::exp2(-level)), least);
    return std::min(drawnStrands(plan.density, scale) + 1, plan.density);
}

DistanceLod distanceLod(
    const groom::Groom& groom, std::span<const glm::vec3> guides, const StrandView& view,
    const Settings& settings) {
    const auto root = [&](std::uint32_t guide) {
        return glm::dvec3(guides[std::size_t{guide} * groom.vertices_per_strand]);
    };
    const auto levelAt = [&](const glm::dvec3& place) {
        return levelAtDistance(
            settings.lod, glm::distance(place, glm::dvec3(settings.camera.position)));
    };

    DistanceLod result;
    if (settings.strands.source == StrandSource::groom) {
        for (const groom::StrandBinding& binding : groom.bindings) {
            glm::dvec3 place = glm::dmat3(glm::mat3(view.head)) * glm::dvec3(binding.offset);
            if (binding.followsHead()) place += glm::dvec3(view.head[3]);
            for (int i = 0; i < 3; ++i)
                place +=
                    double{binding.weights[i]} * root(binding.guides[static_cast<std::size_t>(i)]);
            result.mean_level += levelAt(place) / static_cast<double>(groom.bindings.size());
        }
        return result;
    }
    const float least = view.greatest_width_scale > 0.0f ? 1.0f / view.greatest_width_scale : 0.0f;
    std::uint64_t strands = 0;
    for (const auto& [a, b, c] : groom.root_triangles) {
        const double level = levelAt((root(a) + root(b) + root(c)) / 3.0);
        result.mean_level += level / static_cast<double>(groom.root_triangles.size());
        const auto scale = static_cast<float>(std::exp2(-level));
        strands += drawnStrands(settings.strands.density, std::max(scale, least));
    }
    result.strands = strands;
    return result;
}

// ---- Levels by cluster --------------------------------------------------------------------------

namespace {

// A strand's weights of the first two guides; the third has the rest.
struct Place {
    float u;
    float v;
};

// A number in [0, 1), as unitFloat() of common/random.glsl.
float unitFloat(std::uint32_t bits) { return static_cast<float>(bits >> 8u) * 0x1p-24f; }

// rootWeights() of strands/roots.glsl.
Place folded(float u, float v) { return u > 1.0f - v ? Place{1.0f - u, 1.0f - v} : Place{u, v}; }

int heaviest(const Place& place) {
    const float w = 1.0f - place.u - place.v;
    if (place.u >= place.v && place.u >= w) return 0;
    return place.v >= w ? 1 : 2;
}

// Half of the sum of the weights' differences.
float weightsApart(const Place& a, const Place& b) {
    const float u = std::abs(a.u - b.u);
    const float v = std::abs(a.v - b.v);
    return std::max({u, v, std::abs(a.u - b.u + a.v - b.v)});
}

// The least of the weights: in the measure of weightsApart(), the distance to the nearest edge.
float distanceToEdge(const Place& place) {
    return std::min({place.u, place.v, 1.0f - place.u - place.v});
}

// Puts the places in their order, `strands`, and returns their covering. The next strand is the
// one that is farthest from all before it and from the edges, where strands of the neighbours are.
// `nearest` has room for all.
float orderCluster(
    std::span<const Place> places, bool follows_one, std::span<float> nearest,
    std::span<std::uint32_t> strands) {
    const auto apart = [&](std::size_t a, std::size_t b) {
        const bool differ = follows_one && heaviest(places[a]) != heaviest(places[b]);
        return weightsApart(places[a], places[b]) + (differ ? 2.0f : 0.0f);
    };
    // Beyond an edge, a neighbour's strand may be as far from it.
    const auto room = [&](std::size_t i) {
        return std::min(nearest[i], 2.0f * distanceToEdge(places[i]));
    };
    std::ranges::fill(nearest, std::numeric_limits<float>::max());
    std::size_t next = 0;
    for (std::size_t i = 1; i < places.size(); ++i)
        if (room(i) > room(next)) next = i;
    float covering = 0.0f;
    for (std::size_t kept = 0; kept < places.size(); ++kept) {
        strands[kept] = static_cast<std::uint32_t>(next);
        const std::size_t newest = next;
        float farthest = 0.0f;
        float most = -std::numeric_limits<float>::max();
        for (std::size_t i = 0; i < places.size(); ++i) {
            if (nearest[i] < 0.0f) continue;  // kept, and not again if another is at its place
            nearest[i] = i == newest ? -1.0f : std::min(nearest[i], apart(i, newest));
            if (i == newest) continue;
            farthest = std::max(farthest, nearest[i]);
            if (room(i) <= most) continue;
            most = room(i);
            next = i;
        }
        covering = std::max(covering, std::sqrt(static_cast<float>(kept + 2)) * farthest);
    }
    return covering;
}

}  // namespace

ClusterOrder
orderClusters(std::uint32_t seed, std::uint32_t triangles, const StrandSettings& settings) {
    constexpr float kRounding = 1.0f + 1e-5f;
    const std::uint32_t density = settings.density;
    const bool follows_one =
        settings.interpolation != Interpolation::multi || settings.collision_rule;
    ClusterOrder order;
    order.strands.resize(std::size_t{triangles} * density);
    order.coverings.reserve(triangles);
    std::vector<glm::vec2> pattern;
    if (settings.randomness == Randomness::thesis) pattern = thesisRootPattern(density);
    std::vector<Place> places(density);
    std::vector<float> nearest(density);
    for (std::uint32_t triangle = 0; triangle < triangles; ++triangle) {
        const std::uint32_t key = hash(seed, triangle, gpu::kRootPurpose);
        for (std::uint32_t strand = 0; strand < density; ++strand) {
            const std::uint32_t bits = pcg(key + strand);
            places[strand] = pattern.empty() ? folded(unitFloat(bits), unitFloat(pcg(bits)))
                                             : folded(pattern[strand].x, pattern[strand].y);
        }
        const auto strands =
            std::span(order.strands).subspan(std::size_t{triangle} * density, density);
        order.coverings.push_back(kRounding * orderCluster(places, follows_one, nearest, strands));
    }
    return order;
}

// ---- The published program's random pairs -------------------------------------------------------

// Thesis program 2.4; there the strand is gl_TessCoord.y.
std::vector<glm::vec2> thesisRootPattern(std::uint32_t density) {
    std::vector<glm::vec2> pairs;
    pairs.reserve(density);
    for (std::uint32_t strand = 0; strand < density; ++strand) {
        const double isoline = static_cast<double>(strand) / density;
        pairs.emplace_back(thesisRandom(isoline, 0.6), thesisRandom(isoline, -0.4));
    }
    return pairs;
}

}  // namespace hair::rendering
