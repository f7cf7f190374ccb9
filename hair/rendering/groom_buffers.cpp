#include "hair/rendering/groom_buffers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <span>
#include <vector>

#include "engine/error.h"
#include "engine/transfer.h"
#include "hair/gpu_structs.h"
#include "hair/groom/style/displace.h"
#include "hair/random.h"
#include "hair/rendering/shadow_pass.h"
#include "hair/rendering/strand_offsets.h"
#include "hair/rendering/strand_plan.h"

namespace hair::rendering {
namespace {

static_assert(sizeof(gpu::BoundStrand) == 56 && offsetof(gpu::BoundStrand, offset) == 24);
static_assert(sizeof(gpu::RootFrame) == 24);

// Returns the numbers of the bound strands in random order: levels of detail keep the first ones.
std::vector<std::uint32_t> randomOrder(const groom::Groom& groom, std::uint32_t seed) {
    std::vector<std::uint32_t> order(groom.bindings.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::stable_sort(
        order, {}, [&](std::uint32_t i) { return hash(seed, i, gpu::kOrderPurpose); });
    return order;
}

// A strand that follows the head alone may be at any distance from its guides.
constexpr float kAnyReach = 1e6f;  // m

// Returns the factor that takes the width at the root to the strand's own width.
float widthFactor(
    const groom::Groom& groom, const StrandSettings& settings,
    const groom::StrandBinding& binding) {
    if (binding.width == 0.0f) return 1.0f;
    double width = settings.root_width;
    if (settings.width == WidthSource::groom) {
        width = 0.0;
        for (int i = 0; i < 3; ++i) {
            const std::size_t guide = binding.guides[static_cast<std::size_t>(i)];
            width += double{binding.weights[i]} * groom.widths[guide * groom.vertices_per_strand];
        }
    }
    return width > 0.0 ? static_cast<float>(binding.width / width) : 1.0f;
}

// `residuals` has the strands in the same order, or none.
std::vector<gpu::BoundStrand> boundStrands(
    const groom::Groom& groom, const StrandSettings& settings,
    const std::vector<std::uint32_t>& order, const StrandResiduals& residuals) {
    std::vector<gpu::BoundStrand> strands;
    strands.reserve(order.size());
    for (const std::uint32_t i : order) {
        const groom::StrandBinding& binding = groom.bindings[i];
        const auto& guides = binding.guides;
        gpu::BoundStrand strand{
            .guides = {guides[0], guides[1], guides[2]},
            .weights = binding.weights,
            .offset = binding.offset,
            .width = widthFactor(groom, settings, binding)};
        if (!residuals.strands.empty()) {
            const StrandResidual& residual = residuals.strands[strands.size()];
            strand.first_residual = residual.first;
            strand.residuals = residual.count;
            strand.residual_step = residual.step;
            strand.residual_reach = binding.followsHead() ? kAnyReach : residual.reach;
        }
        strands.push_back(strand);
    }
    return strands;
}

std::vector<gpu::RootFrame> rootFrames(const groom::Groom& groom) {
    std::vector<gpu::RootFrame> frames;
    frames.reserve(groom.strand_count);
    for (std::uint32_t i = 0; i < groom.strand_count; ++i) {
        const glm::dvec3 direction = groom::rootDirection(groom.strand(i));
        frames.push_back({glm::vec3(direction), glm::vec3(groom::across(direction))});
    }
    return frames;
}

// Returns a shade in [0, 1) for the group of each strand. Multiples of the golden ratio keep the
// shades of any number of groups apart (Knuth 1998, section 6.4, theorem S).
std::vector<float> groupShades(const std::vector<std::int32_t>& groups) {
    std::vector<std::int32_t> all = groups;
    std::ranges::sort(all);
    all.erase(std::ranges::unique(all).begin(), all.end());
    std::vector<float> shades;
    shades.reserve(groups.size());
    for (const std::int32_t group : groups) {
        const auto index = std::ranges::lower_bound(all, group) - all.begin();
        const double turns = static_cast<double>(index) * (std::numbers::phi - 1.0);
        shades.push_back(std::min(static_cast<float>(turns - std::floor(turns)), 0.999999f));
    }
    return shades;
}

// Returns the greatest distance of a root from where the mean motion of all roots would take it, m,
// over evenly spaced poses of the clip.
double scalpReach(const groom::Groom& groom, const groom::DeformingMesh& mesh) {
    constexpr int kPoses = 64;
    std::vector<glm::vec3> roots;
    for (std::uint32_t i = 0; i < groom.strand_count; ++i) roots.push_back(groom.strand(i).front());
    const std::vector<groom::SurfaceBinding> bindings = mesh.bind(roots);
    double reach = 0.0;
    for (int i = 0; i <= kPoses; ++i) {
        const auto motions = mesh.motions(bindings, mesh.period() * i / kPoses);
        const groom::SurfaceMotion mean = groom::meanMotion(motions, roots);
        for (std::size_t root = 0; root < roots.size(); ++root) {
            const glm::dvec3 rest(roots[root]);
            reach = std::max(reach, glm::distance(motions[root](rest), mean(rest)));
        }
    }
    return reach;
}

// Overshoot of the cubic through the values of offsets: the magnitudes of its weights add up to 1 +
// t (1 - t).
constexpr float kOvershoot = 1.25f;

}  // namespace

engine::MemoryRows GroomBuffers::rows(const Settings& settings, const groom::GroomSize& size) {
    constexpr engine::Purpose kGroom("groom");
    const StrandSettings& strands = settings.strands;
    const bool from_groom = strands.source == StrandSource::groom;
    const std::uint64_t grouped = from_groom ? size.grouped_strands : size.grouped_guides;
    engine::MemoryRows rows(
        kGroom,
        {{"root triangles", engine::bytesOf<std::array<std::uint32_t, 3>>(size.root_triangles)}});
    if (size.root_normals > 0)
        rows.add(kGroom, {{"root normals", engine::bytesOf<glm::vec3>(size.root_normals)}});
    if (strands.width == WidthSource::groom)
        rows.add(kGroom, {{"guide widths", engine::bytesOf<float>(size.vertices())}});
    if (grouped > 0) rows.add(kGroom, {{"group shades", engine::bytesOf<float>(grouped)}});
    if (from_groom)
        rows.add(
            kGroom, {{"bound strands", engine::bytesOf<gpu::BoundStrand>(size.bound_strands)}});
    // Points at one place have one residual.
    if (from_groom && size.bound_points > 0)
        rows.add(
            kGroom, {{.name = "strand residuals",
                      .size = engine::bytesOf<glm::uvec2>(size.bound_points + 1),
                      .at_most = true},
                     {"guide tangents at rest", engine::bytesOf<glm::vec3>(size.vertices())}});
    if (strands.randomness == Randomness::thesis)
        rows.add(kGroom, {{"root pattern", engine::bytesOf<glm::vec2>(strands.density)}});
    if (hasOffsets(strands)) {
        const GrowSettings& grow = settings.groom.grow;
        const double length =  // m; hair in files is rarely longer
            settings.groom.file.empty() ? double{grow.length} * (1.0 + grow.length_variation) : 1.0;
        rows.add(
            kGroom, {{.name = "strand offsets",
                      .size = static_cast<std::size_t>(offsetBytes(strands, length)),
                      .at_most = true}});
    }
    if (hasFrames(strands))
        rows.add(kGroom, {{"root frames", engine::bytesOf<gpu::RootFrame>(size.guides)}});
    if (!settings.simulation.animation.clip.empty())
        rows.add(kGroom, {{"guides at rest", engine::bytesOf<glm::vec4>(size.vertices())}});
    return rows;
}

GroomBuffers::GroomBuffers(
    const engine::Device& device, const groom::Groom& groom, const Settings& settings,
    const groom::StrandSet* model, const groom::DeformingMesh* deforming)
    : view_{
          .deforming = deforming,
          .guide_count = groom.strand_count,
          .vertices_per_guide = groom.vertices_per_strand,
          .triangle_count = static_cast<std::uint32_t>(groom.root_triangles.size())} {
    checkStrands(settings.strands, groom);
    const Sphere bounds = strandBounds(groom, settings.strands);
    view_.centre = bounds.centre;
    view_.radius = bounds.radius;
    view_.greatest_width_scale = greatestWidthScale(groom, settings.strands);
    view_.greatest_width = settings.strands.width == WidthSource::groom
                               ? std::ranges::max(groom.widths)
                               : std::max(settings.strands.root_width, settings.strands.tip_width);
    const engine::MemoryRows rows = GroomBuffers::rows(settings, sizeOf(groom));
    const auto upload = [&]<class Value>(
                            engine::Buffer& buffer, const std::vector<Value>& values,
                            const char* name) {
        buffer = engine::makeBuffer(device, values, rows, name);
        return buffer.address();
    };
    view_.root_triangles = upload(root_triangles_, groom.root_triangles, "root triangles");
    if (!groom.root_normals.empty())
        view_.root_normals = upload(root_normals_, groom.root_normals, "root normals");
    if (settings.strands.width == WidthSource::groom)
        view_.guide_widths = upload(widths_, groom.widths, "guide widths");
    if (settings.strands.source != StrandSource::groom && !groom.guide_groups.empty())
        view_.group_shades = upload(group_shades_, groupShades(groom.guide_groups), "group shades");
    if (settings.strands.source == StrandSource::groom) {
        const std::vector<std::uint32_t> order = randomOrder(groom, settings.seed);
        if (!groom.groups.empty()) {
            std::vector<std::int32_t> groups;
            groups.reserve(order.size());
            for (const std::uint32_t strand : order) groups.push_back(groom.groups[strand]);
            view_.group_shades = upload(group_shades_, groupShades(groups), "group shades");
        }
        StrandResiduals residuals;
        if (!groom.bound_ends.empty()) {
            residuals = makeStrandResiduals(groom, settings.strands, order);
            view_.residuals = upload(residuals_, residuals.samples, "strand residuals");
            view_.rest_tangents =
                upload(rest_tangents_, restTangents(groom), "guide tangents at rest");
            float reach = 0.0f;
            for (std::size_t i = 0; i < order.size(); ++i)
                if (!groom.bindings[order[i]].followsHead())
                    reach = std::max(reach, residuals.strands[i].reach);
            view_.radius += reach;
        }
        const std::vector<gpu::BoundStrand> bound =
            boundStrands(groom, settings.strands, order, residuals);
        if (view_.residuals != 0)
            view_.greatest_width *=
                std::max(1.0f, std::ranges::max(bound, {}, &gpu::BoundStrand::width).width);
        view_.bound_strands = upload(bound_strands_, bound, "bound strands");
        view_.bound_strand_count = static_cast<std::uint32_t>(groom.bindings.size());
    }
    if (settings.strands.randomness == Randomness::thesis) {
        view_.root_pattern =
            upload(root_pattern_, thesisRootPattern(settings.strands.density), "root pattern");
    }
    if (hasOffsets(settings.strands)) {
        const StrandOffsets offsets =
            makeStrandOffsets(settings.strands, groom, model, settings.seed);
        view_.offsets = upload(offsets_, offsets.values, "strand offsets");
        for (const glm::vec3& value : offsets.values)
            view_.offset_reach = std::max(view_.offset_reach, kOvershoot * glm::length(value));
        view_.offset_profiles = offsets.profiles;
        view_.offset_samples = offsets.samples;
    }
    if (hasFrames(settings.strands))
        view_.root_frames = upload(root_frames_, rootFrames(groom), "root frames");
    view_.radius += functionReach(settings.strands);
    view_.offset_reach += functionReach(settings.strands);
    if (deforming) {
        std::vector<glm::vec4> rest;
        for (const glm::vec3& point : groom.points) rest.emplace_back(point, 0.0f);
        view_.rest_guides = upload(rest_guides_, rest, "guides at rest");
        // A strand may be corrected by as much as its root departs from the motion of the whole
        // scalp. Its guides may be as far away on the other side.
        const float reach = static_cast<float>(2.0 * scalpReach(groom, *deforming));
        view_.radius += reach;
        view_.offset_reach += reach;
    }
}

void checkStrands(const StrandSettings& settings, const groom::Groom& groom) {
    if (settings.width == WidthSource::groom && groom.widths.empty())
        throw engine::Error("/strands/width", "is groom, but the groom has no widths");
    if (!settings.offset_function.empty() && !settings.offset_parameters.file)
        throw engine::Error("/strands/offset_function", "names a file that was not read");
    if (settings.source == StrandSource::groom && groom.bindings.empty())
        throw engine::Error("/strands/source", "is groom, but the groom has no bindings");
}

}  // namespace hair::rendering
