#pragma once

#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/fields.h"

// The parameters of the simulation: settings.h has the others and says how to add one.
namespace hair {

// Thesis equation (10): X += k_G (X_rest - X).
struct GlobalSettings {
    float stiffness = 0.002f;
};

constexpr auto fields(const GlobalSettings*) {
    using S = GlobalSettings;
    return std::tuple{Field{
        "stiffness", &S::stiffness, 0, 1, "1",
        "fraction of the way to the rest position, per 1/60 s"}};
}

// Thesis equation (11); Han and Harada 2012, Real-time hair simulation with efficient hair style
// preservation.
struct LocalSettings {
    float stiffness = 0.01f;
    std::uint32_t iterations = 10;
};

constexpr auto fields(const LocalSettings*) {
    using S = LocalSettings;
    return std::tuple{
        Field{
            "stiffness", &S::stiffness, 0, 1, "1",
            "k_L per iteration at 10 iterations, 1/60 s and segments of 21.4285 mm; used up to "
            "0.95"},
        Field{"iterations", &S::iterations, 0, 64, "count", "iterations per step"}};
}

// Thesis equation (12); Mueller et al. 2007, Position based dynamics.
struct LengthSettings {
    std::uint32_t iterations = 5;
};

constexpr auto fields(const LengthSettings*) {
    using S = LengthSettings;
    return std::tuple{
        Field{"iterations", &S::iterations, 0, 256, "count", "red-black iterations per step"}};
}

// Mueller, Kim and Chentanez 2012, Fast simulation of inextensible hair and fur, equation (9).
struct FtlSettings {
    float velocity_correction = 0.9f;
};

constexpr auto fields(const FtlSettings*) {
    using S = FtlSettings;
    return std::tuple{Field{
        "velocity_correction", &S::velocity_correction, 0, 1, "1",
        "part of the projection of the vertex below that a velocity gets back"}};
}

// Inextensible elastic rods, a direct solve per strand: hair/simulation/reference_rod.h.
struct RodSettings {
    std::uint32_t iterations = 2;
};

constexpr auto fields(const RodSettings*) {
    using S = RodSettings;
    return std::tuple{
        Field{"iterations", &S::iterations, 1, 64, "count", "Newton iterations per substep"}};
}

// What one hair is made of. Hair is anisotropic: neither modulus follows from the other.
struct MaterialSettings {
    float density = 1320.0f;
    float radius = 37e-6f;
    float youngs_modulus = 3.9e9f;
    float shear_modulus = 0.6e9f;
};

constexpr auto fields(const MaterialSettings*) {
    using S = MaterialSettings;
    return std::tuple{
        Field{"density", &S::density, 1, 20000, "kg/m^3", "mass per volume"},
        Field{
            "radius", &S::radius, 1e-6, 0.01, "m",
            "radius of the round cross-section; stiffness of `rod`, drag of the wind"},
        Field{"youngs_modulus", &S::youngs_modulus, 1, 1e12, "Pa", "E: resists bending"},
        Field{"shear_modulus", &S::shear_modulus, 1, 1e12, "Pa", "G: resists twist"}};
}

enum class WindMode { thesis, drag };

// thesis: equations (13) and (14) there. drag: the force of air on a cylinder across its axis, in a
// wind with divergence-free turbulence that the mean wind carries along (Taylor 1938).
struct WindSettings {
    WindMode mode = WindMode::thesis;
    float strength = 0.0f;
    glm::vec3 direction{1.0f, 0.0f, 0.0f};
    float cone_angle = 20.0f;
    float gust_rate = 3.0f;
    float speed = 0.0f;
    float turbulence = 0.0f;
    float turbulence_scale = 0.5f;
    std::uint32_t turbulence_octaves = 3;
    float air_density = 1.2f;
    float air_viscosity = 1.8e-5f;
};

constexpr auto fields(const WindSettings*) {
    using S = WindSettings;
    return std::tuple{
        Choice<S, WindMode, 2>{
            "mode",
            &S::mode,
            {{{WindMode::thesis, "thesis"}, {WindMode::drag, "drag"}}},
            "thesis: acceleration by strength, cone and gusts; drag: air drag by speed and "
            "turbulence, which also brakes hair in still air"},
        Field{
            "strength", &S::strength, 0, 1500, "m/s^2",
            "thesis mode: acceleration at magnitude 1; the thesis uses 0 to 15"},
        Field{
            "direction", &S::direction, -1, 1, "1", "where the wind blows to; any length but zero"},
        Field{
            "cone_angle", &S::cone_angle, 0, 89, "deg",
            "thesis mode: half-angle of the cone of four wind vectors round the direction"},
        Field{
            "gust_rate", &S::gust_rate, 0, 100, "rad/s",
            "thesis mode: w in magnitude = sin^2(w t) + 0.5; the thesis's 0.05 per frame at 60 Hz "
            "is 3"},
        Field{"speed", &S::speed, 0, 100, "m/s", "drag mode: mean speed of the wind"},
        Field{
            "turbulence", &S::turbulence, 0, 2, "1",
            "drag mode: root mean square of each component of the fluctuation over the speed"},
        Field{
            "turbulence_scale", &S::turbulence_scale, 0.01, 100, "m",
            "drag mode: size of the largest eddies, which are the gusts"},
        Field{
            "turbulence_octaves", &S::turbulence_octaves, 1, 8, "count",
            "drag mode: sizes of eddies, each half of the one before"},
        Field{"air_density", &S::air_density, 0, 1000, "kg/m^3", "drag mode: density of the air"},
        Field{
            "air_viscosity", &S::air_viscosity, 1e-7, 1, "Pa s",
            "drag mode: dynamic viscosity of the air"}};
}

// What a body moves with.
enum class Follows { head, world };

// A capsule, or a sphere where a == b.
struct Collider {
    glm::vec3 a{0.0f};
    glm::vec3 b{0.0f};
    float radius = 0.1f;
    Follows follows = Follows::head;
};

constexpr auto fields(const Collider*) {
    using S = Collider;
    return std::tuple{
        Field{"a", &S::a, -100, 100, "m", "one end of the axis"},
        Field{"b", &S::b, -100, 100, "m", "other end of the axis"},
        Field{"radius", &S::radius, 0.0001, 10, "m", "radius"},
        Choice<S, Follows, 2>{
            "follows",
            &S::follows,
            {{{Follows::head, "head"}, {Follows::world, "world"}}},
            "head: moves with /simulation/motion; world: stands still"}};
}

// The signed distance to a closed mesh, sampled on a grid.
struct DistanceFieldSettings {
    std::string mesh;
    std::uint32_t resolution = 64;
    Follows follows = Follows::head;
};

constexpr auto fields(const DistanceFieldSettings*) {
    using S = DistanceFieldSettings;
    return std::tuple{
        FileName<S>{
            {"mesh", &S::mesh,
             "closed mesh, relative to the scene file; empty: the mesh that the hair grows on"}},
        Field{
            "resolution", &S::resolution, 8, 256, "count",
            "cells along the longest side of the mesh"},
        Choice<S, Follows, 2>{
            "follows",
            &S::follows,
            {{{Follows::head, "head"}, {Follows::world, "world"}}},
            "head: moves with /simulation/motion; world: stands still"}};
}

struct CollisionSettings {
    float margin = 0.0f;
    float friction = 0.0f;
};

constexpr auto fields(const CollisionSettings*) {
    using S = CollisionSettings;
    return std::tuple{
        Field{"margin", &S::margin, 0, 1, "m", "distance that guides keep from colliders"},
        Field{
            "friction", &S::friction, 0, 10, "1",
            "Coulomb's coefficient of friction on colliders"}};
}

// Petrovic, Henne and Anderson 2005, Volumetric methods for simulation and rendering of hair. Off
// where friction and repulsion are 0.
struct HairHairSettings {
    float friction = 0.0f;
    float repulsion = 0.0f;
    float crowding = 1.0f;
    std::uint32_t resolution = 32;
};

constexpr auto fields(const HairHairSettings*) {
    using S = HairHairSettings;
    return std::tuple{
        Field{
            "friction", &S::friction, 0, 1, "1",
            "part of the difference to the other strands' mean velocity that hair loses per 1/60 "
            "s; 0.05 for loose hair to 0.5 for hair that moves as one"},
        Field{
            "repulsion", &S::repulsion, 0, 1000, "m^2/s^2",
            "square of the speed of sound in crowded hair: its pressure over the density beyond "
            "the crowding; 0.1 to 0.6 for hair of 15 cm; used up to half of (cell / time "
            "step)^2"},
        Field{
            "crowding", &S::crowding, 0.1, 100, "1",
            "density from which hair repels hair, over the mean density at rest"},
        Field{
            "resolution", &S::resolution, 8, 128, "count",
            "cells along each side of the grid round the hair; cells much smaller than guide "
            "segments miss hair"}};
}

// A pose of the head: a turn round the pivot, then a translation.
struct Keyframe {
    float time = 0.0f;
    glm::vec3 rotation{0.0f};
    glm::vec3 translation{0.0f};
};

constexpr auto fields(const Keyframe*) {
    using S = Keyframe;
    return std::tuple{
        Field{"time", &S::time, 0, 100000, "s", "simulated time; keyframes are in its order"},
        Field{
            "rotation", &S::rotation, -36000, 36000, "deg",
            "pitch (nod, about +x), yaw (turn, about +y) and roll (about +z), applied roll first"},
        Field{"translation", &S::translation, -100, 100, "m", "displacement"}};
}

// Rigid motion of the head, and with it of the roots, the rest shape and what follows the head.
struct MotionSettings {
    std::vector<Keyframe> keyframes;
    glm::vec3 pivot{0.0f};
    bool repeat = false;
};

constexpr auto fields(const MotionSettings*) {
    using S = MotionSettings;
    return std::tuple{
        List<S, Keyframe>{
            "keyframes", &S::keyframes, 10000,
            "poses of the head, with smooth motion between them; none: it stands still"},
        Field{"pivot", &S::pivot, -100, 100, "m", "point that rotations turn about"},
        Toggle<S>{
            "repeat", &S::repeat, "start again with the first keyframe at the time of the last"}};
}

// Where a hand is.
struct PullKey {
    float time = 0.0f;
    glm::vec3 position{0.0f};
};

constexpr auto fields(const PullKey*) {
    using S = PullKey;
    return std::tuple{
        Field{"time", &S::time, 0, 100000, "s", "simulated time; keys are in its order"},
        Field{"position", &S::position, -100, 100, "m", "of the hand; straight between keys"}};
}

// A hand that pulls at hair: a damped spring between it and a vertex, whose acceleration the hair
// round that vertex gets too. From the first key's time to the last key's.
struct PullSettings {
    std::uint32_t guide = 0;
    std::uint32_t vertex = 1;
    float radius = 0.02f;
    float stiffness = 400.0f;
    std::vector<PullKey> path;
};

constexpr auto fields(const PullSettings*) {
    using S = PullSettings;
    return std::tuple{
        Field{"guide", &S::guide, 0, 4294967295.0, "1", "guide that is held"},
        Field{"vertex", &S::vertex, 1, 65535, "1", "its vertex that is held; 0 is the root"},
        Field{
            "radius", &S::radius, 0, 10, "m",
            "at this distance from the vertex, at rest, hair gets 1/e of the acceleration; 0: the "
            "vertex alone"},
        Field{
            "stiffness", &S::stiffness, 0, 100000, "1/s^2",
            "acceleration by distance from the vertex to the hand; damped critically"},
        List<S, PullKey>{"path", &S::path, 10000, "where the hand is; none: it does not pull"}};
}

enum class Solver { none, shape, ftl, rod };
enum class Parallelism { automatic, vertex, strand, serial };
enum class StiffnessScaling { invariant, thesis };

struct SimulationSettings {
    Solver solver = Solver::shape;
    Parallelism parallelism = Parallelism::automatic;
    float time_step = 1.0f / 60.0f;
    std::uint32_t substeps = 0;
    std::uint32_t settle_steps = 0;
    glm::vec3 gravity{0.0f, -9.8f, 0.0f};
    float friction = 0.05f;
    StiffnessScaling stiffness_scaling = StiffnessScaling::invariant;
    GlobalSettings global;
    LocalSettings local;
    LengthSettings length;
    FtlSettings ftl;
    RodSettings rod;
    MaterialSettings material;
    WindSettings wind;
    CollisionSettings collision;
    std::vector<Collider> colliders;
    std::vector<DistanceFieldSettings> distance_fields;
    HairHairSettings hair_hair;
    MotionSettings motion;
    std::vector<PullSettings> pulls;
};

constexpr auto fields(const SimulationSettings*) {
    using S = SimulationSettings;
    return std::tuple{
        Choice<S, Solver, 4>{
            "solver",
            &S::solver,
            {{{Solver::none, "none"},
              {Solver::shape, "shape"},
              {Solver::ftl, "ftl"},
              {Solver::rod, "rod"}}},
            "none: frozen at rest; shape: the thesis's Verlet with shape constraints; ftl: follow "
            "the leader; rod: Cosserat rods with SI material"},
        Choice<S, Parallelism, 4>{
            "parallelism",
            &S::parallelism,
            {{{Parallelism::automatic, "automatic"},
              {Parallelism::vertex, "vertex"},
              {Parallelism::strand, "strand"},
              {Parallelism::serial, "serial"}}},
            "what an invocation of `shape` moves. vertex: two vertices; strand: up to 32, in "
            "registers; automatic: strand on a CPU, by the number of guides on a GPU; serial: a "
            "strand, vertex by vertex in memory, to compare with"},
        Field{"time_step", &S::time_step, 0.0005, 0.1, "s", "fixed step of simulated time"},
        Field{
            "substeps", &S::substeps, 0, 64, "count",
            "solver steps per time step; 0: one, for rod as many as keep a substep to 1/480 s"},
        Field{
            "settle_steps", &S::settle_steps, 0, 100000, "count",
            "steps simulated without wind before the first frame"},
        Field{"gravity", &S::gravity, -100, 100, "m/s^2", "acceleration of gravity"},
        Field{"friction", &S::friction, 0, 1, "1", "fraction of the velocity lost per 1/60 s"},
        Choice<S, StiffnessScaling, 2>{
            "stiffness_scaling",
            &S::stiffness_scaling,
            {{{StiffnessScaling::invariant, "invariant"}, {StiffnessScaling::thesis, "thesis"}}},
            "invariant: stiffness means the same at any time step, iteration count and segment "
            "length; "
            "thesis: the raw factor, applied once per iteration"},
        Group<S, GlobalSettings>{"global", &S::global, "pull toward the rest position"},
        Group<S, LocalSettings>{"local", &S::local, "pull toward the rest shape"},
        Group<S, LengthSettings>{"length", &S::length, "inextensible segments"},
        Group<S, FtlSettings>{"ftl", &S::ftl, "follow the leader"},
        Group<S, RodSettings>{"rod", &S::rod, "Cosserat rods"},
        Group<S, MaterialSettings>{
            "material", &S::material, "of a hair, for `rod` and the drag of the wind"},
        Group<S, WindSettings>{"wind", &S::wind, "wind"},
        Group<S, CollisionSettings>{"collision", &S::collision, "contact with bodies"},
        List<S, Collider>{"colliders", &S::colliders, 65536, "capsules that push guides out"},
        List<S, DistanceFieldSettings>{
            "distance_fields", &S::distance_fields, 8, "closed meshes that push guides out"},
        Group<S, HairHairSettings>{
            "hair_hair", &S::hair_hair, "contact of hair with hair, on a grid of density"},
        Group<S, MotionSettings>{"motion", &S::motion, "keyframed motion of the head"},
        List<S, PullSettings>{"pulls", &S::pulls, 64, "hands that pull at hair"}};
}

}  // namespace hair
