#include "hair/reference/path_tracer.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <thread>
#include <utility>

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "hair/reference/fiber.h"

namespace hair::reference {
// The namespace has a name, because the class below has members of these types, and files are
// compiled together.
inline namespace path_tracer {

constexpr double kTracedPi = std::numbers::pi;
constexpr double kNoHit = std::numeric_limits<double>::infinity();

// ---- Random numbers -----------------------------------------------------------------------------

// SplitMix64; Steele, Lea and Flood 2014, Fast splittable pseudorandom number generators. A path
// through much hair needs more numbers than the 2^24 values of random01() tell apart.
class SplitMix {
public:
    explicit SplitMix(std::uint64_t seed) : state_(seed) {}

    std::uint64_t bits() {
        state_ += 0x9e3779b97f4a7c15u;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30u)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27u)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31u);
    }
    double number() { return static_cast<double>(bits() >> 11u) * 0x1p-53; }  // in [0, 1)

private:
    std::uint64_t state_;
};

// ---- Fibres -------------------------------------------------------------------------------------

struct Ray {
    glm::dvec3 origin;
    glm::dvec3 direction;  // unit

    glm::dvec3 at(double t) const { return origin + t * direction; }
};

// A piece of a fibre: a round cone about the axis from a to b, ended by the two planes. The pieces
// of a strand share planes, so that they join without gap or overlap.
struct Piece {
    glm::dvec4 a;  // w: radius
    glm::dvec4 b;
    glm::dvec3 plane_a;  // unit normals towards the tip; also the strand's tangents
    glm::dvec3 plane_b;
    std::uint32_t span;  // between knots, of all curves
};

// Largest distance of a chord from its B-spline span, over the radius. Determines the number of
// chords.
constexpr double kChordError = 0.02;
constexpr int kMostChords = 16;

// Returns the uniform cubic B-spline from knot `span` on, u in [0, 1].
glm::dvec4 splinePoint(std::span<const glm::dvec4> control, std::size_t span, double u) {
    const double v = 1 - u;
    return (v * v * v * control[span] + (3 * u * u * u - 6 * u * u + 4) * control[span + 1] +
            (3 * v * v * v - 6 * v * v + 4) * control[span + 2] + u * u * u * control[span + 3]) /
           6.0;
}

// The second derivative of a span interpolates between its second differences. A chord's distance
// from its arc is at most an eighth of the derivative over the square of the number of chords.
int chordsOfSpan(std::span<const glm::dvec4> control, std::size_t span) {
    const auto bend = [&](std::size_t i) {
        return glm::length(glm::dvec3(control[i] - 2.0 * control[i + 1] + control[i + 2]));
    };
    const double radius = std::max(control[span + 1].w, control[span + 2].w);
    if (radius <= 0) return 1;
    const double chords =
        std::sqrt(std::max(bend(span), bend(span + 1)) / (8 * kChordError * radius));
    return std::clamp(static_cast<int>(std::ceil(chords)), 1, kMostChords);
}

// `spans`: the number of spans of the curves before this one; those of this one are added.
void addPieces(
    std::vector<Piece>& pieces, std::span<const glm::dvec4> control, std::uint32_t& spans) {
    std::vector<glm::dvec4> points;
    std::vector<std::uint32_t> ends_span;  // [point], the span that it ends
    for (std::size_t span = 0; span + 3 < control.size(); ++span) {
        const int chords = chordsOfSpan(control, span);
        for (int i = span == 0 ? 0 : 1; i <= chords; ++i) {
            const glm::dvec4 point = splinePoint(control, span, double(i) / chords);
            if (!points.empty() && glm::dvec3(point) == glm::dvec3(points.back())) continue;
            points.push_back(point);
            ends_span.push_back(spans);
        }
        ++spans;
    }
    const auto along = [&](std::size_t i) {
        return glm::normalize(glm::dvec3(points[i + 1] - points[i]));
    };
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const glm::dvec3 begin = i == 0 ? along(i) : glm::normalize(along(i - 1) + along(i));
        const glm::dvec3 end =
            i + 2 == points.size() ? along(i) : glm::normalize(along(i) + along(i + 1));
        pieces.push_back({points[i], points[i + 1], begin, end, ends_span[i + 1]});
    }
}

// Returns where a ray enters the piece, beyond `begin`; kNoHit if it doesn't.
double intersectPiece(const Piece& piece, const Ray& ray, double begin) {
    const glm::dvec3 a(piece.a);
    const glm::dvec3 offset = glm::dvec3(piece.b) - a;
    const double length = glm::length(offset);
    const glm::dvec3 axis = offset / length;
    const double slope = (piece.b.w - piece.a.w) / length;

    // Solves |part of origin + t direction across the axis|^2 = radius^2 at that point.
    const glm::dvec3 from = ray.origin - a;
    const double from_along = glm::dot(from, axis);
    const double along = glm::dot(ray.direction, axis);
    const glm::dvec3 from_across = from - from_along * axis;
    const glm::dvec3 across = ray.direction - along * axis;
    const double radius = piece.a.w + slope * from_along;
    const double change = slope * along;
    const double square = glm::dot(across, across) - change * change;
    if (square <= 0) return kNoHit;
    const double half = glm::dot(from_across, across) - change * radius;
    const double rest = glm::dot(from_across, from_across) - radius * radius;
    const double discriminant = half * half - square * rest;
    if (discriminant <= 0) return kNoHit;
    const double t = (-half - std::sqrt(discriminant)) / square;
    if (!(t > begin)) return kNoHit;
    const glm::dvec3 point = ray.at(t);
    const bool within = glm::dot(point - a, piece.plane_a) >= 0 &&
                        glm::dot(point - glm::dvec3(piece.b), piece.plane_b) < 0;
    return within ? t : kNoHit;
}

// ---- Triangles ----------------------------------------------------------------------------------

struct Corners {
    std::uint32_t mesh;
    std::uint32_t triangle;
};

struct TriangleHit {
    double t = kNoHit;
    double v = 0;  // barycentric coordinates of the second and third corner
    double w = 0;
};

// Möller and Trumbore 1997, Fast, minimum storage ray/triangle intersection.
TriangleHit intersectTriangle(
    const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const Ray& ray, double begin) {
    const glm::dvec3 ab = b - a;
    const glm::dvec3 ac = c - a;
    const glm::dvec3 p = glm::cross(ray.direction, ac);
    const double determinant = glm::dot(ab, p);
    if (determinant == 0) return {};
    const glm::dvec3 from = ray.origin - a;
    const double v = glm::dot(from, p) / determinant;
    const glm::dvec3 q = glm::cross(from, ab);
    const double w = glm::dot(ray.direction, q) / determinant;
    const double t = glm::dot(ac, q) / determinant;
    if (v < 0 || w < 0 || v + w > 1 || !(t > begin)) return {};
    return {t, v, w};
}

// Returns where a ray enters a sphere, beyond `begin`.
double intersectSphere(const SphereLight& sphere, const Ray& ray, double begin) {
    const glm::dvec3 from = ray.origin - sphere.center;
    const double half = glm::dot(from, ray.direction);
    const double rest = glm::dot(from, from) - sphere.radius * sphere.radius;
    const double discriminant = half * half - rest;
    if (discriminant <= 0) return kNoHit;
    const double t = -half - std::sqrt(discriminant);
    return t > begin ? t : kNoHit;
}

// ---- Boxes --------------------------------------------------------------------------------------

struct TracedBox {
    glm::dvec3 lower{kNoHit};
    glm::dvec3 upper{-kNoHit};

    void add(const glm::dvec3& a, const glm::dvec3& b) {
        lower = glm::min(lower, a);
        upper = glm::max(upper, b);
    }
    void add(const TracedBox& box) { add(box.lower, box.upper); }
    glm::dvec3 middle() const { return 0.5 * (lower + upper); }

    // Returns where the ray enters the box, kNoHit if not before `end`.
    double intersect(const glm::dvec3& origin, const glm::dvec3& inverse, double end) const {
        const glm::dvec3 one = (lower - origin) * inverse;
        const glm::dvec3 other = (upper - origin) * inverse;
        const glm::dvec3 in = glm::min(one, other);
        const glm::dvec3 out = glm::max(one, other);
        const double first = std::max({in.x, in.y, in.z, 0.0});
        const double last = std::min({out.x, out.y, out.z, end});
        return first <= last ? first : kNoHit;
    }
};

// A ray may hit the round ends beyond the axis's ends, where the planes slant.
TracedBox boxOfPiece(const Piece& piece) {
    TracedBox box;
    for (const glm::dvec4& end : {piece.a, piece.b}) {
        const glm::dvec3 around(2 * std::max(piece.a.w, piece.b.w));
        box.add(glm::dvec3(end) - around, glm::dvec3(end) + around);
    }
    return box;
}

struct Node {
    TracedBox box;
    std::uint32_t begin = 0;  // first item of a leaf; second child of an inner node
    std::uint32_t count = 0;  // 0: an inner node; its first child is the next node
};

constexpr std::uint32_t kLeafPrimitives = 4;

// A BVH that splits at the median of the boxes' centres along the longest side.
class Bvh {
public:
    explicit Bvh(std::span<const TracedBox> boxes) : order_(boxes.size()) {
        for (std::uint32_t i = 0; i < order_.size(); ++i) order_[i] = i;
        if (!boxes.empty()) split(boxes, 0, static_cast<std::uint32_t>(boxes.size()));
    }

    // visit(primitive, end) returns the new end of the ray. A negative end stops the traversal.
    template <class Visit>
    void traverse(const Ray& ray, double end, const Visit& visit) const {
        if (nodes_.empty()) return;
        const glm::dvec3 inverse = 1.0 / ray.direction;
        std::array<std::uint32_t, 64> stack;
        std::size_t left = 0;
        stack[left++] = 0;
        while (left > 0) {
            const std::uint32_t index = stack[--left];
            const Node& node = nodes_[index];
            if (node.box.intersect(ray.origin, inverse, end) == kNoHit) continue;
            for (std::uint32_t i = 0; i < node.count; ++i) {
                end = visit(order_[node.begin + i], end);
                if (end < 0) return;
            }
            if (node.count > 0) continue;
            std::uint32_t near = index + 1;
            std::uint32_t far = node.begin;
            if (nodes_[far].box.intersect(ray.origin, inverse, end) <
                nodes_[near].box.intersect(ray.origin, inverse, end))
                std::swap(near, far);
            stack[left++] = far;
            stack[left++] = near;
        }
    }

private:
    void split(std::span<const TracedBox> boxes, std::uint32_t begin, std::uint32_t end) {
        const auto index = static_cast<std::uint32_t>(nodes_.size());
        Node node;
        TracedBox middles;
        for (std::uint32_t i = begin; i < end; ++i) {
            const glm::dvec3 middle = boxes[order_[i]].middle();
            node.box.add(boxes[order_[i]]);
            middles.add(middle, middle);
        }
        const bool leaf = end - begin <= kLeafPrimitives;
        if (leaf) {
            node.begin = begin;
            node.count = end - begin;
        }
        nodes_.push_back(node);
        if (leaf) return;
        const glm::dvec3 sides = middles.upper - middles.lower;
        int side = sides.y > sides.x ? 1 : 0;
        if (sides.z > sides[side]) side = 2;
        const std::uint32_t middle = begin + (end - begin) / 2;
        std::nth_element(
            order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
            [&](std::uint32_t a, std::uint32_t b) {
                return boxes[a].middle()[side] < boxes[b].middle()[side];
            });
        split(boxes, begin, middle);
        nodes_[index].begin = static_cast<std::uint32_t>(nodes_.size());
        split(boxes, middle, end);
    }

    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
};

}  // namespace path_tracer

// ---- Surfaces -----------------------------------------------------------------------------------

class PathTracer::Surfaces {
public:
    struct Hit {
        double t = kNoHit;
        std::uint32_t primitive = 0;
        double v = 0;  // of a triangle: barycentric
        double w = 0;
    };

    explicit Surfaces(const TracedScene& scene)
        : scene_(scene), pieces_(piecesOf(scene)), corners_(cornersOf(scene)),
          tree_(boxes(scene, pieces_, corners_)) {
        for (const Piece& piece : pieces_)
            ray_offset_ = std::max(ray_offset_, kRayOffset * piece.a.w);
    }

    bool isFiber(const Hit& hit) const { return hit.primitive < pieces_.size(); }
    const Piece& piece(const Hit& hit) const { return pieces_[hit.primitive]; }
    const Corners& corners(const Hit& hit) const {
        return corners_[hit.primitive - pieces_.size()];
    }

    Hit closestHit(const Ray& ray) const {
        Hit hit;
        tree_.traverse(ray, kNoHit, [&](std::uint32_t primitive, double end) {
            const Hit other = intersect(ray, primitive);
            if (!(other.t < end)) return end;
            hit = other;
            return other.t;
        });
        return hit;
    }

    bool isUnoccluded(const Ray& ray, double end) const {
        bool free = true;
        tree_.traverse(ray, end, [&](std::uint32_t primitive, double within) {
            free = !(intersect(ray, primitive).t < within);
            return free ? within : -1.0;
        });
        return free;
    }

    // Rays that leave a surface hit nothing nearer than this, which is far above rounding.
    double begin() const { return ray_offset_; }

private:
    static constexpr double kRayOffset = 1e-4;  // of the widest fibre's radius

    Hit intersect(const Ray& ray, std::uint32_t primitive) const {
        if (primitive < pieces_.size())
            return {intersectPiece(pieces_[primitive], ray, ray_offset_), primitive};
        const Corners& corners = corners_[primitive - pieces_.size()];
        const MattMesh& mesh = scene_.meshes[corners.mesh];
        const auto& [a, b, c] = mesh.triangles[corners.triangle];
        const TriangleHit hit = intersectTriangle(
            mesh.positions[a], mesh.positions[b], mesh.positions[c], ray, ray_offset_);
        return {hit.t, primitive, hit.v, hit.w};
    }

    static std::vector<Piece> piecesOf(const TracedScene& scene) {
        std::vector<Piece> pieces;
        std::uint32_t spans = 0;
        for (const auto& control : scene.curves) addPieces(pieces, control, spans);
        return pieces;
    }

    static std::vector<Corners> cornersOf(const TracedScene& scene) {
        std::vector<Corners> corners;
        for (std::uint32_t mesh = 0; mesh < scene.meshes.size(); ++mesh)
            for (std::uint32_t i = 0; i < scene.meshes[mesh].triangles.size(); ++i)
                corners.push_back({mesh, i});
        return corners;
    }

    static std::vector<TracedBox> boxes(
        const TracedScene& scene, std::span<const Piece> pieces, std::span<const Corners> corners) {
        std::vector<TracedBox> boxes;
        boxes.reserve(pieces.size() + corners.size());
        for (const Piece& piece : pieces) boxes.push_back(boxOfPiece(piece));
        for (const Corners& its : corners) {
            TracedBox box;
            const MattMesh& mesh = scene.meshes[its.mesh];
            for (const std::uint32_t corner : mesh.triangles[its.triangle])
                box.add(mesh.positions[corner], mesh.positions[corner]);
            boxes.push_back(box);
        }
        return boxes;
    }

    const TracedScene& scene_;
    std::vector<Piece> pieces_;
    std::vector<Corners> corners_;
    Bvh tree_;
    double ray_offset_ = 1e-12;  // m, if there are no fibres
};

// ---- Paths --------------------------------------------------------------------------------------

inline namespace path_tracer {

// Axes at a point of a fibre, as in fiber.h: x towards the tip, y outwards.
struct FiberAxes {
    glm::dvec3 x;
    glm::dvec3 y;
    glm::dvec3 z;

    glm::dvec3 local(const glm::dvec3& w) const {
        return {glm::dot(w, x), glm::dot(w, y), glm::dot(w, z)};
    }
    glm::dvec3 world(const glm::dvec3& w) const { return w.x * x + w.y * y + w.z * z; }
};

// The tangent is interpolated linearly between a piece's root and tip.
FiberAxes axesAt(const Piece& piece, const glm::dvec3& point) {
    const glm::dvec3 a(piece.a);
    const glm::dvec3 offset = glm::dvec3(piece.b) - a;
    const double along =
        std::clamp(glm::dot(point - a, offset) / glm::dot(offset, offset), 0.0, 1.0);
    const glm::dvec3 x = glm::normalize(glm::mix(piece.plane_a, piece.plane_b, along));
    const glm::dvec3 outward = point - (a + along * offset);
    const glm::dvec3 y = glm::normalize(outward - glm::dot(outward, x) * x);
    return {x, y, glm::cross(x, y)};
}

// Returns two unit vectors perpendicular to a third.
std::array<glm::dvec3, 2> perpendicularAxes(const glm::dvec3& axis) {
    const glm::dvec3 other = std::abs(axis.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 first = glm::normalize(glm::cross(axis, other));
    return {first, glm::cross(axis, first)};
}

// Samples uniformly in a cone about `axis`, with cosines of `least` or more.
glm::dvec3 sampleCone(const glm::dvec3& axis, double least, SplitMix& random) {
    const double cosine = 1 - random.number() * (1 - least);
    const double sine = std::sqrt(std::max(1 - cosine * cosine, 0.0));
    const double angle = 2 * kTracedPi * random.number();
    const auto [first, second] = perpendicularAxes(axis);
    return cosine * axis + sine * (std::cos(angle) * first + std::sin(angle) * second);
}

}  // namespace path_tracer

class PathTracer::Paths {
public:
    Paths(const TracedScene& scene, const Surfaces& surfaces)
        : scene_(scene), surfaces_(surfaces) {}

    // Returns the radiance along the ray towards its origin.
    glm::dvec3 radiance(Ray ray, SplitMix& random) const {
        glm::dvec3 gathered(0);
        glm::dvec3 throughput(1);
        for (int bounces = 0; bounces < kMostBounces; ++bounces) {
            const Surfaces::Hit hit = surfaces_.closestHit(ray);
            const SphereLight* const sphere = nearestSphere(ray, hit.t);
            if (sphere && bounces == 0) gathered += sphere->radiance;
            if (sphere) break;  // its light on a surface is sampled at the surface
            if (hit.t == kNoHit) {
                gathered += throughput * scene_.background;
                break;
            }
            const glm::dvec3 point = ray.at(hit.t);
            const glm::dvec3 from = -ray.direction;
            const bool goes_on =
                surfaces_.isFiber(hit)
                    ? scatterAtFiber(
                          surfaces_.piece(hit), point, from, gathered, throughput, ray, random)
                    : scatterAtMesh(hit, point, from, gathered, throughput, ray, random);
            if (!goes_on || !survivesRoulette(bounces, throughput, random)) break;
        }
        return gathered;
    }

private:
    static constexpr int kRouletteStart = 8;
    static constexpr double kMostSurvival = 0.95;

    // Russian roulette.
    static bool survivesRoulette(int bounces, glm::dvec3& throughput, SplitMix& random) {
        const double most = std::max({throughput.r, throughput.g, throughput.b});
        if (!(most > 0)) return false;
        if (bounces < kRouletteStart) return true;
        const double likely = std::min(most, kMostSurvival);
        if (random.number() >= likely) return false;
        throughput /= likely;
        return true;
    }

    const SphereLight* nearestSphere(const Ray& ray, double end) const {
        const SphereLight* first = nullptr;
        for (const SphereLight& sphere : scene_.spheres) {
            const double t = intersectSphere(sphere, ray, surfaces_.begin());
            if (!(t < end)) continue;
            end = t;
            first = &sphere;
        }
        return first;
    }

    bool isUnoccluded(const Ray& ray, double end) const {
        return !nearestSphere(ray, end) && surfaces_.isUnoccluded(ray, end);
    }

    // Returns the light from all sources at a point, weighted by `scattered(wi)`: f |cos|.
    template <class Scattered>
    glm::dvec3
    directLight(const glm::dvec3& point, SplitMix& random, const Scattered& scattered) const {
        glm::dvec3 sum(0);
        const auto add = [&](const glm::dvec3& wi, double distance, const glm::dvec3& irradiance) {
            const glm::dvec3 light = irradiance * scattered(wi);
            if (light != glm::dvec3(0) && isUnoccluded({point, wi}, distance)) sum += light;
        };
        for (const PointLight& light : scene_.points) {
            const glm::dvec3 offset = light.position - point;
            const double distance = glm::length(offset);
            add(offset / distance, distance, light.intensity / (distance * distance));
        }
        for (const DirectionalLight& light : scene_.directions)
            add(-light.direction, kNoHit, light.irradiance);
        for (const SphereLight& light : scene_.spheres) {
            const glm::dvec3 offset = light.center - point;
            const double distance = glm::length(offset);
            if (distance <= light.radius) continue;
            const double sine = light.radius / distance;
            const double cosine = std::sqrt(1 - sine * sine);
            const glm::dvec3 wi = sampleCone(offset / distance, cosine, random);
            // 1 - cosine, without cancellation.
            const double solid_angle = 2 * kTracedPi * sine * sine / (1 + cosine);
            const double end = intersectSphere(light, {point, wi}, 0);
            if (end < kNoHit) add(wi, end * (1 - 1e-9), light.radiance * solid_angle);
        }
        return sum;
    }

    bool scatterAtFiber(
        const Piece& piece, const glm::dvec3& point, const glm::dvec3& from, glm::dvec3& gathered,
        glm::dvec3& throughput, Ray& ray, SplitMix& random) const {
        const FiberAxes axes = axesAt(piece, point);
        const glm::dvec3 wo = axes.local(from);
        // The azimuth of the normal, phi_o - asin(h), is 0.
        const double across_axis = std::hypot(wo.y, wo.z);
        const double h = across_axis > 0 ? std::clamp(wo.z / across_axis, -1.0, 1.0) : 0.0;
        Fiber fiber = scene_.fiber;
        if (!scene_.absorptions.empty()) fiber.absorption = scene_.absorptions[piece.span];
        gathered += throughput * directLight(point, random, [&](const glm::dvec3& wi) {
                        return scattering(fiber, wo, axes.local(wi), h);
                    });
        const std::array u{random.number(), random.number(), random.number(), random.number()};
        const glm::dvec3 wi = sampleDirection(fiber, wo, h, u);
        const double density = samplingPdf(fiber, wo, wi, h);
        if (!(density > 0)) return false;
        throughput *= scattering(fiber, wo, wi, h) / density;
        ray = {point, glm::normalize(axes.world(wi))};
        return true;
    }

    bool scatterAtMesh(
        const Surfaces::Hit& hit, const glm::dvec3& point, const glm::dvec3& from,
        glm::dvec3& gathered, glm::dvec3& throughput, Ray& ray, SplitMix& random) const {
        const Corners& corners = surfaces_.corners(hit);
        const MattMesh& mesh = scene_.meshes[corners.mesh];
        const auto& [a, b, c] = mesh.triangles[corners.triangle];
        glm::dvec3 normal = glm::normalize(
            (1 - hit.v - hit.w) * mesh.normals[a] + hit.v * mesh.normals[b] +
            hit.w * mesh.normals[c]);
        if (glm::dot(normal, from) <= 0) {
            if (mesh.sides == MattMesh::Sides::front) return false;
            normal = -normal;
        }
        gathered += throughput * directLight(point, random, [&](const glm::dvec3& wi) {
                        return mesh.reflectance * (std::max(glm::dot(normal, wi), 0.0) / kTracedPi);
                    });
        // Samples by the cosine: Malley's method.
        const double radius = std::sqrt(random.number());
        const double angle = 2 * kTracedPi * random.number();
        const auto [first, second] = perpendicularAxes(normal);
        const glm::dvec3 wi = radius * (std::cos(angle) * first + std::sin(angle) * second) +
                              std::sqrt(std::max(1 - radius * radius, 0.0)) * normal;
        throughput *= mesh.reflectance;
        ray = {point, glm::normalize(wi)};
        return true;
    }

    const TracedScene& scene_;
    const Surfaces& surfaces_;
};

// ---- Pictures -----------------------------------------------------------------------------------

PathTracer::PathTracer(const TracedScene& scene)
    : scene_(scene), surfaces_(std::make_unique<Surfaces>(scene)) {}

PathTracer::~PathTracer() = default;

TracedPicture
PathTracer::trace(const TracedCamera& camera, std::uint32_t samples, std::uint64_t seed) const {
    assert(samples >= 2);
    const Paths paths(scene_, *surfaces_);
    const glm::dvec3 forward = glm::normalize(camera.target - camera.position);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up));
    const glm::dvec3 up = glm::cross(right, forward);
    const double half_height = std::tan(glm::radians(camera.field_of_view) / 2);
    const double pixel = 2 * half_height / camera.height;

    const std::size_t count = std::size_t{camera.width} * camera.height;
    TracedPicture picture{std::vector<glm::dvec3>(count), std::vector<glm::dvec3>(count)};
    const auto tracePixel = [&](std::uint32_t row, std::uint32_t column) {
        const std::size_t index = std::size_t{row} * camera.width + column;
        SplitMix random(SplitMix(SplitMix(seed).bits() + index).bits());
        glm::dvec3 mean(0);
        glm::dvec3 squares(0);  // of the differences from the mean; Welford 1962
        for (std::uint32_t i = 0; i < samples; ++i) {
            const double x = column + random.number() - 0.5 * camera.width;
            const double y = row + random.number() - 0.5 * camera.height;
            const glm::dvec3 direction = glm::normalize(forward + pixel * (x * right - y * up));
            const glm::dvec3 light = paths.radiance({camera.position, direction}, random);
            const glm::dvec3 difference = light - mean;
            mean += difference / (i + 1.0);
            squares += difference * (light - mean);
        }
        picture.radiances[index] = mean;
        picture.variances[index] = squares / (samples - 1.0) / double(samples);
    };
    std::atomic<std::uint32_t> next_row = 0;
    const auto traceRows = [&] {
        for (std::uint32_t row = next_row++; row < camera.height; row = next_row++)
            for (std::uint32_t column = 0; column < camera.width; ++column) tracePixel(row, column);
    };
    {
        const std::jthread other(traceRows);
        traceRows();
    }
    return picture;
}

glm::dvec3 TracedPicture::mean() const {
    glm::dvec3 sum(0);
    for (const glm::dvec3& radiance : radiances) sum += radiance;
    return sum / static_cast<double>(radiances.size());
}

glm::dvec3 TracedPicture::standardError() const {
    glm::dvec3 sum(0);
    for (const glm::dvec3& variance : variances) sum += variance;
    return glm::sqrt(sum) / static_cast<double>(variances.size());
}

}  // namespace hair::reference
