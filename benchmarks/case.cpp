#include "benchmarks/case.h"

#include <span>

#include "benchmarks/assets.h"
#include "benchmarks/hash.h"
#include "engine/transfer.h"
#include "hair/groom/build_groom.h"
#include "hair/rendering/working_color.h"

namespace benchmarks {

namespace {

template <class Asset>
const Asset* pointerTo(const std::optional<Asset>& asset) {
    return asset ? &*asset : nullptr;
}

}  // namespace

Case::Case(
    const engine::Device& device, const hair::Settings& settings,
    const std::filesystem::path& directory)
    : device_(device), settings_(settings), directory_(directory),
      mesh_(loadMesh(settings, directory)),
      groom_(hair::buildGroom(settings.groom, pointerTo(mesh_), directory, settings.seed)),
      simulation_(
          device, groom_, settings.simulation, settings.seed,
          loadFieldMeshes(settings, mesh_, directory)),
      fixed_step_(double{settings.simulation.time_step}),
      groom_buffers_(std::make_unique<hair::GroomBuffers>(groomBuffers(settings))),
      renderer_(std::make_unique<hair::Renderer>(
          device, settings, view(), loadRenderAssets(settings, pointerTo(mesh_), directory))) {}

hair::GroomBuffers Case::groomBuffers(const hair::Settings& settings) const {
    return {device_, groom_, settings, pointerTo(loadOffsets(settings, directory_))};
}

void Case::setDrawing(const hair::Settings& settings) {
    auto buffers = std::make_unique<hair::GroomBuffers>(groomBuffers(settings));
    auto renderer = std::make_unique<hair::Renderer>(
        device_, settings, viewOf(*buffers),
        loadRenderAssets(settings, pointerTo(mesh_), directory_));
    groom_buffers_ = std::move(buffers);
    renderer_ = std::move(renderer);
    settings_ = settings;
}

void Case::setCamera(const hair::CameraSettings& camera) {
    settings_.camera = camera;
    renderer_->setCamera(camera);
}

void Case::carryOn(const hair::SimulationSettings& settings) {
    simulation_.carryOn(settings);
    settings_.simulation = settings;
}

void Case::simulate(engine::Passes& passes) {
    using engine::PassKind;
    const bool blows = settings_.simulation.solver != hair::Solver::none;
    const std::uint32_t steps =
        simulation_.moves() ? fixed_step_.stepsFor(double{settings_.run.frame_time}) : 0;
    for (std::uint32_t i = 0; i < steps; ++i) {
        if (blows) {
            passes.pass("wind", PassKind::compute, [&](engine::Commands& commands) {
                simulation_.recordWind(commands);
            });
        }
        if (simulation_.hasVolume()) {
            passes.pass("volume", PassKind::compute, [&](engine::Commands& commands) {
                simulation_.recordVolume(commands);
            });
        }
        if (blows && simulation_.hasPulls()) {
            passes.pass("pull", PassKind::compute, [&](engine::Commands& commands) {
                simulation_.recordPulls(commands);
            });
        }
        passes.pass("simulate", PassKind::compute, [&](engine::Commands& commands) {
            simulation_.recordStep(commands);
        });
    }
}

void Case::frame(engine::Passes& passes) {
    simulate(passes);
    draw(passes);
}

void Case::draw(engine::Passes& passes) { renderer_->record(passes, view()); }

void Case::reset() {
    simulation_.reset();
    fixed_step_.reset();
}

std::vector<std::uint8_t> Case::picture() const {
    return engine::readOutput(device_, renderer_->target());
}

std::string Case::pictureHash() const {
    const std::vector<std::uint8_t> pixels = picture();
    return hashBytes(std::as_bytes(std::span(pixels)));
}

std::vector<float> Case::radiance() const {
    if (renderer_->target().hasRadiance())
        return engine::readRadiance(device_, renderer_->target());
    const std::vector<std::uint8_t> pixels = picture();
    std::vector<float> light;
    light.reserve(pixels.size() / 4 * 3);
    for (std::size_t i = 0; i < pixels.size(); i += 4) {
        const glm::dvec3 linear =
            hair::toLinear(glm::dvec3(pixels[i], pixels[i + 1], pixels[i + 2]) / 255.0);
        for (int c = 0; c < 3; ++c) light.push_back(static_cast<float>(linear[c]));
    }
    return light;
}

std::string Case::stateHash() const {
    const std::vector<glm::vec3> positions = simulation_.readPositions();
    return hashBytes(std::as_bytes(std::span(positions)));
}

hair::StrandPoints Case::strands() const {
    return hair::evaluateStrandPoints(device_, settings_, view());
}

hair::Renderer Case::rendererOf(const hair::Settings& settings) const {
    return {device_, settings, view(), loadRenderAssets(settings, pointerTo(mesh_), directory_)};
}

std::vector<std::pair<std::string, std::uint64_t>> Case::counts() const {
    std::vector<std::pair<std::string, std::uint64_t>> counts{
        {"guides", groom_.strand_count},
        {"vertices_per_guide", groom_.vertices_per_strand},
        {"root_triangles", groom_.root_triangles.size()}};
    if (settings_.render.hair) {
        if (settings_.strands.source == hair::StrandSource::groom)
            counts.emplace_back("groom_strands", groom_.bindings.size());
        counts.emplace_back("strands", plan().strands());
        counts.emplace_back("segments", plan().drawnSegments());
    }
    return counts;
}

hair::StrandView Case::view() const { return viewOf(*groom_buffers_); }

hair::StrandView Case::viewOf(const hair::GroomBuffers& buffers) const {
    hair::StrandView view = buffers.view();
    const hair::GuideView guides = simulation_.guides();
    view.guides = guides.positions;
    view.contacts = guides.contacts;
    view.head = hair::toMatrix(simulation_.pose());
    return view;
}

}  // namespace benchmarks
