#include "hair/rendering/environment.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <span>

#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include "engine/transfer.h"

namespace hair::rendering {

// ---- Lights -------------------------------------------------------------------------------------

namespace {

gpu::Light makeLight(const RenderSettings& render, const LightSettings& light) {
    gpu::Light result{
        .position = light.position,
        .type = gpu::kLightPoint,
        .to_light = {},
        .radius = 0.0f,
        .color = light.strength * workingColor(render, light.color),
        .reference_distance = light.reference_distance,
        .half_width = {},
        .half_height = {}};
    if (light.type == LightType::directional) {
        result.type = gpu::kLightDirectional;
        result.to_light = -glm::normalize(light.direction);
        result.radius = glm::radians(light.angular_radius);
        result.reference_distance = 0.0f;
    }
    if (light.type == LightType::sphere) {
        result.type = gpu::kLightSphere;
        result.radius = light.radius;
    }
    if (light.type == LightType::rectangle) {
        const RectangleFace face = rectangleFace(light);
        result.type = gpu::kLightRectangle;
        result.to_light = -face.normal;
        result.half_width = face.half_width;
        result.half_height = face.half_height;
        // In front of its middle, irradiance / pi is the radiance times the form factor.
        if (light.reference_distance > 0.0f)
            result.color /= static_cast<float>(rectangleFormFactor(light));
    }
    return result;
}

}  // namespace

static_assert(gpu::kNearDepth == engine::kNearDepth && gpu::kFarDepth == engine::kFarDepth);

glm::mat4 viewProjection(const CameraSettings& camera, float aspect) {
    // glm's depth is 0 at the first plane and 1 at the second.
    static_assert(engine::kFarDepth == 0.0f && engine::kNearDepth == 1.0f);
    glm::mat4 projection = glm::perspectiveRH_ZO(
        glm::radians(camera.field_of_view), aspect, camera.far_plane, camera.near_plane);
    projection[1][1] = -projection[1][1];
    return projection * glm::lookAtRH(camera.position, camera.target, camera.up);
}

RectangleFace rectangleFace(const LightSettings& light) {
    const glm::vec3 normal = glm::normalize(light.direction);
    glm::vec3 up = light.up - glm::dot(light.up, normal) * normal;
    if (glm::length(up) <= 1e-4f * glm::length(light.up)) up = glm::vec3(1, 0, 0);
    up = glm::normalize(up - glm::dot(up, normal) * normal);
    return {
        .normal = normal,
        .half_width = 0.5f * light.width * glm::cross(normal, up),
        .half_height = 0.5f * light.height * up};
}

double rectangleFormFactor(const LightSettings& light) {
    const double distance{light.reference_distance};
    const double x = 0.5 * double{light.width} / distance;
    const double y = 0.5 * double{light.height} / distance;
    const double by_x = std::sqrt(1.0 + x * x);
    const double by_y = std::sqrt(1.0 + y * y);
    return 2.0 / std::numbers::pi *
           (x / by_x * std::atan(y / by_x) + y / by_y * std::atan(x / by_y));
}

static_assert(offsetof(gpu::Light, half_width) == 48 && sizeof(gpu::Light) == 72);

std::vector<gpu::Light> makeLights(const Settings& settings) {
    std::vector<gpu::Light> lights;
    for (const LightSettings& light : settings.shading.lights)
        lights.push_back(makeLight(settings.render, light));
    return lights;
}

std::uint32_t shadowMaps(const LightSettings& light) {
    const bool sized = (light.type == LightType::sphere && light.radius > 0.0f) ||
                       light.type == LightType::rectangle ||
                       (light.type == LightType::directional && light.angular_radius > 0.0f);
    return sized && light.shadows ? light.shadow_samples : 1;
}

std::uint32_t lightKinds(const Settings& settings) {
    std::uint32_t kinds = 0;
    for (const LightSettings& light : settings.shading.lights)
        if (shadowMaps(light) > 1) kinds |= gpu::kSomeSampled;
    for (const gpu::Light& light : makeLights(settings)) {
        if (light.type == gpu::kLightRectangle) kinds |= gpu::kSomeRectangles | gpu::kSomeSpheres;
        if (light.type == gpu::kLightDirectional) kinds |= gpu::kSomeDirectional;
        const bool distant = light.type == gpu::kLightDirectional;
        if (light.type == gpu::kLightSphere || (distant && light.radius > 0.0f))
            kinds |= gpu::kSomeSpheres;
        if (light.reference_distance > 0.0f) kinds |= gpu::kSomeAttenuate;
    }
    return kinds;
}

// ---- The environment ----------------------------------------------------------------------------

namespace {

std::array<double, 9> harmonics(const glm::dvec3& n) {
    return {
        0.282095,
        0.488603 * n.y,
        0.488603 * n.z,
        0.488603 * n.x,
        1.092548 * n.x * n.y,
        1.092548 * n.y * n.z,
        0.315392 * (3 * n.z * n.z - 1),
        1.092548 * n.x * n.z,
        0.546274 * (n.x * n.x - n.y * n.y)};
}

// The cosine lobe's harmonics over pi, by l: Ramamoorthi and Hanrahan 2001, eq. 8.
constexpr std::array kLobe{1.0, 2.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0, 0.25, 0.25, 0.25, 0.25, 0.25};

static_assert(offsetof(gpu::EnvironmentParameters, irradiance) == 20);
static_assert(sizeof(gpu::EnvironmentParameters) == 128);

// Radiance is clamped to this. A half-precision file holds a sun of up to 65504.
constexpr float kBrightest = 1e6f;

// The picture's radiance times the strength, clamped to [0, kBrightest]; NaN becomes 0.
engine::FloatPixels soundLight(engine::FloatPixels picture, float strength) {
    for (float& value : picture.rgb) {
        value *= strength;
        value = value > 0.0f ? std::min(value, kBrightest) : 0.0f;
    }
    return picture;
}

gpu::EnvironmentParameters
parametersOf(const engine::FloatPixels& light, float turn, std::uint64_t texels) {
    gpu::EnvironmentParameters parameters{
        .texels = texels,
        .width = light.width,
        .height = light.height,
        .turn = turn,
        .irradiance = {}};
    const std::array harmonics = irradianceHarmonics(light, double{turn});
    std::ranges::copy(harmonics, parameters.irradiance);
    return parameters;
}

struct TexelLight {
    glm::dvec3 light;  // radiance times solid angle
    double solid_angle;
};

// Calls f(direction, light) for each texel: the direction of its middle, unit length, and its
// light.
template <class Function>
void forEachTexel(const engine::FloatPixels& picture, double turn, Function f) {
    using std::numbers::pi;
    const float* texel = picture.rgb.data();
    for (std::uint32_t row = 0; row < picture.height; ++row) {
        const double top = pi * row / picture.height;
        const double bottom = pi * (row + 1) / picture.height;
        const double solid_angle = 2 * pi / picture.width * (std::cos(top) - std::cos(bottom));
        const double polar = (top + bottom) / 2;
        for (std::uint32_t column = 0; column < picture.width; ++column, texel += 3) {
            const double azimuth = turn + 2 * pi * (0.5 - (column + 0.5) / picture.width);
            const glm::dvec3 direction{
                std::sin(polar) * std::sin(azimuth), std::cos(polar),
                std::sin(polar) * std::cos(azimuth)};
            f(direction,
              TexelLight{solid_angle * glm::dvec3(texel[0], texel[1], texel[2]), solid_angle});
        }
    }
}

// Light of some of an environment's directions.
struct LightCluster {
    glm::dvec3 light{0};  // radiance times solid angle
    double weight = 0;  // the mean of its channels
    glm::dvec3 moment{0};  // sum of weight times direction
    double solid_angle = 0;

    void add(const LightCluster& other) {
        light += other.light;
        weight += other.weight;
        moment += other.moment;
        solid_angle += other.solid_angle;
    }
    // The direction that the irradiance comes from.
    glm::dvec3 centroid() const {
        const double length = glm::length(moment);
        return length > 1e-9 * weight ? moment / length : glm::dvec3(0, 1, 0);
    }
    // The weight times 1 - the mean cosine with the centroid.
    double spread() const { return weight - glm::length(moment); }
};

// Sums of the picture's texels over at most 128 x 64 cells, without the dark ones.
std::vector<LightCluster> cellsOf(const engine::FloatPixels& picture, double turn) {
    const std::uint32_t columns = std::min(picture.width, 128u);
    const std::uint32_t rows = std::min(picture.height, 64u);
    std::vector<LightCluster> cells(std::size_t{columns} * rows);
    std::size_t texel = 0;
    forEachTexel(picture, turn, [&](const glm::dvec3& direction, const TexelLight& at) {
        const std::size_t row = texel / picture.width * rows / picture.height;
        const std::size_t column = texel % picture.width * columns / picture.width;
        const double weight = (at.light.r + at.light.g + at.light.b) / 3;
        cells[row * columns + column].add({at.light, weight, weight * direction, at.solid_angle});
        ++texel;
    });
    std::erase_if(cells, [](const LightCluster& cell) { return cell.weight == 0; });
    return cells;
}

// Clusters of cells by k-means on the sphere: each cell belongs to the cluster with the nearest
// centroid, weighted by light.
class LightClusters {
public:
    explicit LightClusters(std::span<const LightCluster> cells) : cells_(cells) { assign({}); }

    const std::vector<LightCluster>& clusters() const { return clusters_; }
    double spread() const {
        double sum = 0;
        for (const LightCluster& cluster : clusters_) sum += cluster.spread();
        return sum;
    }

    // Divides the cluster with the widest light in two, across its longest axis.
    void split() {
        const auto widest = std::ranges::max_element(clusters_, {}, &LightCluster::spread);
        const auto index = static_cast<std::size_t>(widest - clusters_.begin());
        const glm::dvec3 axis = longestAxis(index);
        const glm::dvec3 mean = widest->moment / widest->weight;
        std::vector<glm::dvec3> centroids;
        for (const LightCluster& cluster : clusters_) centroids.push_back(cluster.centroid());
        std::array<LightCluster, 2> halves;
        for (std::size_t i = 0; i < cells_.size(); ++i)
            if (assignments_[i] == index)
                halves[glm::dot(cells_[i].centroid() - mean, axis) > 0 ? 1 : 0].add(cells_[i]);
        centroids[index] = halves[0].centroid();
        centroids.push_back(halves[1].centroid());
        assign(centroids);
    }

    void iterate(int times) {
        for (int i = 0; i < times; ++i) {
            std::vector<glm::dvec3> centroids;
            for (const LightCluster& cluster : clusters_) centroids.push_back(cluster.centroid());
            assign(centroids);
        }
    }

private:
    // Without centroids, all cells are one cluster. Clusters without a cell disappear.
    void assign(std::span<const glm::dvec3> centroids) {
        std::vector<LightCluster> clusters(std::max<std::size_t>(centroids.size(), 1));
        assignments_.resize(cells_.size());
        for (std::size_t i = 0; i < cells_.size(); ++i) {
            const glm::dvec3 direction = cells_[i].centroid();
            const auto nearest =
                std::ranges::max_element(centroids, {}, [&](const glm::dvec3& centroid) {
                    return glm::dot(centroid, direction);
                });
            assignments_[i] =
                centroids.empty() ? 0 : static_cast<std::size_t>(nearest - centroids.begin());
            clusters[assignments_[i]].add(cells_[i]);
        }
        std::vector<std::size_t> kept(clusters.size());
        clusters_.clear();
        for (std::size_t i = 0; i < clusters.size(); ++i) {
            kept[i] = clusters_.size();
            if (clusters[i].weight > 0) clusters_.push_back(clusters[i]);
        }
        for (std::size_t& assignment : assignments_) assignment = kept[assignment];
    }

    // The axis of the greatest variance of a cluster's directions, by the power method.
    glm::dvec3 longestAxis(std::size_t cluster) const {
        const glm::dvec3 mean = clusters_[cluster].moment / clusters_[cluster].weight;
        glm::dmat3 variance(0);
        for (std::size_t i = 0; i < cells_.size(); ++i) {
            if (assignments_[i] != cluster) continue;
            const glm::dvec3 offset = cells_[i].centroid() - mean;
            variance += cells_[i].weight * glm::outerProduct(offset, offset);
        }
        glm::dvec3 axis = glm::normalize(glm::dvec3(0.8, 0.53, 0.29));  // along no likely axis
        for (int i = 0; i < 30; ++i) {
            const glm::dvec3 next = variance * axis;
            if (!(glm::length(next) > 0)) break;
            axis = glm::normalize(next);
        }
        return axis;
    }

    std::span<const LightCluster> cells_;
    std::vector<std::size_t> assignments_;  // [cell], its cluster
    std::vector<LightCluster> clusters_;
};

// Lights whose directions are within a mean cosine of 1 - this, some 8 degrees, need no more
// clusters:
// hair's narrowest lobes are about as wide.
constexpr double kNarrow = 0.005;

std::vector<LightCluster> clustersOf(std::span<const LightCluster> cells, std::uint32_t count) {
    LightClusters clusters(cells);
    double weight = 0;
    for (const LightCluster& cell : cells) weight += cell.weight;
    while (clusters.clusters().size() < count && clusters.spread() > kNarrow * weight) {
        const std::size_t before = clusters.clusters().size();
        clusters.split();
        if (clusters.clusters().size() == before) break;
        clusters.iterate(3);
    }
    clusters.iterate(12);
    std::vector<LightCluster> result = clusters.clusters();
    std::ranges::sort(result, std::ranges::greater(), &LightCluster::weight);
    return result;
}

// How much wider discs are than the light of their cluster, from 1 to the root of 2. Discs of even
// light would leave dark gaps between them, so they have twice the area. Uneven light, with a mean
// square of its radiance of 1.5 times the squared mean or more, keeps its contrast.
double widening(std::span<const LightCluster> cells) {
    double weight = 0;
    double squares = 0;
    for (const LightCluster& cell : cells) {
        weight += cell.weight;
        squares += cell.weight * cell.weight / cell.solid_angle;
    }
    const double unevenness = 4 * std::numbers::pi * squares / (weight * weight) - 1;
    return std::lerp(std::numbers::sqrt2, 1.0, std::clamp(2 * unevenness, 0.0, 1.0));
}

}  // namespace

// ---- Irradiance ---------------------------------------------------------------------------------

std::array<glm::dvec3, 9> irradianceHarmonics(const engine::FloatPixels& picture, double turn) {
    std::array<glm::dvec3, 9> sums{};
    forEachTexel(picture, turn, [&](const glm::dvec3& direction, const TexelLight& at) {
        const std::array basis = harmonics(direction);
        for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += basis[i] * at.light;
    });
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] *= kLobe[i];
    return sums;
}

// ---- Lights -------------------------------------------------------------------------------------

std::vector<LightSettings> environmentLights(
    const engine::FloatPixels& picture, const RenderSettings& render, std::uint32_t count) {
    const engine::FloatPixels light = soundLight(picture, render.environment_strength);
    const std::vector<LightCluster> cells =
        cellsOf(light, glm::radians(double{render.environment_turn}));
    if (cells.empty()) return {};
    const double wider = widening(cells);
    std::vector<LightSettings> lights;
    for (const LightCluster& cluster : clustersOf(cells, count)) {
        // A light's colour is irradiance / pi, split into display RGB up to 1 and a strength.
        const glm::dvec3 color = cluster.light / std::numbers::pi;
        const double strength = std::max({color.r, color.g, color.b, 1e-12});
        const glm::dvec3 share = color / strength;
        const bool is_linear = hasLinearLight(render);
        // The mean cosine of a cap's directions with its middle is (1 + cos r) / 2.
        const double cosine = 1 - 2 * cluster.spread() / cluster.weight;
        const double radius = wider * std::acos(std::clamp(cosine, -1.0, 1.0));
        lights.push_back(
            {.type = LightType::directional,
             .direction = glm::vec3(-cluster.centroid()),
             .color = glm::vec3(is_linear ? toDisplay(share) : toDisplay(color)),
             .strength = is_linear ? static_cast<float>(strength) : 1.0f,
             .angular_radius = static_cast<float>(std::min(glm::degrees(radius), 90.0))});
    }
    return lights;
}

// ---- The pass -----------------------------------------------------------------------------------

EnvironmentPass::EnvironmentPass(
    const engine::Device& device, const Settings& settings, const RenderAssets& assets) {
    if (!assets.environment) return;
    const RenderSettings& render = settings.render;
    const engine::FloatPixels light = soundLight(*assets.environment, render.environment_strength);
    texels_ = engine::makeBuffer(device, light.rgb, "environment", "shading");
    const gpu::EnvironmentParameters parameters =
        parametersOf(light, glm::radians(render.environment_turn), texels_.address());
    parameters_ =
        engine::makeBuffer(device, std::array{parameters}, rows(), "environment parameters");
    background_.emplace(
        device, engine::GraphicsDescription{
                    .shaders = {"environment/background.vert", "environment/background.frag"},
                    .constants = {{gpu::kBackgroundLinearLightConstant, hasLinearLight(render)}},
                    .push_size = sizeof(gpu::EnvironmentPush),
                    .colors = {{colorFormat(render)}},
                    .depth_format = engine::Target::kDepthFormat,
                    .samples = render.msaa,
                    .depth_compare = engine::kIsNearerOrEqual,
                    .depth_write = false});
}

void EnvironmentPass::draw(engine::Commands& commands, std::uint64_t picture) const {
    if (!background_) return;
    commands.bind(*background_, gpu::EnvironmentPush{.picture = picture, .environment = address()});
    commands.draw({.vertices = 3});
}

}  // namespace hair::rendering
