#include "hair/rendering/backend_choice.h"

#include <array>
#include <cassert>
#include <optional>

#include "engine/error.h"

namespace hair::rendering {
namespace {

// All settings that back ends don't draw, one row each.
constexpr std::array kBackendLimits{
    BackendLimit{
        Backend::lines, "`/render/coverage` `analytic`", "its lines are a pixel wide",
        [](const Settings& s) { return s.render.coverage == Coverage::analytic; }},
    BackendLimit{
        Backend::software, "a `/render/transparency` other than `none`",
        "it keeps one strand per sample",
        [](const Settings& s) { return s.render.transparency != Transparency::none; }},
    BackendLimit{
        Backend::software, "a `/render/show` other than `shading`",
        "it can only draw shaded strands",
        [](const Settings& s) { return s.render.show != Show::shading; }},
    BackendLimit{
        Backend::software, "`/strands/texture`", "its strands have no holes",
        [](const Settings& s) { return !s.strands.texture.empty(); }},
};

// As measured on lavapipe (docs/performance.md).
constexpr std::array kOnProcessors{Backend::software, Backend::tessellation,     Backend::expanded,
                                   Backend::mesh,     Backend::pulling_geometry, Backend::pulling};

// As measured on an H200 (docs/performance.md).
constexpr std::array kOnGraphicsProcessors{Backend::software,     Backend::expanded,
                                           Backend::pulling,      Backend::mesh,
                                           Backend::tessellation, Backend::pulling_geometry};

// The reason why the back end can't draw the case; absent if it can.
std::optional<std::string> obstacle(
    Backend backend, const engine::Device& device, const Settings& settings,
    const StrandPlan& plan) {
    try {
        checkBackend(backend, settings);
        checkDevice(backend, device, settings, plan);
    } catch (const engine::Unsupported& error) {
        return error.what();
    }
    return std::nullopt;
}

}  // namespace

std::span<const BackendLimit> backendLimits() { return kBackendLimits; }

void checkBackend(Backend backend, const Settings& settings) {
    for (const BackendLimit& limit : kBackendLimits) {
        if (limit.backend != backend || !limit.asks(settings)) continue;
        std::string text =
            std::string(limit.asked_for) + " is not drawn: " + std::string(limit.reason);
        std::erase(text, '`');
        throw engine::Unsupported("/strands/backend", text);
    }
}

std::span<const Backend> backendOrder(const engine::DeviceInfo& device) {
    if (device.type == "cpu") return kOnProcessors;
    return kOnGraphicsProcessors;
}

BackendChoice chooseBackend(
    const engine::Device& device, const Settings& settings, const StrandPlan& plan,
    const StrandStages& stages) {
    const Backend own = settings.strands.backend;
    if (own != Backend::automatic) {
        if (settings.render.hair) checkBackend(own, settings);
        return {own, {}, "the scene names it"};
    }
    if (!settings.render.hair) return {Backend::tessellation, {}, "no hair is drawn"};
    if (stages != StrandStages{}) return {Backend::tessellation, {}, "its stages can be left out"};
    std::string others;
    for (const Backend backend : backendOrder(device.info())) {
        const std::optional<std::string> against = obstacle(backend, device, settings, plan);
        if (!against) return {backend, {}, "automatic: the first that can draw it" + others};
        others += "; not " + std::string(backendName(backend)) + ": " + *against;
    }
    throw engine::Unsupported("/strands/backend", "none can draw this" + others);
}

}  // namespace hair::rendering
