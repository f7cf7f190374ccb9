#include "benchmarks/viewer/settings_panel.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>

#include <glm/gtc/type_ptr.hpp>
#include <imgui.h>

#include "benchmarks/viewer/setting_text.h"
#include "hair/fields.h"

namespace benchmarks::viewer {
namespace {

// ---- The line of a field ------------------------------------------------------------------------

// Placement of a setting's name and widget.
enum class FieldShape {
    beside,  // name left of the widget, or above it if it is long
    below,  // name always above, because the widget needs the width
    check,  // checkbox with its name on the right
};

// Texts about a setting.
struct FieldText {
    std::string pointer;
    std::string name;  // readable
    std::string unit;  // if the widget has no room for it; otherwise empty
    std::string help;
    std::string range;  // empty: none
};

enum class FieldMark { as_in_scene, changed };

constexpr float kNameShare = 0.46f;  // share of the line

float resetWidth() { return ImGui::GetFrameHeight(); }

// Some fonts lack the arrow.
const char* resetLabel() { return ImGui::GetFont()->FindGlyphNoFallback(0x21ba) ? "↺" : "x"; }

void explain(const FieldText& text) {
    if (!ImGui::IsItemHovered(ImGuiHoveredFlags_DelayNormal)) return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 28.0f);
    ImGui::TextUnformatted(text.help.c_str());
    if (!text.range.empty()) ImGui::TextDisabled("%s", text.range.c_str());
    ImGui::TextDisabled("%s", text.pointer.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

void showName(const FieldText& text) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(text.name.c_str());
    explain(text);
    if (text.unit.empty()) return;
    ImGui::SameLine();
    ImGui::TextDisabled("%s", text.unit.c_str());
}

// A button that resets a value, at the right end of the last item's line.
bool reset(const FieldText& text, float end) {
    ImGui::SameLine(end - resetWidth());
    const std::string label = std::string(resetLabel()) + "##" + text.pointer + "/reset";
    const bool pressed = ImGui::Button(label.c_str(), {resetWidth(), 0.0f});
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_DelayShort)) ImGui::SetTooltip("resets the value");
    return pressed;
}

// Shows a setting in one or two lines within the current Dear ImGui window: its name and its
// widget. `widget` makes the widget as its last item, with the width already set. A checkbox shows
// its own name. Returns whether to reset the value.
bool fieldLine(
    const FieldText& text, FieldShape shape, FieldMark mark, const std::function<void()>& widget) {
    const bool changed = mark == FieldMark::changed;
    const float start = ImGui::GetCursorPosX();
    const float room = ImGui::GetContentRegionAvail().x;
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
    const float name = ImGui::CalcTextSize(text.name.c_str()).x + 2.0f * gap;
    const bool above =
        shape == FieldShape::below || (shape == FieldShape::beside && name > room * kNameShare);
    bool is_reset = false;
    if (changed)
        ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_PlotHistogram));
    if (shape != FieldShape::check) showName(text);
    if (changed && shape != FieldShape::check) ImGui::PopStyleColor();
    if (above) {
        if (changed) is_reset = reset(text, start + room);
        ImGui::SetNextItemWidth(-1.0f);
    } else if (shape == FieldShape::beside) {
        ImGui::SameLine(start + room * kNameShare);
        ImGui::SetNextItemWidth(changed ? -resetWidth() - gap : -1.0f);
    }
    widget();
    if (changed && shape == FieldShape::check) ImGui::PopStyleColor();
    explain(text);
    if (changed && !above) is_reset = reset(text, start + room);
    return is_reset;
}

// ---- The widget of one value --------------------------------------------------------------------

// Each editValue() shows the widget of one value, with the next item's width, within the current
// Dear ImGui window. Returns whether it changed the value.

bool isColor(const std::string& name, const hair::Range& range) {
    return range.minimum == 0.0 && range.maximum == 1.0 &&
           (name.find("color") != std::string::npos || name == "background");
}

bool editValue(
    const char* label, const char* name, const hair::Number<glm::vec3>& row,
    hair::SettingsRef settings) {
    glm::vec3& value = row.in(settings);
    const float largest = std::max({std::abs(value.x), std::abs(value.y), std::abs(value.z)});
    const auto speed = static_cast<float>(dragSpeed(double{largest}, row.minimum, row.maximum));
    bool changed = false;
    ImGui::BeginGroup();
    if (isColor(name, row)) {
        constexpr ImGuiColorEditFlags kSwatch =
            ImGuiColorEditFlags_NoInputs | ImGuiColorEditFlags_NoLabel | ImGuiColorEditFlags_Float;
        const std::string swatch = std::string(label) + "/swatch";
        changed |= ImGui::ColorEdit3(swatch.c_str(), glm::value_ptr(value), kSwatch);
        ImGui::SameLine(0.0f, ImGui::GetStyle().ItemInnerSpacing.x);
    }
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
    const float width = std::floor((ImGui::GetContentRegionAvail().x - 2.0f * gap) / 3.0f);
    for (int i = 0; i < 3; ++i) {
        if (i > 0) ImGui::SameLine(0.0f, gap);
        ImGui::SetNextItemWidth(i < 2 ? width : -1.0f);
        const std::string component = label + ('/' + std::to_string(i));
        changed |= ImGui::DragFloat(
            component.c_str(), &value[i], speed, static_cast<float>(row.minimum),
            static_cast<float>(row.maximum), "%.4g", ImGuiSliderFlags_AlwaysClamp);
    }
    ImGui::EndGroup();
    return changed;
}

bool editValue(
    const char* label, const char*, const hair::Number<float>& row, hair::SettingsRef settings) {
    float& value = row.in(settings);
    const std::string format = numberFormat("%.5g", row.unit);
    return ImGui::DragFloat(
        label, &value, static_cast<float>(dragSpeed(double{value}, row.minimum, row.maximum)),
        static_cast<float>(row.minimum), static_cast<float>(row.maximum), format.c_str(),
        ImGuiSliderFlags_AlwaysClamp);
}

template <class Whole>
bool editValue(
    const char* label, const char*, const hair::Number<Whole>& row, hair::SettingsRef settings) {
    constexpr bool kSigned = std::is_signed_v<Whole>, kLong = sizeof(Whole) == 8;
    constexpr ImGuiDataType kType = kLong     ? ImGuiDataType_U64
                                    : kSigned ? ImGuiDataType_S32
                                              : ImGuiDataType_U32;
    Whole& value = row.in(settings);
    const std::string format = numberFormat(kLong ? "%llu" : kSigned ? "%d" : "%u", row.unit);
    const auto minimum = static_cast<Whole>(row.minimum);
    const auto maximum = static_cast<Whole>(row.maximum);
    const double speed =
        std::max(dragSpeed(static_cast<double>(value), row.minimum, row.maximum), 0.05);
    return ImGui::DragScalar(
        label, kType, &value, static_cast<float>(speed), &minimum, &maximum, format.c_str(),
        ImGuiSliderFlags_AlwaysClamp);
}

bool editValue(const char* label, const char*, const hair::OneOf& row, hair::SettingsRef settings) {
    std::uint32_t& value = row.in(settings);
    const std::string unit = shownUnit(row.unit);
    const auto text = [&](std::uint32_t number) {
        return std::to_string(number) + (unit.empty() ? "" : " " + unit);
    };
    if (!ImGui::BeginCombo(label, text(value).c_str())) return false;
    bool changed = false;
    for (const std::uint32_t each : row.values) {
        if (!ImGui::Selectable(text(each).c_str(), each == value)) continue;
        changed = value != each;
        value = each;
    }
    ImGui::EndCombo();
    return changed;
}

// Takes the text only when the field loses focus, because a partial file name is not valid.
bool editValue(const char* label, const char*, const hair::Text& row, hair::SettingsRef settings) {
    std::string& value = row.in(settings);
    std::string text = value;
    textInput(label, text);
    if (!ImGui::IsItemDeactivatedAfterEdit() || text == value) return false;
    value = text;
    return true;
}

bool editValue(
    const char* label, const char*, const hair::Toggle& row, hair::SettingsRef settings) {
    return ImGui::Checkbox(label, &row.in(settings));
}

bool editValue(
    const char* label, const char*, const hair::Choice& row, hair::SettingsRef settings) {
    const std::optional<std::size_t> chosen = row.chosen(settings);
    if (!ImGui::BeginCombo(label, chosen ? row.names[*chosen].name : "")) return false;
    bool changed = false;
    for (std::size_t i = 0; i < row.names.size(); ++i) {
        if (!ImGui::Selectable(row.names[i].name, i == chosen)) continue;
        changed = i != chosen;
        row.choose(settings, i);
    }
    ImGui::EndCombo();
    return changed;
}

// Lists names, and below them a field for a file's path.
bool editValue(
    const char* label, const char* name, const hair::ChoiceOrFile& row,
    hair::SettingsRef settings) {
    std::string& file = row.file.in(settings);
    const std::optional<std::size_t> chosen = row.chosen(settings);
    const char* const shown = chosen ? row.names[*chosen].name : file.c_str();
    if (!ImGui::BeginCombo(label, shown)) return false;
    bool changed = false;
    for (std::size_t i = 0; i < row.names.size(); ++i) {
        if (!ImGui::Selectable(row.names[i].name, i == chosen)) continue;
        changed = i != chosen;
        row.chooseName(settings, i);
    }
    std::string path = file;
    textInput((std::string("##") + name + "/file").c_str(), path, "or a file (.glsl)");
    if (ImGui::IsItemDeactivatedAfterEdit() && path != file &&
        path.ends_with(hair::ChoiceOrFile::kExtension)) {
        row.chooseFile(settings, path);
        changed = true;
    }
    ImGui::EndCombo();
    return changed;
}

// ---- The original value -------------------------------------------------------------------------

template <class Value>
void reset(const hair::Member<Value>& row, hair::SettingsRef settings, hair::SettingsView before) {
    row.in(settings) = row.in(before);
}

void reset(const hair::Choice& row, hair::SettingsRef settings, hair::SettingsView before) {
    if (const auto chosen = row.chosen(before)) row.choose(settings, *chosen);
}

void reset(const hair::ChoiceOrFile& row, hair::SettingsRef settings, hair::SettingsView before) {
    if (const auto chosen = row.chosen(before))
        row.chooseName(settings, *chosen);
    else
        row.chooseFile(settings, row.file.in(before));
}

// ---- Appearance of a row ------------------------------------------------------------------------

FieldShape shapeOf(const hair::Place&) { return FieldShape::beside; }
FieldShape shapeOf(const hair::Number<glm::vec3>&) { return FieldShape::below; }
FieldShape shapeOf(const hair::Text&) { return FieldShape::below; }
FieldShape shapeOf(const hair::Toggle&) { return FieldShape::check; }

template <class Row>
std::string unitOf(const Row& row) {
    if constexpr (requires { row.unit; })
        return shownUnit(row.unit);
    else
        return {};
}

template <class Row>
std::string rangeOf(const Row& row) {
    if constexpr (requires { row.minimum; }) {
        char text[96];
        std::snprintf(
            text, sizeof text, "%.10g to %.10g %s", row.minimum, row.maximum,
            shownUnit(row.unit).c_str());
        return text;
    } else {
        return {};
    }
}

FieldMark markOf(bool changed) { return changed ? FieldMark::changed : FieldMark::as_in_scene; }

// Shows a widget for each row of a settings table. A group or list is a collapsible node. A
// widget's label is "##" and the JSON pointer of its field.
class FieldWidgets {
public:
    explicit FieldWidgets(const std::string& search) : search_(searchable(search)) {}

    const Edit& edit() const { return edit_; }

    void showAll(hair::SettingsRef settings, hair::SettingsView original) {
        for (const hair::Field& field : settings.fields())
            if (search_.empty() || finds(field, settings))
                std::visit(
                    [&](const auto& row) { show(field, row, settings, original); }, field.kind);
    }

private:
    void show(
        const hair::Field& field, const hair::Group& row, hair::SettingsRef settings,
        hair::SettingsView original) {
        const FieldMark mark = markOf(hair::differ(field, settings, original));
        inside(field.name, shownName(field.name), field.help, mark, [&] {
            showAll(row.in(settings), row.in(original));
        });
    }

    void show(
        const hair::Field& field, const hair::List& row, hair::SettingsRef settings,
        hair::SettingsView original) {
        const std::size_t size = row.size(settings);
        const FieldMark mark = markOf(hair::differ(field, settings, original));
        const std::string title = shownName(field.name) + " (" + std::to_string(size) + ")";
        inside(field.name, title, field.help, mark, [&] {
            const ElementRange range = turnPages(size);
            std::optional<std::size_t> removed;
            for (std::size_t i = range.first; i < range.last; ++i) {
                const hair::SettingsView before =
                    i < row.size(original) ? row.at(original, i) : row.newElement();
                if (showElement(i, row.at(settings, i), before)) removed = i;
            }
            if (removed) {
                row.erase(settings, *removed);
                edit_.changed = true;
            }
            const std::size_t left = row.size(settings);
            if (left < row.maximum_count && ImGui::SmallButton(label("Add").c_str())) {
                row.resize(settings, left + 1);
                edit_.changed = true;
            }
        });
    }

    // Shows the parameters that the file declares, each like a struct with one member.
    void show(
        const hair::Field& field, const hair::Parameters& row, hair::SettingsRef settings,
        hair::SettingsView original) {
        hair::ExtensionParameters& parameters = row.in(settings);
        if (!parameters.file || parameters.values.empty()) return;
        const auto& before = row.in(original).values;
        const FieldMark mark = markOf(hair::differ(field, settings, original));
        inside(field.name, shownName(field.name), field.help, mark, [&] {
            for (std::size_t i = 0; i < parameters.values.size(); ++i) {
                const hair::ExtensionParameter& declared = parameters.file->parameters.at(i);
                const auto same =
                    std::ranges::find(before, declared.name, &hair::ExtensionValue::name);
                showParameter(
                    declared, parameters.values[i],
                    same != before.end()
                        ? *same
                        : hair::ExtensionValue{
                              declared.name, declared.is_vector, declared.original});
            }
        });
    }

    void showParameter(
        const hair::ExtensionParameter& declared, hair::ExtensionValue& value,
        const hair::ExtensionValue& before) {
        static const hair::Table none(nullptr, {});
        const hair::SettingsRef now(none, &value);
        const hair::SettingsView then(none, &before);
        const hair::Range range{declared.minimum, declared.maximum, declared.unit.c_str()};
        const auto showAs = [&](const auto& row) {
            show({declared.name.c_str(), declared.help.c_str(), row}, row, now, then);
        };
        if (declared.is_vector)
            showAs(hair::Number<glm::vec3>{{hair::Place(&value, &value.value)}, range});
        else
            showAs(hair::Number<float>{{hair::Place(&value, &value.value.x)}, range});
    }

    // Returns whether to remove the element.
    bool showElement(std::size_t index, hair::SettingsRef element, hair::SettingsView before) {
        const std::string name = std::to_string(index);
        bool removed = false;
        inside(name.c_str(), "No. " + name, "", markOf(hair::differ(element, before)), [&] {
            showAll(element, before);
            removed = ImGui::SmallButton(label("Remove").c_str());
        });
        return removed;
    }

    // Shows a row with one value.
    template <class Row>
    void show(
        const hair::Field& field, const Row& row, hair::SettingsRef settings,
        hair::SettingsView original) {
        const FieldText text{
            .pointer = path_ + '/' + field.name,
            .name = shownName(field.name),
            .unit = shapeOf(row) == FieldShape::below ? unitOf(row) : "",
            .help = field.help,
            .range = rangeOf(row)};
        const bool is_box = shapeOf(row) == FieldShape::check;
        const std::string id = (is_box ? text.name : "") + "##" + text.pointer;
        const FieldMark mark = markOf(hair::differ(field, settings, original));
        const bool as_it_was = fieldLine(text, shapeOf(row), mark, [&] {
            if (editValue(id.c_str(), field.name, row, settings)) edit_.changed = true;
            if (ImGui::IsItemActive()) edit_.continues = true;
        });
        if (!as_it_was) return;
        reset(row, settings, original);
        edit_.changed = true;
    }

    // ---- Search ---------------------------------------------------------------------------------

    bool finds(const hair::Field& field, hair::SettingsView settings) {
        if (searchable(path_ + '/' + field.name).find(search_) != std::string::npos ||
            searchable(field.help).find(search_) != std::string::npos)
            return true;
        if (const auto* const group = std::get_if<hair::Group>(&field.kind))
            return findsIn(field.name, group->in(settings));
        if (const auto* const own = std::get_if<hair::Parameters>(&field.kind))
            return std::ranges::any_of(own->in(settings).values, [&](const auto& value) {
                return searchable(value.name).find(search_) != std::string::npos;
            });
        if (const auto* const list = std::get_if<hair::List>(&field.kind))
            return list->size(settings) > 0 &&
                   findsIn(std::string(field.name) + "/0", list->at(settings, 0));
        return false;
    }

    bool findsIn(const std::string& name, hair::SettingsView settings) {
        const std::string path = path_;
        path_ += '/' + name;
        const bool any = std::ranges::any_of(
            settings.fields(), [&](const hair::Field& field) { return finds(field, settings); });
        path_ = path;
        return any;
    }

    // ---- Nodes ----------------------------------------------------------------------------------

    std::string label(const char* text) const { return std::string(text) + "##" + path_; }

    template <class Body>
    void inside(
        const char* name, const std::string& title, const char* help, FieldMark mark, Body&& body) {
        const std::string path = path_;
        path_ += std::string("/") + name;
        // Nodes opened by a search have other ids than nodes opened by the user.
        if (!search_.empty()) ImGui::SetNextItemOpen(true, ImGuiCond_Appearing);
        const std::string id = title + "###" + path_ + (search_.empty() ? "" : "?");
        if (mark == FieldMark::changed)
            ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_PlotHistogram));
        const bool open = ImGui::TreeNodeEx(
            id.c_str(), ImGuiTreeNodeFlags_SpanAvailWidth | ImGuiTreeNodeFlags_FramePadding);
        if (mark == FieldMark::changed) ImGui::PopStyleColor();
        if (*help && ImGui::IsItemHovered(ImGuiHoveredFlags_DelayNormal))
            ImGui::SetTooltip("%s", help);
        if (open) {
            body();
            ImGui::TreePop();
        }
        path_ = path;
    }

    std::string search_;
    std::string path_;  // pointer of the group being shown: "/strands/curl"
    Edit edit_;
};

}  // namespace

Edit settingsPanel(
    hair::Settings& settings, const hair::Settings& original, const std::string& search) {
    FieldWidgets widgets(search);
    widgets.showAll(settings, original);
    return widgets.edit();
}

}  // namespace benchmarks::viewer
