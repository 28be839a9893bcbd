// SPDX-License-Identifier: MIT
#include <tangency/dem/scene.hpp>

#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include <tangency/dem/scene/scene_file.hpp>
#include <tangency/dem/scene/scene_growth.hpp>
#include <tangency/dem/scene/scene_loading.hpp>
#include <tangency/dem/scene/scene_particles.hpp>
#include <tangency/dem/scene/scene_reader.hpp>
#include <tangency/dem/scene/scene_section.hpp>

namespace tangency::inline v0::dem {
namespace {

/// Classes of micro.csv by default, the published ones [Ouadfel1998, section 2.3.2].
constexpr std::int64_t kClassesOfNearUniform = 4, kRingsOfPolar = 18;

/// Share of the smallest semi-axis that a wall may go in a time step. Chosen: the largest overlap
/// that is sound.
constexpr double kMostOfAStep = 0.1;

/// What walls are called in [contact.NAME-NAME].
constexpr std::string_view kWallName = "wall";

bool is_contact_key(std::string_view name) {
  const auto keys = scene_keys();
  return std::any_of(keys.begin(), keys.end(),
                     [&](const Key& key) { return key.section == "contact" && key.name == name; });
}

/// The largest stiffness of a Hertz contact of two bodies with these curvatures at their flattest.
HertzContact stiffest(const Vec2& a, const Vec2& b, double overlap, const Material& material) {
  const double curvature[2] = {a[0] + b[0], a[1] + b[1]};
  return hertz_contact(curvature, overlap, material);
}

class Reader {
 public:
  Reader(const toml::table& root, const Source& source, const BodyShapes& shapes)
      : root_(root), source_(source), shapes_(shapes) {}

  Scene read() {
    const Section top(source_, root_, "", "");
    read_units();
    read_cell();
    read_planes();
    read_motion();
    read_particles();
    read_contacts();
    read_stages();
    check_planes();
    read_output();
    return std::move(scene_);
  }

 private:
  /// A section's table; an empty one where it is left out.
  /// @param wanted  what a section that must not be left out has to be; "" for one that may
  const toml::table& table(std::string_view name, const std::string& wanted = {}) const {
    static const toml::table empty;
    const toml::node* node = root_.get(name);
    if (!node && !wanted.empty()) source_.fail(std::string(name) + " is missing: " + wanted);
    if (!node) return empty;
    if (!node->is_table())
      source_.fail(node->source(), std::string(name) + " = " + text_of(*node) + ": a table");
    return *node->as_table();
  }

  void read_output() {
    const Section output(source_, table("output"), "output", "output");
    scene_.output = {output.integer("history_interval"),    output.integer("frame_interval"),
                     output.integer("checkpoint_interval"), output.real("checkpoint_seconds"),
                     output.integer("contact_interval"),    output.integer("micro_interval")};
    scene_.output.contact_frames = output.boolean("contact_frames");
    scene_.output.polar = output.text("partition") == "polar";
    const std::int64_t usual = scene_.output.polar ? kRingsOfPolar : kClassesOfNearUniform;
    const std::int64_t classes = output.optional_integer("classes").value_or(usual);
    if (scene_.output.polar && classes < 2)
      output.refuse("classes", classes, "2 or more with partition = \"polar\"");
    scene_.output.classes = static_cast<int>(classes);
  }

  void read_units() {
    if (!root_.get("units")) return;
    const Section units(source_, table("units"), "units", "units");
    scene_.units = units_of(units.text("length"), units.text("stress"), units.text("time"));
    if (!scene_.units)
      units.fail("length", "with stress = \"" + units.text("stress") +
                               "\" one whose force and energy have a prefix from a to G");
  }

  void read_cell() {
    const Section cell(source_, table("cell"), "cell", "cell");
    scene_.cell_size = cell.optional_real3("size");
    scene_.dimensions = static_cast<int>(cell.integer("dimensions"));
    if (scene_.dimensions == 2 && scene_.cell_size && (*scene_.cell_size)[2] != 1.0)
      cell.fail("size", "with dimensions = 2 the third edge is the unit thickness, 1");
    const std::string walls = cell.text("walls");
    for (std::size_t k = 0; k < 3; ++k)
      scene_.walled[k] = walls != "none" && walls.find("xyz"[k]) != walls.npos;
    if (scene_.dimensions == 2 && scene_.walled[2])
      cell.fail("walls", "with dimensions = 2 of x and y alone");
  }

  void read_planes() {
    const toml::node* node = root_.get("wall");
    if (!node) return;
    const toml::array* list = node->as_array();
    if (!list || !list->is_homogeneous<toml::table>())
      source_.fail(node->source(), "wall = " + text_of(*node) + ": a list of [[wall]] tables");
    if (!scene_.has_walls() || !scene_.cell_size)
      source_.fail(node->source(), "wall: in a cell with a size and walls of its own, cell.walls");
    for (std::size_t k = 0; k < list->size(); ++k)
      scene_.planes.push_back(read_plane(
          Section(source_, *list->get(k)->as_table(), "wall[" + std::to_string(k) + "]", "wall")));
  }

  PlaneWall read_plane(const Section& section) const {
    const Vec3 normal = *section.optional_real3("normal");
    if (normal.isZero(0.0)) section.fail("normal", "3 finite numbers, not all 0");
    for (int k = 0; k < 3; ++k)
      if (!scene_.walled[static_cast<std::size_t>(k)] && normal[k] != 0.0)
        section.fail("normal", "0 along axes without walls in cell.walls");
    PlaneWall plane{normal.normalized(), 0.0,
                    section.optional_real3("velocity").value_or(Vec3::Zero())};
    plane.offset = plane.normal.dot(*section.optional_real3("point"));
    if (scene_.dimensions == 2 && plane.velocity[2] != 0.0)
      section.fail("velocity", "with dimensions = 2 none along z");
    if (!section.has("stress")) {
      section.forbid("max_speed", "with stress alone");
      return plane;
    }
    if (!section.has("max_speed")) section.fail_missing("max_speed");
    plane.held = {section.real("stress"), section.real("max_speed")};
    return plane;
  }

  /// A wall that goes further in a step passes a body, or throws it, before the two have met.
  void check_planes() const {
    const double most = kMostOfAStep * smallest_semi_axis() / longest_step();
    const auto allowed = [&](const char* what) {
      return std::string(what) + " < " + short_text(most) + " (m/s), " + short_text(kMostOfAStep) +
             " of the smallest semi-axis in the longest time step";
    };
    for (std::size_t k = 0; k < scene_.planes.size(); ++k) {
      const PlaneWall& plane = scene_.planes[k];
      const Section section(source_, *root_.get("wall")->as_array()->get(k)->as_table(),
                            "wall[" + std::to_string(k) + "]", "wall");
      if (plane.held && !(plane.held->max_speed < most))
        section.fail("max_speed", allowed("a finite number"));
      if (!plane.held && !(std::abs(plane.normal.dot(plane.velocity)) < most))
        section.fail("velocity", allowed("3 finite numbers, their part along the normal"));
    }
  }

  /// Of all shapes that the types have at the end of a stage.
  double smallest_semi_axis() const {
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t type = 0; type < scene_.particle_types.size(); ++type)
      for (std::size_t k = 0; k <= scene_.stages.size(); ++k)
        smallest =
            std::min(smallest, scene_.shape_in(type, k, 0).semi_axes(scene_.dimensions).minCoeff());
    for (const ParticleType& type : scene_.particle_types)
      for (const Shape& shape : type.batch.shapes)
        smallest = std::min(smallest, shape.semi_axes(scene_.dimensions).minCoeff());
    return smallest;
  }

  double longest_step() const {
    double factor = 0.0;
    for (const Stage& stage : scene_.stages)
      if (stage.drive) factor = std::max(factor, stage.drive->time_step_factor);
    return factor * scene_.characteristic_time();
  }

  void read_motion() {
    const Section motion(source_, table("motion"), "motion", "motion");
    scene_.gravity = motion.optional_real3("gravity").value_or(Vec3::Zero());
    if (scene_.dimensions == 2 && scene_.gravity[2] != 0.0)
      motion.fail("gravity", "with dimensions = 2 none along z");
    const std::string rotation = motion.text("rotation");
    scene_.rotation = rotation == "full"         ? Rotation::full
                      : rotation == "simplified" ? Rotation::simplified
                                                 : Rotation::none;
    const std::string contacts = motion.text("contacts");
    if (scene_.dimensions == 2 && contacts == "trace")
      motion.fail("contacts", "with dimensions = 2 follow or global: trace is of ellipsoids");
    scene_.branch = contacts == "global"  ? Branch::global
                    : contacts == "trace" ? Branch::trace
                                          : Branch::follow;
  }

  /// In the plane there is nothing to be flat.
  void check_flatness(const Section& section) const {
    if (scene_.dimensions == 2 && section.has("flatness") && section.real("flatness") != 1.0)
      section.fail("flatness", "with dimensions = 2 it is 1");
  }

  void read_particles() {
    const toml::table& types = table("particles", "at least one table [particles.NAME]");
    for (const auto& [name, node] : types) {
      const std::string path = "particles." + std::string(name.str());
      if (!is_name(name.str()))
        source_.fail(name.source(), path + ": a name of letters, digits and underscores");
      if (!node.is_table()) source_.fail(node.source(), path + " = " + text_of(node) + ": a table");
      if (name.str() == kWallName)
        source_.fail(name.source(), path + ": another name: walls have it in [contact.NAME-wall]");
      const Section type(source_, *node.as_table(), path, "particles");
      scene_.particle_types.push_back(
          {std::string(name.str()), read_batch(type, scene_.dimensions)});
      take_shapes(scene_.particle_types.size() - 1);
    }
    if (types.empty())
      source_.fail(types.source(), "particles = {}: at least one table [particles.NAME]");
  }

  /// Those of the table of bodies, if it has any of this type; set_bodies() refuses other numbers.
  void take_shapes(std::size_t type) {
    if (type >= shapes_.size() || shapes_[type].empty()) return;
    Batch& batch = scene_.particle_types[type].batch;
    batch.shapes = shapes_[type];
    batch.shapes.resize(batch.count, batch.shapes.back());
  }

  /// The least curvatures of a type's bodies at their flattest place, the end of the shortest axis,
  /// where an ellipsoid has radii b^2/c and a^2/c; of a wall those of a sphere so large that it is
  /// flat.
  Vec2 flattest_of(std::size_t type) const {
    const auto& types = scene_.particle_types;
    if (type >= types.size()) return Vec2::Constant(1e-150);
    const Batch& batch = types[type].batch;
    Vec2 least = Vec2::Constant(std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < (batch.shapes.empty() ? 1 : batch.count); ++i) {
      const Vec3 axes = batch.shape_of(i).semi_axes(scene_.dimensions);
      least = least.cwiseMin(Vec2(axes[2] / (axes[1] * axes[1]), axes[2] / (axes[0] * axes[0])));
    }
    return least;
  }

  /// The largest of its mean radii, of a wall infinite.
  double radius_of(std::size_t type) const {
    const auto& types = scene_.particle_types;
    return type < types.size() ? types[type].batch.radius_range()[1]
                               : std::numeric_limits<double>::infinity();
  }

  ContactLaw law_of(const Section& section, std::size_t a, std::size_t b) const {
    const double friction = section.real("friction_coefficient");
    const double cohesion = section.real("cohesion");
    const double damping = damping_ratio_of(section.real("restitution"));
    if (section.text("law") == "linear") {
      for (const char* key : {"young_modulus", "poisson_ratio", "largest_overlap"})
        section.forbid(key, "with law = \"hertz\" alone");
      if (!section.has("normal_stiffness")) section.fail_missing("normal_stiffness");
      const double normal = section.real("normal_stiffness");
      return {normal,   section.optional_real("shear_stiffness").value_or(normal),
              friction, cohesion,
              {},       damping};
    }
    if (scene_.dimensions == 2)
      section.fail("law", "with dimensions = 2 linear: Hertz has no overlap of disks");
    for (const char* key : {"normal_stiffness", "shear_stiffness"})
      section.forbid(key, "with law = \"linear\" alone");
    if (!section.has("young_modulus")) section.fail_missing("young_modulus");
    const Material material{section.real("young_modulus"), section.real("poisson_ratio")};
    const double smaller = std::min(radius_of(a), radius_of(b));
    const HertzContact most = stiffest(flattest_of(a), flattest_of(b),
                                       section.real("largest_overlap") * smaller, material);
    return {most.stiffness, std::max(most.shear_stiffness[0], most.shear_stiffness[1]),
            friction,       cohesion,
            material,       damping};
  }

  /// The index of a type, of "wall" in a walled cell the one after them.
  std::optional<std::size_t> type_named(std::string_view name) const {
    const auto& types = scene_.particle_types;
    for (std::size_t k = 0; k < types.size(); ++k)
      if (types[k].name == name) return k;
    if (scene_.has_walls() && name == kWallName) return types.size();
    return std::nullopt;
  }
  bool are_walls(std::size_t a, std::size_t b) const {
    return std::min(a, b) == scene_.particle_types.size();
  }
  std::string type_name(std::size_t type) const {
    const auto& types = scene_.particle_types;
    return type < types.size() ? types[type].name : std::string(kWallName);
  }

  /// [contact.a-b] and [contact.b-a] are one law: of the two, refuses that of the later line.
  void refuse_second_law(const toml::table& contact, const toml::key& name, std::string_view b,
                         std::string_view a) const {
    const std::string reversed = std::string(b) + "-" + std::string(a);
    const auto other = contact.find(reversed);
    if (a == b || other == contact.end()) return;
    const auto line = [](const toml::key& key) { return key.source().begin.line; };
    const bool first = line(name) < line(other->first);
    const toml::key& second = first ? other->first : name;
    source_.fail(second.source(), "contact." + std::string(second.str()) + ": a second law for " +
                                      "the two types of contact." +
                                      std::string((first ? name : other->first).str()) +
                                      "; one is allowed");
  }

  void read_contacts() {
    const toml::table& contact =
        table("contact", "a table [contact] for all pairs, or [contact.NAME-NAME] for each");
    const std::size_t types = scene_.particle_types.size() + (scene_.has_walls() ? 1 : 0);
    std::vector<std::optional<ContactLaw>> laws(types * types);
    const bool common = std::any_of(contact.begin(), contact.end(), [](const auto& entry) {
      return !entry.second.is_table() || is_contact_key(entry.first.str());
    });
    if (common || contact.empty()) {
      const Section section(source_, contact, "contact", "contact");
      for (std::size_t k = 0; k < laws.size(); ++k)
        if (!are_walls(k / types, k % types)) laws[k] = law_of(section, k / types, k % types);
    }
    for (const auto& [name, node] : contact) {
      if (!node.is_table()) continue;
      const std::string_view pair = name.str();
      const std::size_t dash = std::min(pair.find('-'), pair.size());
      const auto a = type_named(pair.substr(0, dash));
      const auto b = type_named(pair.substr(std::min(dash + 1, pair.size())));
      const std::string path = "contact." + std::string(pair);
      if (!a || !b || are_walls(*a, *b))
        source_.fail(name.source(), path + ": NAME-NAME of two of the scene's particle types" +
                                        (scene_.has_walls() ? ", or of one and wall" : ""));
      refuse_second_law(contact, name, pair.substr(dash + 1), pair.substr(0, dash));
      const Section section(source_, *node.as_table(), path, "contact", {}, &contact);
      laws[*a * types + *b] = laws[*b * types + *a] = law_of(section, *a, *b);
    }
    scene_.laws.types = types;
    for (std::size_t k = 0; k < laws.size(); ++k) {
      if (are_walls(k / types, k % types)) laws[k] = laws.front();  // no two walls meet
      if (!laws[k])
        source_.fail(contact.source(),
                     "contact." + type_name(k / types) + "-" + type_name(k % types) +
                         " is missing: a law for every two types, or one in [contact] for all");
      scene_.laws.law.push_back(*laws[k]);
    }
  }

  void read_stages() {
    const toml::node* node = root_.get("stage");
    if (!node)
      source_.fail("stage is missing: a list of [[stage]] tables, the first of kind place");
    const toml::array* list = node->as_array();
    if (!list || list->empty() || !list->is_homogeneous<toml::table>())
      source_.fail(node->source(), "stage = " + text_of(*node) + ": a list of [[stage]] tables");
    for (std::size_t k = 0; k < list->size(); ++k)
      read_stage(*list->get(k)->as_table(), "stage[" + std::to_string(k) + "]", k == 0);
  }

  void read_stage(const toml::table& stage, const std::string& path, bool first) {
    const toml::node* kind_node = stage.get("kind");
    const auto& kind_key = *std::find_if(scene_keys().begin(), scene_keys().end(),
                                         [](const Key& key) { return key.name == "kind"; });
    if (!kind_node)
      source_.fail(stage.source(), path + ".kind is missing: " + allowed_values(kind_key));
    if (!fits(kind_key, *kind_node))
      source_.fail(kind_node->source(),
                   path + ".kind = " + text_of(*kind_node) + ": " + allowed_values(kind_key));
    const std::string kind = kind_node->ref<std::string>();
    if (first != (kind == "place"))
      source_.fail(kind_node->source(), path + ".kind = '" + kind + "': " +
                                            (first ? "the first stage must be of kind place"
                                                   : "only the first stage may be of kind place"));
    const Section section(source_, stage, path, "stage", kind);
    const std::string name = section.text("name", kind);
    refuse_shear_namesake(section, name, kind == "shear");
    const KeptStates kept = read_kept(section, name, kind == "shear");
    Stage& added = scene_.stages.emplace_back(Stage{name, {}, {}, {}, kept});
    if (kind == "place") {
      added.place = read_place(section);
      read_bodies(section);
      check_placement(path, stage);
      return;
    }
    added.drive = read_drive(section, kind, scene_);
    if (kind != "grow") return;
    check_flatness(section);
    added.growth = read_growth(section, scene_);
  }

  /// Files are called by their stage's name.
  KeptStates read_kept(const Section& section, const std::string& name, bool shears) const {
    KeptStates kept;
    kept.end = section.boolean("save");
    if (shears) {
      kept.points = section.boolean("save_points");
      kept.strains = section.reals("save_strains");
      const auto& strains = kept.strains;
      const bool ascends = std::adjacent_find(strains.begin(), strains.end(),
                                              std::greater_equal<>()) == strains.end();
      if (!ascends || (!strains.empty() && strains.back() > section.real("axial_strain")))
        section.fail("save_strains", "finite numbers > 0 and at most axial_strain, ascending");
    }
    for (const Stage& other : scene_.stages)
      if (kept.any() && other.kept.any() && other.name == name)
        section.fail(section.has("name") ? "name" : "kind",
                     "a name of its own: two stages of that name keep states");
    return kept;
  }

  /// The rows of a shear stage, of which summary.json has the peaks, are found by its name.
  void refuse_shear_namesake(const Section& section, const std::string& name, bool shears) const {
    for (const Stage& other : scene_.stages) {
      const bool other_shears = other.drive && other.drive->axial_strain;
      if (other.name == name && shears != other_shears)
        section.fail(section.has("name") ? "name" : "kind",
                     "a name of its own: a shear stage and another have the same");
    }
  }

  Place read_place(const Section& section) const {
    const std::string arrangement = section.text("arrangement");
    const auto only_of = [&](const char* one, std::initializer_list<const char*> keys) {
      for (const char* key : keys)
        if (arrangement != one)
          section.forbid(key, "with arrangement = \"" + std::string(one) + "\" alone");
    };
    only_of("lattice", {"jitter"});
    only_of("random", {"bounding_fraction"});
    only_of("insertion", {"volume_fraction"});
    if (scene_.cell_size) section.forbid("volume_fraction", "without cell.size alone");
    only_of("explicit", {"file"});
    refuse_what_is_not_placed_so(section, arrangement);
    if (arrangement == "explicit")
      for (const char* key : {"seed", "axes", "axes_direction", "axes_cone_deg"})
        section.forbid(key, "not with arrangement = \"explicit\"");
    const Place place{arrangement == "random"      ? Arrangement::random
                      : arrangement == "insertion" ? Arrangement::insertion
                      : arrangement == "explicit"  ? Arrangement::explicit_bodies
                                                   : Arrangement::lattice,
                      static_cast<std::uint64_t>(section.integer("seed")),
                      section.real("jitter"),
                      section.real("bounding_fraction"),
                      section.text("file", ""),
                      read_start_axes(section),
                      section.real("volume_fraction")};
    const double most = largest_bounding_fraction(scene_.dimensions);
    if (place.bounding_fraction > most)
      section.fail("bounding_fraction",
                   "a finite number > 0 and <= " + short_text(most) +
                       " with dimensions = " + std::to_string(scene_.dimensions));
    return place;
  }

  /// Layers are for insertion, and bodies that stand in the scene or a file have their shapes
  /// there.
  void refuse_what_is_not_placed_so(const Section& section, const std::string& arrangement) const {
    for (const auto& [name, batch] : scene_.particle_types) {
      if (arrangement != "insertion" && batch.layer != std::array{0.0, 1.0})
        section.fail(section.has("arrangement") ? "arrangement" : "kind",
                     "arrangement = \"insertion\" with particles." + name + ".layer");
      if (arrangement == "explicit" && !batch.shapes.empty() && shapes_.empty())
        section.fail("arrangement", "another: the bodies of particles." + name + " are not alike");
    }
  }

  StartAxes read_start_axes(const Section& section) const {
    const std::string rule = section.text("axes");
    if (rule == "random") section.forbid("axes_direction", "not with axes = \"random\"");
    if (rule != "cone") section.forbid("axes_cone_deg", "with axes = \"cone\" alone");
    if (rule == "cone" && !section.has("axes_cone_deg")) section.fail_missing("axes_cone_deg");
    const Vec3 axial = Vec3::Unit(scene_.dimensions - 1);
    const Vec3 direction = section.optional_real3("axes_direction").value_or(axial);
    if (direction.isZero(0.0)) section.fail("axes_direction", "3 finite numbers, not all 0");
    if (scene_.dimensions == 2 && direction[2] != 0.0)
      section.fail("axes_direction", "with dimensions = 2 none along z");
    const double degrees = section.optional_real("axes_cone_deg").value_or(0.0);
    return {rule == "aligned" ? StartAxes::Rule::aligned
            : rule == "cone"  ? StartAxes::Rule::cone
            : rule == "plane" ? StartAxes::Rule::across
                              : StartAxes::Rule::random,
            direction, degrees * std::numbers::pi / 180.0};
  }

  /// The scene's [[body]] tables, which an explicit arrangement without a file must have.
  void read_bodies(const Section& place) {
    const bool wanted = scene_.stages.front().place->arrangement == Arrangement::explicit_bodies &&
                        scene_.stages.front().place->file.empty();
    const toml::node* node = root_.get("body");
    if (!node && wanted) place.fail("arrangement", "with a file, or a list of [[body]] tables");
    if (!node) return;
    if (!wanted)
      source_.fail(node->source(),
                   "body: a place with arrangement = \"explicit\" and without a file has it");
    const toml::array* list = node->as_array();
    if (!list || !list->is_homogeneous<toml::table>())
      source_.fail(node->source(), "body = " + text_of(*node) + ": a list of [[body]] tables");
    std::vector<Body> bodies;
    for (std::size_t k = 0; k < list->size(); ++k)
      bodies.push_back(read_body(
          Section(source_, *list->get(k)->as_table(), "body[" + std::to_string(k) + "]", "body")));
    set_bodies(scene_, std::move(bodies), source_.at(node->source()));
  }

  Body read_body(const Section& section) const {
    const auto type = type_named(section.text("type"));
    if (!type || *type == scene_.particle_types.size())
      section.fail("type", "a name of one of the scene's particle types");
    Body body{*type, *section.optional_real3("position")};
    for (int k = 0; k < 3 && scene_.cell_size; ++k)
      if (!is_near_cell(body.position[k], (*scene_.cell_size)[k]))
        section.fail("position", kNearTheCell);
    if (const auto q = section.optional_real4("orientation")) {
      if (q->isZero(0.0)) section.fail("orientation", "4 finite numbers, not all 0");
      if (scene_.dimensions == 2 && ((*q)[1] != 0.0 || (*q)[2] != 0.0))
        section.fail("orientation", "with dimensions = 2 about z: x and y are 0");
      body.orientation = {(*q)[0], (*q)[1], (*q)[2], (*q)[3]};
    }
    body.velocity = section.optional_real3("velocity").value_or(Vec3::Zero());
    body.angular_velocity = section.optional_real3("angular_velocity").value_or(Vec3::Zero());
    if (scene_.dimensions == 2) {
      if (body.position[2] != 0.0) section.fail("position", "with dimensions = 2 z is 0");
      if (body.velocity[2] != 0.0) section.fail("velocity", "with dimensions = 2 none along z");
      if (body.angular_velocity.head<2>() != Vec2::Zero())
        section.fail("angular_velocity", "with dimensions = 2 about z");
    }
    return body;
  }

  void check_placement(const std::string& path, const toml::table& stage) const {
    try {
      check_room(scene_.batches(), scene_.placement());
      check_thickness(scene_.batches(), scene_.placement());
    } catch (const DoesNotFit& error) {
      const toml::node* size = root_["cell"]["size"].node();
      if (size) source_.fail(size->source(), "cell.size = " + text_of(*size) + ": " + error.what());
      source_.fail(stage.source(), path + ": " + error.what());
    }
  }

  const toml::table& root_;
  const Source& source_;
  const BodyShapes& shapes_;
  Scene scene_;
};

}  // namespace

void set_bodies(Scene& scene, std::vector<Body> bodies, const std::string& name) {
  std::vector<std::size_t> counts(scene.particle_types.size(), 0);
  for (const Body& body : bodies) ++counts.at(body.type);
  for (std::size_t k = 0; k < counts.size(); ++k)
    if (const ParticleType& type = scene.particle_types[k]; counts[k] != type.batch.count)
      throw SceneError(name + ": " + std::to_string(counts[k]) + " bodies of type " + type.name +
                       ": as many as particles." + type.name + ".count, " +
                       std::to_string(type.batch.count));
  scene.bodies = std::move(bodies);
}

Scene read_scene(const toml::table& root, const Source& source, const BodyShapes& shapes) {
  return Reader(root, source, shapes).read();
}

Scene parse_scene(const std::string& text, const std::string& name) {
  return SceneFile(text, name).scene();
}

Scene load_scene(const std::filesystem::path& file) { return SceneFile(file).scene(); }

}  // namespace tangency::inline v0::dem
