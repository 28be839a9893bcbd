// SPDX-License-Identifier: MIT
#include <tangency/dem/scene/scene_keys.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <ostream>
#include <sstream>
#include <vector>

#include <tangency/dem/contact/contact_law.hpp>
#include <tangency/dem/samples/insertion.hpp>
#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::dem {
namespace {

using enum KeyType;

/// Of a text.
constexpr Range kNoRange{};
/// Without its ends.
constexpr Range kOpenUnitInterval{.low = 0.0, .high = 1.0};
constexpr Range between(double low, double high) { return {low, high, true, true}; }
constexpr Range above_to(double low, double high) { return {low, high, false, true}; }

/// Chosen: 32-bit indices hold them, and a run of more needs another program.
constexpr double kMostParticles = 1e6;
constexpr double kMostCycles = 1e12;
constexpr double kMostIncrements = 1e6;
/// What has a unit. Chosen: no laboratory comes near these bounds, and within them masses, moments
/// of inertia, sqrt(m/K) and its inverse are normal doubles, at most 1e200 and at least 1e-200.
constexpr Range kPositive = between(1e-30, 1e30);
constexpr Range kNotNegative = between(0.0, 1e30);
constexpr Range kAnySign = between(-1e30, 1e30);
/// Of semi-axes. Chosen: two of them make a needle or a disk of 1e8.
constexpr Range kAxisRatio = between(1.0, 1e4);
/// (a - b) / (a + b) of these, but for a last digit.
constexpr Range kEccentricity = between(0.0, 0.9998);
/// Measured on shear tests of one sample at steps growing from 0.05 sqrt(m/K_n): a step above
/// 0.3 sqrt(m/K_n) does not blow up. The servo hides that the motion is wrong, and the peak
/// friction angle silently falls from 44 to 33 degrees.
constexpr double kLargestTimeStepFactor = 0.3;

/// The kinds of stages: all, those that move particles, those that load by one mean stress.
constexpr std::string_view kStageKinds = "place compress grow relax unload shear servo";
constexpr std::string_view kMovingKinds = "compress grow relax unload shear servo";
constexpr std::string_view kIsotropicKinds = "compress grow relax unload";
constexpr std::string_view kRampedKinds = "compress relax unload shear servo";
/// Advice of `check` that a stage may not want, and, in the second line, a scene alone.
constexpr std::string_view kAdviceOfStages =
    "inertial_number servo_inertial_number overlap time_step";
constexpr std::string_view kAdviceOfScenes =
    "inertial_number servo_inertial_number overlap time_step impact largest_overlap gravity";
/// Those that have to hold one; relax may also leave the cell as it is.
constexpr std::string_view kPressedKinds = "compress grow unload";

constexpr std::array kKeys{
    Key{"", "schema", integer, "-", "", between(1, 1), "", "", "Version of this table"},
    Key{"", "include", paths, "-", "(none)", kNoRange, "", "",
        "Files beside this one whose keys hold where this one, or a later one of them, does not "
        "say otherwise; lists of tables are joined, theirs first. A file that is included again, "
        "by "
        "another way too, counts once, where it is first"},
    Key{"", "intended", words, "-", "(nothing)", kNoRange, kAdviceOfScenes, "",
        "What tangency-dem check advises against and this scene means: a flow has an "
        "inertial_number, a published sample may be soft (overlap). Neither check nor the run "
        "speaks of it. It changes no number"},

    Key{"units", "length", text, "-", "", kNoRange, "um mm m km", "",
        "What the scene's lengths are in. This table names units for pages and summary.json, and "
        "changes no number: the run has those of the scene"},
    Key{"units", "stress", text, "-", "", kNoRange, "Pa kPa MPa GPa", "",
        "What its stresses are in: forces are then in stress times length^2, masses in stress "
        "times length "
        "times time^2 (mm, kPa and s: mN and kg)"},
    Key{"units", "time", text, "-", "s", kNoRange, "us ms s", "", "What its times are in"},

    Key{"cell", "size", real3, "m", "(as the placing needs)", kPositive, "", "",
        "Edges of the periodic cell along x, y, z at the start; the lattice is spread over them"},
    Key{"cell", "dimensions", integer, "-", "3", between(2, 3), "", "",
        "2: elliptic disks of unit thickness in the plane z = 0; a size then has 1 along z"},
    Key{"cell", "walls", text, "-", "none", kNoRange, "none x y z xy xz yz xyz", "",
        "Axes whose two faces are plane walls; the others are periodic"},

    Key{"wall", "point", real3, "m", "", kAnySign, "", "", "Of its face, at the start"},
    Key{"wall", "normal", real3, "-", "", kAnySign, "", "",
        "Out of the wall, to the side where the bodies are, of any length; 0 along axes without "
        "walls in cell.walls"},
    Key{"wall", "velocity", real3, "m/s", "(0)", kAnySign, "", "",
        "Of the wall from the first cycle on; what is along the normal moves its face"},
    Key{"wall", "stress", real, "Pa", "(not held)", kPositive, "", "",
        "To bear: force of the bodies along the normal over the area of the face within the cell; "
        "the wall comes and goes for it"},
    Key{"wall", "max_speed", real, "m/s", "(needed to hold a stress)", kPositive, "", "",
        "Largest speed of a wall that holds a stress, along its normal"},

    Key{"motion", "gravity", real3, "m/s^2", "(0)", kAnySign, "", "", "Acceleration"},
    Key{"motion", "rotation", text, "-", "full", kNoRange, "none simplified full", "",
        "Euler's equations: full, without their quadratic terms, or none at all"},
    Key{"motion", "contacts", text, "-", "follow", kNoRange, "follow global trace", "",
        "Of several ways out of an overlap: that of the step before, or the shortest; trace: that "
        "of the published scheme of curves, slow"},

    Key{"particles", "count", integer, "-", "", between(1, kMostParticles), "", "",
        "Number of particles of this type"},
    Key{"particles", "mean_radius", real, "m", "(needed, but for a sieve curve)", kPositive, "", "",
        "Geometric mean of the semi-axes a >= b >= c, in the plane of a and b; where sizes differ "
        "their mean, of lognormal ones the median"},
    Key{"particles", "elongation", real, "-", "1.0", kAxisRatio, "", "", "a / b"},
    Key{"particles", "flatness", real, "-", "1.0", kAxisRatio, "", "", "b / c; 1 in the plane"},
    Key{"particles", "elongations", reals, "-", "(elongation)", kAxisRatio, "", "",
        "Least and largest a / b instead: they are uniform in number between the two"},
    Key{"particles", "flatnesses", reals, "-", "(flatness)", kAxisRatio, "", "",
        "Least and largest b / c instead, alike"},
    Key{"particles", "sizes", text, "-", "equal", kNoRange, "equal uniform normal lognormal sieve",
        "",
        "Distribution of the mean radii: in number, or by the mass that passes sieves; number i of "
        "n has the size at the share (i + 1/2) / n"},
    Key{"particles", "size_spread", real, "-", "(needed by uniform, normal, lognormal)",
        above_to(0.0, 2.0), "", "",
        "uniform: half the width over mean_radius; normal: standard deviation over mean_radius; "
        "lognormal: standard deviation of the logarithm"},
    Key{"particles", "size_tails", real, "-", "0.02", between(1e-6, 0.4), "", "",
        "normal, lognormal: share in number of the distribution that is left out at either end"},
    Key{"particles", "sieve_openings", reals, "m", "(needed by sieve)", kPositive, "", "",
        "Square openings, ascending; an ellipsoid passes one of sqrt(2 (b^2 + c^2)), a disk of the "
        "plane one of 2 b"},
    Key{"particles", "sieve_passing", reals, "-", "(needed by sieve)", between(0.0, 1.0), "", "",
        "Share of the mass that passes each of sieve_openings, ascending from 0 to 1; linear in "
        "the logarithm of the opening between two"},
    Key{"particles", "layer", reals, "-", "(0 and 1)", between(0.0, 1.0), "", "",
        "insertion: ends of the layer where the centres lie, in shares of the cell along z (in the "
        "plane y)"},
    Key{"particles", "density", real, "kg/m^3", "1000.0", kPositive, "", "",
        "Mass over volume; scales time, and nothing else in slow motion"},

    Key{"body", "type", text, "-", "", kNoRange, "", "", "Name of a particle type"},
    Key{"body", "position", real3, "m", "", kAnySign, "", "", "Centre"},
    Key{"body", "orientation", real4, "-", "(1, 0, 0, 0)", kAnySign, "", "",
        "Quaternion w, x, y, z, not 0, of any length; in the plane about z"},
    Key{"body", "velocity", real3, "m/s", "(0)", kAnySign, "", "", "Relative to the strain"},
    Key{"body", "angular_velocity", real3, "1/s", "(0)", kAnySign, "", "", "In space axes"},

    Key{"contact", "law", text, "-", "linear", kNoRange, "linear hertz", "",
        "hertz: elliptic contacts by Hertz and Mindlin, from curvatures and material"},
    Key{"contact", "normal_stiffness", real, "N/m", "(needed by linear)", kPositive, "", "",
        "K_n: normal force over overlap"},
    Key{"contact", "shear_stiffness", real, "N/m", "(normal_stiffness)", kNotNegative, "", "",
        "K_s: shear force over shear displacement"},
    Key{"contact", "friction_coefficient", real, "-", "0.0", kNotNegative, "", "",
        "tan(phi): slope of the Coulomb limit of the shear force"},
    Key{"contact", "young_modulus", real, "Pa", "(needed by hertz)", kPositive, "", "",
        "hertz: E of both bodies"},
    Key{"contact", "poisson_ratio", real, "-", "0.3", between(0.0, 0.5), "", "",
        "hertz: nu of both bodies"},
    Key{"contact", "largest_overlap", real, "mean_radius", "0.02", above_to(0.0, 0.2), "", "",
        "hertz: overlap, of the smaller radius, up to which the time step is right"},
    Key{"contact", "cohesion", real, "N", "0.0", kNotNegative, "", "",
        "Coulomb limit without a normal force"},
    Key{"contact", "restitution", real, "-", "1.0", between(kLeastRestitution, 1.0), "", "",
        "Speed of parting over speed of approach, along the normal where two bodies meet, of an "
        "impact; contacts are damped so that it comes out, to 1e-3 with a time_step_factor of "
        "0.04; relax and unload without damping leave it out"},

    Key{"stage", "kind", text, "-", "", kNoRange, kStageKinds, kStageKinds, "What the stage does"},
    Key{"stage", "name", text, "-", "(its kind)", kNoRange, "", kStageKinds,
        "Name in the column stage of history.csv"},
    Key{"stage", "intended", words, "-", "(the scene's)", kNoRange, kAdviceOfStages, kMovingKinds,
        "The same of this stage alone, beside the scene's"},
    Key{"stage", "save", boolean, "-", "false", kNoRange, "", kStageKinds,
        "Keep the state at the stage's end: states/NAME.state, NAME the stage's"},
    Key{"stage", "save_strains", reals, "-", "(none)", above_to(0.0, 3.0), "", "shear",
        "Axial strains, ascending, at each of which the state is kept: states/NAME-0.05.state"},
    Key{"stage", "save_points", boolean, "-", "false", kNoRange, "", "shear",
        "Keep the states at the start, where yielding begins, at the peak of friction and where "
        "the volume begins to stay constant: states/NAME-A.state to -D.state, found in the rows of "
        "history.csv"},
    Key{"stage", "arrangement", text, "-", "lattice", kNoRange, "lattice random insertion explicit",
        "place",
        "A simple cubic (in the plane square) lattice; drawn places where bounding spheres do not "
        "overlap; drawn places where the bodies do not; or [[body]] by [[body]]"},
    Key{"stage", "file", path, "-", "(the scene's [[body]])", kNoRange, "", "place",
        "explicit: a table of bodies instead, beside the scene: CSV with type, x, y, z and, if so "
        "wanted, qw, qx, qy, qz, vx, vy, vz, wx, wy, wz, and shapes of their own: r1, r2, r3, a "
        "shape matrix m.xx ..., its inverse p.xx ..., or vectors u1.x ..., as tangency contact"},
    Key{"stage", "seed", integer, "-", "1", between(0, 9e15), "", "place",
        "Start of the random numbers"},
    Key{"stage", "jitter", real, "mean_radius", "1e-3", between(0.0, 1.0), "", "place",
        "Largest shift of each coordinate off the lattice; of the smallest type's radius"},
    Key{"stage", "bounding_fraction", real, "-", "0.25", above_to(0.0, 0.45), "", "place",
        "random: share of the cell that bounding spheres (circles) fill; at most 0.3 in space"},
    Key{"stage", "volume_fraction", real, "-", "0.3", above_to(0.0, kMostInserted), "", "place",
        "insertion, without cell.size: share of the cell that the bodies fill; equal bodies to "
        "0.37"},
    Key{"stage", "axes", text, "-", "random", kNoRange, "random aligned cone plane", "place",
        "Where the longest axis points, of oblate bodies the symmetry axis (the shortest), of "
        "spheres that of their later shape: anywhere; along axes_direction; uniform in a cone "
        "about it; uniform in the plane across it (with dimensions = 2 the line across it). The "
        "spin about the axis is uniform"},
    Key{"stage", "axes_direction", real3, "-", "(z, in the plane y)", kAnySign, "", "place",
        "aligned, cone, plane: a direction of any length"},
    Key{"stage", "axes_cone_deg", real, "degrees", "(needed by cone)", above_to(0.0, 90.0), "",
        "place", "cone: the largest angle to axes_direction"},
    Key{"stage", "mean_stress", real, "Pa", "", kPositive, "", kPressedKinds,
        "Mean stress to reach (compress) or to hold (grow, unload)"},
    Key{"stage", "mean_stress", real, "Pa", "(not held)", kPositive, "", "relax",
        "Mean stress to hold; without it the cell stays as it is, and bodies come to rest in it: "
        "under gravity they settle"},
    Key{"stage", "hold", text, "-", "mean", kNoRange, "mean components", "compress relax",
        "What mean_stress holds: the mean alone, or each normal stress, which are else free to "
        "differ"},
    Key{"stage", "mean_stress", real, "Pa", "(not held)", kPositive, "", "shear servo",
        "Mean stress to hold; a shear that holds none keeps its volume"},
    Key{"stage", "lateral_stress", real, "Pa", "(not held)", kPositive, "", "shear",
        "Stress to hold along the lateral axes, instead of a mean stress"},
    Key{"stage", "intermediate_ratio", real, "-", "(not held)", between(0.0, 1.0), "",
        "shear servo",
        "b to hold in s_yy - s_xx = b (s_zz - s_xx), in space: true triaxial; in a shear beside "
        "mean_stress"},
    Key{"stage", "inertial_number", real, "-", "(by the rates)", above_to(0.0, 1.0), "",
        "shear servo",
        "I: the largest given rate is I sqrt(p / density) / diameter, p the largest stress that "
        "this stage, or else the last before it, holds; instead of an axial_strain_rate, and the "
        "rates of a servo then say proportions alone"},
    Key{"stage", "axial_strain_rate", real, "1/s", "(by inertial_number)", kPositive, "", "shear",
        "Compression along z (in the plane y); the lateral axes extend at constant volume, with an "
        "intermediate_ratio in the proportions of its deviator, but for what is held"},
    Key{"stage", "axial_strain", real, "-", "", above_to(0.0, 3.0), "", "shear",
        "Logarithmic axial compression at which the stage ends"},
    Key{"stage", "strain_rate", real3, "1/s", "(0)", kAnySign, "", "servo",
        "Along x, y, z, compression positive; servos add to it"},
    Key{"stage", "shear_rate", real3, "1/s", "(0)", kAnySign, "", "servo",
        "Components xy, yz, zx of the strain rate, of the same sign"},
    Key{"stage", "simple_shear_rate", real3, "1/s", "(0)", kAnySign, "", "servo",
        "Simple shear instead, which also turns: rates at which layers across y move along x, "
        "across z along y, and across z along x, against the axis where > 0, so that s_xy, s_yz, "
        "s_zx become > 0. The cell is described by its least skewed image"},
    Key{"stage", "stress_xx", real, "Pa", "(not held)", kNotNegative, "", "servo", "To hold"},
    Key{"stage", "stress_yy", real, "Pa", "(not held)", kNotNegative, "", "servo", "To hold"},
    Key{"stage", "stress_zz", real, "Pa", "(not held)", kNotNegative, "", "servo", "To hold"},
    Key{"stage", "plane_mean_stress", real, "Pa", "(not held)", kPositive, "", "servo",
        "(s_xx + s_yy) / 2 to hold"},
    Key{"stage", "major_direction", real, "degrees", "(not held)", between(-90.0, 90.0), "",
        "servo",
        "Of a principal stress in the plane of z and x (in the plane y and x), from z towards x"},
    Key{"stage", "duration", integer, "cycles", "", between(1, kMostCycles), "", "servo",
        "The stage ends after so many"},
    Key{"stage", "elongation", real, "-", "(by eccentricity)", kAxisRatio, "", "grow",
        "a / b at the end, of all types; mean radii and masses stay"},
    Key{"stage", "eccentricity", real, "-", "(by elongation)", kEccentricity, "", "grow",
        "(a - b) / (a + b) at the end instead of the elongation; increments are then equal in it"},
    Key{"stage", "flatness", real, "-", "(as it is)", kAxisRatio, "", "grow",
        "b / c at the end, of all types; 1 in the plane"},
    Key{"stage", "increments", integer, "-", "200", between(1, kMostIncrements), "", "grow",
        "Steps in which the shape changes, each after a wait for balance and stress; one changes a "
        "semi-axis by at most 0.01"},
    Key{"stage", "cycles_per_percent", integer, "cycles", "(increments)",
        between(1, kMostIncrements), "", "grow",
        "Of an eccentricity, instead of increments: 0.01 of it grows in so many cycles, an "
        "increment in each without a wait; then the assembly waits for balance and stress before "
        "the next 0.01"},
    Key{"stage", "mean_stress_start", real, "Pa", "(mean_stress)", kPositive, "", "grow",
        "Mean stress where the growth begins; it changes linearly in the eccentricity of the first "
        "type up to ramp_eccentricity"},
    Key{"stage", "ramp_eccentricity", real, "-", "(no ramp)", kEccentricity, "", "grow",
        "Where mean_stress is reached, on the way of the first type's eccentricity"},
    Key{"stage", "max_inertial_fraction", real, "-", "0.01", above_to(0.0, 0.1), "", "grow",
        "What waits, and the end, wait for the inertial fraction to be at most this"},
    Key{"stage", "max_strain_rate", real, "1/s", "", kPositive, "", kPressedKinds,
        "Bound on the size of a servo's linear strain rate; a step strains by less than 0.1"},
    Key{"stage", "max_strain_rate", real, "1/s", "(by the stress)", kPositive, "", "shear",
        "Bound on the size of a servo's linear strain rate; without: 0.05 sqrt(held stress / "
        "density) / diameter, an inertial number of 0.05, or axial_strain_rate where that is more"},
    Key{"stage", "max_strain_rate", real, "1/s", "(needed to hold a stress)", kPositive, "",
        "relax servo",
        "Bound on the size of a servo's linear strain rate; a step strains by less than 0.1"},
    Key{"stage", "servo_gain", real, "-", "0.5", kOpenUnitInterval, "", "shear servo",
        "Share of the stress error that the servo removes in a cycle"},
    Key{"stage", "servo_gain", real, "-", "0.2", kOpenUnitInterval, "", "relax unload",
        "Share of the stress error that the servo removes in a cycle; small, since cell and "
        "particles come to rest together"},
    Key{"stage", "servo_gain", real, "-", "0.005", kOpenUnitInterval, "", "compress grow",
        "Share of the stress error that the servo removes in a cycle; very small, since these pass "
        "through states that hardly bear stress"},
    Key{"stage", "published_gain", real, "1/(Pa s)", "(servo_gain)", kPositive, "", kMovingKinds,
        "Gain of the published servo instead: the rate grows by it times the stress error each "
        "cycle; it rings"},
    Key{"stage", "damping", real, "sqrt(K_max/m_min)", "0.5", between(0.0, 10.0), "",
        "compress grow shear servo",
        "Rate at which the velocity of a free particle decays; times time_step_factor at most 2"},
    Key{"stage", "damping", real, "sqrt(K_max/m_min)", "(adaptive)", between(0.0, 10.0), "",
        "relax unload",
        "Rate at which the velocity of a free particle decays; times time_step_factor at most 2; "
        "without: velocities are turned towards the forces, and taken away where they run against "
        "them, by the fast inertial relaxation engine"},
    Key{"stage", "rotational_damping", real, "sqrt(K_max/m_min)", "(damping)", between(0.0, 10.0),
        "", kMovingKinds, "Rate at which the angular velocity decays, where damping is a number"},
    Key{"stage", "time_step_factor", real, "sqrt(m_min/K_max)", "0.2",
        above_to(0.0, kLargestTimeStepFactor), "", kMovingKinds, "Time step of a cycle"},
    Key{"stage", "friction_coefficient", real, "-", "(that of the contact)", kNotNegative, "",
        "compress relax shear servo", "Used for all contacts during this stage"},
    Key{"stage", "friction_coefficient", real, "-", "0.0", kNotNegative, "", "grow unload",
        "Used for all contacts during this stage"},
    Key{"stage", "ramp_cycles", integer, "cycles", "(at once)", between(1, kMostCycles), "",
        kRampedKinds,
        "Held stresses, and friction_coefficient where the stage says one, go to their values "
        "linearly over so many cycles, from what they are where it begins; friction from that of "
        "the stage before. The stage does not end on the way"},
    Key{"stage", "ramp_time", real, "s", "(at once)", kPositive, "", kRampedKinds,
        "As ramp_cycles, over a time"},
    Key{"stage", "ramp_strain", real, "-", "(at once)", above_to(0.0, 30.0), "", "shear servo",
        "As ramp_cycles, over a strain: of a shear the axial one, of a servo the time in it times "
        "the "
        "largest of its given rates, which in a simple shear is the shear strain"},
    Key{"stage", "stress_tolerance", real, "-", "0.002", above_to(0.0, 0.1), "", kIsotropicKinds,
        "The stage ends with the mean stress this close to the wanted, relatively"},
    Key{"stage", "max_unbalanced_ratio", real, "-", "0.005", above_to(0.0, 0.1), "", "relax unload",
        "The stage ends with every particle's unbalanced force, and moment over its largest "
        "semi-axis, below this times the mean contact force"},
    Key{"stage", "max_cycles", integer, "-", "200000", between(1, kMostCycles), "", kMovingKinds,
        "The run fails when the stage has not ended by then"},

    Key{"output", "history_interval", integer, "cycles", "50", between(1, kMostCycles), "", "",
        "Between two rows of history.csv; a stage's end always has one"},
    Key{"output", "frame_interval", integer, "cycles", "1000", between(0, kMostCycles), "", "",
        "Between two frames; the start and a stage's end have one too. With 0 there are none at "
        "all"},
    Key{"output", "history_strain", real, "-", "(by cycles)", above_to(0.0, 3.0), "", "",
        "Strain between two rows of history.csv instead, in stages with a given rate: of a shear "
        "the axial strain, of a servo the time in it times the largest of its given rates, which "
        "in a simple shear is the shear strain"},
    Key{"output", "frame_strain", real, "-", "(by cycles)", above_to(0.0, 3.0), "", "",
        "As history_strain, between two frames"},
    Key{"output", "contact_frames", boolean, "-", "false", kNoRange, "", "",
        "With each frame its contacts: contacts.pvd (points) and chains.pvd (lines between "
        "centres) for ParaView, frames/CYCLE.bonds for OVITO"},
    Key{"output", "contact_interval", integer, "cycles", "0", between(0, kMostCycles), "", "",
        "Between two tables contacts/CYCLE.csv; the start and a stage's end have one too. With 0 "
        "there are none at all"},
    Key{"output", "micro_interval", integer, "cycles", "0", between(0, kMostCycles), "", "",
        "Between two rows of micro.csv; a stage's end has one too. With 0 there is none at all"},
    Key{"output", "partition", text, "-", "near-uniform", kNoRange, "near-uniform polar", "",
        "micro.csv: how directions are sorted: near-uniform has 24 N^2 classes, polar N rings of "
        "2 N sectors about z; in the plane 8 N and 2 N arcs"},
    Key{"output", "classes", integer, "-", "(4; polar 18)", between(1, 100), "", "",
        "micro.csv: N of the partition; polar from 2"},
    Key{"output", "checkpoint_interval", integer, "cycles", "5000", between(0, kMostCycles), "", "",
        "Between two writes of checkpoint.state; 0 leaves it at the next key and interrupted runs"},
    Key{"output", "checkpoint_seconds", real, "s", "60.0", between(0.0, 1e9), "", "",
        "Time of the clock on the wall after which it is written again; 0 leaves it at cycles"},

    Key{"sweep", "after", text, "-", "(each runs all stages)", kNoRange, "", "",
        "Name of the stage up to which all combinations have one run; each goes on from its end"},
};

/// Whole numbers in full, as one writes them for an integer.
std::string number(double x) {
  const bool whole = x == std::floor(x) && std::abs(x) < 1e16;
  return whole ? tables::to_text(x, std::chars_format::fixed) : tables::to_text(x);
}

std::string range_text(const Range& range) {
  const bool below = range.low > -std::numeric_limits<double>::infinity();
  const bool above = range.high < std::numeric_limits<double>::infinity();
  if (below && above && range.low == range.high) return number(range.low);
  if (below && above && range.low_included && range.high_included)
    return "from " + number(range.low) + " to " + number(range.high);
  std::string text;
  if (below) text = (range.low_included ? ">= " : "> ") + number(range.low);
  if (above)
    text += (below ? " and " : "") + std::string(range.high_included ? "<= " : "< ") +
            number(range.high);
  return text.empty() ? "any" : text;
}

std::string choices_text(std::string_view choices) {
  std::string text;
  for (const char c : choices) text += c == ' ' ? std::string(", ") : std::string(1, c);
  return text;
}

std::string_view header_of(std::string_view section) {
  if (section == "particles") return "[particles.NAME]";
  if (section == "contact") return "[contact] for all pairs, [contact.NAME-NAME] for one";
  if (section == "wall") return "[[wall]], planes inside a cell with walls, which no stage strains";
  if (section == "body") return "[[body]], of a place with arrangement = explicit";
  if (section == "stage") return "[[stage]], in the order of the run";
  if (section == "units") return "[units], which may be left out: no unit is then named";
  if (section == "cell") return "[cell]";
  if (section == "motion") return "[motion]";
  if (section == "output") return "[output]";
  if (section == "sweep")
    return "[sweep], and in it \"KEY\" = [VALUE, ...] for keys by their path, as --set has them: a "
           "run for each combination";
  return "top level";
}

using SchemaLine = std::array<std::string, 6>;

SchemaLine schema_line(const Key& key) {
  const std::string allowed =
      key.type == path      ? std::string("a file's name")
      : key.type == paths   ? std::string("a file's name, a list of them")
      : key.type == boolean ? std::string("true, false")
      : key.type == words   ? "a list of " + choices_text(key.choices)
      : key.type == text ? (key.choices.empty() ? "letters, digits, _" : choices_text(key.choices))
                         : range_text(key.range);
  std::string meaning(key.meaning);
  if (key.section == "stage" && key.kinds != kStageKinds)
    meaning += " [" + choices_text(key.kinds) + ']';
  return {std::string(key.name),
          std::string(type_text(key.type)),
          std::string(key.unit),
          std::string(key.required() ? "required" : key.fallback),
          allowed,
          meaning};
}

/// Columns as wide as their widest cell.
void print_section(std::ostream& out, std::span<const Key> keys) {
  std::vector<SchemaLine> lines{{"key", "type", "unit", "default", "allowed", "meaning"}};
  for (const Key& key : keys) lines.push_back(schema_line(key));
  std::array<std::size_t, std::tuple_size_v<SchemaLine> - 1> wide{};
  for (const SchemaLine& line : lines)
    for (std::size_t k = 0; k < wide.size(); ++k) wide[k] = std::max(wide[k], line[k].size());
  for (const SchemaLine& line : lines) {
    for (std::size_t k = 0; k < wide.size(); ++k)
      out << "  " << line[k] << std::string(wide[k] - line[k].size(), ' ');
    out << "  " << line.back() << '\n';
  }
}

}  // namespace

std::span<const Key> scene_keys() { return kKeys; }

std::string_view type_text(KeyType type) {
  switch (type) {
    case integer:
      return "integer";
    case real:
      return "number";
    case real3:
      return "3 numbers";
    case real4:
      return "4 numbers";
    case reals:
      return "numbers";
    case boolean:
      return "boolean";
    case text:
    case path:
      return "text";
    case paths:
      return "text, or texts";
    case words:
      return "texts";
  }
  return "";
}

bool is_among(std::string_view word, std::string_view words) {
  std::istringstream stream{std::string(words)};
  for (std::string one; stream >> one;)
    if (one == word) return true;
  return false;
}

std::string allowed_values(const Key& key) {
  const std::string unit = key.unit == "-" ? "" : " (" + std::string(key.unit) + ")";
  switch (key.type) {
    case integer:
      return "an integer " + range_text(key.range) + unit;
    case real:
      return "a finite number " + range_text(key.range) + unit;
    case real3:
      return "3 finite numbers " + range_text(key.range) + unit;
    case real4:
      return "4 finite numbers " + range_text(key.range) + unit;
    case reals:
      return "a list of finite numbers " + range_text(key.range) + unit;
    case boolean:
      return "true or false";
    case path:
      return "the name of a file";
    case paths:
      return "the name of a file, or a list of them";
    case words:
      return "a list of one or more of " + choices_text(key.choices);
    case text:
      break;
  }
  if (key.choices.empty()) return "a name of letters, digits and underscores";
  return (key.choices.find(' ') == std::string_view::npos ? "" : "one of ") +
         choices_text(key.choices);
}

void print_schema(std::ostream& out) {
  out << "Scene schema 1. Compression is positive in stress.\n";
  for (std::span<const Key> rest = scene_keys(); !rest.empty();) {
    const auto ends = [&](const Key& key) { return key.section != rest.front().section; };
    const auto size = std::find_if(rest.begin(), rest.end(), ends) - rest.begin();
    out << '\n' << header_of(rest.front().section) << '\n';
    print_section(out, rest.first(static_cast<std::size_t>(size)));
    rest = rest.subspan(static_cast<std::size_t>(size));
  }
}

}  // namespace tangency::inline v0::dem
