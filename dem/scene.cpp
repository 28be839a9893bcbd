// SPDX-License-Identifier: MIT
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>
#include <tangency/dem/files.hpp>
#include <tangency/dem/scene.hpp>
#include <tangency/dem/scene_keys.hpp>

namespace tangency::dem {
namespace {

/// The tables of a scene.
constexpr std::string_view sections = "cell particles contact stage output";

/// Chosen: a larger change of shape throws neighbours about that no relaxation brings back.
constexpr double largest_growth_of_an_increment = 0.01;

/// Chosen: a cell that shrinks by more in a step has left every contact of the step before.
constexpr double largest_strain_of_a_step = 0.1;

std::string short_text(double x) {
  std::ostringstream text;
  text << std::setprecision(3) << x;
  return text.str();
}

/// A name in a scene: also part of a key's path, so without '-', '.' and blanks.
bool is_name(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  });
}

/// The shortest text that reads back to x: toml++ writes 0.05 with 17 digits.
std::string text_of(double x) {
  std::array<char, 32> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), x);
  const std::string text(buffer.data(), end.ptr);
  return text.find_first_not_of("-0123456789") == text.npos ? text + ".0" : text;
}

/// A value on one line, as TOML writes it.
std::string text_of(const toml::node& node) {
  if (node.is_table()) return "a table";
  if (node.is_floating_point()) return text_of(*node.value<double>());
  std::ostringstream out;
  if (const auto* array = node.as_array()) {
    if (array->is_array_of_tables()) return "a list of tables";
    out << *array;
  } else {
    node.visit([&](const auto& value) {
      if constexpr (toml::is_value<decltype(value)>) out << value;
    });
  }
  std::string text = out.str();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// What every message starts with.
class Source {
 public:
  explicit Source(std::string name) : name_(std::move(name)) {}

  [[noreturn]] void fail(const toml::source_region& at, const std::string& message) const {
    throw SceneError(name_ + ":" + std::to_string(at.begin.line) + ": " + message);
  }
  /// For what is missing from the whole file.
  [[noreturn]] void fail(const std::string& message) const {
    throw SceneError(name_ + ":1: " + message);
  }

 private:
  std::string name_;
};

bool fits(const Key& key, const toml::node& node) {
  // No range holds nan, nor an infinity: its bounds are open there.
  const auto number_fits = [&](const toml::node& one) {
    return one.is_number() && key.range.holds(*one.value<double>());
  };
  switch (key.type) {
    case KeyType::integer:
      return node.is_integer() && number_fits(node);
    case KeyType::real:
      return number_fits(node);
    case KeyType::real3: {
      const auto* array = node.as_array();
      return array && array->size() == 3 && std::all_of(array->begin(), array->end(), number_fits);
    }
    case KeyType::text: {
      if (!node.is_string()) return false;
      const std::string& text = node.ref<std::string>();
      return key.choices.empty() ? is_name(text) : is_among(text, key.choices);
    }
  }
  return false;
}

/// One table of a scene, checked against the keys of its section. Values are taken by name.
class Section {
 public:
  /// @param path     what messages call the table: "particles.p"; "" for the top level
  /// @param section  of scene_keys()
  /// @param kind     of a stage, else ""
  /// @param base     looked in for keys that the table lacks: [contact] for [contact.a-b]
  Section(const Source& source, const toml::table& table, std::string path,
          std::string_view section, std::string_view kind = {}, const toml::table* base = nullptr)
      : source_(source),
        table_(table),
        path_(std::move(path)),
        section_(section),
        kind_(kind),
        base_(base) {
    for (const auto& [name, node] : table_) check(name, node);
    for (const Key& key : scene_keys())
      if (applies(key) && key.required() && !find(key.name))
        source_.fail(table_.source(), label(key.name) + " is missing: " + allowed_values(key));
  }

  /// Refuses the value of a key that the section has.
  [[noreturn]] void fail(std::string_view name, const std::string& allowed) const {
    const toml::node& node = *find(name);
    source_.fail(node.source(), label(name) + " = " + text_of(node) + ": " + allowed);
  }

  /// The same for a number that may be the key's default: then at the table's line.
  void refuse(std::string_view name, std::int64_t value, const std::string& allowed) const {
    if (has(name)) fail(name, allowed);
    source_.fail(table_.source(), label(name) + " = " + std::to_string(value) + ": " + allowed);
  }

  bool has(std::string_view name) const { return find(name) != nullptr; }

  double real(std::string_view name) const {
    const toml::node* node = find(name);
    return node ? *node->value<double>() : std::stod(std::string(fallback(name)));
  }
  std::optional<double> optional_real(std::string_view name) const {
    return has(name) ? std::optional(real(name)) : std::nullopt;
  }
  std::int64_t integer(std::string_view name) const {
    const toml::node* node = find(name);
    return node ? *node->value<std::int64_t>() : std::stoll(std::string(fallback(name)));
  }
  std::string text(std::string_view name, std::string_view otherwise) const {
    const toml::node* node = find(name);
    return node ? node->ref<std::string>() : std::string(otherwise);
  }
  std::string text(std::string_view name) const { return text(name, fallback(name)); }
  std::optional<Vec3> optional_real3(std::string_view name) const {
    const toml::array* array = table_.get_as<toml::array>(name);
    if (!array) return std::nullopt;
    Vec3 v = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k)
      v[static_cast<int>(k)] = array->get(k)->value<double>().value_or(0.0);
    return v;
  }

 private:
  bool applies(const Key& key) const {
    return key.section == section_ && (kind_.empty() || is_among(kind_, key.kinds));
  }

  std::string label(std::string_view name) const {
    return path_.empty() ? std::string(name) : path_ + "." + std::string(name);
  }

  void check(const toml::key& name, const toml::node& node) const {
    if (section_.empty() && is_among(name.str(), sections)) return;
    if (section_ == "contact" && node.is_table()) return;  // a pair
    std::string names;
    for (const Key& key : scene_keys()) {
      if (!applies(key)) continue;
      if (key.name == name.str()) {
        if (fits(key, node)) return;
        fail(key.name, allowed_values(key));
      }
      names += (names.empty() ? "" : ", ") + std::string(key.name);
    }
    if (section_.empty())
      for (const char c : " " + std::string(sections)) names += c == ' ' ? ", " : std::string(1, c);
    source_.fail(name.source(), label(name.str()) + ": no such key" +
                                    (kind_.empty() ? "" : " in a stage of this kind") +
                                    "; allowed are " + names);
  }

  const toml::node* find(std::string_view name) const {
    const toml::node* node = table_.get(name);
    return node || !base_ ? node : base_->get(name);
  }

  std::string_view fallback(std::string_view name) const {
    const auto keys = scene_keys();
    return std::find_if(keys.begin(), keys.end(),
                        [&](const Key& key) { return applies(key) && key.name == name; })
        ->fallback;
  }

  const Source& source_;
  const toml::table& table_;
  std::string path_;
  std::string section_, kind_;
  const toml::table* base_;
};

class Reader {
 public:
  Reader(const toml::table& root, const Source& source) : root_(root), source_(source) {}

  Scene read() {
    const Section top(source_, root_, "", "");
    read_cell();
    read_particles();
    read_contacts();
    read_stages();
    const Section output(source_, table("output"), "output", "output");
    scene_.output = {output.integer("history_interval"), output.integer("frame_interval"),
                     output.integer("checkpoint_interval")};
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

  void read_cell() {
    const Section cell(source_, table("cell"), "cell", "cell");
    scene_.cell_size = cell.optional_real3("size");
    scene_.dimensions = static_cast<int>(cell.integer("dimensions"));
    if (scene_.dimensions == 2 && scene_.cell_size && (*scene_.cell_size)[2] != 1.0)
      cell.fail("size", "with dimensions = 2 the third edge is the unit thickness, 1");
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
      const Section type(source_, *node.as_table(), path, "particles");
      check_flatness(type);
      scene_.particle_types.push_back(
          {std::string(name.str()),
           {{type.real("mean_radius"), type.real("elongation"), type.real("flatness")},
            type.real("density"),
            static_cast<std::size_t>(type.integer("count"))}});
    }
    if (types.empty())
      source_.fail(types.source(), "particles = {}: at least one table [particles.NAME]");
  }

  ContactLaw law_of(const Section& section) const {
    const double normal = section.real("normal_stiffness");
    return {normal, section.optional_real("shear_stiffness").value_or(normal),
            section.real("friction_coefficient"), section.real("cohesion")};
  }

  /// The index of a type; the number of types where there is none of this name.
  std::size_t type_named(std::string_view name) const {
    const auto& types = scene_.particle_types;
    const auto found = std::find_if(types.begin(), types.end(),
                                    [&](const ParticleType& type) { return type.name == name; });
    return static_cast<std::size_t>(found - types.begin());
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
    const std::size_t types = scene_.particle_types.size();
    std::vector<std::optional<ContactLaw>> laws(types * types);
    const bool common = std::any_of(contact.begin(), contact.end(),
                                    [](const auto& entry) { return !entry.second.is_table(); });
    if (common || contact.empty())
      laws.assign(types * types, law_of(Section(source_, contact, "contact", "contact")));
    for (const auto& [name, node] : contact) {
      if (!node.is_table()) continue;
      const std::string_view pair = name.str();
      const std::size_t dash = pair.find('-');
      const std::size_t a = type_named(pair.substr(0, dash));
      const std::size_t b = dash == pair.npos ? types : type_named(pair.substr(dash + 1));
      const std::string path = "contact." + std::string(pair);
      if (a == types || b == types)
        source_.fail(name.source(), path + ": NAME-NAME of two of the scene's particle types");
      refuse_second_law(contact, name, pair.substr(dash + 1), pair.substr(0, dash));
      const ContactLaw law =
          law_of(Section(source_, *node.as_table(), path, "contact", {}, &contact));
      laws[a * types + b] = laws[b * types + a] = law;
    }
    scene_.laws.types = types;
    for (std::size_t k = 0; k < laws.size(); ++k) {
      if (!laws[k])
        source_.fail(contact.source(),
                     "contact." + scene_.particle_types[k / types].name + "-" +
                         scene_.particle_types[k % types].name +
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
    Stage& added = scene_.stages.emplace_back(Stage{section.text("name", kind), {}, {}, {}});
    if (kind == "place") {
      added.place = read_place(section);
      check_placement(path, stage);
      return;
    }
    added.compress = read_compress(section, kind);
    check_step(section, *added.compress);
    if (kind == "grow") added.growth = read_growth(section);
  }

  Place read_place(const Section& section) const {
    const Place place{
        section.text("arrangement") == "random" ? Arrangement::random : Arrangement::lattice,
        static_cast<std::uint64_t>(section.integer("seed")), section.real("jitter"),
        section.real("bounding_fraction")};
    const double most = largest_bounding_fraction(scene_.dimensions);
    if (place.bounding_fraction > most)
      section.fail("bounding_fraction",
                   "a finite number > 0 and <= " + short_text(most) +
                       " with dimensions = " + std::to_string(scene_.dimensions));
    return place;
  }

  void check_placement(const std::string& path, const toml::table& stage) const {
    try {
      check_room(scene_.batches(), scene_.placement());
    } catch (const DoesNotFit& error) {
      const toml::node* size = root_["cell"]["size"].node();
      if (size) source_.fail(size->source(), "cell.size = " + text_of(*size) + ": " + error.what());
      source_.fail(stage.source(), path + ": " + error.what());
    }
  }

  Growth read_growth(const Section& section) const {
    check_flatness(section);
    Growth growth{section.real("elongation"), section.optional_real("flatness"),
                  section.integer("increments"), section.real("max_inertial_fraction")};
    double change = 0.0;
    for (std::size_t type = 0; type < scene_.particle_types.size(); ++type)
      change =
          std::max(change, growth.largest_change(scene_.shape_in(type, scene_.stages.size() - 1, 0),
                                                 scene_.dimensions));
    if (change > largest_growth_of_an_increment)
      section.refuse("increments", growth.increments,
                     "more: an increment would change a semi-axis by " + short_text(change) +
                         " of itself, and at most " + short_text(largest_growth_of_an_increment) +
                         " is allowed");
    return growth;
  }

  static Compress read_compress(const Section& section, const std::string& kind) {
    return {
        {section.real("mean_stress"), section.real("servo_gain"), section.real("max_strain_rate")},
        section.real("damping"),
        section.real("time_step_factor"),
        kind == "grow" ? std::optional(section.real("friction_coefficient"))
                       : section.optional_real("friction_coefficient"),
        section.real("stress_tolerance"),
        kind == "relax" ? std::optional(section.real("max_unbalanced_ratio")) : std::nullopt,
        section.integer("max_cycles")};
  }

  void check_step(const Section& section, const Compress& stage) const {
    if (stage.damping * stage.time_step_factor > 2.0)
      section.fail("damping",
                   "with time_step_factor = " + short_text(stage.time_step_factor) +
                       " a finite number <= " + short_text(2.0 / stage.time_step_factor) +
                       ": a step that damps more would turn velocities round");
    double lightest = std::numeric_limits<double>::infinity();
    for (const Batch& batch : scene_.batches())
      lightest = std::min(
          lightest,
          batch.density * volume_of(batch.shape.semi_axes(scene_.dimensions), scene_.dimensions));
    const double largest =
        largest_strain_of_a_step /
        (stage.time_step_factor * std::sqrt(lightest / scene_.laws.largest_stiffness()));
    if (!(stage.servo.max_strain_rate < largest))
      section.fail("max_strain_rate", "a finite number < " + short_text(largest) +
                                          " (1/s), a strain of " +
                                          short_text(largest_strain_of_a_step) + " a time step");
  }

  const toml::table& root_;
  const Source& source_;
  Scene scene_;
};

}  // namespace

std::vector<Batch> Scene::batches() const {
  std::vector<Batch> all;
  for (const ParticleType& type : particle_types) all.push_back(type.batch);
  return all;
}

std::size_t Scene::particle_count() const {
  std::size_t count = 0;
  for (const ParticleType& type : particle_types) count += type.batch.count;
  return count;
}

double Scene::smallest_mean_radius() const {
  double smallest = particle_types.front().batch.shape.mean_radius;
  for (const ParticleType& type : particle_types)
    smallest = std::min(smallest, type.batch.shape.mean_radius);
  return smallest;
}

Placement Scene::placement() const {
  const Place& place = stages.front().place.value();
  return {cell_size,
          place.jitter * smallest_mean_radius(),
          place.seed,
          place.arrangement,
          place.bounding_fraction,
          dimensions};
}

Shape Scene::shape_in(std::size_t type, std::size_t stage, std::int64_t increments) const {
  Shape shape = particle_types[type].batch.shape;
  for (std::size_t k = 0; k < stages.size() && k <= stage; ++k)
    if (const auto& growth = stages[k].growth)
      shape = growth->shape_after(shape, k < stage ? growth->increments : increments);
  return shape;
}

Scene parse_scene(const std::string& text, const std::string& name) {
  const Source source(name);
  toml::table root;
  try {
    root = toml::parse(text);
  } catch (const toml::parse_error& error) {
    std::string what(error.description());
    std::replace(what.begin(), what.end(), '\n', ' ');
    source.fail(error.source(), "not TOML: " + what);
  }
  return Reader(root, source).read();
}

Scene load_scene(const std::filesystem::path& file) {
  const std::optional<std::string> text = read_whole(file);
  if (!text) throw SceneError(file.string() + ": cannot be read: a scene in TOML");
  return parse_scene(*text, file.string());
}

}  // namespace tangency::dem
