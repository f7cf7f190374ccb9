#include "benchmarks/viewer/toolbar.h"

#include <imgui.h>

namespace benchmarks::viewer {
namespace {

float aspectOf(const hair::Settings& settings) {
    return static_cast<float>(settings.render.width) / static_cast<float>(settings.render.height);
}

struct ToolRow {
    Tool tool;
    const char* name;
    const char* tooltip;
};

constexpr ToolRow kTools[] = {
    {Tool::camera, "Camera",
     "Drag: orbit. Shift+drag, or right or middle button: pan. Wheel, Ctrl+drag, + and -: zoom.\n"
     "W A S D Q E: fly, with Shift faster. Double click: look at what is under the mouse.\n"
     "The other tools do the same if the mouse is not on a handle."},
    {Tool::wind, "Wind", "The wind's arrow: drag its tip to turn and to stretch it"},
    {Tool::grab, "Grab", "Drag hair: a hand pulls at it, and is kept in the scene"},
    {Tool::brush, "Brush", "Drag over hair: combs, cuts, lengthens, pushes or clumps it"},
    {Tool::head, "Head", "Arrows and rings at the head's pivot: drag them to move the head"},
    {Tool::colliders, "Colliders", "Capsules that hair collides with: click to select, then drag"},
    {Tool::lights, "Lights", "Lights and the environment: drag them round the hair"}};

constexpr double kPause = 0.5;  // s without a new frame; longer than a frame on a slow device

}  // namespace

bool RunningClock::runs(const Shown& shown, double seconds) {
    const auto [entry, is_new] = seen_.try_emplace(&shown, Seen{.frame = shown.frame});
    Seen& seen = entry->second;
    if (seen.frame != shown.frame) seen = {shown.frame, seconds};
    return seconds - seen.since < kPause;
}

// ---- Mouse and keys over a picture --------------------------------------------------------------

bool PictureTools::drags() const {
    return wind_.drags() || grab_.drags() || head_.drags() || colliders_.drags() ||
           brush_.drags() || lights_.drags();
}

Edit PictureTools::handle(
    const Pointer& pointer, Handles& handles, hair::Settings& settings, const Shown& played) {
    const bool runs = clock_.runs(played, ImGui::GetTime());
    switch (tool) {
    case Tool::camera:
        break;
    case Tool::wind:
        return wind_.update(pointer, handles, settings, played);
    case Tool::grab:
        return grab_.update(pointer, handles, settings, played, runs);
    case Tool::brush:
        return brush_.update(pointer, handles, settings, played);
    case Tool::lights:
        return lights_.update(pointer, handles, settings, played);
    case Tool::head:
        return head_.update(pointer, handles, settings, played, runs);
    case Tool::colliders:
        return colliders_.update(pointer, handles, settings, played);
    }
    return {};
}

Edit PictureTools::update(
    const PictureRect& rect, const PictureRect& clip, bool hovered, bool held,
    hair::Settings& settings, const Shown& played) {
    const ImGuiIO& io = ImGui::GetIO();
    const bool had = drags();
    // A press with Shift, Ctrl or Alt goes to the camera, not to a handle.
    const bool is_plain = !io.KeyShift && !io.KeyCtrl && !io.KeyAlt;
    // Uses the view of the shown settings; the wanted ones may be ahead of them.
    const Pointer pointer{
        .view = {played.settings.camera, played.settings.render, rect},
        .at = held || had ? dragPoint() : glm::vec2{io.MousePos.x, io.MousePos.y},
        .moved = dragged(),
        .hovers = hovered,
        .pressed = hovered && held && is_plain && ImGui::IsMouseClicked(ImGuiMouseButton_Left),
        .holds = held && ImGui::IsMouseDown(ImGuiMouseButton_Left)};
    Handles handles(clip);
    Edit edit = handle(pointer, handles, settings, played);
    const bool has = had || drags();
    edit |= camera_.update(
        pointer, has ? CameraTool::Left::handle : CameraTool::Left::camera, held, settings, played);
    return edit;
}

Edit PictureTools::frameGroom(hair::Settings& settings, const Shown& played) const {
    const Sphere groom = groomNow(played);
    frameSphere(settings.camera, groom.center, groom.radius, aspectOf(settings));
    return {.changed = true};
}

Edit PictureTools::look(
    hair::Settings& settings, const Shown& played, const CameraPreset& preset) const {
    const Sphere groom = groomNow(played);
    viewer::look(settings.camera, preset, groom.center, groom.radius, aspectOf(settings));
    return {.changed = true};
}

// ---- The line of tools --------------------------------------------------------------------------

Edit PictureTools::toolbar(hair::Settings& settings, const Shown& played) {
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
            if (line.button(preset.name, true, "Looks at the whole groom from this direction"))
                edit |= look(settings, played, preset);
        break;
    case Tool::wind:
        edit = WindTool::options(line, settings);
        break;
    case Tool::grab:
        edit = grab_.options(line, settings);
        break;
    case Tool::brush:
        edit = brush_.options(line, settings);
        break;
    case Tool::lights:
        edit = lights_.options(line, settings, played);
        break;
    case Tool::head:
        edit = head_.options(line, settings);
        break;
    case Tool::colliders:
        edit = colliders_.options(line, settings, played);
        break;
    }
    ImGui::PopID();
    return edit;
}

}  // namespace benchmarks::viewer
