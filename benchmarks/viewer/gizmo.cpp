#include "benchmarks/viewer/gizmo.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec4.hpp>
#include <imgui.h>

#include "hair/rendering/environment.h"

namespace benchmarks::viewer {

// ---- What is at a pixel -------------------------------------------------------------------------

namespace {

// Returns the distance along the ray, m, by Möller and Trumbore 1997, Fast, minimum storage
// ray/triangle intersection.
std::optional<double>
hitTriangle(const Ray& ray, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 p = glm::cross(ray.direction, c - a);
    const double determinant = glm::dot(b - a, p);
    if (determinant == 0.0) return {};
    const glm::dvec3 s = ray.from - a;
    const glm::dvec3 q = glm::cross(s, b - a);
    const double u = glm::dot(s, p) / determinant;
    const double v = glm::dot(ray.direction, q) / determinant;
    const double distance = glm::dot(c - a, q) / determinant;
    if (u < 0.0 || v < 0.0 || u + v > 1.0 || distance <= 0.0) return {};
    return distance;
}

// Returns the smaller root of x^2 + 2 b x + c if it is positive.
std::optional<double> firstRoot(double b, double c) {
    const double square = b * b - c;
    if (square < 0.0) return {};
    const double root = -b - std::sqrt(square);
    if (root <= 0.0) return {};
    return root;
}

std::optional<double> hitSphere(const Ray& ray, const glm::dvec3& center, double radius) {
    const glm::dvec3 arm = ray.from - center;
    return firstRoot(glm::dot(arm, ray.direction), glm::dot(arm, arm) - radius * radius);
}

std::optional<double>
hitCylinder(const Ray& ray, const glm::dvec3& a, const glm::dvec3& b, double radius) {
    const double length = glm::length(b - a);
    if (length == 0.0) return {};
    const glm::dvec3 axis = (b - a) / length;
    const auto across = [&](const glm::dvec3& v) { return v - axis * glm::dot(v, axis); };
    const glm::dvec3 direction = across(ray.direction), arm = across(ray.from - a);
    const double square = glm::dot(direction, direction);
    if (square < 1e-12) return {};  // parallel to the axis: the ray meets an end first
    const auto root = firstRoot(
        glm::dot(arm, direction) / square, (glm::dot(arm, arm) - radius * radius) / square);
    if (!root) return {};
    const double along = glm::dot(ray.from + ray.direction * *root - a, axis);
    if (along < 0.0 || along > length) return {};
    return root;
}

double distanceToSegment(const glm::dvec3& point, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 line = b - a;
    const double square = glm::dot(line, line);
    const double share =
        square > 0.0 ? std::clamp(glm::dot(point - a, line) / square, 0.0, 1.0) : 0.0;
    return glm::length(point - a - line * share);
}

}  // namespace

// ---- The view -----------------------------------------------------------------------------------

PictureView::PictureView(
    const hair::CameraSettings& camera, const hair::RenderSettings& render, const PictureRect& rect)
    : rect_(rect),
      projection_(hair::rendering::viewProjection(
          camera, static_cast<float>(render.width) / static_cast<float>(render.height))),
      inverse_(glm::inverse(projection_)), eye_(camera.position),
      right_(glm::normalize(glm::cross(camera.target - camera.position, camera.up))),
      back_(glm::normalize(camera.position - camera.target)),
      pixels_at_one_(rect.size.y / (2.0f * std::tan(glm::radians(camera.field_of_view) / 2.0f))) {
    up_ = glm::cross(back_, right_);
}

std::optional<glm::vec2> PictureView::pixel(const glm::vec3& point) const {
    const glm::dvec4 clip = projection_ * glm::dvec4(point, 1.0);
    if (clip.w <= 0.0 || clip.z < 0.0) return {};
    const glm::vec2 share = (glm::dvec2(clip) / clip.w + 1.0) / 2.0;
    return rect_.corner + share * rect_.size;
}

Ray PictureView::ray(glm::vec2 pixel) const {
    const glm::dvec2 unit = 2.0 * glm::dvec2(rect_.share(pixel)) - 1.0;
    const glm::dvec4 point = inverse_ * glm::dvec4(unit, 0.0, 1.0);  // on the near plane
    const glm::dvec3 eye = eye_;
    return {eye, glm::normalize(glm::dvec3(point) / point.w - eye)};
}

glm::vec3 PictureView::onPlane(glm::vec2 pixel, const glm::vec3& through) const {
    const Ray line = ray(pixel);
    const glm::dvec3 normal = back_;
    return line.from + line.direction * (glm::dot(normal, glm::dvec3(through) - line.from) /
                                         glm::dot(normal, line.direction));
}

glm::vec3 PictureView::dragged(const glm::vec3& point, glm::vec2 from, glm::vec2 to) const {
    return onPlane(to, point) - onPlane(from, point);
}

float PictureView::pixelsPerMetre(const glm::vec3& at) const {
    const float distance = depth(at);
    return distance > 0.0f ? pixels_at_one_ / distance : 0.0f;
}

float PictureView::depth(const glm::vec3& point) const { return glm::dot(eye_ - point, back_); }

// ---- What is under a pixel ----------------------------------------------------------------------

Sphere sphereRound(std::span<const glm::vec3> points) {
    glm::vec3 low = points.front(), high = points.front();
    for (const glm::vec3& point : points) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    Sphere sphere{(low + high) / 2.0f};
    for (const glm::vec3& point : points)
        sphere.radius = std::max(sphere.radius, glm::length(point - sphere.center));
    return sphere;
}

std::optional<GuideVertex> pickVertex(
    const PictureView& view, std::span<const glm::vec3> guides, std::uint32_t vertices_per_guide,
    glm::vec2 pixel, float reach, float depth_scale) {
    std::optional<GuideVertex> best;
    float lowest = std::numeric_limits<float>::max();
    for (std::size_t i = 0; i < guides.size(); ++i) {
        const std::size_t vertex = i % vertices_per_guide;
        if (vertex == 0) continue;
        const auto shown = view.pixel(guides[i]);
        if (!shown) continue;
        const float distance = glm::length(*shown - pixel);
        if (distance > reach) continue;
        const float cost = distance / reach + view.depth(guides[i]) / depth_scale;
        if (cost >= lowest) continue;
        lowest = cost;
        best = {
            static_cast<std::uint32_t>(i / vertices_per_guide), static_cast<std::uint32_t>(vertex)};
    }
    return best;
}

std::optional<glm::vec3> pickHair(
    const PictureView& view, std::span<const glm::vec3> guides, std::uint32_t vertices_per_guide,
    glm::vec2 pixel, float reach) {
    std::optional<glm::vec3> best;
    for (std::size_t i = 0; i + 1 < guides.size(); ++i) {
        if ((i + 1) % vertices_per_guide == 0) continue;  // a tip and the next root
        const auto a = view.pixel(guides[i]);
        const auto b = view.pixel(guides[i + 1]);
        if (!a || !b) continue;
        const glm::vec2 line = *b - *a;
        const float square = glm::dot(line, line);
        const float share =
            square > 0.0f ? std::clamp(glm::dot(pixel - *a, line) / square, 0.0f, 1.0f) : 0.0f;
        if (glm::length(pixel - *a - line * share) > reach) continue;
        // Perspective: equal steps along a line are shorter in the picture the farther away they
        // are.
        const float near = view.depth(guides[i]), far = view.depth(guides[i + 1]);
        const float along = share * near / (share * near + (1.0f - share) * far);
        const glm::vec3 point = glm::mix(guides[i], guides[i + 1], along);
        if (!best || view.depth(point) < view.depth(*best)) best = point;
    }
    return best;
}

std::optional<double> pickMesh(
    const Ray& ray, const hair::groom::Mesh& mesh, const hair::simulation::RigidMotion& moved) {
    const glm::dquat back = glm::conjugate(moved.rotation);
    const Ray local{back * (ray.from - moved.translation), back * ray.direction};
    std::optional<double> nearest;
    for (const auto& [a, b, c] : mesh.triangles) {
        const auto hit =
            hitTriangle(local, mesh.positions[a], mesh.positions[b], mesh.positions[c]);
        if (hit && (!nearest || *hit < *nearest)) nearest = hit;
    }
    return nearest;
}

std::optional<double>
pickCapsule(const Ray& ray, const glm::vec3& a, const glm::vec3& b, float radius) {
    if (distanceToSegment(ray.from, a, b) <= double{radius}) return {};
    std::optional<double> nearest;
    for (const auto& hit :
         {hitSphere(ray, a, double{radius}), hitSphere(ray, b, double{radius}),
          hitCylinder(ray, a, b, double{radius})})
        if (hit && (!nearest || *hit < *nearest)) nearest = hit;
    return nearest;
}

// ---- Handles ------------------------------------------------------------------------------------

namespace {

// ---- Gizmo --------------------------------------------------------------------------------------

constexpr int kArcSegments = 48;
constexpr float kArrow = 0.8f;  // share of the rings' radius; leaves the ring free to grab beyond
                                // the tip
constexpr float kFacing = 0.85f;  // cosine between a ring's axis and the view
// Below this cosine between a ring's plane and the view, the ring is seen edge-on. The mouse then
// drags along it, not around it.
constexpr double kEdge = 0.2;

struct Plane {
    glm::vec3 u, v;  // unit vectors perpendicular to the axis, which is u x v
};

// Returns the plane of a ring, with u toward the camera.
Plane planeOf(const PictureView& view, const Gizmo& gizmo, int axis) {
    const glm::vec3 normal = gizmo.turn_axes[static_cast<std::size_t>(axis)];
    const glm::vec3 toward = glm::normalize(view.eye() - gizmo.origin);
    glm::vec3 u = toward - normal * glm::dot(toward, normal);
    if (glm::length(u) < 1e-3f) u = view.right() - normal * glm::dot(view.right(), normal);
    u = glm::normalize(u);
    return {u, glm::cross(normal, u)};
}

// Returns the distance, m, from `from` along a line to the point nearest to a ray.
double nearestAlong(const Ray& ray, const glm::dvec3& from, const glm::dvec3& axis) {
    const glm::dvec3 arm = ray.from - from;
    const double cosine = glm::dot(axis, ray.direction);
    return (glm::dot(arm, axis) - glm::dot(arm, ray.direction) * cosine) / (1.0 - cosine * cosine);
}

std::optional<double>
angleUnder(const PictureView& view, const Gizmo& gizmo, const Plane& plane, glm::vec2 pixel) {
    const Ray ray = view.ray(pixel);
    const glm::dvec3 u = plane.u, v = plane.v;
    const glm::dvec3 normal = glm::cross(u, v);
    const double cosine = glm::dot(normal, ray.direction);
    if (std::abs(cosine) < kEdge) return {};
    const glm::dvec3 arm = glm::dvec3(gizmo.origin) - ray.from;
    const glm::dvec3 point = ray.direction * (glm::dot(normal, arm) / cosine) - arm;
    return std::atan2(glm::dot(point, v), glm::dot(point, u));
}

// Returns the distance in px from a point to a line segment.
float pixelsToSegment(glm::vec2 point, glm::vec2 a, glm::vec2 b) {
    const glm::vec2 line = b - a;
    const float square = glm::dot(line, line);
    const float share =
        square > 0.0f ? std::clamp(glm::dot(point - a, line) / square, 0.0f, 1.0f) : 0.0f;
    return glm::length(point - a - line * share);
}

// ---- Handles ------------------------------------------------------------------------------------

constexpr ImU32 kBox = IM_COL32(0, 0, 0, 190);

// Faint colours get a faint outline.
ImU32 outlineOf(ImU32 color) {
    const ImU32 alpha = (color >> IM_COL32_A_SHIFT) * 190u / 255u;
    return IM_COL32(0, 0, 0, alpha);
}

// Sizes in font heights.
constexpr float kLine = 0.13f;
constexpr float kBorder = 0.09f;  // width of the outline on each side
constexpr float kDot = 0.36f;
constexpr float kHead = 0.75f;  // length of an arrow's head
constexpr float kPadding = 0.3f;

float sized(float fonts) { return fonts * ImGui::GetFontSize(); }
ImVec2 at(glm::vec2 point) { return {point.x, point.y}; }

// ---- Options of a tool --------------------------------------------------------------------------

constexpr const char* kBar = "|";

float spacing() { return ImGui::GetStyle().ItemSpacing.x; }

float buttonWidth(const char* name) {
    return ImGui::CalcTextSize(name, nullptr, true).x + 2.0f * ImGui::GetStyle().FramePadding.x;
}

}  // namespace

// ---- Gizmo --------------------------------------------------------------------------------------

glm::vec3 moveAxis(int axis) {
    glm::vec3 unit{0.0f};
    unit[axis] = 1.0f;
    return unit;
}

glm::vec3 arrowTip(const Gizmo& gizmo, int axis) {
    return gizmo.origin + moveAxis(axis) * (kArrow * gizmo.size);
}

bool canBeDragged(const PictureView& view, const Gizmo& gizmo, int axis) {
    const float along = glm::dot(moveAxis(axis), glm::normalize(view.eye() - gizmo.origin));
    return std::abs(along) < 0.97f;  // at least a quarter of its length is visible
}

std::vector<glm::vec3> ringArc(const PictureView& view, const Gizmo& gizmo, int axis) {
    const Plane plane = planeOf(view, gizmo, axis);
    const glm::vec3 normal = gizmo.turn_axes[static_cast<std::size_t>(axis)];
    const float along = glm::dot(normal, glm::normalize(view.eye() - gizmo.origin));
    const float turns = std::abs(along) > kFacing ? 1.0f : 0.5f;
    std::vector<glm::vec3> points;
    for (int i = 0; i <= kArcSegments; ++i) {
        const float angle = (static_cast<float>(i) / kArcSegments - 0.5f) * turns * 2.0f *
                            std::numbers::pi_v<float>;
        points.push_back(
            gizmo.origin + gizmo.size * (plane.u * std::cos(angle) + plane.v * std::sin(angle)));
    }
    return points;
}

std::optional<GizmoPart>
pickGizmo(const PictureView& view, const Gizmo& gizmo, glm::vec2 pixel, float reach) {
    std::optional<GizmoPart> best;
    float nearest = std::numeric_limits<float>::max();
    const auto consider = [&](GizmoPart part, const glm::vec3& from, const glm::vec3& to) {
        const auto a = view.pixel(from), b = view.pixel(to);
        if (!a || !b) return;
        const float distance = pixelsToSegment(pixel, *a, *b);
        if (distance > reach || distance >= nearest) return;
        nearest = distance;
        best = part;
    };
    for (int axis = 0; axis < 3; ++axis)
        if (canBeDragged(view, gizmo, axis))
            consider({GizmoPart::Kind::arrow, axis}, gizmo.origin, arrowTip(gizmo, axis));
    if (best) return best;
    for (int axis = 0; axis < 3; ++axis) {
        const std::vector<glm::vec3> arc = ringArc(view, gizmo, axis);
        for (std::size_t i = 0; i + 1 < arc.size(); ++i)
            consider({GizmoPart::Kind::ring, axis}, arc[i], arc[i + 1]);
    }
    return best;
}

float moved(const PictureView& view, const Gizmo& gizmo, int axis, glm::vec2 from, glm::vec2 to) {
    const glm::dvec3 unit = moveAxis(axis), origin = gizmo.origin;
    return static_cast<float>(
        nearestAlong(view.ray(to), origin, unit) - nearestAlong(view.ray(from), origin, unit));
}

float turned(const PictureView& view, const Gizmo& gizmo, int axis, glm::vec2 from, glm::vec2 to) {
    const Plane plane = planeOf(view, gizmo, axis);
    const auto before = angleUnder(view, gizmo, plane, from);
    const auto after = angleUnder(view, gizmo, plane, to);
    if (before && after)
        return static_cast<float>(
            std::remainder(*after - *before, 2.0 * std::numbers::pi_v<double>));
    // Edge-on: along the ring at its nearest point to the camera.
    const glm::vec3 nearest = gizmo.origin + plane.u * gizmo.size;
    return glm::dot(view.dragged(nearest, from, to), plane.v) / gizmo.size;
}

// ---- Handles ------------------------------------------------------------------------------------

Handles::Handles(const PictureRect& seen) : seen_(seen), list_(ImGui::GetWindowDrawList()) {
    list_->PushClipRect(at(seen.corner), at(seen.corner + seen.size), true);
}

Handles::~Handles() { list_->PopClipRect(); }

float Handles::reach() { return sized(0.6f); }

void Handles::line(glm::vec2 a, glm::vec2 b, Color color) {
    list_->AddLine(at(a), at(b), outlineOf(color), sized(kLine + 2.0f * kBorder));
    list_->AddLine(at(a), at(b), color, sized(kLine));
}

void Handles::path(std::span<const glm::vec2> points, Color color) {
    std::vector<ImVec2> line;
    for (const glm::vec2& point : points) line.push_back(at(point));
    const auto count = static_cast<int>(line.size());
    list_->AddPolyline(line.data(), count, outlineOf(color), 0, sized(kLine + 2.0f * kBorder));
    list_->AddPolyline(line.data(), count, color, 0, sized(kLine));
}

void Handles::thinPath(std::span<const glm::vec2> points, Color color) {
    std::vector<ImVec2> line;
    for (const glm::vec2& point : points) line.push_back(at(point));
    list_->AddPolyline(line.data(), static_cast<int>(line.size()), color, 0, 1.0f);
}

void Handles::circle(glm::vec2 center, float radius, Color color) {
    list_->AddCircle(at(center), radius, outlineOf(color), 0, sized(kLine + 2.0f * kBorder));
    list_->AddCircle(at(center), radius, color, 0, sized(kLine));
}

void Handles::dot(glm::vec2 center, Color color) {
    list_->AddCircleFilled(at(center), sized(kDot + kBorder), outlineOf(color));
    list_->AddCircleFilled(at(center), sized(kDot), color);
}

void Handles::arrow(glm::vec2 from, glm::vec2 tip, Color color) {
    const float length = glm::length(tip - from);
    if (length < 1.0f) {
        dot(tip, color);
        return;
    }
    const glm::vec2 along = (tip - from) / length;
    const glm::vec2 across{-along.y, along.x};
    const auto head = [&](float border, ImU32 with) {
        const glm::vec2 foot = tip - along * sized(kHead + border);
        const glm::vec2 side = across * sized(0.5f * kHead + 1.5f * border);
        list_->AddTriangleFilled(
            at(tip + along * sized(2.0f * border)), at(foot + side), at(foot - side), with);
    };
    const glm::vec2 neck = tip - along * std::min(length, sized(kHead));
    list_->AddLine(at(from), at(neck), outlineOf(color), sized(kLine + 2.0f * kBorder));
    head(kBorder, outlineOf(color));
    list_->AddLine(at(from), at(neck), color, sized(kLine));
    head(0.0f, color);
}

void Handles::label(glm::vec2 beside, const std::string& text) { box(beside + sized(0.8f), text); }

void Handles::hint(const std::string& text) {
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    box(seen_.corner + glm::vec2{(seen_.size.x - size.x) / 2.0f, sized(0.5f)}, text);
}

void Handles::box(glm::vec2 corner, const std::string& text) {
    const glm::vec2 padding(sized(kPadding));
    const ImVec2 measured = ImGui::CalcTextSize(text.c_str());
    const glm::vec2 size{measured.x, measured.y};
    const glm::vec2 low = seen_.corner + padding;
    const glm::vec2 high = seen_.corner + seen_.size - size - padding;
    corner = glm::max(glm::min(corner, high), low);
    list_->AddRectFilled(at(corner - padding), at(corner + size + padding), kBox, sized(kPadding));
    list_->AddText(at(corner), kPlain, text.c_str());
}

// ---- Options of a tool --------------------------------------------------------------------------

void OptionsLine::place(float width) {
    if (!is_empty_) {
        const float bar = separates_ ? ImGui::CalcTextSize(kBar).x + spacing() : 0.0f;
        const float end = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
        // The cursor is already on the next line. Moving it back without enough room there would
        // add contents to the line.
        if (ImGui::GetItemRectMax().x + spacing() + bar + width <= end) {
            ImGui::SameLine();
            if (separates_) {
                ImGui::TextDisabled("%s", kBar);
                ImGui::SameLine();
            }
        }
    }
    is_empty_ = separates_ = false;
}

bool OptionsLine::button(const char* name, bool enabled, const char* tooltip) {
    place(buttonWidth(name));
    ImGui::BeginDisabled(!enabled);
    const bool pressed = ImGui::Button(name);
    ImGui::EndDisabled();
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_ForTooltip | ImGuiHoveredFlags_AllowWhenDisabled))
        ImGui::SetTooltip("%s", tooltip);
    return pressed;
}

bool OptionsLine::choice(const char* name, Choice choice, const char* tooltip) {
    place(buttonWidth(name));
    const bool chosen = choice == Choice::chosen;
    if (chosen)
        ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
    const bool pressed = ImGui::Button(name);
    if (chosen) ImGui::PopStyleColor();
    ImGui::SetItemTooltip("%s", tooltip);
    return pressed;
}

bool OptionsLine::slider(
    const char* name, float& value, float minimum, float maximum, const char* format) {
    const float width = 9.0f * ImGui::GetFontSize();
    place(width + ImGui::CalcTextSize(name).x + ImGui::GetStyle().ItemInnerSpacing.x);
    ImGui::SetNextItemWidth(width);
    return ImGui::SliderFloat(name, &value, minimum, maximum, format);
}

void OptionsLine::separator() { separates_ = true; }

}  // namespace benchmarks::viewer
