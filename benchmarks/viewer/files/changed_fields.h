#pragma once

#include <string>

#include "benchmarks/field_json.h"

namespace benchmarks {

// The members of settings that are not those of `original`, in the table's order: what a scene has
// to say. A list is there whole where anything in it differs, its elements without what is as in a
// new one. Floats are compared by their bits.
template <class Settings>
Json changedFields(const Settings& settings, const Settings& original);

// Null where the member is the same.
template <class Row, class Owner>
Json changedField(const Row& row, const Owner& owner, const Owner& original) {
    Json value = writeField(row, owner);
    // As texts: numbers that are equal can differ in the sign of zero.
    return value.dump() == writeField(row, original).dump() ? Json() : value;
}

template <class Owner, class Settings>
Json changedField(
    const hair::Group<Owner, Settings>& row, const Owner& owner, const Owner& original) {
    Json members = changedFields(owner.*row.member, original.*row.member);
    return members.empty() ? Json() : members;
}

template <class Owner, class Element>
Json changedField(
    const hair::List<Owner, Element>& row, const Owner& owner, const Owner& original) {
    if (writeField(row, owner).dump() == writeField(row, original).dump()) return {};
    Json list = Json::array();
    for (const Element& element : owner.*row.member)
        list.push_back(changedFields(element, Element{}));
    return list;
}

template <class Settings>
Json changedFields(const Settings& settings, const Settings& original) {
    Json object = Json::object();
    hair::forEachField<Settings>([&](const auto& row) {
        Json value = changedField(row, settings, original);
        if (!value.is_null()) object[row.name] = std::move(value);
    });
    return object;
}

}  // namespace benchmarks
