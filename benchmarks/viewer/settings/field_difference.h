#pragma once

#include <algorithm>
#include <type_traits>

#include "hair/fields.h"

namespace benchmarks {

template <class Row>
inline constexpr bool kIsGroup = false;
template <class Owner, class Settings>
inline constexpr bool kIsGroup<hair::Group<Owner, Settings>> = true;

template <class Row>
inline constexpr bool kIsList = false;
template <class Owner, class Element>
inline constexpr bool kIsList<hair::List<Owner, Element>> = true;

// Whether settings differ in anything that their table has.
template <class Settings>
bool differ(const Settings& a, const Settings& b) {
    bool any = false;
    hair::forEachField<Settings>([&](const auto& row) {
        using Row = std::remove_cvref_t<decltype(row)>;
        if constexpr (kIsGroup<Row>)
            any = any || differ(a.*row.member, b.*row.member);
        else if constexpr (kIsList<Row>)
            any = any || !std::ranges::equal(
                             a.*row.member, b.*row.member,
                             [](const auto& x, const auto& y) { return !differ(x, y); });
        else
            any = any || a.*row.member != b.*row.member;
    });
    return any;
}

}  // namespace benchmarks
