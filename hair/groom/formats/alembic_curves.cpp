#include "hair/groom/formats/alembic_curves.h"

#include <algorithm>
#include <string>

namespace hair::groom {
namespace {

using namespace std::string_view_literals;

// In the order of Alembic's BasisType.
constexpr std::array kAlembicBases{
    AlembicBasis{"no basis", nullptr, 1},        AlembicBasis{"B\xc3\xa9zier", &kBezierBasis, 3},
    AlembicBasis{"B-spline", &kBsplineBasis, 1}, AlembicBasis{"Catmull-Rom", &kCatmullRomBasis, 1},
    AlembicBasis{"Hermite", nullptr, 2},         AlembicBasis{"power", nullptr, 4}};

// Alembic's CurveType.
constexpr std::uint8_t kCubicCurves = 0;
constexpr std::uint8_t kLinearCurves = 1;
constexpr std::uint8_t kCurvesOfOrders = 2;

constexpr auto kExportLinear = ": export them as linear curves (polylines)"sv;

}  // namespace

AlembicTopology::AlembicTopology(
    AlembicValues& values, const AlembicCompound& geometry, const AlembicParameter& sizes) {
    sizes.require(AlembicType::int32, 1);
    sizes_ = sizes.arranged(values.stored<std::int32_t>(sizes));
    for (std::size_t i = 0; i < sizes_.size(); ++i) {
        if (sizes_[i] < 0)
            sizes.fail(
                "curve " + std::to_string(i) + " has " + std::to_string(sizes_[i]) + " vertices");
        vertices_ += static_cast<std::uint64_t>(sizes_[i]);
    }
    const auto kind = values.parameterOf(geometry, "curveBasisAndType");
    const auto knots = values.parameterOf(geometry, ".knots");
    const auto orders = values.parameterOf(geometry, ".orders");
    const auto weights = values.parameterOf(geometry, "w");
    if (!kind) return;
    kind->require(AlembicType::uint8, 4);
    const auto codes = valueAt<std::array<std::uint8_t, 4>>(values.bytes(), kind->elements.start);
    const auto [type, wrap, basis, basis_again] = codes;
    if (wrap != 0) kind->fail("closed (periodic) curves; only those with two ends are strands");
    if (type == kLinearCurves) return;
    if (type != kCubicCurves && type != kCurvesOfOrders)
        kind->fail("curves of the unknown type " + std::to_string(type));
    if (weights)
        for (const float weight : values.floatsOf<float>(*weights))
            if (weight != 1.0f) weights->fail("rational curves" + std::string(kExportLinear));
    if (knots) {
        readKnots(values, *knots, orders);
        return;
    }
    if (type == kCurvesOfOrders)
        kind->fail("curves of variable order without knots" + std::string(kExportLinear));
    if (basis >= kAlembicBases.size() || !kAlembicBases[basis].weights)
        kind->fail(
            "cubic curves of " +
            (basis < kAlembicBases.size() ? std::string(kAlembicBases[basis].name)
                                          : "the basis " + std::to_string(basis)) +
            std::string(kExportLinear));
    basis_ = &kAlembicBases[basis];
}

void AlembicTopology::readKnots(
    const AlembicValues& values, const AlembicParameter& knots,
    const std::optional<AlembicParameter>& orders) {
    constexpr std::uint32_t kCubicOrder = 4;
    std::vector<std::int32_t> all(sizes_.size(), kCubicOrder);
    if (orders) all = values.integersOf(*orders);
    if (all.size() == 1) all.resize(sizes_.size(), std::int32_t{all.front()});
    if (all.size() != sizes_.size())
        orders->fail(
            std::to_string(all.size()) + " orders of " + std::to_string(sizes_.size()) + " curves");
    knots_ = values.floatsOf<float>(knots);
    requireFinite(knots_, knots.elements.start, knots.path);
    nurbs_.reserve(sizes_.size());
    std::uint64_t first = 0;
    for (std::size_t i = 0; i < sizes_.size(); ++i) {
        const auto size = static_cast<std::uint32_t>(sizes_[i]);
        const std::string curve = "curve " + std::to_string(i);
        if (all[i] < 2 || all[i] > static_cast<std::int32_t>(AlembicKnots::kGreatestOrder))
            knots.fail(curve + " has the order " + std::to_string(all[i]) + ", expected 2 to 16");
        const auto order = static_cast<std::uint32_t>(all[i]);
        if (size < order && size > 1)
            knots.fail(
                curve + " has " + std::to_string(size) + " vertices, too few for order " +
                std::to_string(order));
        if (knots_.size() - first < std::uint64_t{size} + order)
            knots.fail(curve + " has too few knots, expected as many as vertices and its order");
        const auto own = std::span(knots_).subspan(first, std::size_t{size} + order);
        if (!std::ranges::is_sorted(own)) knots.fail(curve + " has knots that decrease");
        std::uint32_t segments = 0;  // none of a curve that is a point
        for (std::size_t k = order - 1; k < size; ++k) segments += own[k] < own[k + 1] ? 1 : 0;
        if (segments == 0 && size > 1) knots.fail(curve + " has knots that are all equal");
        nurbs_.push_back({first, order, segments});
        first += own.size();
    }
    if (first != knots_.size())
        knots.fail(
            std::to_string(knots_.size()) + " knots, but the curves have " + std::to_string(first));
}

void AlembicKnots::go(std::uint32_t segment, double t) {
    while (next_segment_ <= segment) {
        do ++span_;
        while (!(knots_[span_] < knots_[span_ + 1]));
        ++next_segment_;
    }
    const double from = knots_[span_];
    const double to = knots_[span_ + 1];
    const double at = t == 1.0 ? to : from + t * (to - from);
    weights_[0] = 1.0;
    for (std::uint32_t degree = 1; degree < order_; ++degree) {
        double saved = 0.0;
        for (std::uint32_t r = 0; r < degree; ++r) {
            const double right = knots_[span_ + r + 1];
            const double left = knots_[span_ + r + 1 - degree];
            const double part = weights_[r] / (right - left);
            weights_[r] = saved + (right - at) * part;
            saved = (at - left) * part;
        }
        weights_[degree] = saved;
    }
}

// Whether each curve begins and ends with two vertices in one place.
bool AlembicTopology::hasDoubledEnds(std::span<const glm::vec3> vertices) const {
    std::size_t first = 0;
    for (const std::int32_t size : sizes_) {
        const auto own = vertices.subspan(first, static_cast<std::size_t>(size));
        first += own.size();
        if (own.size() <= 1) continue;
        if (own.size() < 4 || own[0] != own[1] || own[own.size() - 2] != own.back()) return false;
    }
    return true;
}

void AlembicTopology::draw(std::span<const glm::vec3> vertices, const AlembicParameter& sizes) {
    is_pinned_ = basis_ && basis_->weights == &kCatmullRomBasis && !hasDoubledEnds(vertices);
    for (std::size_t i = 0; i < sizes_.size(); ++i) {
        const auto size = static_cast<std::uint32_t>(sizes_[i]);
        if (size <= 1) continue;  // a point, or nothing, which usableStrands() leaves out
        const bool is_curve =
            !basis_ || (is_pinned_ ? size >= 2 : size >= 4 && (size - 4) % basis_->step == 0);
        if (!is_curve)
            sizes.fail(
                "curve " + std::to_string(i) + " has " + std::to_string(size) +
                " vertices, which do not make a cubic " + std::string(basis_->name) + " curve");
        const std::uint32_t segments = segmentsOf(i);
        pieces_ = std::max(pieces_, (size - 1 + segments - 1) / segments);
    }
}

std::uint64_t AlembicTopology::ends() const {
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < sizes_.size(); ++i)
        count += sizes_[i] == 0 ? 0 : std::uint64_t{segmentsOf(i)} + 1;
    return count;
}

}  // namespace hair::groom
