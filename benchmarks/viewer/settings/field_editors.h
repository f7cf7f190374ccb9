#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <type_traits>

#include <glm/gtc/type_ptr.hpp>
#include <imgui.h>

#include "benchmarks/viewer/settings/number_text.h"
#include "benchmarks/viewer/settings/text_input.h"
#include "hair/fields.h"

// The widget of one value, for each kind of row in a settings table: of the next item's width,
// within the current window of Dear ImGui. True where it changed the value.
namespace benchmarks {

template <class Row>
bool isColor(const Row& row) {
    const std::string name = row.name;
    return row.minimum == 0.0 && row.maximum == 1.0 &&
           (name.find("color") != std::string::npos || name == "background");
}

template <class Owner>
bool editValue(const char* label, const hair::Field<Owner, glm::vec3>& row, glm::vec3& value) {
    const float largest = std::max({std::abs(value.x), std::abs(value.y), std::abs(value.z)});
    const auto speed = static_cast<float>(dragSpeed(double{largest}, row.minimum, row.maximum));
    bool changed = false;
    ImGui::BeginGroup();
    if (isColor(row)) {
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

template <class Owner>
bool editValue(const char* label, const hair::Field<Owner, float>& row, float& value) {
    const std::string format = numberFormat("%.5g", row.unit);
    return ImGui::DragFloat(
        label, &value, static_cast<float>(dragSpeed(double{value}, row.minimum, row.maximum)),
        static_cast<float>(row.minimum), static_cast<float>(row.maximum), format.c_str(),
        ImGuiSliderFlags_AlwaysClamp);
}

template <class Owner, class Value>
    requires std::is_integral_v<Value>
bool editValue(const char* label, const hair::Field<Owner, Value>& row, Value& value) {
    constexpr bool kSigned = std::is_signed_v<Value>, kLong = sizeof(Value) == 8;
    constexpr ImGuiDataType kType = kLong     ? ImGuiDataType_U64
                                    : kSigned ? ImGuiDataType_S32
                                              : ImGuiDataType_U32;
    const std::string format = numberFormat(kLong ? "%llu" : kSigned ? "%d" : "%u", row.unit);
    const auto minimum = static_cast<Value>(row.minimum);
    const auto maximum = static_cast<Value>(row.maximum);
    const double speed =
        std::max(dragSpeed(static_cast<double>(value), row.minimum, row.maximum), 0.05);
    return ImGui::DragScalar(
        label, kType, &value, static_cast<float>(speed), &minimum, &maximum, format.c_str(),
        ImGuiSliderFlags_AlwaysClamp);
}

// Half a file name is none: it counts once it is entered.
template <class Owner>
bool editValue(const char* label, const hair::Text<Owner>&, std::string& value) {
    std::string text = value;
    textInput(label, text);
    if (!ImGui::IsItemDeactivatedAfterEdit() || text == value) return false;
    value = text;
    return true;
}

template <class Owner>
bool editValue(const char* label, const hair::Toggle<Owner>&, bool& value) {
    return ImGui::Checkbox(label, &value);
}

template <class Owner, class Enum, std::size_t Count>
bool editValue(const char* label, const hair::Choice<Owner, Enum, Count>& row, Enum& value) {
    const auto chosen = std::ranges::find(row.names, value, &hair::Named<Enum>::value);
    if (!ImGui::BeginCombo(label, chosen == row.names.end() ? "" : chosen->name)) return false;
    bool changed = false;
    for (const auto& named : row.names) {
        if (!ImGui::Selectable(named.name, named.value == value)) continue;
        changed = value != named.value;
        value = named.value;
    }
    ImGui::EndCombo();
    return changed;
}

template <class Owner, std::size_t Count>
bool editValue(const char* label, const hair::OneOf<Owner, Count>& row, std::uint32_t& value) {
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

}  // namespace benchmarks
