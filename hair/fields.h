#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/extension.h"

// Access to the members of settings structs at run time. A row of a struct's table provides JSON
// reading, range check, JSON Schema, report echo and the viewer's widget. The code for this knows
// the kinds of rows below but no struct. Tables are defined beside the structs: settings.cpp has
// those of settings.h.
namespace hair {

class Table;
struct Field;

template <class Settings>
concept HasTable = requires(const Settings* settings) { tableOf(settings); };

// A non-owning reference to a settings struct of any type, with its table.
class SettingsView {
public:
    template <HasTable Settings>
    SettingsView(const Settings& settings) : SettingsView(tableOf(&settings), &settings) {}
    SettingsView(const Table& table, const void* settings) : table_(&table), settings_(settings) {}

    const std::vector<Field>& fields() const;

private:
    friend class Place;
    const Table* table_;
    const void* settings_;
};

// A mutable SettingsView.
class SettingsRef : public SettingsView {
public:
    template <HasTable Settings>
        requires(!std::is_const_v<Settings>)
    SettingsRef(Settings& settings) : SettingsRef(tableOf(&settings), &settings) {}
    SettingsRef(const Table& table, void* settings)
        : SettingsView(table, settings), settings_(settings) {}

private:
    friend class Place;
    void* settings_;
};

// ---- Kinds of rows ------------------------------------------------------------------------------

// Offset of a member in its struct.
class Place {
public:
    // `member` must be in the struct at `settings`.
    Place(const void* settings, const void* member)
        : offset_(static_cast<std::size_t>(
              static_cast<const std::byte*>(member) - static_cast<const std::byte*>(settings))) {}

    const void* address(SettingsView settings) const {
        return static_cast<const std::byte*>(settings.settings_) + offset_;
    }
    void* address(SettingsRef settings) const {
        return static_cast<std::byte*>(settings.settings_) + offset_;
    }

private:
    std::size_t offset_;
};

template <class Value>
struct Member : Place {
    const Value& in(SettingsView settings) const {
        return *static_cast<const Value*>(address(settings));
    }
    Value& in(SettingsRef settings) const { return *static_cast<Value*>(address(settings)); }
};

struct Range {
    double minimum;  // inclusive
    double maximum;  // inclusive
    const char* unit;  // SI symbol, "1" for a ratio, "count" for integers
};

// A number, or a vector of three numbers with the same range per component.
template <class Value>
struct Number : Member<Value>, Range {};

// A number with a fixed set of values, such as a sample count.
struct OneOf : Member<std::uint32_t> {
    std::vector<std::uint32_t> values;
    const char* unit;
};

struct Text : Member<std::string> {};

// The path of a file, relative to the scene file; empty if there is none.
struct FileName : Text {};

// A GLSL file that is read with the scene: ExtensionParameters.
struct ExtensionFile : FileName {};

struct Toggle : Member<bool> {};

template <class Enum>
struct Named {
    Enum value;
    const char* name;
};

// An enum written in JSON by name. An unknown name is an error that lists the known names.
class Choice : public Place {
public:
    struct Access {
        int (*get)(const void* member);
        void (*set)(void* member, int value);
    };
    Choice(Place place, const Access& access, std::vector<Named<int>> known)
        : Place(place), names(std::move(known)), access_(&access) {}

    // Returns the index of the member's name; none for an enumerator without a name in the row.
    std::optional<std::size_t> chosen(SettingsView settings) const;
    void choose(SettingsRef settings, std::size_t index) const;
    void assign(SettingsRef to, SettingsView from) const {
        access_->set(address(to), access_->get(address(from)));
    }

    std::vector<Named<int>> names;

protected:
    const Access* access_;
};

// A choice, or a file in its place. In JSON the file is a path relative to the scene file that ends
// in kExtension; the enumerator is then `of_file`, which has no name.
struct ChoiceOrFile : Choice {
    ChoiceOrFile(Choice choice, int value, Member<std::string> path)
        : Choice(std::move(choice)), of_file(value), file(path) {}

    static constexpr const char* kExtension = ".glsl";

    void chooseFile(SettingsRef settings, const std::string& path) const;
    void chooseName(SettingsRef settings, std::size_t index) const;

    int of_file;
    Member<std::string> file;  // empty if a name is chosen
};

// The parameters of an extension: a JSON object of numbers and vectors with the names and ranges
// that the file declares.
struct Parameters : Member<ExtensionParameters> {};

// A nested settings struct: a JSON object with its own table.
class Group : public Place {
public:
    Group(Place place, const Table& table) : Place(place), table_(&table) {}

    SettingsView in(SettingsView settings) const { return {*table_, address(settings)}; }
    SettingsRef in(SettingsRef settings) const { return {*table_, address(settings)}; }

private:
    const Table* table_;
};

// A vector of settings structs: a JSON array of objects.
class List : public Place {
public:
    struct Access {
        std::size_t (*size)(const void* list);
        const void* (*at)(const void* list, std::size_t index);
        void* (*change)(void* list, std::size_t index);
        void (*resize)(void* list, std::size_t size);
        void (*erase)(void* list, std::size_t index);
    };
    List(Place place, const Access& access, const Table& elements, std::size_t most)
        : Place(place), maximum_count(most), access_(&access), elements_(&elements) {}

    std::size_t size(SettingsView settings) const { return access_->size(address(settings)); }
    SettingsView at(SettingsView settings, std::size_t index) const {
        return {*elements_, access_->at(address(settings), index)};
    }
    SettingsRef at(SettingsRef settings, std::size_t index) const {
        return {*elements_, access_->change(address(settings), index)};
    }
    // Returns a default element.
    SettingsView newElement() const;
    // Adds or removes elements at the end.
    void resize(SettingsRef settings, std::size_t size) const {
        access_->resize(address(settings), size);
    }
    void erase(SettingsRef settings, std::size_t index) const {
        access_->erase(address(settings), index);
    }

    std::size_t maximum_count;

private:
    const Access* access_;
    const Table* elements_;
};

// ---- Tables -------------------------------------------------------------------------------------

using Kind = std::variant<
    Number<float>, Number<std::uint32_t>, Number<std::int32_t>, Number<std::uint64_t>,
    Number<glm::vec3>, OneOf, Text, FileName, ExtensionFile, Toggle, Choice, ChoiceOrFile,
    Parameters, Group, List>;

struct Field {
    const char* name;
    const char* help;
    Kind kind;
};

class Table {
public:
    // `defaults` must live as long as the table.
    Table(const void* defaults, std::vector<Field> fields)
        : defaults_(defaults), fields_(std::move(fields)) {}
    Table(const Table&) = delete;
    Table& operator=(const Table&) = delete;

    const std::vector<Field>& fields() const { return fields_; }
    // Returns the default struct.
    SettingsView defaults() const { return {*this, defaults_}; }

private:
    const void* defaults_;
    std::vector<Field> fields_;
};

// Returns the row of a member, by the member's address.
const Field& fieldAt(SettingsView settings, const void* member);

// Whether two structs of the same type differ in a field, or in any field.
bool differ(const Field& field, SettingsView a, SettingsView b);
bool differ(SettingsView a, SettingsView b);

// Copies a field, or all fields, between structs of the same type.
void assign(const Field& field, SettingsRef to, SettingsView from);
void assign(SettingsRef to, SettingsView from);

}  // namespace hair
