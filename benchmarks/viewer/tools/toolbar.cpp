#include <imgui.h>

#include "benchmarks/viewer/tools/options_line.h"
#include "benchmarks/viewer/tools/picture_tools.h"

namespace benchmarks {

namespace {

struct ToolRow {
    Tool tool;
    const char* name;
    const char* tooltip;
};

constexpr ToolRow kTools[] = {
    {Tool::camera, "Camera",
     "Drag: orbit. Shift+drag, or right or middle button: pan. Wheel, Ctrl+drag, + and -: zoom.\n"
     "W A S D Q E: fly, with Shift faster. Double click: look at what is under the mouse.\n"
     "The other tools do the same where the mouse is on no handle."},
    {Tool::wind, "Wind", "The wind's arrow: drag its tip to turn and to stretch it"},
    {Tool::grab, "Grab", "Drag hair: a hand pulls at it, and is kept in the scene"},
    {Tool::head, "Head", "Arrows and rings at the head's pivot: drag them to move the head"},
    {Tool::colliders, "Colliders", "Capsules that hair collides with: click to select, then drag"}};

}  // namespace

Edit PictureTools::toolbar(hair::Settings& settings, const Player& player) {
    ImGui::PushID("tools");
    OptionsLine line;
    for (const ToolRow& row : kTools)
        if (line.choice(
                row.name,
                row.tool == tool ? OptionsLine::Choice::chosen : OptionsLine::Choice::open,
                row.tooltip))
            tool = row.tool;
    line.separator();
    Edit edit;
    switch (tool) {
    case Tool::camera:
        for (const CameraPreset& preset : cameraPresets())
            if (line.button(preset.name, true, "Looks at the groom from there"))
                edit |= look(settings, player, preset);
        break;
    case Tool::wind:
        edit = WindTool::options(line, settings);
        break;
    case Tool::grab:
        edit = grab_.options(line, settings);
        break;
    case Tool::head:
        edit = head_.options(line, settings);
        break;
    case Tool::colliders:
        edit = colliders_.options(line, settings, player);
        break;
    }
    ImGui::PopID();
    return edit;
}

}  // namespace benchmarks
