#include "hair/groom/mesh/deforming_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "engine/error.h"
#include "engine/files.h"
#include "hair/groom/files.h"
#include "hair/groom/mesh/gltf_model.h"

namespace hair::groom {
namespace {

// Greatest distance of a sum from 1 if weights are rounded one by one to 8 bits.
constexpr double kWeightSum = 0.01;

tinygltf::Model loadAnimated(const std::filesystem::path& path, const NamedFileCheck& check) {
    engine::OpenFile file(path);
    std::vector<char> bytes(file.size());
    file.read(bytes);
    return loadGltf(
        std::as_bytes(std::span(bytes)), path, GltfImages::skipped, GltfMotion::read,
        orOwnFolder(check, path));
}

bool isGltf(const std::filesystem::path& path) {
    const std::string extension = lowerCaseExtension(path);
    return extension == ".glb" || extension == ".gltf";
}

bool isUsd(const std::filesystem::path& path) {
    const std::string extension = lowerCaseExtension(path);
    return extension == ".usd" || extension == ".usda" || extension == ".usdc" ||
           extension == ".usdz";
}

constexpr const char* kUsdClip = "points";

std::vector<std::string> namesOf(const tinygltf::Model& model) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < model.animations.size(); ++i) {
        const std::string& name = model.animations[i].name;
        names.push_back(name.empty() ? std::to_string(i) : name);
    }
    return names;
}

const tinygltf::Animation& clipOf(const tinygltf::Model& model, const std::string& clip) {
    const std::vector<std::string> names = namesOf(model);
    const auto found = std::ranges::find(names, clip);
    if (found != names.end())
        return model.animations[static_cast<std::size_t>(found - names.begin())];
    if (names.empty()) throw engine::Error("has no animations, so none is named '" + clip + "'");
    std::string known;
    for (const std::string& name : names)
        known.append(known.empty() ? "'" : ", '").append(name + '\'');
    throw engine::Error("has no animation '" + clip + "'; known: " + known);
}

// Returns the numbers of an accessor. Throws engine::Error unless all are finite.
GltfNumbers finiteNumbers(const tinygltf::Model& model, int accessor, GltfIntegers integers) {
    GltfNumbers numbers = readNumbers(model, accessor, integers);
    for (const double value : numbers.values)
        if (!std::isfinite(value))
            throw engine::Error(numbered("accessor", accessor), "has a number that is not finite");
    return numbers;
}

std::vector<glm::dvec3>
vectorsOf(const tinygltf::Model& model, int accessor, std::size_t count, const std::string& name) {
    const GltfNumbers numbers = finiteNumbers(model, accessor, GltfIntegers::normalized);
    if (numbers.components != 3) throw engine::Error(name, "is not VEC3");
    if (numbers.values.size() != 3 * count)
        throw engine::Error(name, "differs from POSITION in count");
    std::vector<glm::dvec3> vectors;
    vectors.reserve(count);
    for (std::size_t i = 0; i < count; ++i)
        vectors.push_back(glm::make_vec3(numbers.values.data() + 3 * i));
    return vectors;
}

}  // namespace

// ---- Reading a file -----------------------------------------------------------------------------

// Makes a MeshAnimation of a model.
class GltfAnimationReader {
public:
    GltfAnimationReader(const tinygltf::Model& model, MeshAnimation& animation)
        : model_(model), to_(animation) {}

    void read(const tinygltf::Animation& clip) {
        readNodes();
        forEachPrimitive(model_, [&](const GltfPlace& place) {
            if (hasTriangles(place.primitive) && !place.is_hidden) readPart(place);
        });
        for (std::size_t i = 0; i < clip.channels.size(); ++i) {
            try {
                readChannel(clip, clip.channels[i]);
            } catch (const engine::Error& error) {
                throw engine::Error("channel " + std::to_string(i), error.what());
            }
        }
    }

private:
    using Interpolation = MeshAnimation::Interpolation;
    using Property = MeshAnimation::Property;

    // Reads all nodes of the file, including those of other scenes and joints outside the scene.
    void readNodes() {
        const std::size_t count = model_.nodes.size();
        std::vector<int> parents(count, -1);
        for (std::size_t i = 0; i < count; ++i) {
            for (const int child : model_.nodes[i].children) {
                at(model_.nodes, child, "node");
                int& parent = parents[static_cast<std::size_t>(child)];
                if (parent >= 0) throw engine::Error(numbered("node", child), "has two parents");
                parent = static_cast<int>(i);
            }
        }
        places_.assign(count, count);
        std::vector<std::size_t> queue;
        for (std::size_t i = 0; i < count; ++i)
            if (parents[i] < 0) queue.push_back(i);
        for (std::size_t next = 0; next < queue.size(); ++next) {
            const std::size_t number = queue[next];
            places_[number] = to_.nodes_.size();
            addNode(static_cast<int>(number), parents[number]);
            for (const int child : model_.nodes[number].children)
                queue.push_back(static_cast<std::size_t>(child));
        }
        if (queue.size() != count) throw engine::Error("its nodes do not form trees");
    }

    void addNode(int number, int parent) {
        const tinygltf::Node& node = model_.nodes[static_cast<std::size_t>(number)];
        MeshAnimation::Node& added = to_.nodes_.emplace_back(MeshAnimation::Node{
            .parent = parent < 0 ? -1 : static_cast<int>(placeOf(parent)),
            .number = number,
            .matrix = glm::dmat4(1.0),
            .has_matrix = node.matrix.size() == 16,
            .translation = glm::dvec3(0.0),
            .rotation = {1.0, 0.0, 0.0, 0.0},
            .scale = glm::dvec3(1.0)});
        if (added.has_matrix) added.matrix = glm::make_mat4(node.matrix.data());
        if (node.translation.size() == 3)
            added.translation = glm::make_vec3(node.translation.data());
        if (node.rotation.size() == 4) {
            const std::vector<double>& r = node.rotation;  // x, y, z, w
            added.rotation = glm::normalize(glm::dquat(r[3], r[0], r[1], r[2]));
        }
        if (node.scale.size() == 3) added.scale = glm::make_vec3(node.scale.data());
    }

    std::size_t placeOf(int node) const {
        at(model_.nodes, node, "node");
        return places_[static_cast<std::size_t>(node)];
    }

    void readPart(const GltfPlace& place) {
        const tinygltf::Primitive& primitive = place.primitive;
        const tinygltf::Node& node = at(model_.nodes, place.node, "node");
        const tinygltf::Mesh& mesh = at(model_.meshes, node.mesh, "mesh");
        MeshAnimation::Part part{
            .first = to_.vertex_count_,
            .positions = {},
            .targets = {},
            .weights = {},
            .node = placeOf(place.node)};
        for (const glm::vec3& position : readPositions(model_, primitive))
            part.positions.emplace_back(position);
        const std::size_t count = part.positions.size();
        for (const auto& target : primitive.targets) {
            const auto accessor = target.find("POSITION");
            part.targets.push_back(
                accessor == target.end()
                    ? std::vector<glm::dvec3>(count, glm::dvec3(0.0))
                    : vectorsOf(model_, accessor->second, count, "a morph target's POSITION"));
        }
        part.weights = node.weights.empty() ? mesh.weights : node.weights;
        if (part.weights.empty()) part.weights.assign(part.targets.size(), 0.0);
        if (part.weights.size() != part.targets.size())
            throw engine::Error(
                "has " + std::to_string(part.targets.size()) + " morph targets and " +
                std::to_string(part.weights.size()) + " weights for them");
        if (node.skin >= 0) readSkin(part, primitive, node.skin);
        to_.vertex_count_ += count;
        to_.parts_.push_back(std::move(part));
    }

    void readSkin(MeshAnimation::Part& part, const tinygltf::Primitive& primitive, int index) {
        const tinygltf::Skin& skin = at(model_.skins, index, "skin");
        if (skin.joints.empty()) throw engine::Error(numbered("skin", index), "has no joints");
        part.is_skinned = true;
        for (const int joint : skin.joints) part.joints.push_back(placeOf(joint));
        part.inverse_binds.assign(part.joints.size(), glm::dmat4(1.0));
        if (skin.inverseBindMatrices >= 0) {
            const GltfNumbers numbers =
                finiteNumbers(model_, skin.inverseBindMatrices, GltfIntegers::normalized);
            if (numbers.components != 16 || numbers.values.size() < 16 * part.joints.size())
                throw engine::Error(
                    numbered("skin", index), "has too few inverse bind matrices for its joints");
            for (std::size_t i = 0; i < part.joints.size(); ++i)
                part.inverse_binds[i] = glm::make_mat4(numbers.values.data() + 16 * i);
        }
        readInfluences(part, primitive);
    }

    void readInfluences(MeshAnimation::Part& part, const tinygltf::Primitive& primitive) {
        const std::size_t count = part.positions.size();
        std::vector<GltfNumbers> joints, weights;
        for (int set = 0;; ++set) {
            const auto joint = findAttribute(primitive, "JOINTS_" + std::to_string(set));
            const auto weight = findAttribute(primitive, "WEIGHTS_" + std::to_string(set));
            if (!joint && !weight) break;
            if (!joint || !weight)
                throw engine::Error(
                    "JOINTS_" + std::to_string(set) + " and WEIGHTS_" + std::to_string(set) +
                    " are not both there");
            joints.push_back(finiteNumbers(model_, *joint, GltfIntegers::whole));
            weights.push_back(finiteNumbers(model_, *weight, GltfIntegers::normalized));
            for (const GltfNumbers* numbers : {&joints.back(), &weights.back()})
                if (numbers->components != 4 || numbers->values.size() != 4 * count)
                    throw engine::Error(
                        "joints or their weights are not VEC4, one for each vertex");
        }
        if (joints.empty())
            throw engine::Error("belongs to a node with a skin, but has no JOINTS_0");
        part.influences = 4 * joints.size();
        part.influence_list.reserve(count * part.influences);
        for (std::size_t vertex = 0; vertex < count; ++vertex) {
            const std::size_t first = part.influence_list.size();
            double sum = 0.0;
            for (std::size_t set = 0; set < joints.size(); ++set) {
                for (std::size_t i = 4 * vertex; i < 4 * vertex + 4; ++i) {
                    const double joint = joints[set].values[i];
                    const double weight = weights[set].values[i];
                    if (!(joint >= 0.0 && joint < static_cast<double>(part.joints.size())))
                        throw engine::Error(
                            "vertex " + std::to_string(vertex) +
                            " names a joint outside the skin's " +
                            std::to_string(part.joints.size()));
                    if (weight < 0.0)
                        throw engine::Error(
                            "vertex " + std::to_string(vertex) + " has a negative weight");
                    part.influence_list.emplace_back(static_cast<std::uint32_t>(joint), weight);
                    sum += weight;
                }
            }
            if (!(std::abs(sum - 1.0) <= kWeightSum))
                throw engine::Error(
                    "the joints' weights of vertex " + std::to_string(vertex) + " add up to " +
                    std::to_string(sum) + ", not to 1");
            for (std::size_t i = first; i < part.influence_list.size(); ++i)
                part.influence_list[i].second /= sum;
        }
    }

    static std::optional<Property> propertyOf(const std::string& path) {
        static const std::map<std::string, Property> kProperties{
            {"translation", Property::translation},
            {"rotation", Property::rotation},
            {"scale", Property::scale},
            {"weights", Property::weights}};
        const auto found = kProperties.find(path);
        if (found == kProperties.end()) return {};
        return found->second;
    }

    static Interpolation interpolationOf(const std::string& name) {
        if (name.empty() || name == "LINEAR") return Interpolation::linear;
        if (name == "STEP") return Interpolation::step;
        if (name == "CUBICSPLINE") return Interpolation::cubic_spline;
        throw engine::Error("unknown interpolation '" + name + "'");
    }

    std::size_t componentsOf(Property property, int node) const {
        if (property == Property::rotation) return 4;
        if (property != Property::weights) return 3;
        std::size_t targets = 0;
        const int mesh = at(model_.nodes, node, "node").mesh;
        if (mesh >= 0)
            for (const tinygltf::Primitive& primitive : at(model_.meshes, mesh, "mesh").primitives)
                targets = std::max(targets, primitive.targets.size());
        if (targets == 0) throw engine::Error("animates weights of a mesh without morph targets");
        return targets;
    }

    std::vector<double> readTimes(int accessor) const {
        const GltfNumbers numbers = finiteNumbers(model_, accessor, GltfIntegers::normalized);
        if (numbers.components != 1 || numbers.values.empty())
            throw engine::Error("its times must be SCALAR, and at least one");
        for (std::size_t i = 0; i < numbers.values.size(); ++i) {
            const double before = i > 0 ? numbers.values[i - 1] : -1.0;
            if (numbers.values[i] < 0.0 || numbers.values[i] <= before)
                throw engine::Error(
                    "the time of keyframe " + std::to_string(i) +
                    (i > 0 ? " is not after the previous one" : " is negative"));
        }
        return numbers.values;
    }

    void readChannel(const tinygltf::Animation& clip, const tinygltf::AnimationChannel& source) {
        const std::optional<Property> property = propertyOf(source.target_path);
        if (source.target_node < 0 || !property) return;
        const tinygltf::AnimationSampler& sampler = at(clip.samplers, source.sampler, "sampler");
        MeshAnimation::Channel channel{
            .node = placeOf(source.target_node),
            .property = *property,
            .interpolation = interpolationOf(sampler.interpolation),
            .components = componentsOf(*property, source.target_node),
            .times = readTimes(sampler.input),
            .values = {}};
        if (channel.property != Property::weights && to_.nodes_[channel.node].has_matrix)
            throw engine::Error("animates a node that has a matrix");
        channel.values = finiteNumbers(model_, sampler.output, GltfIntegers::normalized).values;
        const bool is_cubic = channel.interpolation == Interpolation::cubic_spline;
        const std::size_t expected = channel.times.size() * channel.components * (is_cubic ? 3 : 1);
        if (channel.values.size() != expected)
            throw engine::Error(
                "has " + std::to_string(channel.values.size()) + " numbers for " +
                std::to_string(channel.times.size()) + " keyframes, not " +
                std::to_string(expected));
        for (const MeshAnimation::Channel& other : to_.channels_)
            if (other.node == channel.node && other.property == channel.property)
                throw engine::Error("animates the same property as another channel");
        checkRotations(channel);
        to_.duration_ = std::max(to_.duration_, channel.times.back());
        to_.channels_.push_back(std::move(channel));
    }

    static void checkRotations(const MeshAnimation::Channel& channel) {
        if (channel.property != Property::rotation) return;
        const bool is_cubic = channel.interpolation == Interpolation::cubic_spline;
        for (std::size_t key = 0; key < channel.times.size(); ++key) {
            const double* value = channel.values.data() + 4 * (is_cubic ? 3 * key + 1 : key);
            if (!(glm::length(glm::dquat(value[3], value[0], value[1], value[2])) > 0.5))
                throw engine::Error(
                    "the rotation of keyframe " + std::to_string(key) +
                    " is not a unit quaternion");
        }
    }

    const tinygltf::Model& model_;
    MeshAnimation& to_;
    std::vector<std::size_t> places_;  // [node of the file], index into nodes_
};

std::vector<std::string>
animationNames(const std::filesystem::path& path, const NamedFileCheck& check) {
    if (!isGltf(path) && !isUsd(path)) return {};
    try {
        if (isUsd(path)) {
            std::vector<std::string> names;
            if (readUsdSamples(path, check).times.size() > 1) names.emplace_back(kUsdClip);
            return names;
        }
        return namesOf(loadAnimated(path, check));
    } catch (const engine::Error& error) {
        throw engine::Error(path.string(), error.what());
    }
}

MeshAnimation::MeshAnimation(
    const std::filesystem::path& path, const std::string& clip, const NamedFileCheck& check) {
    try {
        if (isUsd(path)) {
            if (clip != kUsdClip)
                throw engine::Error(
                    "has no animation '" + clip + "'; the only one of a USD file is '" + kUsdClip +
                    '\'');
            samples_ = readUsdSamples(path, check);
            if (samples_.times.empty()) throw engine::Error("nothing in it moves");
            vertex_count_ = samples_.positions.size() / samples_.times.size();
            duration_ = samples_.times.back();
            return;
        }
        if (!isGltf(path))
            throw engine::Error(
                "animations of '" + path.extension().string() +
                "' files are not read: convert it to glTF or USD, with its skin or with its frames "
                "as morph targets");
        const tinygltf::Model model = loadAnimated(path, check);
        const tinygltf::Animation& animation = clipOf(model, clip);
        try {
            GltfAnimationReader(model, *this).read(animation);
        } catch (const engine::Error& error) {
            throw engine::Error("animation '" + clip + "'", error.what());
        }
    } catch (const engine::Error& error) {
        throw engine::Error(path.string(), error.what());
    }
}

// ---- At a time ----------------------------------------------------------------------------------

// Interpolates by glTF 2.0, appendix C. Rotations are x, y, z, w and come out as unit quaternions.
void MeshAnimation::Channel::at(double time, std::vector<double>& result) const {
    const bool is_cubic = interpolation == Interpolation::cubic_spline;
    const auto value = [&](std::size_t key, std::size_t part) {
        const std::size_t number = is_cubic ? 3 * key + part : key;
        return std::span(values).subspan(number * components, components);
    };
    const auto copy = [&](std::size_t key) {
        const auto found = value(key, 1);
        result.assign(found.begin(), found.end());
    };
    result.clear();
    const auto after =
        static_cast<std::size_t>(std::ranges::upper_bound(times, time) - times.begin());
    if (after == 0) {
        copy(0);
    } else if (after == times.size() || interpolation == Interpolation::step) {
        copy(after - 1);
    } else {
        const std::size_t k = after - 1;
        const double span = times[k + 1] - times[k];
        const double t = (time - times[k]) / span;
        const auto a = value(k, 1);
        const auto b = value(k + 1, 1);
        if (is_cubic) {
            const auto out = value(k, 2);
            const auto in = value(k + 1, 0);
            const double t2 = t * t, t3 = t2 * t;
            for (std::size_t i = 0; i < components; ++i)
                result.push_back(
                    (2.0 * t3 - 3.0 * t2 + 1.0) * a[i] + span * (t3 - 2.0 * t2 + t) * out[i] +
                    (3.0 * t2 - 2.0 * t3) * b[i] + span * (t3 - t2) * in[i]);
        } else if (property == Property::rotation) {
            const glm::dquat from = glm::normalize(glm::dquat(a[3], a[0], a[1], a[2]));
            const glm::dquat to = glm::normalize(glm::dquat(b[3], b[0], b[1], b[2]));
            const glm::dquat mean = glm::slerp(from, to, t);  // the shorter way
            result = {mean.x, mean.y, mean.z, mean.w};
        } else {
            for (std::size_t i = 0; i < components; ++i) result.push_back(a[i] + t * (b[i] - a[i]));
        }
    }
    if (property == Property::rotation) {
        const glm::dquat unit =
            glm::normalize(glm::dquat(result[3], result[0], result[1], result[2]));
        result = {unit.x, unit.y, unit.z, unit.w};
    }
}

void MeshAnimation::poseAt(double time, Pose& pose) const {
    if (!samples_.times.empty()) {
        const std::vector<double>& times = samples_.times;
        const auto after =
            static_cast<std::size_t>(std::ranges::upper_bound(times, time) - times.begin());
        pose.before = after == 0 ? 0 : after - 1;
        pose.after = std::min(after, times.size() - 1);
        pose.share = pose.before == pose.after
                         ? 0.0
                         : (time - times[pose.before]) / (times[pose.after] - times[pose.before]);
        return;
    }
    pose.placings.clear();
    for (const Node& node : nodes_)
        pose.placings.push_back({node.translation, node.rotation, node.scale});
    pose.animated.resize(nodes_.size());
    for (std::vector<double>& weights : pose.animated) weights.clear();
    for (const Channel& channel : channels_) {
        channel.at(time, pose.value);
        Pose::Placing& node = pose.placings[channel.node];
        const double* const value = pose.value.data();
        switch (channel.property) {
        case Property::translation:
            node.translation = glm::make_vec3(value);
            break;
        case Property::rotation:
            node.rotation = glm::dquat(value[3], value[0], value[1], value[2]);
            break;
        case Property::scale:
            node.scale = glm::make_vec3(value);
            break;
        case Property::weights:
            pose.animated[channel.node].assign(pose.value.begin(), pose.value.end());
            break;
        }
    }
    pose.transforms.clear();
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        const Node& node = nodes_[i];
        const Pose::Placing& placing = pose.placings[i];
        glm::dmat4 local = node.matrix;
        if (!node.has_matrix) {
            local = glm::mat4_cast(placing.rotation);
            for (int axis = 0; axis < 3; ++axis) local[axis] *= placing.scale[axis];
            local[3] = glm::dvec4(placing.translation, 1.0);
        }
        pose.transforms.push_back(
            node.parent < 0 ? local
                            : pose.transforms[static_cast<std::size_t>(node.parent)] * local);
    }
    pose.joints.resize(parts_.size());
    pose.weights.resize(parts_.size());
    for (std::size_t number = 0; number < parts_.size(); ++number) {
        const Part& part = parts_[number];
        std::vector<glm::dmat4>& joints = pose.joints[number];
        joints.clear();
        if (!part.is_skinned) joints.push_back(pose.transforms[part.node]);
        for (std::size_t i = 0; i < part.joints.size(); ++i)
            joints.push_back(pose.transforms[part.joints[i]] * part.inverse_binds[i]);
        const std::vector<double>& own = pose.animated[part.node];
        const std::vector<double>& weights = own.empty() ? part.weights : own;
        pose.weights[number].assign(weights.begin(), weights.end());
        pose.weights[number].resize(part.targets.size(), 0.0);
    }
}

glm::dvec3
MeshAnimation::placed(const Part& part, const Pose& pose, std::size_t number, std::size_t vertex) {
    glm::dvec3 position = part.positions[vertex];
    for (std::size_t i = 0; i < part.targets.size(); ++i)
        if (pose.weights[number][i] != 0.0)
            position += pose.weights[number][i] * part.targets[i][vertex];
    const std::vector<glm::dmat4>& joints = pose.joints[number];
    if (!part.is_skinned) return glm::dvec3(joints.front() * glm::dvec4(position, 1.0));
    glm::dvec3 sum{0.0};
    for (std::size_t i = 0; i < part.influences; ++i) {
        const auto& [joint, weight] = part.influence_list[vertex * part.influences + i];
        if (weight > 0.0) sum += weight * glm::dvec3(joints[joint] * glm::dvec4(position, 1.0));
    }
    return sum;
}

glm::dvec3 MeshAnimation::sampled(const Pose& pose, std::size_t vertex) const {
    return glm::mix(
        glm::dvec3(samples_.positions[pose.before * vertex_count_ + vertex]),
        glm::dvec3(samples_.positions[pose.after * vertex_count_ + vertex]), pose.share);
}

glm::dvec3 MeshAnimation::position(const Pose& pose, std::size_t vertex) const {
    if (!samples_.times.empty()) return sampled(pose, vertex);
    const auto after = std::ranges::upper_bound(parts_, vertex, {}, &Part::first);
    const auto number = static_cast<std::size_t>(after - parts_.begin()) - 1;
    return placed(parts_[number], pose, number, vertex - parts_[number].first);
}

void MeshAnimation::positions(const Pose& pose, std::vector<glm::dvec3>& positions) const {
    positions.clear();
    positions.reserve(vertex_count_);
    if (!samples_.times.empty())
        for (std::size_t i = 0; i < vertex_count_; ++i) positions.push_back(sampled(pose, i));
    for (std::size_t number = 0; number < parts_.size(); ++number)
        for (std::size_t i = 0; i < parts_[number].positions.size(); ++i)
            positions.push_back(placed(parts_[number], pose, number, i));
}

}  // namespace hair::groom
