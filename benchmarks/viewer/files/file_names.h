#pragma once

#include <string>
#include <utility>

#include "hair/settings.h"

namespace benchmarks {

// Calls `visit(name)` for every member of settings that names a file, also within lists.
template <class Settings, class Visitor>
void forEachFileName(Settings& settings, Visitor&& visit);

template <class Row, class Owner, class Visitor>
void visitFileNames(const Row&, Owner&, Visitor&&) {}

template <class Owner, class Visitor>
void visitFileNames(const hair::FileName<Owner>& row, Owner& owner, Visitor&& visit) {
    visit(owner.*row.member);
}

template <class Owner, class Settings, class Visitor>
void visitFileNames(const hair::Group<Owner, Settings>& row, Owner& owner, Visitor&& visit) {
    forEachFileName(owner.*row.member, visit);
}

template <class Owner, class Element, class Visitor>
void visitFileNames(const hair::List<Owner, Element>& row, Owner& owner, Visitor&& visit) {
    for (Element& element : owner.*row.member) forEachFileName(element, visit);
}

template <class Settings, class Visitor>
void forEachFileName(Settings& settings, Visitor&& visit) {
    hair::forEachField<Settings>([&](const auto& row) { visitFileNames(row, settings, visit); });
}

}  // namespace benchmarks
