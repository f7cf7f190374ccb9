#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <random>
#include <string>

#include "hair/settings.h"

// Settings of which a few members are others than the defaults, each with a value that its row of
// the tables allows: bounds, numbers without a short decimal, texts that need quoting, lists.
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

    template <class Settings>
    void change(Settings& settings) {
        hair::forEachField<Settings>([&](const auto& row) { changeRow(row, settings); });
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

    template <class Owner, class Value>
    void changeRow(const hair::Field<Owner, Value>& row, Owner& owner) {
        if (!chance(share_)) return;
        Value& value = owner.*row.member;
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

    template <class Owner>
    void changeRow(const hair::Text<Owner>& row, Owner& owner) {
        if (chance(share_)) owner.*row.member = text();
    }

    template <class Owner>
    void changeRow(const hair::Toggle<Owner>& row, Owner& owner) {
        if (chance(share_)) owner.*row.member = !(owner.*row.member);
    }

    template <class Owner, class Enum, std::size_t Count>
    void changeRow(const hair::Choice<Owner, Enum, Count>& row, Owner& owner) {
        if (chance(share_)) owner.*row.member = row.names[below(Count)].value;
    }

    template <class Owner, std::size_t Count>
    void changeRow(const hair::OneOf<Owner, Count>& row, Owner& owner) {
        if (chance(share_)) owner.*row.member = row.values[below(Count)];
    }

    template <class Owner, class Settings>
    void changeRow(const hair::Group<Owner, Settings>& row, Owner& owner) {
        change(owner.*row.member);
    }

    template <class Owner, class Element>
    void changeRow(const hair::List<Owner, Element>& row, Owner& owner) {
        if (!chance(share_)) return;
        (owner.*row.member).assign(below(4), {});
        for (Element& element : owner.*row.member) change(element);
    }

    std::mt19937 random_;
    double share_;  // of the members that are changed
};
