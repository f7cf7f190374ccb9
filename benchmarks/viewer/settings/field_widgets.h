#pragma once

#include <cstdio>
#include <string>
#include <type_traits>

#include <imgui.h>

#include "benchmarks/viewer/edit.h"
#include "benchmarks/viewer/settings/field_difference.h"
#include "benchmarks/viewer/settings/field_editors.h"
#include "benchmarks/viewer/settings/field_line.h"
#include "benchmarks/viewer/settings/list_pages.h"
#include "benchmarks/viewer/settings/names.h"

namespace benchmarks {

// A widget for each row of a settings table; a group or list is a node that opens. A widget's label
// is "##" and the JSON pointer of what it changes.
class FieldWidgets {
public:
    explicit FieldWidgets(const std::string& search) : search_(searchable(search)) {}

    const Edit& edit() const { return edit_; }

    template <class Settings>
    void showAll(Settings& settings, const Settings& original) {
        hair::forEachField<Settings>([&](const auto& row) {
            if (search_.empty() || finds(row, settings)) show(row, settings, original);
        });
    }

private:
    static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

    template <class Owner, class Settings>
    void show(const hair::Group<Owner, Settings>& row, Owner& owner, const Owner& original) {
        const FieldMark mark = markOf(differ(owner.*row.member, original.*row.member));
        inside(row.name, shownName(row.name), row.help, mark, [&] {
            showAll(owner.*row.member, original.*row.member);
        });
    }

    template <class Owner, class Element>
    void show(const hair::List<Owner, Element>& row, Owner& owner, const Owner& original) {
        auto& list = owner.*row.member;
        const auto& before = original.*row.member;
        const FieldMark mark = markOf(!std::ranges::equal(
            list, before, [](const auto& x, const auto& y) { return !differ(x, y); }));
        const std::string title = shownName(row.name) + " (" + std::to_string(list.size()) + ")";
        inside(row.name, title, row.help, mark, [&] {
            const ElementRange range = turnPages(list.size());
            std::size_t removed = kNone;
            for (std::size_t i = range.first; i < range.last; ++i)
                if (showElement(i, list[i], i < before.size() ? before[i] : Element{})) removed = i;
            if (removed != kNone) {
                list.erase(list.begin() + static_cast<std::ptrdiff_t>(removed));
                edit_.changed = true;
            }
            if (list.size() < row.maximum_count && ImGui::SmallButton(label("Add").c_str())) {
                list.emplace_back();
                edit_.changed = true;
            }
        });
    }

    // True where it is to go.
    template <class Element>
    bool showElement(std::size_t index, Element& element, const Element& before) {
        const std::string name = std::to_string(index);
        bool removed = false;
        inside(name.c_str(), "No. " + name, "", markOf(differ(element, before)), [&] {
            showAll(element, before);
            removed = ImGui::SmallButton(label("Remove").c_str());
        });
        return removed;
    }

    // Everything else has one value.
    template <class Row, class Owner>
    void show(const Row& row, Owner& owner, const Owner& original) {
        auto& value = owner.*row.member;
        const auto& before = original.*row.member;
        const FieldText text{
            .pointer = path_ + '/' + row.name,
            .name = shownName(row.name),
            .unit = shapeOf(row) == FieldShape::below ? unitOf(row) : "",
            .help = row.help,
            .range = rangeOf(row)};
        const bool is_box = shapeOf(row) == FieldShape::check;
        const std::string id = (is_box ? text.name : "") + "##" + text.pointer;
        const bool reset = fieldLine(text, shapeOf(row), markOf(value != before), [&] {
            if (editValue(id.c_str(), row, value)) edit_.changed = true;
            if (ImGui::IsItemActive()) edit_.continues = true;
        });
        if (!reset) return;
        value = before;
        edit_.changed = true;
    }

    static FieldMark markOf(bool changed) {
        return changed ? FieldMark::changed : FieldMark::as_in_scene;
    }

    // ---- What a row looks like ------------------------------------------------------------------

    template <class Owner, class Value>
    static FieldShape shapeOf(const hair::Field<Owner, Value>&) {
        return std::is_same_v<Value, glm::vec3> ? FieldShape::below : FieldShape::beside;
    }
    template <class Owner>
    static FieldShape shapeOf(const hair::Text<Owner>&) {
        return FieldShape::below;
    }
    template <class Owner>
    static FieldShape shapeOf(const hair::Toggle<Owner>&) {
        return FieldShape::check;
    }
    template <class Row>
    static FieldShape shapeOf(const Row&) {
        return FieldShape::beside;
    }

    template <class Row>
    static std::string unitOf(const Row& row) {
        if constexpr (requires { row.unit; })
            return shownUnit(row.unit);
        else
            return {};
    }

    template <class Row>
    static std::string rangeOf(const Row& row) {
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

    // ---- Search ---------------------------------------------------------------------------------

    template <class Row, class Owner>
    bool finds(const Row& row, const Owner& owner) {
        if (searchable(path_ + '/' + row.name).find(search_) != std::string::npos ||
            searchable(row.help).find(search_) != std::string::npos)
            return true;
        if constexpr (kIsGroup<Row>)
            return findsIn(row.name, owner.*row.member);
        else if constexpr (kIsList<Row>)
            return !(owner.*row.member).empty() &&
                   findsIn((std::string(row.name) + "/0").c_str(), (owner.*row.member).front());
        else
            return false;
    }

    template <class Settings>
    bool findsIn(const char* name, const Settings& settings) {
        const std::string path = path_;
        path_ += std::string("/") + name;
        bool any = false;
        hair::forEachField<Settings>([&](const auto& row) { any = any || finds(row, settings); });
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
        // Nodes that a search opens are others than those that the user opens.
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
    std::string path_;  // of the group that is shown: "/strands/curl"
    Edit edit_;
};

}  // namespace benchmarks
