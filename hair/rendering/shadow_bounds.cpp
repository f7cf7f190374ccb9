#include "hair/rendering/shadow_bounds.h"

#include <algorithm>
#include <span>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace hair {

namespace {

Sphere boundsOf(std::span<const glm::vec3> points) {
    if (points.empty()) return {};
    glm::vec3 least = points.front();
    glm::vec3 most = points.front();
    for (const glm::vec3& point : points) {
        least = glm::min(least, point);
        most = glm::max(most, point);
    }
    Sphere sphere{.centre = 0.5f * (least + most)};
    for (const glm::vec3& point : points)
        sphere.radius = std::max(sphere.radius, glm::distance(point, sphere.centre));
    return sphere;
}

// However it is turned about its origin.
Sphere boundsOf(const Mesh& mesh, const MeshSettings& placed) {
    const Sphere sphere = boundsOf(mesh.positions);
    return {
        .centre = placed.translation,
        .radius = placed.scale * (glm::length(sphere.centre) + sphere.radius)};
}

Sphere moved(const glm::mat4& rigid, const Sphere& sphere) {
    return {glm::vec3(rigid * glm::vec4(sphere.centre, 1.0f)), sphere.radius};
}

}  // namespace

Sphere enclosing(const Sphere& a, const Sphere& b) {
    const float apart = glm::distance(a.centre, b.centre);
    if (b.radius == 0.0f || apart + b.radius <= a.radius) return a;
    if (a.radius == 0.0f || apart + a.radius <= b.radius) return b;
    const float radius = 0.5f * (apart + a.radius + b.radius);
    return {a.centre + (radius - a.radius) / apart * (b.centre - a.centre), radius};
}

ShadowScene::ShadowScene(const Settings& settings, const RenderAssets& assets) {
    if (assets.head && settings.render.head) head_ = boundsOf(assets.head->positions);
    for (std::size_t i = 0; i < assets.meshes.size(); ++i)
        others_ = enclosing(others_, boundsOf(assets.meshes[i], settings.render.meshes[i]));
}

ShadowBounds ShadowScene::bounds(const StrandView& view) const {
    const Sphere hair{view.centre, view.radius};
    ShadowBounds bounds{.seen = moved(view.head, enclosing(hair, head_))};
    if (bounds.seen.radius == 0.0f) bounds.seen = others_;
    bounds.range = enclosing(bounds.seen, others_);
    return bounds;
}

}  // namespace hair
