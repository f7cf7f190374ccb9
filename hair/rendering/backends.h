#pragma once

#include "engine/pipeline.h"
#include "hair/rendering/strand_backend.h"

// The makers that the table in backends.cpp lists.
namespace hair {

// Vertex -> control -> isolines -> evaluation -> geometry (camera-facing quads) -> fragment:
// thesis 2.2, 2.3.5.
std::unique_ptr<StrandBackend> makeTessellationBackend(const BackendContext& context);

// Strand points evaluated in the vertex stage of a line list, then the same geometry and fragment
// stages.
std::unique_ptr<StrandBackend> makePullingGeometryBackend(const BackendContext& context);

// No strand at all.
std::unique_ptr<StrandBackend> makeEmptyBackend();

// The specialization constants of every shader that includes strands/strand.glsl.
engine::Constants strandConstants(const StrandSettings& strands, const StrandPlan& plan);

// The pipeline state that all line back ends share; without shaders.
engine::GraphicsDescription strandPipeline(const BackendContext& context);

}  // namespace hair
