// SPDX-License-Identifier: MIT
#include <tangency/dem/scene/scene_reader.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

#include <tangency/dem/scene/scene_contacts.hpp>
#include <tangency/dem/scene/scene_growth.hpp>
#include <tangency/dem/scene/scene_loading.hpp>
#include <tangency/dem/scene/scene_particles.hpp>
#include <tangency/dem/scene/scene_place.hpp>
#include <tangency/dem/scene/scene_walls.hpp>

namespace tangency::inline v0::dem {
namespace {

/// Classes of micro.csv by default, the published ones [Ouadfel1998, section 2.3.2].
constexpr std::int64_t kClassesOfNearUniform = 4, kRingsOfPolar = 18;

class Reader {
 public:
  Reader(const toml::table& root, const Source& source, const BodyShapes& shapes)
      : root_(root), source_(source), shapes_(shapes) {}

  Scene read() {
    scene_.intended = Section(source_, root_, "", "").words("intended");
    read_units();
    read_cell();
    scene_.planes = read_walls(root_, source_, scene_);
    read_motion();
    read_particles();
    scene_.laws = read_contacts(
        table("contact", "a table [contact] for all pairs, or [contact.NAME-NAME] for each"),
        source_, scene_);
    read_stages();
    check_walls(root_, source_, scene_);
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
    scene_.output.history_strain = output.optional_real("history_strain").value_or(0.0);
    scene_.output.frame_strain = output.optional_real("frame_strain").value_or(0.0);
    if (scene_.output.frame == 0) output.forbid("frame_strain", "with a frame_interval > 0 alone");
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

  void read_stages() {
    const toml::node* node = root_.get("stage");
    if (!node)
      source_.fail("stage is missing: a list of [[stage]] tables, the first of kind place");
    const toml::array& list = tables_of(source_, *node, "stage");
    for (std::size_t k = 0; k < list.size(); ++k)
      read_stage(*list.get(k)->as_table(), "stage[" + std::to_string(k) + "]", k == 0);
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
    Stage& added =
        scene_.stages.emplace_back(Stage{name, {}, {}, {}, kept, section.words("intended")});
    if (kind == "place") {
      added.place = read_place(section, scene_, !shapes_.empty());
      read_bodies(root_, source_, section, scene_);
      check_placement(root_, source_, path, stage, scene_);
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

  const toml::table& root_;
  const Source& source_;
  const BodyShapes& shapes_;
  Scene scene_;
};

}  // namespace

Scene read_scene(const toml::table& root, const Source& source, const BodyShapes& shapes) {
  return Reader(root, source, shapes).read();
}

}  // namespace tangency::inline v0::dem
