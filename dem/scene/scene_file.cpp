// SPDX-License-Identifier: MIT
#include <tangency/dem/scene/scene_file.hpp>

#include <toml++/toml.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <set>
#include <sstream>
#include <utility>

#include <tangency/dem/scene/scene_keys.hpp>
#include <tangency/dem/scene/scene_reader.hpp>
#include <tangency/dem/scene/scene_section.hpp>
#include <tangency/dem/whole_file.hpp>

namespace tangency::inline v0::dem {
namespace {

namespace fs = std::filesystem;

/// Chosen: more runs than anyone waits for.
constexpr std::size_t kMostCombinations = 10000;

/// Chosen: more files than anyone keeps.
constexpr std::size_t kMostIncluded = 1000;

toml::table parsed(const std::string& text, const std::string& name) {
  try {
    return toml::parse(text, std::string_view(name));
  } catch (const toml::parse_error& error) {
    std::string what(error.description());
    std::replace(what.begin(), what.end(), '\n', ' ');
    Source(name).fail(error.source(), "not TOML: " + what);
  }
}

std::string text_of_file(const fs::path& file) {
  try {
    return bytes_of_file(file);
  } catch (const ReadError& error) {
    throw SceneError(error.what());
  }
}

const Key& key_named(std::string_view section, std::string_view name) {
  return *std::find_if(scene_keys().begin(), scene_keys().end(),
                       [&](const Key& key) { return key.section == section && key.name == name; });
}

bool is_list_of_tables(const toml::node& node) {
  return node.is_array() && node.as_array()->is_array_of_tables();
}

/// Joins what is included into a table, whose own keys stay.
void join(toml::table& own, toml::table&& included) {
  for (auto&& [key, node] : included) {
    toml::node* there = own.get(key.str());
    if (!there) {
      own.insert(key, std::move(node));
    } else if (there->is_table() && node.is_table()) {
      join(*there->as_table(), std::move(*node.as_table()));
    } else if (is_list_of_tables(*there) && is_list_of_tables(node)) {
      toml::array& first = *node.as_array();
      for (toml::node& one : *there->as_array()) first.push_back(std::move(*one.as_table()));
      own.insert_or_assign(key, std::move(first));
    }
  }
}

/// Names of other files in a tree, changed.
template <class Change>
void change_files(toml::table& root, const Change& change) {
  toml::node* stages = root.get("stage");
  if (!stages || !is_list_of_tables(*stages)) return;
  for (toml::node& stage : *stages->as_array())
    if (auto* file = stage.as_table()->get_as<std::string>("file"); file && !file->get().empty())
      file->get() = change(fs::path(file->get())).string();
}

/// The tree of a file and of all that it includes.
class Including {
 public:
  toml::table tree_of(const std::string& text, const std::string& name) {
    toml::table own = parsed(text, name);
    const toml::node* node = own.get("include");
    if (!node) return own;
    const Source source(name);
    const Key& key = key_named("", "include");
    const auto refuse = [&](const std::string& why) {
      source.fail(node->source(), "include = " + text_of(*node) + ": " + why);
    };
    if (!fits(key, *node)) refuse(allowed_values(key));
    std::vector<std::string> files;
    if (node->is_string()) files.push_back(node->ref<std::string>());
    if (node->is_array())
      for (const toml::node& one : *node->as_array()) files.push_back(one.ref<std::string>());
    open_.push_back(fs::weakly_canonical(name));
    toml::table all;
    for (const std::string& file : files) {
      const fs::path path = fs::path(name).parent_path() / file;
      if (std::find(open_.begin(), open_.end(), fs::weakly_canonical(path)) != open_.end())
        refuse("a file that does not lead back to this one");
      // Taken once, the first time: over two ways its stages would stand there twice.
      if (!taken_.insert(fs::weakly_canonical(path)).second) continue;
      if (taken_.size() > kMostIncluded)
        refuse("at most " + std::to_string(kMostIncluded) + " files in all");
      toml::table next = tree_from(path, refuse);
      change_files(next, [&](const fs::path& named) {
        return named.is_absolute() ? named : fs::path(file).parent_path() / named;
      });
      join(next, std::move(all));
      all = std::move(next);
    }
    open_.pop_back();
    own.erase("include");
    join(own, std::move(all));
    return own;
  }

 private:
  template <class Refuse>
  toml::table tree_from(const fs::path& path, const Refuse& refuse) {
    std::string text;
    try {
      text = bytes_of_file(path);
    } catch (const ReadError& error) {
      refuse(std::string("a file that can be read; ") + error.what());
    }
    return tree_of(text, path.string());
  }

  std::vector<fs::path> open_;  ///< those that are being read
  std::set<fs::path> taken_;    ///< all so far
};

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, at);) {
    part.erase(0, part.find_first_not_of(' '));
    part.erase(part.find_last_not_of(' ') + 1);
    parts.push_back(part);
  }
  return parts;
}

/// Finds the table that a key of a Setting stands in.
class Finder {
 public:
  Finder(toml::table& root, std::string where) : root_(root), where_(std::move(where)) {}

  [[noreturn]] void fail(const std::string& message) const {
    throw SceneError(where_ + ": " + message);
  }

  /// @param made  an empty table, for one that the file may leave out
  toml::table& table_of(const std::string& path, toml::table&& made) const {
    const std::vector<std::string> parts = split(path, '.');
    if (parts.empty() || parts.back().empty()) fail(path + ": " + kForm);
    if (parts.size() == 1) return root_;
    const std::string& section = parts.front();
    if (section.ends_with(']') && parts.size() == 2) return in_list(section);
    if (section == "stage" && parts.size() == 3) return stage_named(parts[1]);
    if (section == "particles" && parts.size() == 3) {
      toml::table* types = root_["particles"].as_table();
      toml::table* type = types ? (*types)[parts[1]].as_table() : nullptr;
      if (!type) fail("particles." + parts[1] + ": no such particle type in the scene");
      return *type;
    }
    if (is_among(section, "cell motion contact output units") && parts.size() == 2)
      return made_in(root_, section, std::move(made));
    if (section == "contact" && parts.size() == 3) {
      toml::table& contact = made_in(root_, section, toml::table(made));
      return made_in(contact, parts[1], std::move(made));
    }
    fail(path + ": " + kForm);
  }

 private:
  static constexpr const char* kForm =
      "a key as cell.KEY, motion.KEY, particles.NAME.KEY, contact.KEY, contact.NAME-NAME.KEY, "
      "stage.NAME.KEY, stage[N].KEY, wall[N].KEY, body[N].KEY, output.KEY or units.KEY";

  toml::table& made_in(toml::table& parent, const std::string& name, toml::table&& made) const {
    if (!parent.get(name)) parent.insert(name, std::move(made));
    toml::table* table = parent.get(name)->as_table();
    if (!table) fail(name + ": no table in the scene");
    return *table;
  }

  /// "stage[2]"
  toml::table& in_list(const std::string& text) const {
    const std::string name = text.substr(0, text.find('['));
    const std::string index = text.substr(name.size() + 1, text.size() - name.size() - 2);
    toml::array* list = is_among(name, "stage wall body") ? root_[name].as_array() : nullptr;
    const bool is_number =
        !index.empty() && index.size() < 10 && index.find_first_not_of("0123456789") == index.npos;
    if (!list || !is_number || std::stoul(index) >= list->size())
      fail(text + ": stage[N], wall[N] or body[N] with N from 0 to less than their number");
    toml::table* table = list->get(std::stoul(index))->as_table();
    if (!table) fail(text + ": no table in the scene");
    return *table;
  }

  toml::table& stage_named(const std::string& name) const {
    toml::table* found = nullptr;
    std::string names;
    const toml::array* list = root_["stage"].as_array();
    for (std::size_t k = 0; list && k < list->size(); ++k) {
      toml::table* stage = root_["stage"].as_array()->get(k)->as_table();
      if (!stage) continue;
      const std::string kind = (*stage)["kind"].value_or(std::string());
      const std::string own = (*stage)["name"].value_or(kind);
      names += (names.empty() ? "" : ", ") + own;
      if (own != name) continue;
      if (found) fail("stage." + name + ": two stages have this name; stage[N].KEY, N from 0");
      found = stage;
    }
    if (!found) fail("stage." + name + ": no such stage; there are " + names);
    return *found;
  }

  toml::table& root_;
  std::string where_;
};

/// A table {value = ...} whose nodes say that they stand in that line of a file.
toml::table value_at(const std::string& value, const std::string& file, std::size_t line) {
  return toml::parse(std::string(line - 1, '\n') + "value = " + value, std::string_view(file));
}

/// A value from the command line: what is no TOML is a text; nothing for what is neither.
std::optional<std::string> toml_of(const std::string& word) {
  try {
    if (word.find_first_of("\n\r") == word.npos && toml::parse("value = " + word).size() == 1)
      return word;
  } catch (const toml::parse_error&) {
  }
  const std::string text = text_of(toml::value<std::string>(word));
  const toml::table back = toml::parse("value = " + text);
  return back["value"].value_or(std::string()) == word ? std::optional(text) : std::nullopt;
}

void add_axes(const toml::table& table, const std::string& path, const Source& source,
              std::vector<std::pair<toml::source_position, SweepAxis>>& axes) {
  for (const auto& [key, node] : table) {
    const std::string keys = path + std::string(key.str());
    if (keys == "after") continue;
    if (const toml::table* inner = node.as_table()) {
      add_axes(*inner, keys + ".", source, axes);
      continue;
    }
    const toml::array* list = node.as_array();
    const bool is_list = list && !list->empty() &&
                         std::none_of(list->begin(), list->end(),
                                      [](const toml::node& one) { return one.is_table(); });
    if (!is_list)
      source.fail(node.source(), "sweep." + keys + " = " + text_of(node) + ": a list of values");
    SweepAxis axis{keys, {}, source.file_of(node.source()), node.source().begin.line};
    for (const toml::node& one : *list) axis.values.push_back(text_of(one));
    axes.emplace_back(node.source().begin, std::move(axis));
  }
}

/// `key = value` of a table, then its tables.
void write(std::ostream& out, const toml::table& table, const std::string& path) {
  for (const auto& [key, node] : table)
    if (!node.is_table() && !is_list_of_tables(node))
      out << key.str() << " = " << text_of(node) << '\n';
  for (const auto& [key, node] : table) {
    const std::string name = path + std::string(key.str());
    if (const toml::table* inner = node.as_table()) {
      out << "\n[" << name << "]\n";
      write(out, *inner, name + ".");
    } else if (is_list_of_tables(node)) {
      for (const toml::node& one : *node.as_array()) {
        out << "\n[[" << name << "]]\n";
        write(out, *one.as_table(), name + ".");
      }
    }
  }
}

}  // namespace

std::size_t Sweep::combinations() const {
  std::size_t count = 1;
  for (const SweepAxis& axis : axes) count *= axis.values.size();
  return count;
}

std::vector<Setting> Sweep::combination(std::size_t index) const {
  std::vector<Setting> settings(axes.size());
  for (std::size_t k = axes.size(); k-- > 0;) {
    const SweepAxis& axis = axes[k];
    settings[k] = {axis.keys, axis.values[index % axis.values.size()]};
    index /= axis.values.size();
  }
  return settings;
}

struct SceneFile::Tree {
  std::string text, name;  ///< of the file, in messages
  Source source;
  toml::table root;
};

SceneFile::SceneFile(const fs::path& file) : SceneFile(text_of_file(file), file.string()) {}

SceneFile::SceneFile(const std::string& text, const std::string& name)
    : tree_(
          std::make_unique<Tree>(Tree{text, name, Source(name), Including().tree_of(text, name)})) {
}

SceneFile::~SceneFile() = default;
SceneFile::SceneFile(SceneFile&&) noexcept = default;
SceneFile& SceneFile::operator=(SceneFile&&) noexcept = default;

SceneFile SceneFile::again() const { return {tree_->text, tree_->name}; }

Setting SceneFile::set(const std::string& assignment) {
  const std::string where = kSetOption + assignment;
  const std::size_t equals = assignment.find('=');
  if (equals == assignment.npos || equals == 0)
    throw SceneError(where + ": KEY=VALUE, or KEY,KEY=VALUE");
  const auto value = toml_of(assignment.substr(equals + 1));
  if (!value) throw SceneError(where + ": a value as TOML writes it, or a line of UTF-8");
  const Setting setting{assignment.substr(0, equals), *value};
  set(setting, where, 1);
  return setting;
}

void SceneFile::set(const Setting& setting, const std::string& file, std::size_t line) {
  const bool is_option = file.starts_with(kSetOption);
  const Finder finder(tree_->root, is_option ? file : file + ":" + std::to_string(line));
  for (const std::string& path : split(setting.keys, ',')) {
    toml::table made = value_at("{}", file, line), value = value_at(setting.value, file, line);
    toml::table& table = finder.table_of(path, std::move(*made.get("value")->as_table()));
    const std::string name = path.substr(path.rfind('.') + 1);
    if (&table == &tree_->root && name != "schema")
      finder.fail(path + ": a key of one of the scene's tables");
    toml::node& node = *value.get("value");
    table.insert_or_assign(toml::key(name, toml::source_region(node.source())), std::move(node));
  }
}

std::optional<Sweep> SceneFile::sweep() const {
  const toml::node* node = tree_->root.get("sweep");
  if (!node) return std::nullopt;
  const Source& source = tree_->source;
  const toml::table* table = node->as_table();
  if (!table) source.fail(node->source(), "sweep = " + text_of(*node) + ": a table");
  Sweep sweep;
  if (const toml::node* after = table->get("after")) {
    const Key& key = key_named("sweep", "after");
    if (!fits(key, *after))
      source.fail(after->source(), "sweep.after = " + text_of(*after) + ": " + allowed_values(key));
    sweep.after = after->ref<std::string>();
  }
  std::vector<std::pair<toml::source_position, SweepAxis>> axes;
  add_axes(*table, "", source, axes);
  std::sort(axes.begin(), axes.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> seen;
  double count = 1.0;
  for (auto& [place, axis] : axes) {
    for (const std::string& key : split(axis.keys, ',')) {
      if (std::find(seen.begin(), seen.end(), key) != seen.end())
        throw SceneError(axis.file + ":" + std::to_string(axis.line) + ": sweep." + axis.keys +
                         ": each key once; " + key + " stands in it twice");
      seen.push_back(key);
    }
    count *= static_cast<double>(axis.values.size());
    sweep.axes.push_back(std::move(axis));
  }
  if (sweep.axes.empty())
    source.fail(node->source(), "sweep: a list of values for one key or more");
  if (count > static_cast<double>(kMostCombinations))
    source.fail(node->source(), "sweep: at most " + std::to_string(kMostCombinations) +
                                    " combinations, and these are " + short_text(count));
  return sweep;
}

void SceneFile::end_after(const std::string& name) {
  const auto refuse = [&](const std::string& why) {
    const toml::node* after = tree_->root["sweep"]["after"].node();
    const std::string message = "sweep.after = '" + name + "': " + why;
    if (after) tree_->source.fail(after->source(), message);
    tree_->source.fail(message);
  };
  toml::array* stages = tree_->root["stage"].as_array();
  std::vector<std::size_t> found;
  for (std::size_t k = 0; stages && k < stages->size(); ++k) {
    const toml::node_view<toml::node> stage(stages->get(k));
    if (stage["name"].value_or(stage["kind"].value_or(std::string())) == name) found.push_back(k);
  }
  if (found.size() != 1) refuse("the name of one stage");
  if (found.front() + 1 == stages->size()) refuse("a stage before the last");
  stages->erase(std::next(stages->begin(), static_cast<std::ptrdiff_t>(found.front()) + 1),
                stages->end());
}

void SceneFile::drop(const std::string& section) { tree_->root.erase(section); }

Scene SceneFile::scene(const BodyShapes& shapes) const {
  sweep();  // is refused, too
  return read_scene(tree_->root, tree_->source, shapes);
}

std::string SceneFile::text(const fs::path& folder) const {
  toml::table all = tree_->root;
  all.erase("sweep");
  // A folder may be another by a link, and `..` then leads elsewhere.
  const fs::path from = fs::weakly_canonical(fs::absolute(tree_->name).parent_path());
  const fs::path to = fs::weakly_canonical(fs::absolute(folder));
  change_files(all, [&](const fs::path& file) {
    return file.is_absolute() ? file : fs::weakly_canonical(from / file).lexically_relative(to);
  });
  std::ostringstream out;
  write(out, all, "");
  return out.str();
}

}  // namespace tangency::inline v0::dem
