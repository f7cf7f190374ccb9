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

constexpr auto kExportLinear = ": export them as linear curves (polylines)"sv;

}  // namespace

AlembicTopology::AlembicTopology(
    AlembicValues& values, const AlembicCompound& geometry, const AlembicParameter& sizes) {
    sizes.require(AlembicType::int32, 1);
    sizes_ = sizes.arranged(values.stored<std::int32_t>(sizes));
    for (std::size_t i = 0; i < sizes_.size(); ++i) {
        if (sizes_[i] < 1)
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
    if (wrap != 0) kind->fail("closed (periodic) curves, only those with two ends are strands");
    if (type == kLinearCurves) return;
    if (type != kCubicCurves)
        kind->fail("curves of variable order (NURBS)" + std::string(kExportLinear));
    if (basis >= kAlembicBases.size() || !kAlembicBases[basis].weights)
        kind->fail(
            "cubic curves of " +
            (basis < kAlembicBases.size() ? std::string(kAlembicBases[basis].name)
                                          : "the basis " + std::to_string(basis)) +
            std::string(kExportLinear));
    if (knots || orders)
        (knots ? knots : orders)->fail("curves with knots (NURBS)" + std::string(kExportLinear));
    if (weights)
        for (const float weight : values.floatsOf<float>(*weights))
            if (weight != 1.0f) weights->fail("rational curves" + std::string(kExportLinear));
    basis_ = &kAlembicBases[basis];
}

// Whether each curve begins and ends with two vertices in one place.
bool AlembicTopology::hasDoubledEnds(std::span<const glm::vec3> vertices) const {
    std::size_t first = 0;
    for (const std::int32_t size : sizes_) {
        const auto own = vertices.subspan(first, static_cast<std::size_t>(size));
        first += own.size();
        if (own.size() < 4 || own[0] != own[1] || own[own.size() - 2] != own.back()) return false;
    }
    return true;
}

void AlembicTopology::draw(std::span<const glm::vec3> vertices, const AlembicParameter& sizes) {
    is_pinned_ = basis_->weights == &kCatmullRomBasis && !hasDoubledEnds(vertices);
    for (std::size_t i = 0; i < sizes_.size(); ++i) {
        const auto size = static_cast<std::uint32_t>(sizes_[i]);
        const bool is_curve = is_pinned_ ? size >= 2 : size >= 4 && (size - 4) % basis_->step == 0;
        if (!is_curve)
            sizes.fail(
                "curve " + std::to_string(i) + " has " + std::to_string(size) +
                " vertices, which are no cubic " + std::string(basis_->name) + " curve");
        const std::uint32_t segments = segmentsOf(sizes_[i]);
        pieces_ = std::max(pieces_, (size - 1 + segments - 1) / segments);
    }
}

std::uint64_t AlembicTopology::ends() const {
    std::uint64_t count = 0;
    for (const std::int32_t size : sizes_) count += std::uint64_t{segmentsOf(size)} + 1;
    return count;
}

}  // namespace hair::groom
