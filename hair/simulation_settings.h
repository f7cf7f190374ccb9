#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/extension.h"

// Parameters of the simulation. settings.h has the other parameters and says how to add one.
namespace hair {

class Table;

// Thesis equation (10): X += k_G (X_rest - X).
struct GlobalSettings {
    float stiffness = 0.002f;
};

const Table& tableOf(const GlobalSettings*);

// iterate: thesis equation (11), which turns the lower segment of a joint; Han and Harada 2012,
// Real-time hair simulation with efficient hair style preservation. energy: a couple on both
// segments, solved in one system with the lengths: simulation/constraints/bend.glsl.
enum class LocalMethod { iterate, energy };

struct LocalSettings {
    LocalMethod method = LocalMethod::iterate;
    float stiffness = 0.01f;
    std::uint32_t iterations = 10;
};

const Table& tableOf(const LocalSettings*);

// tridiagonal: all segments of a strand at once; simulation/constraints/length.glsl. iterate:
// thesis equation (12), one segment after the other; Mueller et al. 2007, Position based dynamics.
enum class LengthMethod { tridiagonal, iterate };

struct LengthSettings {
    LengthMethod method = LengthMethod::tridiagonal;
    std::uint32_t iterations = 2;
};

const Table& tableOf(const LengthSettings*);

// Mueller, Kim and Chentanez 2012, Fast simulation of inextensible hair and fur, equation (9).
struct FtlSettings {
    float velocity_correction = 0.9f;
};

const Table& tableOf(const FtlSettings*);

// Inextensible elastic rods, a direct solve per strand: hair/reference/rod.h.
enum class RodIntegrator { implicit_euler, generalized_alpha };

struct RodSettings {
    std::uint32_t iterations = 2;
    RodIntegrator integrator = RodIntegrator::implicit_euler;
};

const Table& tableOf(const RodSettings*);

// Hsu, Wang, Wu and Yuksel 2025, Stable Cosserat rods: hair/reference/compared_rods.h.
enum class CosseratMethod { direct, descent };

struct StableCosseratSettings {
    CosseratMethod method = CosseratMethod::direct;
    std::uint32_t iterations = 8;
    float stretch_modulus = 1e6f;
};

const Table& tableOf(const StableCosseratSettings*);

// Kugelstadt and Schoemer 2016, Position and orientation based Cosserat rods:
// hair/reference/compared_rods.h.
struct PositionBasedRodSettings {
    std::uint32_t iterations = 4;
};

const Table& tableOf(const PositionBasedRodSettings*);

// Amador Herrera et al. 2024, Augmented mass-spring model for real-time dense hair simulation:
// hair/reference/compared_rods.h.
struct AugmentedMassSpringSettings {
    std::uint32_t iterations = 2;
    float spring_modulus = 1e6f;
    float integrity = 10.0f;
    float angular_stiffness = 1.0f;
};

const Table& tableOf(const AugmentedMassSpringSettings*);

// Material of a hair. Hair is anisotropic: neither modulus follows from the other.
struct MaterialSettings {
    float density = 1320.0f;
    float radius = 37e-6f;
    float ellipticity = 1.0f;
    float section_angle = 0.0f;
    float twist = 0.0f;
    float youngs_modulus = 3.9e9f;
    float shear_modulus = 0.6e9f;
    float damping = 0.0f;
    float set_share = 0.0f;
    float set_time = 1.0f;
    float water = 0.0f;
};

const Table& tableOf(const MaterialSettings*);

// Mass of hair and its water per volume of dry hair, kg/m^3.
double wetDensity(const MaterialSettings& material);

enum class WindMode { thesis, drag };

// thesis: its equations (13) and (14). drag: air drag on a cylinder, in a wind with divergence-free
// turbulence that the mean wind carries along (Taylor 1938).
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
    float drag_along = 0.0f;
};

const Table& tableOf(const WindSettings*);

// Frame of reference of a body.
enum class Follows { head, world };

// A capsule; a sphere if a == b.
struct Collider {
    glm::vec3 a{0.0f};
    glm::vec3 b{0.0f};
    float radius = 0.1f;
    Follows follows = Follows::head;
};

const Table& tableOf(const Collider*);

// The signed distance to the body that a mesh bounds, sampled on a grid.
struct DistanceFieldSettings {
    std::string mesh;
    std::uint32_t resolution = 64;
    Follows follows = Follows::head;
};

const Table& tableOf(const DistanceFieldSettings*);

// Parts of a guide that collide with bodies.
enum class CollisionParts { vertices, segments };

struct CollisionSettings {
    CollisionParts parts = CollisionParts::vertices;
    float margin = 0.0f;
    float friction = 0.0f;
    bool continuous = false;
    bool warm_start = false;
};

const Table& tableOf(const CollisionSettings*);

// Petrovic, Henne and Anderson 2005, Volumetric methods for simulation and rendering of hair.
// Contact is off if friction, repulsion, cohesion and attraction are 0.
struct HairHairSettings {
    float friction = 0.0f;
    float friction_coefficient = 0.0f;
    float cohesion = 0.0f;
    float attraction = 0.0f;
    float repulsion = 0.0f;
    float crowding = 1.0f;
    float shelter = 0.0f;
    std::uint32_t resolution = 32;
};

const Table& tableOf(const HairHairSettings*);

// Whether hairs stick to each other up to a yield stress.
bool yields(const HairHairSettings& settings);

// A pose of the head: a rotation about the pivot, then a translation.
struct Keyframe {
    float time = 0.0f;
    glm::vec3 rotation{0.0f};
    glm::vec3 translation{0.0f};
};

const Table& tableOf(const Keyframe*);

// Rigid motion of the head. The roots, the rest shape and bodies that follow the head move with it.
struct MotionSettings {
    std::vector<Keyframe> keyframes;
    glm::vec3 pivot{0.0f};
    bool repeat = false;
};

const Table& tableOf(const MotionSettings*);

// An animation in the file of the mesh that hair grows on. It deforms the mesh and with it the
// scalp.
struct AnimationSettings {
    std::string clip;  // empty: the mesh keeps its shape
    float speed = 1.0f;
    bool repeat = true;
};

const Table& tableOf(const AnimationSettings*);

// A hand's position at a time.
struct PullKey {
    float time = 0.0f;
    glm::vec3 position{0.0f};
};

const Table& tableOf(const PullKey*);

// A hand that pulls hair from the first key's time to the last key's: a damped spring between the
// hand and a vertex. The hair round that vertex gets the vertex's acceleration too.
struct PullSettings {
    std::uint32_t guide = 0;
    std::uint32_t vertex = 1;
    float radius = 0.02f;
    float stiffness = 400.0f;
    std::vector<PullKey> path;
};

const Table& tableOf(const PullSettings*);

enum class Solver {
    none,
    shape,
    ftl,
    rod,
    stable_cosserat,
    position_based_rod,
    augmented_mass_spring,
    extension  // of the file that `solver_file` names
};
enum class Parallelism { automatic, vertex, strand, serial };
enum class StiffnessScaling { invariant, thesis };
// Shape of guides without load. groom: the groom's shape, so guides sag under gravity. balanced:
// the shape with which guides hang under gravity as in the groom.
enum class RestShape { groom, balanced };

struct SimulationSettings {
    Solver solver = Solver::shape;
    std::string solver_file;
    ExtensionParameters solver_parameters;
    Parallelism parallelism = Parallelism::automatic;
    float time_step = 1.0f / 60.0f;
    std::uint32_t substeps = 0;
    std::uint32_t settle_steps = 0;
    glm::vec3 gravity{0.0f, -9.8f, 0.0f};
    float friction = 0.05f;
    StiffnessScaling stiffness_scaling = StiffnessScaling::invariant;
    RestShape rest = RestShape::groom;
    float most_stiffening = 16.0f;
    GlobalSettings global;
    LocalSettings local;
    LengthSettings length;
    FtlSettings ftl;
    RodSettings rod;
    StableCosseratSettings stable_cosserat;
    PositionBasedRodSettings position_based_rod;
    AugmentedMassSpringSettings augmented_mass_spring;
    MaterialSettings material;
    WindSettings wind;
    std::string force;
    ExtensionParameters force_parameters;
    CollisionSettings collision;
    std::vector<Collider> colliders;
    std::vector<DistanceFieldSettings> distance_fields;
    HairHairSettings hair_hair;
    MotionSettings motion;
    AnimationSettings animation;
    std::vector<PullSettings> pulls;
};

const Table& tableOf(const SimulationSettings*);

}  // namespace hair
