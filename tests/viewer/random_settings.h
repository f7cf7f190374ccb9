#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <random>
#include <string>

#include "benchmarks/scene/settings_json.h"
#include "hair/fields.h"
#include "hair/settings.h"

// Returns all settings as text, for comparison.
inline std::string allOf(const hair::Settings& settings) {
    return benchmarks::scene::writeSettings(settings).dump();
}

// Settings with a few members changed from the defaults, each to a value that the tables allow:
// bounds, numbers without a short decimal, texts that need quoting, lists.
class RandomSettings {
public:
    RandomSettings(std::uint32_t seed, double share) : random_(seed), share_(share) {}

    hair::Settings operator()() {
        hair::Settings settings;
        change(settings);
        return settings;
    }

private:
    bool chance(double share) { return std::bernoulli_distribution(share)(random_); }
    std::size_t below(std::size_t count) {
        return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_);
    }

    void change(hair::SettingsRef settings) {
        for (const hair::Field& field : settings.fields())
            std::visit([&](const auto& row) { changeRow(row, settings); }, field.kind);
    }

    float numberIn(double minimum, double maximum) {
        const auto low = static_cast<float>(minimum);
        const auto high = static_cast<float>(maximum);
        switch (below(6)) {
        case 0:
            return double{low} >= minimum ? low : std::nextafter(low, high);
        case 1:
            return double{high} <= maximum ? high : std::nextafter(high, low);
        case 2:
            return minimum <= 0.0 && maximum >= 0.0 ? -0.0f : low;
        case 3:
            return std::clamp(1.0f / 3.0f, std::nextafter(low, high), std::nextafter(high, low));
        default:
            return std::clamp(
                static_cast<float>(
                    std::uniform_real_distribution<double>(minimum, maximum)(random_)),
                std::nextafter(low, high), std::nextafter(high, low));
        }
    }

    std::string text() {
        static constexpr const char* kTexts[] = {
            "plain",
            "",
            "two words",
            "a,b",
            "[1,2",
            "{",
            "it's",
            "\"quoted\"",
            "back\\slash",
            "$HOME `x`",
            "tab\tline\nend",
            "12",
            "10:50:20",
            "pow2:6:12",
            "true",
            "null",
            "-dash",
            "a=b",
            "größer — 髪",
            "../up/file.hair",
            "/absolute/file.exr",
            "dir/a b.png",
            "%d ~ & | ; < > ( ) * ? # !"};
        return kTexts[below(std::size(kTexts))];
    }

    template <class Value>
    void changeRow(const hair::Number<Value>& row, hair::SettingsRef settings) {
        if (!chance(share_)) return;
        Value& value = row.in(settings);
        if constexpr (std::integral<Value>) {
            value = static_cast<Value>(
                row.minimum + std::floor(
                                  std::uniform_real_distribution<double>(0.0, 1.0)(random_) *
                                  (row.maximum - row.minimum)));
        } else if constexpr (std::same_as<Value, float>) {
            value = numberIn(row.minimum, row.maximum);
        } else {
            for (int i = 0; i < 3; ++i) value[i] = numberIn(row.minimum, row.maximum);
        }
    }

    void changeRow(const hair::OneOf& row, hair::SettingsRef settings) {
        if (chance(share_)) row.in(settings) = row.values[below(row.values.size())];
    }

    void changeRow(const hair::Text& row, hair::SettingsRef settings) {
        if (chance(share_)) row.in(settings) = text();
    }

    void changeRow(const hair::Toggle& row, hair::SettingsRef settings) {
        if (chance(share_)) row.in(settings) = !row.in(settings);
    }

    void changeRow(const hair::Choice& row, hair::SettingsRef settings) {
        if (chance(share_)) row.choose(settings, below(row.names.size()));
    }

    // GLSL files are read with a scene, but these would not exist.
    void changeRow(const hair::ChoiceOrFile& row, hair::SettingsRef settings) {
        if (chance(share_)) row.chooseName(settings, below(row.names.size()));
    }
    void changeRow(const hair::ExtensionFile&, hair::SettingsRef) {}
    void changeRow(const hair::Parameters&, hair::SettingsRef) {}

    void changeRow(const hair::Group& row, hair::SettingsRef settings) { change(row.in(settings)); }

    void changeRow(const hair::List& row, hair::SettingsRef settings) {
        if (!chance(share_)) return;
        row.resize(settings, 0);
        row.resize(settings, below(4));
        for (std::size_t i = 0; i < row.size(settings); ++i) change(row.at(settings, i));
    }

    std::mt19937 random_;
    double share_;  // of the members to change
};
