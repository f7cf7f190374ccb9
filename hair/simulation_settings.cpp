#include "hair/simulation_settings.h"

#include "hair/field_rows.h"

namespace hair {

const Table& tableOf(const GlobalSettings*) {
    using S = GlobalSettings;
    static const Table table = tableWith<S>({number(
        "stiffness", &S::stiffness, 0, 1, "1",
        "fraction of the way to the rest position, per 1/60 s")});
    return table;
}

const Table& tableOf(const LocalSettings*) {
    using S = LocalSettings;
    static const Table table = tableWith<S>(
        {choice(
             "method", &S::method,
             {{LocalMethod::iterate, "iterate"}, {LocalMethod::energy, "energy"}},
             "how `shape` keeps its shape. iterate: the thesis's method, which has no energy, so "
             "that its rest shape depends on the time step; energy: bending joints, in one direct "
             "solve with the lengths, with the same rest shape at any time step"),
         number(
             "stiffness", &S::stiffness, 0, 1, "1",
             "k_L per iteration at 10 iterations, 1/60 s and segments of 21.4285 mm; used up to "
             "0.95. energy: hair sags under its weight as much as with iterate and 7 segments"),
         number(
             "iterations", &S::iterations, 0, 64, "count",
             "iterations per step; energy: one solve; 0 switches it off")});
    return table;
}

const Table& tableOf(const LengthSettings*) {
    using S = LengthSettings;
    static const Table table = tableWith<S>(
        {choice(
             "method", &S::method,
             {{LengthMethod::tridiagonal, "tridiagonal"}, {LengthMethod::iterate, "iterate"}},
             "how `shape` keeps lengths. tridiagonal: direct solves along the strand, exact after "
             "every pass; iterate: the thesis's method, one segment after the other, which "
             "stretches under load, and more so with more vertices"),
         number(
             "iterations", &S::iterations, 0, 256, "count",
             "per step: passes of `tridiagonal`, red-black iterations of `iterate` (the thesis has "
             "5); 0: lengths are free, except those that /simulation/local/method energy keeps")});
    return table;
}

const Table& tableOf(const FtlSettings*) {
    using S = FtlSettings;
    static const Table table = tableWith<S>({number(
        "velocity_correction", &S::velocity_correction, 0, 1, "1",
        "part of the next vertex's position correction that is added back to a velocity")});
    return table;
}

const Table& tableOf(const RodSettings*) {
    using S = RodSettings;
    static const Table table = tableWith<S>(
        {number("iterations", &S::iterations, 1, 64, "count", "Newton iterations per substep"),
         choice(
             "integrator", &S::integrator,
             {{RodIntegrator::implicit_euler, "implicit_euler"},
              {RodIntegrator::generalized_alpha, "generalized_alpha"}},
             "implicit_euler: damps every motion by half of the substep times its squared "
             "frequency; generalized_alpha: second order in time, so that damping is the "
             "material's, and implicit Euler for strands whose Newton iterations do not converge, "
             "touch a body or have air drag")});
    return table;
}

const Table& tableOf(const StableCosseratSettings*) {
    using S = StableCosseratSettings;
    static const Table table = tableWith<S>(
        {choice(
             "method", &S::method,
             {{CosseratMethod::direct, "direct"}, {CosseratMethod::descent, "descent"}},
             "direct: each iteration solves all positions of a strand at once and orientations "
             "exactly; descent: the paper's way, vertex by vertex with an approximate multiplier, "
             "and with the first segment held at its follicle's angle"),
         number(
             "iterations", &S::iterations, 1, 256, "count",
             "iterations per substep, each a solve of the positions and a sweep over the "
             "orientations"),
         number(
             "stretch_modulus", &S::stretch_modulus, 1, 1e12, "Pa",
             "replaces youngs_modulus against stretch and shear; a greater value keeps lengths "
             "better, but hair then needs more iterations to move correctly")});
    return table;
}

const Table& tableOf(const PositionBasedRodSettings*) {
    using S = PositionBasedRodSettings;
    static const Table table = tableWith<S>({number(
        "iterations", &S::iterations, 1, 256, "count",
        "iterations per substep, each of which corrects every segment and joint once")});
    return table;
}

const Table& tableOf(const AugmentedMassSpringSettings*) {
    using S = AugmentedMassSpringSettings;
    static const Table table = tableWith<S>(
        {number("iterations", &S::iterations, 1, 64, "count", "Newton iterations per substep"),
         number(
             "spring_modulus", &S::spring_modulus, 1, 1e12, "Pa",
             "modulus of the springs along edges, against bending and against torsion: their "
             "tension at twice the length, divided by the hair's cross-section"),
         number(
             "integrity", &S::integrity, 0, 1e6, "1/s^2",
             "acceleration toward the rest position, per distance from it"),
         number(
             "angular_stiffness", &S::angular_stiffness, 0, 1e6, "m^2/s^2",
             "torque that turns a segment to its rest direction, per radian, segment length and "
             "mass per length; it holds up hair of length L against gravity g if it is above g "
             "L")});
    return table;
}

const Table& tableOf(const MaterialSettings*) {
    using S = MaterialSettings;
    static const Table table = tableWith<S>(
        {number("density", &S::density, 1, 20000, "kg/m^3", "mass per volume"),
         number(
             "radius", &S::radius, 1e-6, 0.01, "m",
             "radius of the round cross-section, for the stiffness of rods and the drag of the "
             "wind"),
         number(
             "ellipticity", &S::ellipticity, 1, 10, "1",
             "longer over shorter axis of the cross-section, whose area stays that of `radius`, "
             "for the stiffness of `rod`; human hair has 1 to 1.8. The longer axis is upright "
             "at roots that are level, and goes along strands without twisting"),
         number(
             "section_angle", &S::section_angle, -360, 360, "deg",
             "turn of the longer axis of `rod` at the root, about the hair"),
         number(
             "twist", &S::twist, -10000, 10000, "rad/m",
             "natural twist of rods: what a hair without load is twisted by, beyond the groom's "
             "shape. Curved hair winds to a helix, and the longer axis turns along the hair"),
         number("youngs_modulus", &S::youngs_modulus, 1, 1e12, "Pa", "E: resists bending"),
         number("shear_modulus", &S::shear_modulus, 1, 1e12, "Pa", "G: resists twist"),
         number(
             "damping", &S::damping, 0, 1, "s",
             "damping of `rod` (Kelvin-Voigt): this times the rate of strain is added to the "
             "strain, so that the amplitude of a mode of w rad/s halves in 1.386 / (w^2 damping) "
             "seconds; "
             "an implicit Euler substep damps by at least its own length"),
         number(
             "set_share", &S::set_share, 0, 0.95, "1",
             "share of the stiffness of `rod` that yields when hair is held bent or twisted "
             "(Zener's "
             "standard linear solid): the moment of held hair falls to 1 - set_share of its first, "
             "and hair that was held for long keeps set_share of its bend when it is let go; 0: "
             "hair takes no set"),
         number(
             "set_time", &S::set_time, 0.001, 1000, "s",
             "time in which that share's moment falls to 1/e while hair is held; the set of free "
             "hair falls to 1/e in set_time / (1 - set_share)"),
         number(
             "water", &S::water, 0, 10, "1",
             "water on the hair, over the hair's own mass: its weight, and wet hair's darker "
             "colour "
             "and narrower highlights; 0.2 fills the gaps of a clump, soaked hair has up to 1")});
    return table;
}

double wetDensity(const MaterialSettings& material) {
    return double{material.density} * (1.0 + double{material.water});
}

const Table& tableOf(const WindSettings*) {
    using S = WindSettings;
    static const Table table = tableWith<S>(
        {choice(
             "mode", &S::mode, {{WindMode::thesis, "thesis"}, {WindMode::drag, "drag"}},
             "thesis: acceleration by strength, cone and gusts; drag: air drag by speed and "
             "turbulence, which also brakes hair in still air"),
         number(
             "strength", &S::strength, 0, 1500, "m/s^2",
             "thesis mode: acceleration at magnitude 1; the thesis uses 0 to 15"),
         number(
             "direction", &S::direction, -1, 1, "1",
             "direction that the wind blows toward; any length except zero"),
         number(
             "cone_angle", &S::cone_angle, 0, 89, "deg",
             "thesis mode: half-angle of the cone of four wind vectors round the direction"),
         number(
             "gust_rate", &S::gust_rate, 0, 100, "rad/s",
             "thesis mode: w in magnitude = sin^2(w t) + 0.5; the thesis's 0.05 per frame at 60 Hz "
             "is 3"),
         number("speed", &S::speed, 0, 100, "m/s", "drag mode: mean speed of the wind"),
         number(
             "turbulence", &S::turbulence, 0, 2, "1",
             "drag mode: root mean square of each component of the fluctuation, divided by the "
             "speed"),
         number(
             "turbulence_scale", &S::turbulence_scale, 0.01, 100, "m",
             "drag mode: size of the largest eddies, which are the gusts"),
         number(
             "turbulence_octaves", &S::turbulence_octaves, 1, 8, "count",
             "drag mode: number of sizes of eddies, each half the size of the previous one"),
         number("air_density", &S::air_density, 0, 1000, "kg/m^3", "drag mode: density of the air"),
         number(
             "air_viscosity", &S::air_viscosity, 1e-7, 1, "Pa s",
             "drag mode: dynamic viscosity of the air"),
         number(
             "drag_along", &S::drag_along, 0, 100, "1",
             "drag mode: drag along the hair per length, divided by the viscosity and the air's "
             "speed along it; 0: none. Hair of 10 cm has 0.9 in creeping flow, 1.2 in 0.1 m/s, 1.5 "
             "in 1 m/s and 1.9 in 5 m/s")});
    return table;
}

const Table& tableOf(const Collider*) {
    using S = Collider;
    static const Table table = tableWith<S>(
        {number("a", &S::a, -100, 100, "m", "one end of the axis"),
         number("b", &S::b, -100, 100, "m", "other end of the axis"),
         number("radius", &S::radius, 0.0001, 10, "m", "radius"),
         choice(
             "follows", &S::follows, {{Follows::head, "head"}, {Follows::world, "world"}},
             "head: moves with /simulation/motion; world: stands still")});
    return table;
}

const Table& tableOf(const DistanceFieldSettings*) {
    using S = DistanceFieldSettings;
    static const Table table = tableWith<S>(
        {fileName(
             "mesh", &S::mesh,
             "mesh whose triangles face outward, relative to the scene file; empty: the mesh that "
             "the "
             "hair grows on; openings are capped"),
         number(
             "resolution", &S::resolution, 8, 256, "count",
             "cells along the longest side of the mesh"),
         choice(
             "follows", &S::follows, {{Follows::head, "head"}, {Follows::world, "world"}},
             "head: moves with /simulation/motion; world: stands still")});
    return table;
}

const Table& tableOf(const CollisionSettings*) {
    using S = CollisionSettings;
    static const Table table = tableWith<S>(
        {choice(
             "parts", &S::parts,
             {{CollisionParts::vertices, "vertices"}, {CollisionParts::segments, "segments"}},
             "parts of a guide that stay outside colliders. vertices: only its vertices; segments: "
             "its segments too, so that no long segment passes through a thin collider"),
         number("margin", &S::margin, 0, 1, "m", "distance that guides keep from colliders"),
         number(
             "friction", &S::friction, 0, 10, "1",
             "Coulomb's coefficient of friction on colliders"),
         toggle(
             "continuous", &S::continuous,
             "stop guides where their path in a substep enters a collider, so that fast hair does "
             "not pass through thin ones; off: test only the ends of the paths"),
         toggle(
             "warm_start", &S::warm_start,
             "`rod` carries contact forces from one substep to the next, so that hair presses on "
             "colliders with the force of its stiffness, and sticks up to friction times that "
             "force; off: each substep begins without them")});
    return table;
}

bool yields(const HairHairSettings& settings) {
    return settings.cohesion > 0.0f ||
           (settings.friction_coefficient > 0.0f && settings.repulsion > 0.0f);
}

const Table& tableOf(const HairHairSettings*) {
    using S = HairHairSettings;
    static const Table table = tableWith<S>(
        {number(
             "friction", &S::friction, 0, 1, "1",
             "fraction of the difference from the other strands' mean velocity that hair loses per "
             "1/60 s; 0.05 for loose hair to 0.5 for hair that moves as one"),
         number(
             "friction_coefficient", &S::friction_coefficient, 0, 10, "1",
             "Coulomb's coefficient of friction between hairs, which stick to each other up to "
             "that part of the pressure of `repulsion`; instead of `friction`"),
         number(
             "cohesion", &S::cohesion, 0, 1000, "m^2/s^2",
             "shear stress up to which hairs stick to each other without pressure, divided by the "
             "density; over g, the height of a layer of hair that it holds on a wall; 0.05 for "
             "dry hair with some hold to 1 for gel; instead of `friction`"),
         number(
             "attraction", &S::attraction, 0, 1000, "m^2/s^2",
             "energy that two guides release where water joins them, over the mass of one; 1 for "
             "single wet hairs and 0.1 for guides that stand for 100; used up to half of (cell / "
             "time step)^2 in crowded hair, with friction_coefficient or cohesion up to a quarter"),
         number(
             "repulsion", &S::repulsion, 0, 1000, "m^2/s^2",
             "square of the speed of sound in crowded hair: its pressure divided by the density "
             "above `crowding`; 0.1 to 0.6 for hair of 15 cm; used up to half of (cell / time "
             "step)^2, with friction_coefficient or cohesion up to a quarter"),
         number(
             "crowding", &S::crowding, 0.1, 100, "1",
             "density above which hair repels hair, relative to the mean density at rest"),
         number(
             "shelter", &S::shelter, 0, 1e6, "1",
             "hairs that each guide stands for where they slow the air that reaches the hair "
             "behind them, with wind of mode drag; 0: air reaches all hair undisturbed"),
         number(
             "resolution", &S::resolution, 8, 128, "count",
             "cells along each side of the grid round the hair; cells much smaller than guide "
             "segments miss hair")});
    return table;
}

const Table& tableOf(const Keyframe*) {
    using S = Keyframe;
    static const Table table = tableWith<S>(
        {number("time", &S::time, 0, 100000, "s", "simulated time; keyframes are in order of time"),
         number(
             "rotation", &S::rotation, -36000, 36000, "deg",
             "pitch (nod, about +x), yaw (turn, about +y) and roll (about +z), applied roll first"),
         number("translation", &S::translation, -100, 100, "m", "displacement")});
    return table;
}

const Table& tableOf(const MotionSettings*) {
    using S = MotionSettings;
    static const Table table = tableWith<S>(
        {list(
             "keyframes", &S::keyframes, 10000,
             "poses of the head, with smooth motion between them; none: the head stands still"),
         number("pivot", &S::pivot, -100, 100, "m", "point that rotations turn about"),
         toggle(
             "repeat", &S::repeat, "start again with the first keyframe at the time of the last")});
    return table;
}

const Table& tableOf(const AnimationSettings*) {
    using S = AnimationSettings;
    static const Table table = tableWith<S>(
        {text(
             "clip", &S::clip,
             "animation of the mesh's file (skin, morph targets, nodes) that deforms the head and "
             "carries each root with its triangle, before /simulation/motion moves all of it: its "
             "name, or its number if it has no name; empty: none"),
         number("speed", &S::speed, 0, 100, "1", "speed relative to the file's"),
         toggle("repeat", &S::repeat, "start again at the time of the last keyframe")});
    return table;
}

const Table& tableOf(const PullKey*) {
    using S = PullKey;
    static const Table table = tableWith<S>(
        {number("time", &S::time, 0, 100000, "s", "simulated time; keys are in order of time"),
         number(
             "position", &S::position, -100, 100, "m",
             "position of the hand, which moves straight between keys")});
    return table;
}

const Table& tableOf(const PullSettings*) {
    using S = PullSettings;
    static const Table table = tableWith<S>(
        {number("guide", &S::guide, 0, 4294967295.0, "1", "guide that is held"),
         number(
             "vertex", &S::vertex, 1, 65535, "1",
             "vertex of the guide that is held; 0 is the root"),
         number(
             "radius", &S::radius, 0, 10, "m",
             "distance from the held vertex, at rest, at which hair gets 1/e of the acceleration; "
             "0: that vertex alone"),
         number(
             "stiffness", &S::stiffness, 0, 100000, "1/s^2",
             "acceleration per distance from the vertex to the hand; critically damped"),
         list(
             "path", &S::path, 10000,
             "keys of the hand's position; none: the hand does not pull")});
    return table;
}

const Table& tableOf(const SimulationSettings*) {
    using S = SimulationSettings;
    static const Table table = tableWith<S>(
        {choiceOrFile(
             "solver", &S::solver,
             {{Solver::none, "none"},
              {Solver::shape, "shape"},
              {Solver::ftl, "ftl"},
              {Solver::rod, "rod"},
              {Solver::stable_cosserat, "stable_cosserat"},
              {Solver::position_based_rod, "position_based_rod"},
              {Solver::augmented_mass_spring, "augmented_mass_spring"}},
             Solver::extension, &S::solver_file,
             "none: frozen at rest; shape: the thesis's Verlet with shape constraints; ftl: follow "
             "the leader; rod: Cosserat rods with SI material; stable_cosserat: such rods by Hsu "
             "et al. 2025, solved for positions and orientations alternately; position_based_rod: "
             "such rods by "
             "Kugelstadt and Schoemer 2016, with XPBD's compliances; augmented_mass_spring: "
             "springs and a ghost of the rest shape, by Amador Herrera et al. 2024; a file of GLSL "
             "(.glsl), relative to the scene file: docs/extending.md"),
         parameters(
             "solver_parameters", &S::solver_parameters,
             "parameters of the file that solver names, with the names, ranges and units that it "
             "declares"),
         choice(
             "parallelism", &S::parallelism,
             {{Parallelism::automatic, "automatic"},
              {Parallelism::vertex, "vertex"},
              {Parallelism::strand, "strand"},
              {Parallelism::serial, "serial"}},
             "vertices that an invocation of `shape` moves. vertex: two; strand: up to 32, in "
             "registers; automatic: strand on a CPU, by the number of guides on a GPU; serial: all "
             "of a strand, one by one in memory, for comparison"),
         number("time_step", &S::time_step, 0.0005, 0.1, "s", "fixed step of simulated time"),
         number(
             "substeps", &S::substeps, 0, 64, "count",
             "solver steps per time step; 0: one, or for rods as many as keep a substep within "
             "1/480 s (rod, augmented_mass_spring), 1/960 s (stable_cosserat) or 1/1920 s, and "
             "for a file within its parameter longest_substep"),
         number(
             "settle_steps", &S::settle_steps, 0, 100000, "count",
             "steps simulated without wind before the first frame"),
         number("gravity", &S::gravity, -100, 100, "m/s^2", "acceleration of gravity"),
         number("friction", &S::friction, 0, 1, "1", "fraction of the velocity lost per 1/60 s"),
         choice(
             "stiffness_scaling", &S::stiffness_scaling,
             {{StiffnessScaling::invariant, "invariant"}, {StiffnessScaling::thesis, "thesis"}},
             "invariant: stiffness means the same at any time step, iteration count and segment "
             "length; thesis: the raw factor, applied once per iteration"),
         choice(
             "rest", &S::rest, {{RestShape::groom, "groom"}, {RestShape::balanced, "balanced"}},
             "rest shape of the guides of `shape` and `rod`. groom: the groom's shape, which sags "
             "under gravity; balanced: the shape that gives the groom under gravity"),
         number(
             "most_stiffening", &S::most_stiffening, 1, 1000, "1",
             "rest: balanced: greatest factor by which a guide may be stiffened so that it hangs "
             "stably; a guide that would need more keeps the groom's shape as its rest shape"),
         group("global", &S::global, "pull toward the rest position"),
         group("local", &S::local, "pull toward the rest shape"),
         group("length", &S::length, "inextensible segments"),
         group("ftl", &S::ftl, "follow the leader"),
         group("rod", &S::rod, "Cosserat rods"),
         group("stable_cosserat", &S::stable_cosserat, "stable Cosserat rods"),
         group("position_based_rod", &S::position_based_rod, "position based Cosserat rods"),
         group("augmented_mass_spring", &S::augmented_mass_spring, "augmented mass-spring model"),
         group("material", &S::material, "material of a hair, for rods and the drag of the wind"),
         group("wind", &S::wind, "wind"),
         extensionFile(
             "force", &S::force,
             "file of GLSL (.glsl) that accelerates guides in addition to gravity and wind, but "
             "not while they settle; relative to the scene file: docs/extending.md; empty: none"),
         parameters(
             "force_parameters", &S::force_parameters,
             "parameters of the file that force names, with the names, ranges and units that it "
             "declares"),
         group("collision", &S::collision, "contact with bodies"),
         list("colliders", &S::colliders, 65536, "capsules that push guides out"),
         list("distance_fields", &S::distance_fields, 8, "meshes that push guides out"),
         group("hair_hair", &S::hair_hair, "contact of hair with hair, on a grid of density"),
         group("motion", &S::motion, "keyframed motion of the head"),
         group("animation", &S::animation, "animation that deforms the mesh that hair grows on"),
         list("pulls", &S::pulls, 64, "hands that pull at hair")});
    return table;
}

}  // namespace hair
