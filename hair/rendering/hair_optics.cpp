#include "hair/rendering/hair_optics.h"

#include <span>

#include "engine/transfer.h"

namespace hair {

gpu::HairOptics makeHairOptics(const Settings&) { return {}; }

HairOpticsBuffers::HairOpticsBuffers(const engine::Device& device, const Settings& settings)
    : optics_([&] {
          const gpu::HairOptics optics = makeHairOptics(settings);
          return engine::makeBuffer(device, std::span(&optics, 1), "hair optics");
      }()) {}

}  // namespace hair
