// SPDX-License-Identifier: GPL-3.0-or-later
/// Every key of a scene, wrong in every way that its type and range allow, and keys that exclude
/// one another: each is refused with one line that names place, key, value and what is allowed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iomanip>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include <tangency/dem/scene.hpp>
#include <tangency/dem/scene/scene_keys.hpp>

#include "scenes.hpp"

namespace {

using namespace tangency::dem;
using tangency::testing::refusal;
using tangency::testing::small_scene;
using tangency::testing::with;

/// A stage with all that its kind requires.
std::string stage_of(const std::string& kind) {
  const std::string held = "mean_stress = 1e6\nmax_strain_rate = 0.01\n";
  const std::string head = "[[stage]]\nkind = \"" + kind + "\"\n";
  if (kind == "place") return head;
  if (kind == "shear") return head + "axial_strain_rate = 0.01\naxial_strain = 0.1\n";
  if (kind == "servo") return head + "duration = 10\n";
  if (kind == "grow") return head + "elongation = 1.5\n" + held;
  return head + held;
}

/// A scene that is accepted, with every section, and a stage of the kind last but for the body.
std::string scene_with(const std::string& kind) {
  const bool is_explicit = kind == "explicit", has_wall = kind == "wall", sweeps = kind == "sweep";
  const bool has_units = kind == "units";
  return "schema = 1\n[cell]\nsize = [90.0, 90.0, 90.0]\n" +
         std::string(has_wall ? "walls = \"xyz\"\n" : "") +
         "[motion]\n[particles.grain]\n"
         "count = 1\nmean_radius = 10.0\n[contact]\nnormal_stiffness = 1e10\n[output]\n" +
         stage_of("place") + (is_explicit ? "arrangement = \"explicit\"\n" : "") +
         (is_explicit || has_wall || kind == "place" ? ""
          : sweeps || has_units                      ? stage_of("compress")
                                                     : stage_of(kind)) +
         (is_explicit ? "[[body]]\ntype = \"grain\"\nposition = [1.0, 2.0, 3.0]\n" : "") +
         (has_units ? "[units]\nlength = \"mm\"\nstress = \"kPa\"\n" : "") +
         (sweeps ? "[sweep]\n\"contact.friction_coefficient\" = [0.1, 0.2]\n" : "") +
         (has_wall ? "[[wall]]\npoint = [1.0, 2.0, 3.0]\nnormal = [1.0, 2.0, 3.0]\n"
                     "stress = 1e3\nmax_speed = 1.0\n"
                   : "");
}

/// The last table of that name, with the key set to a value.
std::string with_key(const std::string& scene, const Key& key, const std::string& value) {
  const std::string section(key.section), name(key.name);
  std::string text = scene;
  const std::size_t start = section.empty()          ? 0
                            : section == "stage"     ? text.rfind("[[stage]]")
                            : section == "body"      ? text.rfind("[[body]]")
                            : section == "wall"      ? text.rfind("[[wall]]")
                            : section == "particles" ? text.find("[particles.grain]")
                                                     : text.find("[" + section + "]");
  std::size_t at = section.empty() ? 0 : text.find('\n', start) + 1;
  std::size_t end = text.find("\n[", at == 0 ? 0 : at - 1);
  end = end == text.npos ? text.size() : end + 1;
  const std::size_t old = ("\n" + text).find("\n" + name + " = ", at);  // shifted by one: the line
  if (old < end) text.erase(old, text.find('\n', old) + 1 - old);
  if (section.empty()) at = 0;
  return text.insert(at, name + " = " + value + "\n");
}

std::string text_of(const Key& key, double x) {
  std::ostringstream out;
  if (key.type == KeyType::integer)
    out << static_cast<std::int64_t>(x);
  else
    out << std::setprecision(17) << std::scientific << x;
  return out.str();
}

/// Values next to a bound on its wrong side.
std::vector<double> outside(const Key& key) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Range& range = key.range;
  const bool whole = key.type == KeyType::integer;
  std::vector<double> wrong;
  if (range.low > -infinity)
    wrong.push_back(!range.low_included ? range.low
                    : whole             ? range.low - 1.0
                                        : std::nextafter(range.low, -infinity));
  if (range.high < infinity)
    wrong.push_back(!range.high_included ? range.high
                    : whole              ? range.high + 2.0  // of 9e15 too
                                         : std::nextafter(range.high, infinity));
  return wrong;
}

/// Numbers as an array of `count` with the wrong one last, or the wrong one alone.
std::string among(const std::string& wrong, std::size_t count) {
  if (count == 1) return wrong;
  std::string text = "[";
  for (std::size_t k = 1; k < count; ++k) text += "1.0, ";
  return text + wrong + "]";
}

/// TOML values that the key must not have.
std::vector<std::string> wrong_values(const Key& key) {
  std::vector<std::string> wrong{"{}", "1979-05-27", "[[]]"};
  if (key.type == KeyType::boolean) {
    for (const char* value : {"1", "0", "1.5", "nan", "\"\"", "\"true\"", "[]", "[true]"})
      wrong.push_back(value);
    return wrong;
  }
  wrong.push_back("true");
  if (key.type == KeyType::paths) {
    for (const char* value : {"\"\"", "7", "1.5", "nan", "[]", "[7]", "[\"\"]", "[\"a\", 1]"})
      wrong.push_back(value);
    return wrong;
  }
  if (key.type == KeyType::words) {
    for (const char* value : {"\"\"", "7", "nan", "[]", "[7]", "[\"\"]", "[\"nonsense\"]"})
      wrong.push_back(value);
    const std::string good(key.choices.substr(0, key.choices.find(' ')));
    wrong.push_back('"' + good + '"');
    wrong.push_back("[\"" + good + "\", \"nonsense\"]");
    return wrong;
  }
  const bool is_text = key.type == KeyType::text || key.type == KeyType::path;
  if (is_text) {
    for (const char* value : {"\"\"", "7", "1.5", "nan", "[]", "[\"none\"]"})
      wrong.push_back(value);
    if (key.type == KeyType::text)
      for (const char* value : {"\"no such choice\"", "\"a.b\"", "\"a-b\"", "\"\\n\""})
        wrong.push_back(value);
    if (!key.choices.empty()) wrong.push_back("\"nonsense\"");
    return wrong;
  }
  if (key.type == KeyType::reals) {
    for (const char* value : {"1.0", "[]", "nan", "[true]", "[[1.0]]", "[\"1.0\"]"})
      wrong.push_back(value);
    for (const char* value : {"nan", "inf", "-inf"}) wrong.push_back(among(value, 2));
    for (const double value : outside(key)) wrong.push_back(among(text_of(key, value), 2));
    return wrong;
  }
  const std::size_t count = key.type == KeyType::real3 ? 3 : key.type == KeyType::real4 ? 4 : 1;
  for (const char* value : {"\"many\"", "\"\"", "\"1.0\"", "nan", "inf", "-inf", "+nan"})
    wrong.push_back(among(value, count));
  if (count > 1)
    for (const char* value : {"1.0", "[]", "[1.0]", "[1.0, 1.0, 1.0, 1.0, 1.0]"})
      wrong.push_back(value);
  else
    for (const char* value : {"[]", "[1.0]"}) wrong.push_back(value);
  for (const double value : outside(key)) wrong.push_back(among(text_of(key, value), count));
  if (key.type == KeyType::integer)
    for (const char* value : {"1.0", "1.5", "9223372036854775807", "-9223372036854775808"})
      wrong.push_back(value);
  return wrong;
}

std::vector<std::string> kinds_of(const Key& key) {
  if (key.section == "body") return {"explicit"};
  if (key.section == "wall") return {"wall"};
  if (key.section == "sweep" || key.section == "units") return {std::string(key.section)};
  if (key.section != "stage") return {"compress"};
  std::istringstream stream{std::string(key.kinds)};
  std::vector<std::string> kinds;
  for (std::string kind; stream >> kind;) kinds.push_back(kind);
  return kinds;
}

TEST(EveryKey, WrongInEveryWayIsRefusedInOneLineThatNamesIt) {
  std::size_t tried = 0;
  for (const Key& key : scene_keys())
    for (const std::string& kind : kinds_of(key)) {
      ASSERT_EQ(refusal(scene_with(kind)), "") << kind;
      for (const std::string& value : wrong_values(key)) {
        const std::string scene = with_key(scene_with(kind), key, value);
        const std::string message = refusal(scene);
        const std::string what = std::string(key.section) + "." + std::string(key.name) + " = " +
                                 value + " of " + kind + ": " + message;
        ++tried;
        // The line of the key, and after it the key itself.
        const std::size_t at = scene.find(std::string(key.name) + " = " + value);
        ASSERT_NE(at, scene.npos) << what;
        const auto line =
            1 + std::count(scene.begin(), scene.begin() + static_cast<std::ptrdiff_t>(at), '\n');
        EXPECT_EQ(message.find("scene.toml:" + std::to_string(line) + ": "), 0u) << what;
        EXPECT_NE(message.find(std::string(key.name) + " = "), message.npos) << what;
        EXPECT_EQ(message.find('\n'), message.npos) << what;
        EXPECT_NE(message.find(": " + allowed_values(key)), message.npos) << what;
      }
    }
  EXPECT_GT(tried, 1000u);
}

TEST(EveryKey, EmptyOrGivenTwiceIsNoToml) {
  for (const Key& key : scene_keys()) {
    const std::string scene = scene_with(kinds_of(key).front());
    const std::string name(key.name);
    EXPECT_NE(refusal(with_key(scene, key, "")).find(": not TOML: "), std::string::npos) << name;
    const std::string twice = with_key(scene, key, "1\n" + name + " = 1");
    EXPECT_NE(refusal(twice).find(": not TOML: "), std::string::npos) << name;
  }
}

TEST(EveryKey, OfStagesOfOtherKindsIsRefused) {
  for (const char* kind : {"compress", "grow", "relax", "unload", "shear", "servo"})
    for (const Key& key : scene_keys()) {
      if (key.section != "stage") continue;
      bool has = false;  // the kind has a key of that name
      for (const Key& other : scene_keys())
        has = has ||
              (other.section == "stage" && other.name == key.name && is_among(kind, other.kinds));
      if (has) continue;
      const std::string message = refusal(with_key(scene_with(kind), key, "1.0"));
      EXPECT_NE(message.find("." + std::string(key.name) + ": no such key in a stage of this kind"),
                message.npos)
          << kind << ": " << message;
    }
}

struct Combination {
  const char* what;
  std::string scene, message;
};

std::string servo(const std::string& keys) { return scene_with("servo") + keys; }
std::string place(const std::string& keys) {
  return with(scene_with("compress"), "kind = \"place\"\n", "kind = \"place\"\n" + keys);
}
std::string contact(const std::string& keys) {
  return with(scene_with("compress"), "normal_stiffness = 1e10\n", keys);
}
std::string grow(const std::string& keys) {
  return with(scene_with("grow"), "elongation = 1.5\n", keys);
}
std::string walled(const std::string& keys) {
  return with(servo(keys), "[cell]\n", "[cell]\nwalls = \"z\"\n");
}

TEST(Combinations, ThatExcludeOneAnotherAreRefused) {
  const std::string rate = "max_strain_rate = 0.01\n";
  const std::vector<Combination> all{
      {"hertz key with linear", contact("normal_stiffness = 1e10\nyoung_modulus = 1e9\n"),
       "scene.toml:10: contact.young_modulus = 1e+09: with law = \"hertz\" alone"},
      {"poisson with linear", contact("normal_stiffness = 1e10\npoisson_ratio = 0.2\n"),
       "scene.toml:10: contact.poisson_ratio = 0.2: with law = \"hertz\" alone"},
      {"linear without stiffness", contact("friction_coefficient = 0.1\n"),
       "scene.toml:8: contact.normal_stiffness is missing: a finite number from 1e-30 to 1e+30 "
       "(N/m)"},
      {"stiffness with hertz",
       contact("law = \"hertz\"\nyoung_modulus = 1e9\nnormal_stiffness = 1e10\n"),
       "scene.toml:11: contact.normal_stiffness = 1e+10: with law = \"linear\" alone"},
      {"hertz without modulus", contact("law = \"hertz\"\n"),
       "scene.toml:8: contact.young_modulus is missing: a finite number from 1e-30 to 1e+30 (Pa)"},
      {"walls with shear_rate", walled("shear_rate = [0.1, 0.0, 0.0]\n"),
       "scene.toml:17: stage[1].shear_rate = [ 0.1, 0.0, 0.0 ]: not in a cell with walls"},
      {"walls with a direction", walled("major_direction = 10.0\n" + rate),
       "scene.toml:17: stage[1].major_direction = 10.0: not in a cell with walls"},
      {"walls without their law", with(walled(""), "[contact]", "[contact.grain-grain]"),
       "scene.toml:9: contact.grain-wall is missing: a law for every two types, or one in "
       "[contact] "
       "for all"},
      {"mean and components",
       servo("mean_stress = 1e6\nstress_xx = 1e6\nstress_yy = 1e6\nstress_zz = 1e6\n" + rate),
       "scene.toml:16: stage[1].mean_stress = 1e+06: not together with stresses that it is the "
       "mean of"},
      {"plane mean and components",
       servo("plane_mean_stress = 1e6\nstress_xx = 1e6\nstress_yy = 1e6\n" + rate),
       "scene.toml:16: stage[1].plane_mean_stress = 1e+06: not together with stresses that it "
       "is the mean of"},
      {"shear and another of one name",
       scene_with("shear") + "[[stage]]\nkind = \"servo\"\nname = \"shear\"\nduration = 1\n",
       "scene.toml:19: stage[2].name = 'shear': a name of its own: a shear stage and another have "
       "the same"},
      {"two ramps", servo("friction_coefficient = 0.1\nramp_cycles = 5\nramp_time = 1e-3\n"),
       "scene.toml:18: stage[1].ramp_time = 0.001: one of ramp_cycles, ramp_time and ramp_strain"},
      {"a ramp of nothing", servo("ramp_cycles = 5\n"),
       "scene.toml:16: stage[1].ramp_cycles = 5: with a stress to hold or a friction_coefficient "
       "alone"},
      {"a ramp over no strain", servo("friction_coefficient = 0.1\nramp_strain = 0.1\n"),
       "scene.toml:17: stage[1].ramp_strain = 0.1: with a rate of strain alone"},
      {"a ramp beyond its stage", servo("friction_coefficient = 0.1\nramp_cycles = 11\n"),
       "scene.toml:17: stage[1].ramp_cycles = 11: at most 10, where the stage ends"},
      {"a ramp a little beyond its stage",
       with(servo("friction_coefficient = 0.1\nramp_cycles = 25159\n"), "duration = 10\n",
            "duration = 25158\n"),
       "scene.toml:17: stage[1].ramp_cycles = 25159: at most 25158, where the stage ends"},
      {"a ramp beyond its strain",
       scene_with("shear") + "friction_coefficient = 0.1\nramp_strain = 0.11\n",
       "scene.toml:18: stage[1].ramp_strain = 0.11: at most 0.1, where the stage ends"},
      {"a rate twice", scene_with("shear") + "mean_stress = 1e6\ninertial_number = 1e-3\n",
       "scene.toml:15: stage[1].axial_strain_rate = 0.01: not together with inertial_number"},
      {"an inertial number of no stress",
       with(scene_with("shear"), "axial_strain_rate = 0.01", "inertial_number = 1e-3"),
       "scene.toml:15: stage[1].inertial_number = 0.001: with a stress that this stage or one "
       "before "
       "it holds"},
      {"an inertial number of no rate", servo("mean_stress = 1e6\ninertial_number = 1e-3\n" + rate),
       "scene.toml:17: stage[1].inertial_number = 0.001: with a rate that is not 0"},
      {"frames by strain where there are none",
       with(scene_with("shear"), "[output]\n",
            "[output]\nframe_interval = 0\nframe_strain = 0.01\n"),
       "scene.toml:12: output.frame_strain = 0.01: with a frame_interval > 0 alone"},
      {"strains beyond the stage's", scene_with("shear") + "save_strains = [0.05, 0.11]\n",
       "scene.toml:17: stage[1].save_strains = [ 0.05, 0.11 ]: finite numbers > 0 and at most "
       "axial_strain, ascending"},
      {"strains that do not ascend", scene_with("shear") + "save_strains = [0.05, 0.05]\n",
       "scene.toml:17: stage[1].save_strains = [ 0.05, 0.05 ]: finite numbers > 0 and at most "
       "axial_strain, ascending"},
      {"two of one name that keep states",
       scene_with("compress") + "save = true\n" + stage_of("compress") + "save = true\n",
       "scene.toml:19: stage[2].kind = 'compress': a name of its own: two stages of that name keep "
       "states"},
      {"two shears of one name that keep states",
       scene_with("shear") + "save_points = true\n" + stage_of("shear") +
           "name = \"shear\"\nsave_strains = [0.1]\n",
       "scene.toml:22: stage[2].name = 'shear': a name of its own: two stages of that name keep "
       "states"},
      {"a wall that faces nowhere",
       with(scene_with("wall"), "[1.0, 2.0, 3.0]\nstress", "[0.0, 0.0, 0.0]\nstress"),
       "scene.toml:16: wall[0].normal = [ 0.0, 0.0, 0.0 ]: 3 finite numbers, not all 0"},
      {"a wall across a periodic axis", with(scene_with("wall"), "\"xyz\"", "\"yz\""),
       "scene.toml:16: wall[0].normal = [ 1.0, 2.0, 3.0 ]: 0 along axes without walls in "
       "cell.walls"},
      // The smallest semi-axis goes by in 10 steps of 0.2 sqrt(m / K), m = 4/3 pi 1e6 kg, K = 1e10.
      {"a wall that is too fast",
       with(scene_with("wall") + stage_of("servo"), "stress = 1e3\nmax_speed = 1.0\n",
            "velocity = [0.0, 0.0, -305.5]\n"),
       "scene.toml:17: wall[0].velocity = [ 0.0, 0.0, -305.5 ]: 3 finite numbers, their part along "
       "the normal < 244 (m/s), 0.1 of the smallest semi-axis in the longest time step"},
      {"a held wall that may be too fast",
       with(scene_with("wall") + stage_of("servo"), "max_speed = 1.0\n", "max_speed = 245.0\n"),
       "scene.toml:18: wall[0].max_speed = 245.0: a finite number < 244 (m/s), 0.1 of the smallest "
       "semi-axis in the longest time step"},
      {"a wall in a periodic cell", with(scene_with("wall"), "walls = \"xyz\"\n", ""),
       "scene.toml:13: wall: in a cell with a size and walls of its own, cell.walls"},
      {"a held wall without a bound", with(scene_with("wall"), "max_speed = 1.0\n", ""),
       "scene.toml:14: wall[0].max_speed is missing: a finite number from 1e-30 to 1e+30 (m/s)"},
      {"a bound of a wall that is not held", with(scene_with("wall"), "stress = 1e3\n", ""),
       "scene.toml:17: wall[0].max_speed = 1.0: with stress alone"},
      {"a wall in a cell that strains", scene_with("wall") + stage_of("compress"),
       "scene.toml:20: stage[1].kind = 'compress': with [[wall]] a servo without rates and "
       "stresses, or a relax without mean_stress: these walls do not strain with the cell"},
      {"simple shear with walls", walled("simple_shear_rate = [0.1, 0.0, 0.0]\n"),
       "scene.toml:17: stage[1].simple_shear_rate = [ 0.1, 0.0, 0.0 ]: not in a cell with walls"},
      {"two shears", servo("shear_rate = [0.1, 0.0, 0.0]\nsimple_shear_rate = [0.1, 0.0, 0.0]\n"),
       "scene.toml:16: stage[1].shear_rate = [ 0.1, 0.0, 0.0 ]: not together with "
       "simple_shear_rate"},
      {"simple shear out of the plane",
       with(with(servo("simple_shear_rate = [0.1, 0.0, 0.1]\n"), "[cell]\n",
                 "[cell]\ndimensions = 2\n"),
            "90.0]", "1.0]"),
       "scene.toml:17: stage[1].simple_shear_rate = [ 0.1, 0.0, 0.1 ]: with dimensions = 2 of xy "
       "alone"},
      {"a relax that holds nothing",
       scene_with("compress") + "[[stage]]\nkind = \"relax\"\nhold = \"components\"\n",
       "scene.toml:19: stage[2].hold = 'components': with mean_stress alone"},
      {"a bound of nothing",
       scene_with("compress") + "[[stage]]\nkind = \"relax\"\nmax_strain_rate = 0.1\n",
       "scene.toml:19: stage[2].max_strain_rate = 0.1: with mean_stress alone"},
      {"a relax without a bound",
       scene_with("compress") + "[[stage]]\nkind = \"relax\"\nmean_stress = 1e6\n",
       "scene.toml:17: stage[2].max_strain_rate is missing: a finite number from 1e-30 to 1e+30 "
       "(1/s)"},
      {"holding without a bound", servo("mean_stress = 1e6\n"),
       "scene.toml:13: stage[1].max_strain_rate is missing: a finite number from 1e-30 to 1e+30 "
       "(1/s)"},
      {"jitter with random", place("arrangement = \"random\"\njitter = 0.1\n"),
       "scene.toml:14: stage[0].jitter = 0.1: with arrangement = \"lattice\" alone"},
      {"bounding_fraction with lattice", place("bounding_fraction = 0.1\n"),
       "scene.toml:13: stage[0].bounding_fraction = 0.1: with arrangement = \"random\" alone"},
      {"file with lattice", place("file = \"bodies.csv\"\n"),
       "scene.toml:13: stage[0].file = 'bodies.csv': with arrangement = \"explicit\" alone"},
      {"seed with explicit",
       with(scene_with("explicit"), "\"explicit\"\n", "\"explicit\"\nseed = 3\n"),
       "scene.toml:14: stage[0].seed = 3: not with arrangement = \"explicit\""},
      {"axes with explicit",
       with(scene_with("explicit"), "\"explicit\"\n", "\"explicit\"\naxes = \"aligned\"\n"),
       "scene.toml:14: stage[0].axes = 'aligned': not with arrangement = \"explicit\""},
      {"a direction with explicit",
       with(scene_with("explicit"), "\"explicit\"\n",
            "\"explicit\"\naxes_direction = [0.0, 0.0, 1.0]\n"),
       "scene.toml:14: stage[0].axes_direction = [ 0.0, 0.0, 1.0 ]: not with arrangement = "
       "\"explicit\""},
      {"a direction of random axes", place("axes_direction = [0.0, 0.0, 1.0]\n"),
       "scene.toml:13: stage[0].axes_direction = [ 0.0, 0.0, 1.0 ]: not with axes = \"random\""},
      {"no direction", place("axes = \"plane\"\naxes_direction = [0.0, 0.0, 0.0]\n"),
       "scene.toml:14: stage[0].axes_direction = [ 0.0, 0.0, 0.0 ]: 3 finite numbers, not all 0"},
      {"a direction out of the plane",
       with(with(place("axes = \"aligned\"\naxes_direction = [0.0, 1.0, 1.0]\n"), "[cell]\n",
                 "[cell]\ndimensions = 2\n"),
            "90.0]", "1.0]"),
       "scene.toml:15: stage[0].axes_direction = [ 0.0, 1.0, 1.0 ]: with dimensions = 2 none along "
       "z"},
      {"a cone without its angle", place("axes = \"cone\"\n"),
       "scene.toml:11: stage[0].axes_cone_deg is missing: a finite number > 0 and <= 90 (degrees)"},
      {"an angle without a cone", place("axes = \"plane\"\naxes_cone_deg = 20.0\n"),
       "scene.toml:14: stage[0].axes_cone_deg = 20.0: with axes = \"cone\" alone"},
      {"growth to nowhere", grow(""),
       "scene.toml:13: stage[1].elongation is missing: a finite number from 1 to 10000"},
      {"growth to two ends", grow("elongation = 1.5\neccentricity = 0.2\n"),
       "scene.toml:15: stage[1].elongation = 1.5: not together with eccentricity"},
      {"a rate of an elongation", grow("elongation = 1.5\ncycles_per_percent = 100\n"),
       "scene.toml:16: stage[1].cycles_per_percent = 100: with an eccentricity alone"},
      {"a rate and increments",
       grow("eccentricity = 0.2\nincrements = 100\ncycles_per_percent = 100\n"),
       "scene.toml:16: stage[1].increments = 100: not together with cycles_per_percent"},
      {"a rate of what does not grow", grow("eccentricity = 0.0\ncycles_per_percent = 100\n"),
       "scene.toml:16: stage[1].cycles_per_percent = 100: with an eccentricity that the particles "
       "do not have yet"},
      {"too fast a rate", grow("eccentricity = 0.5\ncycles_per_percent = 1\n"),
       "scene.toml:16: stage[1].cycles_per_percent = 1: 2 or more: an increment would change a "
       "semi-axis by 0.0178 of itself, and at most 0.01 is allowed"},
      {"a ramp without its end", grow("eccentricity = 0.2\nmean_stress_start = 1e5\n"),
       "scene.toml:16: stage[1].mean_stress_start = 1e+05: together with ramp_eccentricity"},
      {"a ramp without its start", grow("eccentricity = 0.2\nramp_eccentricity = 0.1\n"),
       "scene.toml:16: stage[1].ramp_eccentricity = 0.1: together with mean_stress_start"},
      {"a ramp beyond the growth",
       grow("elongation = 1.5\nmean_stress_start = 1e5\nramp_eccentricity = 0.21\n"),
       "scene.toml:17: stage[1].ramp_eccentricity = 0.21: a finite number > 0 and <= 0.2, on the "
       "way of the first type's"},
      {"a ramp that ends where it begins",
       grow("elongation = 1.5\nmean_stress_start = 1e5\nramp_eccentricity = 0.0\n"),
       "scene.toml:17: stage[1].ramp_eccentricity = 0.0: a finite number > 0 and <= 0.2, on the "
       "way of the first type's"},
      {"a ramp without growth",
       grow("eccentricity = 0.0\nmean_stress_start = 1e5\nramp_eccentricity = 0.0\n"),
       "scene.toml:17: stage[1].ramp_eccentricity = 0.0: with an eccentricity that changes"},
      {"lateral and mean stress", scene_with("shear") + "mean_stress = 1e6\nlateral_stress = 1e6\n",
       "scene.toml:18: stage[1].lateral_stress = 1e+06: not together with mean_stress"},
      {"a ratio in the plane",
       with(scene_with("shear"), "size = [90.0, 90.0, 90.0]", "dimensions = 2") +
           "mean_stress = 1e6\nintermediate_ratio = 0.5\n",
       "scene.toml:18: stage[1].intermediate_ratio = 0.5: with dimensions = 3 alone"},
      {"a ratio at constant volume", scene_with("shear") + "intermediate_ratio = 0.5\n",
       "scene.toml:17: stage[1].intermediate_ratio = 0.5: with mean_stress alone"},
      {"a ratio beside equal lateral stresses",
       scene_with("shear") + "lateral_stress = 1e6\nintermediate_ratio = 0.5\n",
       "scene.toml:18: stage[1].intermediate_ratio = 0.5: with mean_stress alone"},
      {"a ratio of stresses that are all held",
       servo("stress_xx = 1e6\nstress_yy = 1e6\nstress_zz = 1e6\nintermediate_ratio = 0.5\n" +
             rate),
       "scene.toml:19: stage[1].intermediate_ratio = 0.5: not together with stresses that it "
       "follows from"},
      {"a ratio of turned stresses",
       servo("mean_stress = 1e6\nmajor_direction = 10.0\nintermediate_ratio = 0.5\n" + rate),
       "scene.toml:17: stage[1].major_direction = 10.0: not together with intermediate_ratio"},
      {"a shear whose lateral axis strains too fast",
       with(scene_with("shear"), "axial_strain_rate = 0.01", "axial_strain_rate = 20.0") +
           "mean_stress = 1e6\nintermediate_ratio = 1.0\n",
       "scene.toml:15: stage[1].axial_strain_rate = 20.0: a finite number < 12.2 (1/s), a strain "
       "of "
       "0.1 a time step"},
      {"a rate of turns without one of shifts", scene_with("relax") + "rotational_damping = 0.5\n",
       "scene.toml:17: stage[1].rotational_damping = 0.5: where damping is a number alone"},
      {"turns damped so that they turn round",
       scene_with("compress") + "rotational_damping = 10.0\ntime_step_factor = 0.25\n",
       "scene.toml:17: stage[1].rotational_damping = 10.0: with time_step_factor = 0.25 a finite "
       "number <= 8: a step that damps more would turn velocities round"},
      {"the scheme of curves in the plane",
       with(with(scene_with("shear"), "size = [90.0, 90.0, 90.0]", "dimensions = 2"), "[motion]",
            "[motion]\ncontacts = \"trace\""),
       "scene.toml:5: motion.contacts = 'trace': with dimensions = 2 follow or global: trace is of "
       "ellipsoids"},
      {"an explicit scene without bodies", place("arrangement = \"explicit\"\n"),
       "scene.toml:13: stage[0].arrangement = 'explicit': with a file, or a list of [[body]] "
       "tables"},
      {"bodies of a lattice",
       scene_with("compress") + "[[body]]\ntype = \"grain\"\nposition = [1.0, 2.0, 3.0]\n",
       "scene.toml:17: body: a place with arrangement = \"explicit\" and without a file has it"},
      {"more bodies than the count",
       scene_with("explicit") + "[[body]]\ntype = \"grain\"\nposition = [1.0, 2.0, 3.0]\n",
       "scene.toml:14: 2 bodies of type grain: as many as particles.grain.count, 1"},
      {"a body of no type", with(scene_with("explicit"), "type = \"grain\"", "type = \"sand\""),
       "scene.toml:15: body[0].type = 'sand': a name of one of the scene's particle types"},
      {"a body that is too far away for its neighbours to be found",
       with(scene_with("explicit"), "[1.0, 2.0, 3.0]", "[1.0, -3e10, 3.0]"),
       "scene.toml:16: body[0].position = [ 1.0, -3e+10, 3.0 ]: at most 2^28 edges of the cell "
       "away from its corner"},
      {"a body without orientation",
       scene_with("explicit") + "orientation = [0.0, 0.0, 0.0, 0.0]\n",
       "scene.toml:17: body[0].orientation = [ 0.0, 0.0, 0.0, 0.0 ]: 4 finite numbers, not all 0"},
      {"a table in a law",
       with(scene_with("compress"), "[output]", "[contact.grain-grain.more]\n[output]"),
       "scene.toml:10: contact.grain-grain.more: no such key; allowed are law, normal_stiffness, "
       "shear_stiffness, friction_coefficient, young_modulus, poisson_ratio, largest_overlap, "
       "cohesion, restitution"},
  };
  for (const Combination& one : all) EXPECT_EQ(refusal(one.scene), one.message) << one.what;
}

TEST(Combinations, ThatAreSoundAreAccepted) {
  EXPECT_EQ(refusal(servo("mean_stress = 1e6\nstress_zz = 1e6\nmax_strain_rate = 0.01\n")), "");
  EXPECT_EQ(refusal(walled("stress_zz = 1e6\nmax_strain_rate = 0.01\n")), "");
  EXPECT_EQ(refusal(contact("law = \"hertz\"\nyoung_modulus = 1e9\n")), "");
  EXPECT_EQ(refusal(scene_with("shear") + "lateral_stress = 1e6\n"), "");
  EXPECT_EQ(refusal(scene_with("shear") + "save_strains = [0.02, 0.1]\nsave_points = true\n"), "");
  EXPECT_EQ(refusal(scene_with("compress") + "save = true\n" + stage_of("compress")), "");
  EXPECT_EQ(refusal(with(scene_with("explicit"), "[1.0, 2.0, 3.0]", "[1.0, -2e10, 3.0]")), "");
  EXPECT_EQ(refusal(servo("shear_rate = [0.01, 0.0, 0.0]\n")), "");
  EXPECT_EQ(refusal(place("axes = \"cone\"\naxes_cone_deg = 90.0\n")), "");
  EXPECT_EQ(refusal(place("arrangement = \"random\"\naxes = \"plane\"\n"
                          "axes_direction = [-1.0, 0.0, 1e-3]\n")),
            "");
  EXPECT_EQ(refusal(grow("eccentricity = 0.2\n")), "");
  EXPECT_EQ(refusal(grow("eccentricity = 0.2\ncycles_per_percent = 1000\n"
                         "mean_stress_start = 1e5\nramp_eccentricity = 0.01\n")),
            "");
  // An elongation that is e = 0.2 but for its last digit.
  EXPECT_EQ(refusal(grow("elongation = 1.4999999999999998\nmean_stress_start = 1e5\n"
                         "ramp_eccentricity = 0.2\n")),
            "");
  EXPECT_EQ(refusal(scene_with("shear") + "mean_stress = 1e6\nintermediate_ratio = 1\n"), "");
  EXPECT_EQ(refusal(servo("mean_stress = 1e6\nintermediate_ratio = 0.5\nmax_strain_rate = 0.01\n")),
            "");
  EXPECT_EQ(refusal(scene_with("relax") + "damping = 0.1\nrotational_damping = 0.2\n"), "");
}

// 2^53 + 1 and the largest integer of TOML.
TEST(Integers, ThatNoDoubleHoldsAreRoundedWhereANumberIsWanted) {
  const auto read = [](const std::string& before, const std::string& after) {
    return parse_scene(with(scene_with("servo"), before, after), "scene.toml");
  };
  const Scene heavy = read("count = 1\n", "count = 1\ndensity = 9007199254740993\n");
  EXPECT_EQ(heavy.particle_types[0].batch.density, 9007199254740992.0);
  const Scene pulled = read("[motion]\n", "[motion]\ngravity = [0, 0, -9223372036854775807]\n");
  EXPECT_EQ(pulled.gravity[2], -0x1p63);
}

}  // namespace
