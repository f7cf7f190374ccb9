#pragma once

#include <span>
#include <string>
#include <string_view>

#include "engine/device.h"
#include "hair/rendering/backends.h"
#include "hair/rendering/strand_plan.h"
#include "hair/settings.h"

// Which back end draws a case's strands.
namespace hair::rendering {

// A setting that a back end doesn't draw: docs/rendering.md has the table.
struct BackendLimit {
    Backend backend;
    std::string_view asked_for;
    std::string_view reason;
    bool (*asks)(const Settings&);
};
std::span<const BackendLimit> backendLimits();

// Throws engine::Unsupported for settings that the back end doesn't draw.
void checkBackend(Backend backend, const Settings& settings);

// Returns the back ends that draw the same picture, fastest first on this kind of device.
// docs/rendering.md has both orders and their sources.
std::span<const Backend> backendOrder(const engine::DeviceInfo& device);

struct BackendChoice {
    Backend backend = Backend::tessellation;
    std::string variant;  // StrandBackend::variant() of the back end that was made
    std::string reason;
};

// Returns the case's own back end or, if that is `automatic`, the first of backendOrder() that can
// draw the case on the device. Throws engine::Unsupported if the case's own back end can't draw it,
// or if none can.
BackendChoice chooseBackend(
    const engine::Device& device, const Settings& settings, const StrandPlan& plan,
    const StrandStages& stages);

}  // namespace hair::rendering
