#include "hair/rendering/rays_backend.h"

#include <cassert>

#include "hair/rendering/render_assets.h"

namespace hair::rendering {
namespace {

constexpr const char* kRays = "/strands/backend: rays";

const BackendContext& checked(const BackendContext& context) {
    assert(context.structure);
    return context;
}

engine::ComputeDescription traceStage(const BackendContext& context) {
    engine::ComputeDescription stage =
        samplesStage(context, "rays", "trace.comp", pixelGroup(context.device));
    stage.constants.emplace_back(gpu::kBoxesConstant, context.structure->hasBoxes());
    return stage;
}

}  // namespace

void RaysBackend::check(
    const engine::Device& device, const Settings& settings, const StrandPlan& plan) {
    Settings traced = settings;
    traced.strands.backend = Backend::rays;
    StrandStructure::check(device, traced, plan);
    checkPoints(plan);
    VisibilityBuffer::check(device, settings, kRays);
}

engine::MemoryRows
RaysBackend::rows(const engine::Device&, const Settings& settings, const StrandPlan&) {
    return VisibilityBuffer::rows(targetDescription(settings.render));
}

RaysBackend::RaysBackend(const BackendContext& context)
    : points_(*context.points), structure_(*checked(context).structure),
      visibility_(context, kRays),
      columns_(divideUp(context.target->color().extent().width, pixelGroup(context.device))),
      trace_(context.device, traceStage(context)) {}

void RaysBackend::prepare(engine::Commands& commands, const StrandPicture& picture) const {
    visibility_.clear(commands, picture);
    gpu::SoftwarePush constants = visibility_.push(picture);
    constants.points = commands.reads(points_.points());
    constants.pieces = commands.reads(points_.pieces());
    constants.bounds = commands.reads(points_.bounds());
    constants.visibility = commands.writes(visibility_.samples());
    constants.structure = structure_.traces(commands);
    if (structure_.hasBoxes()) constants.boxes = commands.reads(structure_.boxes());
    commands.bind(trace_, constants);
    commands.dispatch(constants.height, columns_);
    visibility_.shade(commands, picture);
}

void RaysBackend::draw(engine::Commands& commands, const StrandPicture& picture) const {
    visibility_.draw(commands, picture);
}

}  // namespace hair::rendering
