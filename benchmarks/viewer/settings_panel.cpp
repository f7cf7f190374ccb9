#include "benchmarks/viewer/settings_panel.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <optional>
#include <type_traits>
#include <utility>

#include <glm/gtc/type_ptr.hpp>
#include <imgui.h>

#include "hair/fields.h"

namespace benchmarks::viewer {

// ---- Values as text -----------------------------------------------------------------------------

namespace {

constexpr std::size_t kElements = 10;  // per page

std::size_t pages(std::size_t count) {
    return std::max<std::size_t>((count + kElements - 1) / kElements, 1);
}

constexpr std::array<std::string_view, 4> kAcronyms{"ftl", "lod", "msaa", "ssaa"};

constexpr std::array kSigns{
    std::pair<std::string_view, std::string_view>{"^2", "²"},
    std::pair<std::string_view, std::string_view>{"^3", "³"},
    std::pair<std::string_view, std::string_view>{"deg", "°"}};

// Resizes the string when Dear ImGui needs more room.
int resize(ImGuiInputTextCallbackData* data) {
    if (data->EventFlag != ImGuiInputTextFlags_CallbackResize) return 0;
    auto& text = *static_cast<std::string*>(data->UserData);
    text.resize(static_cast<std::size_t>(data->BufTextLen));
    data->Buf = text.data();
    return 0;
}

}  // namespace

// ---- Pages of a list ----------------------------------------------------------------------------

ElementRange elementsOf(std::size_t page, std::size_t count) {
    const std::size_t first = std::min(page, pages(count) - 1) * kElements;
    return {first, std::min(first + kElements, count)};
}

ElementRange turnPages(std::size_t count) {
    if (pages(count) < 2) return elementsOf(0, count);
    int& page = *ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("page"), 0);
    const int last = static_cast<int>(pages(count)) - 1;
    page = std::clamp(page, 0, last);
    if (ImGui::ArrowButton("##earlier", ImGuiDir_Left)) page = std::max(page - 1, 0);
    ImGui::SameLine();
    if (ImGui::ArrowButton("##later", ImGuiDir_Right)) page = std::min(page + 1, last);
    ImGui::SameLine();
    int shown = page + 1;
    ImGui::SetNextItemWidth(-1.0f);
    ImGui::SliderInt("##page", &shown, 1, last + 1, "page %d", ImGuiSliderFlags_AlwaysClamp);
    page = shown - 1;
    return elementsOf(static_cast<std::size_t>(page), count);
}

// ---- Names --------------------------------------------------------------------------------------

std::string shownName(std::string_view name) {
    std::string shown(name);
    if (std::ranges::count(kAcronyms, name) > 0) {
        std::ranges::transform(shown, shown.begin(), [](unsigned char c) {
            return static_cast<char>(std::toupper(c));
        });
        return shown;
    }
    std::ranges::replace(shown, '_', ' ');
    if (!shown.empty())
        shown.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(shown.front())));
    return shown;
}

std::string searchable(std::string_view text) {
    std::string found(text);
    std::ranges::transform(found, found.begin(), [](unsigned char c) {
        return c == '_' ? ' ' : static_cast<char>(std::tolower(c));
    });
    return found;
}

// ---- Numbers and units --------------------------------------------------------------------------

std::string shownUnit(const char* unit) {
    std::string text = unit;
    if (text == "1" || text == "count" || text == "factor") return {};
    for (const auto& [written, sign] : kSigns)
        for (std::size_t at = text.find(written); at != std::string::npos; at = text.find(written))
            text.replace(at, written.size(), sign);
    return text;
}

std::string numberFormat(const char* conversion, const char* unit) {
    const std::string shown = shownUnit(unit);
    std::string format = conversion;
    if (shown.empty()) return format;
    if (shown != "°") format += ' ';
    for (const char letter : shown) {
        if (letter == '%') format += '%';
        format += letter;
    }
    return format;
}

double dragSpeed(double value, double minimum, double maximum) {
    const double range = maximum - minimum;
    // In a small range, a drag across a panel covers the whole range.
    if (range <= 4.0) return range / 400.0;
    // In a large range, a pixel changes the number by a hundredth of itself, so that its leading
    // digits move.
    return std::max(std::abs(value) * 0.01, std::min(range / 4000.0, 0.01));
}

// ---- Fields of text -----------------------------------------------------------------------------

bool textInput(const char* label, std::string& text, const char* hint) {
    return ImGui::InputTextWithHint(
        label, hint, text.data(), text.capacity() + 1, ImGuiInputTextFlags_CallbackResize, resize,
        &text);
}

// ---- The panel ----------------------------------------------------------------------------------

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
