#include "benchmarks/measure/hair_cache.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <fstream>
#include <iostream>
#include <string_view>
#include <system_error>
#include <vector>

#include <nlohmann/json.hpp>

#include "benchmarks/scene/settings_json.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/shaders.h"
#include "hair/fields.h"

namespace benchmarks::measure {

// ---- Files of a cache ---------------------------------------------------------------------------

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMagic = "hairbench-cache 1\n";
constexpr std::string_view kExtension = ".entry";

struct Header {
    std::uint64_t key_size = 0;
    std::uint64_t size = 0;
    std::array<char, 16> hash{};  // report::hashText() of the key and the bytes
};

Header headerOf(const std::string& key, const std::string& bytes) {
    Header header{.key_size = key.size(), .size = bytes.size()};
    const std::string hash = report::hashText(report::hashText(key) + report::hashText(bytes));
    std::ranges::copy(hash, header.hash.begin());
    return header;
}

}  // namespace

fs::path hairCacheFolder() {
    const fs::path folder = engine::userCacheFolder();
    return folder.empty() ? folder : folder / "hair";
}

fs::path DiskCache::fileOf(const std::string& key) const {
    return options_.folder / (report::hashText(key) + std::string(kExtension));
}

void DiskCache::warn(const std::string& key, const std::string& reason) const {
    if (options_.warn) options_.warn(fileOf(key).string() + ": " + reason + "; it is ignored");
}

std::optional<std::string> DiskCache::load(const std::string& key) const {
    if (!isOn()) return std::nullopt;
    const fs::path path = fileOf(key);
    std::error_code error;
    const std::uintmax_t size = fs::file_size(path, error);
    if (error) return std::nullopt;  // missing, or not a regular file
    const auto unusable = [&](const char* reason) {
        warn(key, reason);
        return std::nullopt;
    };

    std::ifstream file(path, std::ios::binary);
    std::string magic(kMagic.size(), '\0');
    Header header;
    file.read(magic.data(), static_cast<std::streamsize>(magic.size()));
    file.read(reinterpret_cast<char*>(&header), sizeof header);
    if (!file || magic != kMagic) return unusable("is not an entry of this cache");
    if (size > options_.most_bytes) return unusable("is damaged");  // larger than the whole cache
    const std::uintmax_t body = size - kMagic.size() - sizeof header;
    if (header.key_size > body || header.size != body - header.key_size)
        return unusable("is damaged");
    std::string found(header.key_size, '\0');
    std::string bytes(header.size, '\0');
    file.read(found.data(), static_cast<std::streamsize>(found.size()));
    file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!file || headerOf(found, bytes).hash != header.hash) return unusable("is damaged");
    if (found != key) return unusable("belongs to other data");
    fs::last_write_time(path, fs::file_time_type::clock::now(), error);  // marks it as used
    return bytes;
}

void DiskCache::store(const std::string& key, const std::string& bytes) const {
    if (!takes(bytes.size())) return;
    const fs::path path = fileOf(key);
    const Header header = headerOf(key, bytes);
    try {
        engine::replaceFile(path, [&](std::ostream& file) {
            file.write(kMagic.data(), kMagic.size());
            file.write(reinterpret_cast<const char*>(&header), sizeof header);
            file.write(key.data(), static_cast<std::streamsize>(key.size()));
            file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        });
    } catch (const engine::Error&) {  // the next run makes it again
    }
    engine::trimCache(options_.folder, options_.most_bytes, [](std::string_view name) {
        return name.ends_with(kExtension);
    });
}

// ---- Data that cases share ----------------------------------------------------------------------

namespace {

using hair::simulation::BakedField;
using hair::simulation::SettledState;

// ---- Keys ---------------------------------------------------------------------------------------

template <class Value>
std::string hashOf(const std::vector<Value>& values) {
    return std::to_string(values.size()) + ' ' +
           report::hashBytes(std::as_bytes(std::span(values)));
}

// A key: lines with a name and a value.
class Key {
public:
    explicit Key(const char* kind) : text_(std::string(kind) + '\n') {}

    Key& add(const char* name, const std::string& value) {
        text_ += std::string(name) + ": " + value + '\n';
        return *this;
    }
    const std::string& text() const { return text_; }

private:
    std::string text_;
};

// Everything that can change the bits of a device's results.
std::string deviceText(const engine::Device& device, const std::string& processor) {
    const engine::DeviceInfo& info = device.info();
    VkPhysicalDeviceSubgroupProperties subgroups{
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES};
    VkPhysicalDeviceProperties2 asked{
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, .pNext = &subgroups};
    vkGetPhysicalDeviceProperties2(info.handle, &asked);
    const VkPhysicalDeviceProperties& properties = asked.properties;
    std::string features;
    for (const engine::Feature feature : info.features)
        features += std::to_string(static_cast<int>(feature)) + ' ';
    const VkPhysicalDeviceLimits& limits = info.limits;
    Key key("device");
    key.add("name", info.name)
        .add("type", engine::deviceTypeName(info.type))
        .add("driver", info.driver + ' ' + info.driver_version + ' ' + info.api_version)
        .add("build", report::hashBytes(std::as_bytes(std::span(properties.pipelineCacheUUID))))
        .add("features", features)
        .add("subgroup", std::to_string(subgroups.subgroupSize))
        .add("invocations", std::to_string(limits.maxComputeWorkGroupInvocations))
        .add("shared memory", std::to_string(limits.maxComputeSharedMemorySize))
        .add("storage", std::to_string(limits.maxStorageBufferRange))
        .add("memory", std::to_string(info.local_bytes));
    if (info.type == engine::DeviceType::cpu) key.add("processor", processor);
    return key.text();
}

std::string meshText(const hair::groom::Mesh& mesh) {
    return hashOf(mesh.positions) + ' ' + hashOf(mesh.triangles);
}

std::string fieldKey(
    const std::string& basis, const std::string& mesh, const hair::SimulationSettings& settings,
    std::size_t index) {
    scene::Json parts{
        {"resolution", settings.distance_fields[index].resolution},
        {"collision", scene::writeFields(settings.collision)}};
    return Key("distance field").add("mesh", mesh).add("settings", parts.dump()).text() + basis;
}

std::string stateKey(
    const std::string& basis, const hair::groom::Groom& groom, const hair::Settings& settings,
    const std::vector<std::string>& meshes) {
    // A force from the scene does not act while hair settles.
    scene::Json simulation = scene::writeFields(settings.simulation);
    simulation.erase("force");
    simulation.erase("force_parameters");
    Key key("settled state");
    if (const auto& solver = settings.simulation.solver_parameters.file)
        key.add("solver", report::hashBytes(std::as_bytes(std::span(solver->text))));
    for (const std::string& mesh : meshes) key.add("mesh", mesh);
    // Guides settle where a cache has them at first, and are pulled there if they follow it.
    if (!groom.cache.times.empty())
        key.add("cache", hashOf(groom.cache.points))
            .add("strength", std::to_string(groom.cache.strength.value_or(0.0f)));
    return key.add("guides", std::to_string(groom.strand_count))
               .add("points", hashOf(groom.points))
               .add("seed", std::to_string(settings.seed))
               .add("settings", simulation.dump())
               .text() +
           basis;
}

// ---- Bytes --------------------------------------------------------------------------------------

template <class Value>
void append(std::string& bytes, const Value& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// Reads values from the front of a byte sequence.
class Reader {
public:
    explicit Reader(std::string_view bytes) : bytes_(bytes) {}

    template <class Value>
    bool read(Value& value) {
        return read(&value, sizeof value);
    }
    bool read(void* to, std::size_t size) {
        if (size > bytes_.size()) return false;
        if (size > 0) std::memcpy(to, bytes_.data(), size);
        bytes_.remove_prefix(size);
        return true;
    }
    std::size_t left() const { return bytes_.size(); }

private:
    std::string_view bytes_;
};

std::string bytesOf(const BakedField& field) {
    std::string bytes;
    append(bytes, field.grid);
    append(bytes, std::uint64_t{field.warning.size()});
    bytes += field.warning;
    bytes.append(
        reinterpret_cast<const char*>(field.distances.data()),
        field.distances.size() * sizeof(float));
    return bytes;
}

std::optional<BakedField> fieldOf(std::string_view bytes) {
    Reader reader(bytes);
    BakedField field;
    std::uint64_t warning = 0;
    if (!reader.read(field.grid) || !reader.read(warning) || warning > reader.left())
        return std::nullopt;
    field.warning.resize(warning);
    reader.read(field.warning.data(), warning);
    const glm::u64vec3 points(field.grid.points);
    const std::uint64_t count = reader.left() / sizeof(float);
    if (points.x * points.y * points.z != count || count == 0) return std::nullopt;
    field.distances.resize(count);
    if (!reader.read(field.distances.data(), count * sizeof(float)) || reader.left() > 0)
        return std::nullopt;
    return field;
}

std::string bytesOf(const SettledState& state) {
    std::string bytes;
    append(bytes, std::uint64_t{state.buffers.size()});
    for (const std::vector<std::byte>& buffer : state.buffers) {
        append(bytes, std::uint64_t{buffer.size()});
        bytes.append(reinterpret_cast<const char*>(buffer.data()), buffer.size());
    }
    return bytes;
}

std::optional<SettledState> stateOf(std::string_view bytes) {
    Reader reader(bytes);
    std::uint64_t count = 0;
    if (!reader.read(count)) return std::nullopt;
    SettledState state;
    for (std::uint64_t i = 0; i < count; ++i) {
        std::uint64_t size = 0;
        if (!reader.read(size) || size > reader.left()) return std::nullopt;
        auto& buffer = state.buffers.emplace_back(size);
        reader.read(buffer.data(), size);
    }
    return reader.left() == 0 ? std::optional(std::move(state)) : std::nullopt;
}

std::size_t sizeOf(const BakedField& field) { return field.distances.size() * sizeof(float); }

std::size_t sizeOf(const SettledState& state) {
    std::size_t size = 0;
    for (const std::vector<std::byte>& buffer : state.buffers) size += buffer.size();
    return size;
}

}  // namespace

// ---- The cache ----------------------------------------------------------------------------------

std::string HairCache::program(const engine::Device& device) {
    if (program_.empty() && disk_.isOn()) {
        try {
            program_ = report::hashText(engine::readFile(engine::system::thisProgramAsStarted()));
        } catch (const engine::Error&) {
            disk_ = DiskCache({});
        }
    }
    std::string text = program_;
    for (const auto& [path, code] : device.shaders().replacements())
        text += ' ' + path + ' ' + hashOf(code);
    return text;
}

template <class Value>
void HairCache::keep(const std::string& key, Value value, scene::LruCache<Value>& values) {
    const std::size_t size = sizeOf(value);
    if (disk_.takes(size)) disk_.store(key, bytesOf(value));
    values.add(key, std::move(value), size);
}

const BakedField* HairCache::field(const std::string& key) {
    if (const BakedField* known = fields_.find(key)) return known;
    const std::optional<std::string> bytes = disk_.load(key);
    if (!bytes) return nullptr;
    std::optional<BakedField> field = fieldOf(*bytes);
    if (!field) {
        disk_.warn(key, "is not a distance field");
        return nullptr;
    }
    return &fields_.add(key, std::move(*field), bytes->size());
}

const SettledState* HairCache::settled(const std::string& key) {
    if (const SettledState* known = states_.find(key)) return known;
    const std::optional<std::string> bytes = disk_.load(key);
    if (!bytes) return nullptr;
    std::optional<SettledState> state = stateOf(*bytes);
    if (!state) {
        disk_.warn(key, "is not a state");
        return nullptr;
    }
    return &states_.add(key, std::move(*state), bytes->size());
}

hair::simulation::Simulation HairCache::simulation(
    const engine::Device& device, const hair::groom::Groom& groom, const hair::Settings& settings,
    std::span<const hair::groom::Mesh> field_meshes, const hair::groom::DeformingMesh* deforming) {
    const std::string basis =
        Key("made by").add("program", program(device)).text() + deviceText(device, processor_);
    std::vector<std::string> meshes, field_keys;
    std::vector<const BakedField*> fields;
    for (const hair::groom::Mesh& mesh : field_meshes) {
        meshes.push_back(meshText(mesh));
        field_keys.push_back(
            fieldKey(basis, meshes.back(), settings.simulation, field_keys.size()));
        fields.push_back(field(field_keys.back()));
    }
    if (deforming) meshes.push_back("deformed " + hashOf(deforming->positions(0.0)));
    // A state without settling needs no cache.
    const bool settles = settings.simulation.settle_steps > 0;
    const std::string state_key = stateKey(basis, groom, settings, meshes);
    const SettledState* const state = settles ? settled(state_key) : nullptr;

    hair::simulation::Simulation simulation(
        device, groom, settings.simulation, settings.seed, field_meshes,
        {.fields = fields, .settled = state}, deforming);
    for (std::size_t i = 0; i < fields.size(); ++i) {
        if (fields[i] || fields_.find(field_keys[i])) continue;
        ++made_;
        keep(field_keys[i], simulation.readField(i), fields_);
    }
    if (!state && settles && simulation.moves()) {
        ++made_;
        keep(state_key, simulation.readSettled(), states_);
    }
    fields_.trim();
    states_.trim();
    return simulation;
}

HairCache userHairCache(bool on_disk) {
    DiskCacheOptions options;
    if (on_disk) options.folder = hairCacheFolder();
    options.warn = [](const std::string& fault) {
        std::cerr << "hairbench: " << engine::shownText(fault) << '\n';
    };
    return HairCache(DiskCache(std::move(options)));
}

}  // namespace benchmarks::measure
