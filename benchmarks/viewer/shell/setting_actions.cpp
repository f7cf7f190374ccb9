#include "benchmarks/viewer/shell/setting_actions.h"

#include <algorithm>
#include <string_view>

namespace benchmarks {

bool* switchOf(Action action, hair::Settings& settings) {
    hair::OverlaySettings& overlays = settings.render.overlays;
    switch (action) {
    case Action::overlay_guides:
        return &overlays.guides;
    case Action::overlay_root_triangles:
        return &overlays.root_triangles;
    case Action::overlay_bodies:
        return &overlays.bodies;
    case Action::show_head:
        return &settings.render.head;
    case Action::show_hair:
        return &settings.render.hair;
    default:
        return nullptr;
    }
}

std::optional<Tool> toolOf(Action action) {
    switch (action) {
    case Action::tool_camera:
        return Tool::camera;
    case Action::tool_wind:
        return Tool::wind;
    case Action::tool_grab:
        return Tool::grab;
    case Action::tool_head:
        return Tool::head;
    case Action::tool_colliders:
        return Tool::colliders;
    default:
        return std::nullopt;
    }
}

const CameraPreset* presetOf(Action action) {
    const ActionRow& row = rowOf(action);
    if (std::string_view(row.menu) != "Camera") return nullptr;
    const auto presets = cameraPresets();
    const auto found = std::ranges::find_if(presets, [&](const CameraPreset& preset) {
        return std::string_view(preset.name) == row.name;
    });
    return found == presets.end() ? nullptr : &*found;
}

}  // namespace benchmarks
