#include "benchmarks/ablate/still_hair.h"

#include "benchmarks/assets.h"
#include "benchmarks/interrupt.h"

namespace benchmarks {

StillHair::StillHair(
    const engine::Device& device, const hair::Settings& settings,
    const std::filesystem::path& directory, std::uint32_t frame)
    : case_(device, settings, directory), mesh_(loadMesh(settings, directory)),
      assets_(loadRenderAssets(settings, mesh_ ? &*mesh_ : nullptr, directory)) {
    engine::FrameLoop loop(device, engine::Timing::statistics);
    for (std::uint32_t i = 0; i <= frame; ++i) {
        checkInterrupted();
        loop.frame([&](engine::Passes& passes) { case_.simulate(passes); });
    }
}

}  // namespace benchmarks
