#include "benchmarks/measure/case.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <sstream>
#include <string>

#include "benchmarks/measure/hair_cache.h"
#include "benchmarks/report/environment.h"
#include "benchmarks/scene/assets.h"
#include "benchmarks/scene/extensions.h"
#include "benchmarks/scene/schema.h"
#include "engine/buffer_image.h"
#include "engine/error.h"
#include "hair/groom/build_groom.h"
#include "hair/groom/files.h"
#include "hair/groom/mesh/import_mesh.h"
#include "hair/groom/mesh/surface.h"
#include "hair/rendering/groom_buffers.h"
#include "hair/rendering/render_assets.h"
#include "hair/rendering/strand_offsets.h"

namespace benchmarks::measure {
namespace {

// ---- The case -----------------------------------------------------------------------------------

template <class Asset>
const Asset* pointerTo(const std::optional<Asset>& asset) {
    return asset ? &*asset : nullptr;
}

hair::simulation::Simulation simulationOf(
    const engine::Device& device, const hair::groom::Groom& groom, const hair::Settings& settings,
    std::span<const hair::groom::Mesh> field_meshes, const hair::groom::DeformingMesh* deforming,
    HairCache* cache) {
    if (!cache)
        return {device, groom, settings.simulation, settings.seed, field_meshes, {}, deforming};
    cache->assets().trim();
    return cache->simulation(device, groom, settings, field_meshes, deforming);
}

// The simulation of a head of /copies. Hands pull only the first one.
hair::SimulationSettings
ofHead(const hair::Settings& settings, hair::SimulationSettings simulation, std::uint32_t head) {
    const float delay = settings.copies.delay * static_cast<float>(head);
    for (hair::Keyframe& key : simulation.motion.keyframes) key.time -= delay;
    if (head > 0) simulation.pulls.clear();
    return simulation;
}

}  // namespace

Case::Case(
    const engine::Device& device, const hair::Settings& settings,
    const std::filesystem::path& directory, HairCache* cache)
    : device_(device), settings_(scene::withExtensions(settings, directory)), directory_(directory),
      mesh_(
          cache ? cache->assets().mesh(settings_, directory)
                : scene::loadMesh(settings_, directory)),
      groom_(
          cache ? cache->assets().groom(settings_, directory)
                : hair::groom::buildGroom(
                      settings_.groom, pointerTo(mesh_), directory, settings_.seed)),
      deforming_(scene::loadDeforming(settings_, mesh_, directory)),
      simulation_(simulationOf(
          device, groom_, settings_, scene::loadFieldMeshes(settings_, mesh_, directory),
          deforming_.get(), cache)),
      others_(simulationsOfOthers(cache)), fixed_step_(double{settings_.simulation.time_step}),
      groom_buffers_(std::make_unique<hair::rendering::GroomBuffers>(groomBuffers(settings_))),
      renderer_(std::make_unique<hair::rendering::Renderer>(
          device, settings_, view(),
          scene::loadRenderAssets(settings_, pointerTo(mesh_), directory))) {
    if (settings_.run.interpolate && simulation_.moves())
        forSimulations([](hair::simulation::Simulation& each) { each.interpolate(); });
}

std::vector<std::unique_ptr<hair::simulation::Simulation>>
Case::simulationsOfOthers(HairCache* cache) const {
    std::vector<std::unique_ptr<hair::simulation::Simulation>> others;
    const std::vector<hair::groom::Mesh> field_meshes =
        scene::loadFieldMeshes(settings_, mesh_, directory_);
    for (std::uint32_t head = 1; head < motions(settings_.copies); ++head) {
        hair::Settings own = settings_;
        own.simulation = ofHead(settings_, settings_.simulation, head);
        own.seed = settings_.seed + head;
        others.push_back(
            std::unique_ptr<hair::simulation::Simulation>(new hair::simulation::Simulation(
                simulationOf(device_, groom_, own, field_meshes, deforming_.get(), cache))));
    }
    return others;
}

std::optional<hair::groom::StrandSet> Case::probeReference() const {
    return scene::loadProbeReference(settings_, groom_, directory_);
}

hair::rendering::GroomBuffers Case::groomBuffers(const hair::Settings& settings) const {
    return {
        device_, groom_, settings, pointerTo(scene::loadOffsets(settings, directory_)),
        deforming_.get()};
}

void Case::setDrawing(const hair::Settings& unread) {
    const hair::Settings settings = scene::withExtensions(unread, directory_);
    auto buffers = std::make_unique<hair::rendering::GroomBuffers>(groomBuffers(settings));
    auto renderer = std::make_unique<hair::rendering::Renderer>(
        device_, settings, viewOf(*buffers, simulation_),
        scene::loadRenderAssets(settings, pointerTo(mesh_), directory_));
    groom_buffers_ = std::move(buffers);
    renderer_ = std::move(renderer);
    settings_ = settings;
}

void Case::setCamera(const hair::CameraSettings& camera) {
    settings_.camera = camera;
    renderer_->setCamera(camera);
}

void Case::carryOn(const hair::SimulationSettings& settings) {
    std::uint32_t head = 0;
    forSimulations([&](hair::simulation::Simulation& each) {
        each.carryOn(ofHead(settings_, settings, head++));
    });
    const auto force = settings_.simulation.force_parameters.file;
    const auto solver = settings_.simulation.solver_parameters.file;
    settings_.simulation = settings;
    settings_.simulation.force_parameters.file = force;
    settings_.simulation.solver_parameters.file = solver;
}

void Case::simulate(engine::Passes& passes) {
    using engine::Commands;
    using engine::PassKind;
    using hair::simulation::Simulation;
    // Records the same part of the simulations of all heads.
    const auto ofAll = [this](auto record) {
        return [this, record](Commands& commands) {
            forSimulations([&](Simulation& each) { record(each, commands); });
        };
    };
    const auto wind = [](Simulation& of, Commands& commands) { of.recordWind(commands); };
    const auto volume = [](Simulation& of, Commands& commands) { of.recordVolume(commands); };
    const auto force = [](Simulation& of, Commands& commands) { of.recordForce(commands); };
    const bool blows = settings_.simulation.solver != hair::Solver::none;
    const std::uint32_t steps =
        simulation_.moves() ? fixed_step_.stepsFor(double{settings_.run.frame_time}) : 0;
    // Interpolation needs the positions before the last step, so every step changes the copy.
    const bool between = settings_.run.interpolate && simulation_.moves();
    for (std::uint32_t i = 0; i < steps; ++i) {
        if (blows) passes.pass("wind", PassKind::compute, ofAll(wind));
        if (simulation_.hasVolume()) passes.pass("volume", PassKind::compute, ofAll(volume));
        if (blows && simulation_.hasForce()) passes.pass("force", PassKind::compute, ofAll(force));
        if (blows && simulation_.hasPulls())
            passes.pass("pull", PassKind::compute, [&](Commands& commands) {
                simulation_.recordPulls(commands);
            });
        const auto into =
            between || i == 0 ? hair::simulation::Copy::other : hair::simulation::Copy::same;
        const auto step = [into](Simulation& of, Commands& commands) {
            of.recordStep(commands, into);
        };
        passes.pass("simulate", PassKind::compute, ofAll(step));
    }
    if (!between) return;
    const auto share = [this](Simulation& of, Commands& commands) {
        of.recordInterpolation(commands, fixed_step_.remainder());
    };
    passes.pass("interpolate", PassKind::compute, ofAll(share));
}

void Case::probe(engine::Passes& passes, hair::simulation::Probes& probes) {
    passes.pass("probe", engine::PassKind::compute, [&](engine::Commands& commands) {
        probes.record(commands, simulation_.recordProbed(commands));
    });
}

// Drawing reads one of two copies of the guides, so the next step may write the other meanwhile.
// There is only one copy of interpolated guides.
void Case::frame(engine::Passes& passes) {
    passes.asyncCompute(settings_.run.interpolate ? 0 : 1, [&] { simulate(passes); });
    draw(passes);
}

void Case::draw(engine::Passes& passes) {
    findViews(views_);  // without an allocation in every frame
    renderer_->record(passes, views_);
}

void Case::recordReset(engine::Passes& passes) {
    passes.asyncCompute(0, [&] {
        passes.pass("reset", engine::PassKind::compute, [&](engine::Commands& commands) {
            forSimulations([&](hair::simulation::Simulation& each) { each.recordReset(commands); });
        });
    });
    fixed_step_.reset();
}

void Case::reset() {
    forSimulations([](hair::simulation::Simulation& each) { each.reset(); });
    fixed_step_.reset();
}

std::vector<glm::vec3> Case::guides() const {
    std::vector<glm::vec3> first = soundGuides(simulation_);
    for (const auto& other : others_) soundGuides(*other);
    return first;
}

std::vector<glm::vec3> Case::soundGuides(const hair::simulation::Simulation& simulation) const {
    std::vector<glm::vec3> positions = simulation.readPositions();
    const auto broken = hair::simulation::findBroken(
        positions, groom_.points, groom_.vertices_per_strand,
        hair::simulation::mostStretch(settings_.simulation));
    if (!broken) return positions;
    const double frame = simulation.time() / double{settings_.run.frame_time};
    std::ostringstream what;
    what.precision(3);
    what << "after " << std::llround(frame) << " frames the simulation has failed: guide "
         << broken->guide << ", vertex " << broken->vertex;
    if (std::isnan(broken->stretch))
        what << " has no finite position";
    else
        what << " is " << broken->stretch << " times as far along it as at rest";
    throw engine::Error("/simulation", what.str());
}

std::vector<glm::vec3> Case::drawnGuides() const {
    guides();
    return simulation_.readDrawn();
}

std::vector<std::uint8_t> Case::picture() const {
    guides();
    return engine::readOutput(device_, renderer_->target());
}

std::string Case::pictureHash() const {
    const std::vector<std::uint8_t> pixels = picture();
    return report::hashBytes(std::as_bytes(std::span(pixels)));
}

std::vector<float> Case::radiance() const {
    if (renderer_->target().hasRadiance()) {
        guides();
        return engine::readRadiance(device_, renderer_->target());
    }
    const std::vector<std::uint8_t> pixels = picture();
    std::vector<float> light;
    light.reserve(pixels.size() / 4 * 3);
    for (std::size_t i = 0; i < pixels.size(); i += 4) {
        const glm::dvec3 linear =
            hair::rendering::toLinear(glm::dvec3(pixels[i], pixels[i + 1], pixels[i + 2]) / 255.0);
        for (int c = 0; c < 3; ++c) light.push_back(static_cast<float>(linear[c]));
    }
    return light;
}

std::string Case::stateHash() const {
    std::vector<glm::vec3> positions = soundGuides(simulation_);
    for (const auto& other : others_) {
        const std::vector<glm::vec3> more = soundGuides(*other);
        positions.insert(positions.end(), more.begin(), more.end());
    }
    return report::hashBytes(std::as_bytes(std::span(positions)));
}

void Case::deform(hair::groom::Mesh& mesh) const {
    if (!deforming_) return;
    const std::vector<glm::dvec3> positions = deforming_->positions(simulation_.drawnTime());
    mesh.positions.assign(positions.begin(), positions.end());
    mesh.normals = deforming_->normals(positions);
}

hair::rendering::StrandPoints Case::strands() const {
    guides();
    hair::rendering::StrandPoints strands =
        hair::rendering::evaluateStrandPoints(device_, settings_, view());
    for (const hair::gpu::StrandPointRecord& each : strands.records)
        if (each.width >= 0.0f &&
            !std::isfinite(each.position.x + each.position.y + each.position.z))
            throw engine::Error(
                "/strands", "a point " + std::to_string(each.along) +
                                " along its strand has no finite position");
    return strands;
}

hair::rendering::Renderer Case::rendererOf(const hair::Settings& unread) const {
    const hair::Settings settings = scene::withExtensions(unread, directory_);
    return {
        device_, settings, view(), scene::loadRenderAssets(settings, pointerTo(mesh_), directory_)};
}

std::vector<std::pair<std::string, std::uint64_t>> Case::counts() const {
    std::vector<std::pair<std::string, std::uint64_t>> counts{
        {"guides", groom_.strand_count},
        {"vertices_per_guide", groom_.vertices_per_strand},
        {"root_triangles", groom_.root_triangles.size()}};
    if (simulation_.moves()) {
        const auto [fewest, most] = scene::stepsPerFrame(settings_);
        counts.emplace_back("fewest_steps_per_frame", fewest);
        counts.emplace_back("most_steps_per_frame", most);
    }
    if (settings_.render.hair) {
        if (settings_.strands.source == hair::StrandSource::groom)
            counts.emplace_back("groom_strands", groom_.bindings.size());
        const std::uint32_t heads = renderer_->heads();
        if (heads > 1) counts.emplace_back("heads", heads);
        counts.emplace_back("strands", heads * plan().strands());
        counts.emplace_back("segments", heads * plan().drawnSegments());
    }
    return counts;
}

std::optional<hair::rendering::BackendChoice> Case::backend() const {
    if (!settings_.render.hair) return std::nullopt;
    return renderer_->backend();
}

hair::rendering::StrandView Case::view() const { return viewOf(*groom_buffers_, simulation_); }

std::vector<hair::rendering::StrandView> Case::views() const {
    std::vector<hair::rendering::StrandView> views;
    findViews(views);
    return views;
}

void Case::findViews(std::vector<hair::rendering::StrandView>& views) const {
    views.assign(1, view());
    for (const auto& other : others_) views.push_back(viewOf(*groom_buffers_, *other));
}

hair::rendering::StrandView Case::viewOf(
    const hair::rendering::GroomBuffers& buffers,
    const hair::simulation::Simulation& simulation) const {
    hair::rendering::StrandView view = buffers.view();
    const hair::simulation::GuideView guides = simulation.guides();
    view.guides = guides.positions;
    view.contacts = guides.contacts;
    view.bodies = guides.bodies;
    view.head = hair::simulation::toMatrix(simulation.drawnPose());
    view.time = simulation.drawnTime();
    view.carried = glm::dmat4(hair::simulation::toMatrix(simulation.drawnCarried()));
    return view;
}

std::string droppedFragments(const Case& test_case) {
    const std::optional<hair::rendering::ListedFragments> listed = test_case.blend().listed();
    if (!listed || listed->dropped() == 0) return {};
    return std::to_string(listed->dropped()) + " of " + std::to_string(listed->wanted) +
           " fragments did not fit /render/list_length: the picture lacks them";
}

// ---- Strands for a file -------------------------------------------------------------------------

namespace {

// Calls each(point) for the points of every drawn strand, root first, and end() after each strand.
template <class Each, class End>
void forDrawnPoints(const hair::rendering::StrandPoints& points, Each each, End end) {
    const hair::rendering::StrandPlan& plan = points.plan;
    for (std::uint32_t triangle = 0; triangle < plan.triangles; ++triangle) {
        for (std::uint32_t strand = 0; strand < plan.forced_density; ++strand) {
            for (std::uint32_t segment = 0; segment < plan.segments; ++segment) {
                // The first point of a segment is the last of the previous segment.
                for (std::uint32_t i = segment == 0 ? 0 : 1; i <= plan.forced_tessellation; ++i) {
                    const auto& point = points.at(triangle, strand, segment, i);
                    if (point.width < 0.0f) break;
                    each(point);
                }
            }
            end();
        }
    }
}

std::size_t mostPoints(const hair::rendering::StrandPlan& plan) {
    return plan.strands() * (std::uint64_t{plan.segments} * plan.forced_tessellation + 1);
}

}  // namespace

hair::groom::StrandSet drawnStrands(const hair::rendering::StrandPoints& points) {
    hair::groom::StrandSet set;
    set.metres_per_unit = 1.0;
    set.ends.reserve(points.plan.strands());
    set.points.reserve(mostPoints(points.plan));
    set.widths.values.reserve(mostPoints(points.plan));
    forDrawnPoints(
        points,
        [&](const hair::gpu::StrandPointRecord& point) {
            set.points.push_back(point.position);
            set.widths.values.push_back(point.width);
        },
        [&] {
            const auto end = static_cast<std::uint32_t>(set.points.size());
            if (end > (set.ends.empty() ? 0 : set.ends.back())) set.ends.push_back(end);
        });
    return set;
}

std::vector<float> drawnPowers(const hair::rendering::StrandPoints& points) {
    std::vector<float> powers;
    powers.reserve(mostPoints(points.plan));
    forDrawnPoints(
        points, [&](const hair::gpu::StrandPointRecord& point) { powers.push_back(point.power); },
        [] {});
    return powers;
}

hair::groom::StrandSet
guideStrands(const hair::groom::Groom& groom, std::vector<glm::vec3> positions) {
    hair::groom::StrandSet set;
    set.metres_per_unit = 1.0;
    set.points = std::move(positions);
    set.root_triangles = groom.root_triangles;
    for (std::uint32_t i = 1; i <= groom.strand_count; ++i)
        set.ends.push_back(i * groom.vertices_per_strand);
    return set;
}

}  // namespace benchmarks::measure
