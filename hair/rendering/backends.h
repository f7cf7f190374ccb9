#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "engine/buffer_image.h"
#include "engine/device.h"
#include "hair/rendering/strand_backend.h"
#include "hair/rendering/strand_plan.h"
#include "hair/settings.h"

// The list of back ends, for code that chooses one, and features that only some of them have.

namespace hair::rendering {

// Throws engine::Unsupported for stages that the back end or the device lacks. Quads that face a
// light are drawn by mapBackend().
std::unique_ptr<StrandBackend> makeBackend(Backend backend, const BackendContext& context);

// Returns the back end that draws shadow maps for this one: itself, or another if it draws none.
// Not for those that draw them in compute.
Backend mapBackend(Backend backend);

// Whether a MapRasterizer draws the back end's shadow maps.
bool drawsMapsInCompute(Backend backend);

// Throws engine::Unsupported if the device can't draw the case's strands by the back end: the
// device lacks stages, or there are more strands than shaders can number.
void checkDevice(
    Backend backend, const engine::Device& device, const Settings& settings,
    const StrandPlan& plan);

// Returns the memory of the case's back end for a picture's strands, without points.
engine::MemoryRows backendRows(
    const engine::Device& device, const Settings& settings, const StrandPlan& plan, QuadKind quads);

// Whether the case's back end draws from the points of a PointsPass.
bool readsPoints(const Settings& settings);

// Whether the case's back end reads the depth of the scene.
bool readsSceneDepth(const Settings& settings);

// Adds up the outputs of watched stages. A condition on an invocation's outputs decides whether
// they are added. Drivers can't predict it, so they must do the work of all invocations. The
// additions are atomic and need no order, so Commands::uses() need not know of them.
class StageWatch {
public:
    // Starts in the state of countNone(). Throws engine::Unsupported if stages before the
    // rasteriser can't write to buffers.
    explicit StageWatch(const engine::Device& device);

    std::uint64_t address() const { return buffer_.address(); }

    // Adds up every invocation from the next frame on, which is slow. The device must have finished
    // the last frame.
    void countAll();
    // Adds up almost no invocation from the next frame on (one of 2^32 for random outputs), at the
    // cost of a comparison. The device must have finished the last frame.
    void countNone();

    struct Counts {
        std::uint32_t invocations = 0;
        std::uint32_t sum = 0;  // of the bits of their outputs, modulo 2^32
    };
    // Returns the sums since the last call of countAll() or countNone(). Waits for the device.
    Counts counts() const;

private:
    void set(std::uint32_t mask, std::uint32_t wanted);

    const engine::Device& device_;
    engine::Buffer buffer_;
};

// Which back end draws a case's strands.

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
