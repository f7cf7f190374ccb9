#include "hair/fields.h"

#include <algorithm>
#include <cassert>

namespace hair {
namespace {

template <class Value>
bool differsIn(const Member<Value>& row, SettingsView a, SettingsView b) {
    return row.in(a) != row.in(b);
}

bool differsIn(const Choice& row, SettingsView a, SettingsView b) {
    return row.chosen(a) != row.chosen(b);
}

bool differsIn(const ChoiceOrFile& row, SettingsView a, SettingsView b) {
    return row.chosen(a) != row.chosen(b) || row.file.in(a) != row.file.in(b);
}

bool differsIn(const Group& row, SettingsView a, SettingsView b) {
    return differ(row.in(a), row.in(b));
}

bool differsIn(const List& row, SettingsView a, SettingsView b) {
    if (row.size(a) != row.size(b)) return true;
    for (std::size_t i = 0; i < row.size(a); ++i)
        if (differ(row.at(a, i), row.at(b, i))) return true;
    return false;
}

template <class Value>
void assignIn(const Member<Value>& row, SettingsRef to, SettingsView from) {
    row.in(to) = row.in(from);
}

void assignIn(const Choice& row, SettingsRef to, SettingsView from) { row.assign(to, from); }

void assignIn(const ChoiceOrFile& row, SettingsRef to, SettingsView from) {
    row.assign(to, from);
    row.file.in(to) = row.file.in(from);
}

void assignIn(const Group& row, SettingsRef to, SettingsView from) {
    assign(row.in(to), row.in(from));
}

void assignIn(const List& row, SettingsRef to, SettingsView from) {
    row.resize(to, row.size(from));
    for (std::size_t i = 0; i < row.size(from); ++i) assign(row.at(to, i), row.at(from, i));
}

}  // namespace

const std::vector<Field>& SettingsView::fields() const { return table_->fields(); }

std::optional<std::size_t> Choice::chosen(SettingsView settings) const {
    const auto row = std::ranges::find(names, access_->get(address(settings)), &Named<int>::value);
    if (row == names.end()) return {};
    return static_cast<std::size_t>(row - names.begin());
}

void Choice::choose(SettingsRef settings, std::size_t index) const {
    access_->set(address(settings), names[index].value);
}

void ChoiceOrFile::chooseFile(SettingsRef settings, const std::string& path) const {
    access_->set(address(settings), of_file);
    file.in(settings) = path;
}

void ChoiceOrFile::chooseName(SettingsRef settings, std::size_t index) const {
    choose(settings, index);
    file.in(settings).clear();
}

SettingsView List::newElement() const { return elements_->defaults(); }

const Field& fieldAt(SettingsView settings, const void* member) {
    const auto row = std::ranges::find_if(settings.fields(), [&](const Field& field) {
        return member ==
               std::visit([&](const Place& place) { return place.address(settings); }, field.kind);
    });
    assert(row != settings.fields().end());
    return *row;
}

bool differ(const Field& field, SettingsView a, SettingsView b) {
    return std::visit([&](const auto& row) { return differsIn(row, a, b); }, field.kind);
}

bool differ(SettingsView a, SettingsView b) {
    return std::ranges::any_of(a.fields(), [&](const Field& field) { return differ(field, a, b); });
}

void assign(const Field& field, SettingsRef to, SettingsView from) {
    std::visit([&](const auto& row) { assignIn(row, to, from); }, field.kind);
}

void assign(SettingsRef to, SettingsView from) {
    for (const Field& field : from.fields()) assign(field, to, from);
}

}  // namespace hair
