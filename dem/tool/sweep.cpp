// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/sweep.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <tangency/dem/tool/results.hpp>
#include <tangency/dem/tool/run.hpp>
#include <tangency/dem/whole_file.hpp>
#include <tangency/geometry/tables/command_line.hpp>

namespace tangency::inline v0::dem {
namespace {

namespace fs = std::filesystem;

/// A run of the sweep.
struct Combination {
  std::vector<Setting> settings;
  std::string folder;
  std::string scene;  ///< scene.toml
};

/// What is neither letter, digit nor one of ".+-_" becomes "_"; quotes go.
std::string file_name_of(const std::string& value) {
  std::string name;
  for (const char c : value) {
    if (c == '\'' || c == '"' || c == ' ') continue;
    const bool stays =
        std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '+' || c == '-';
    name += stays ? c : '_';
  }
  name.erase(0, name.find_first_not_of('_'));  // brackets of a list
  return name.erase(name.find_last_not_of('_') + 1);
}

/// The last part of a key's path, or all of it where another axis has the same.
std::string short_key(const Sweep& sweep, std::size_t axis) {
  const auto first = [&](std::size_t k) {
    const std::string& keys = sweep.axes[k].keys;
    return keys.substr(0, keys.find(','));
  };
  const auto last = [](const std::string& path) { return path.substr(path.rfind('.') + 1); };
  for (std::size_t k = 0; k < sweep.axes.size(); ++k)
    if (k != axis && last(first(k)) == last(first(axis))) return first(axis);
  return last(first(axis));
}

std::string without_commas(std::string text) {
  std::erase_if(text, [](char c) { return c == '\'' || c == '"'; });
  std::replace(text.begin(), text.end(), ',', ' ');
  return text;
}

/// Names and values of a summary.json that are one number or text; nothing without one.
std::vector<std::pair<std::string, std::string>> values_of(const fs::path& folder) {
  std::vector<std::pair<std::string, std::string>> values;
  const auto text = read_whole(folder / "summary.json");
  if (!text) return values;
  const auto summary = nlohmann::ordered_json::parse(*text, nullptr, false);
  for (const auto& [name, value] : summary.items())
    if (value.is_primitive())
      values.emplace_back(name, value.is_null()     ? ""
                                : value.is_string() ? value.get<std::string>()
                                                    : value.dump());
  return values;
}

class Study {
 public:
  Study(const RunOptions& options, const SceneFile& file)
      : options_(options), file_(file), sweep_(*file.sweep()) {
    if (options.resume)
      throw OutputError("--resume " + options.resume->string() +
                        ": without [sweep]; the runs of a sweep go on by themselves");
    for (std::size_t k = 0; k < sweep_.combinations(); ++k) combinations_.push_back(made(k));
    std::set<std::string> names;
    for (const Combination& one : combinations_)
      if (!names.insert(one.folder).second)
        throw SceneError(options.scene.string() + ": sweep: two combinations are called " +
                         one.folder + ": each value once");
    if (sweep_.after) base_ = base();
  }

  int run() {
    std::size_t number = 0;
    for (const Combination& one : combinations_) require_own(one);
    if (base_) {
      require_own(*base_);
      if (is_another(*base_))  // from whose end all have gone on
        for (const Combination& one : combinations_) forget(one);
      const int status = run_in(*base_, std::nullopt, *sweep_.after);
      if (status != success) return status;
    }
    for (const Combination& one : combinations_) {
      const std::string which =
          std::to_string(++number) + " of " + std::to_string(combinations_.size());
      std::optional<fs::path> start;
      if (base_) start = options_.out / base_->folder / "final.state";
      statuses_.push_back(run_in(one, start, which));
      if (statuses_.back() > kLastOwnStatus) return statuses_.back();
      write_table();
    }
    return *std::max_element(statuses_.begin(), statuses_.end());
  }

 private:
  /// Above it a run was ended by a signal.
  static constexpr int kLastOwnStatus = 128;

  /// The file with the settings of the command line.
  SceneFile fresh() const {
    SceneFile file = file_.again();
    for (const std::string& assignment : options_.settings) file.set(assignment);
    return file;
  }

  SceneFile with(const std::vector<Setting>& settings) const {
    SceneFile file = fresh();
    for (std::size_t k = 0; k < settings.size(); ++k)
      file.set(settings[k], sweep_.axes[k].file, sweep_.axes[k].line);
    return file;
  }

  Combination made(std::size_t index) const {
    Combination one{sweep_.combination(index), "", ""};
    for (std::size_t k = 0; k < one.settings.size(); ++k)
      one.folder += (k > 0 ? "_" : "") + file_name_of(short_key(sweep_, k)) + "=" +
                    file_name_of(one.settings[k].value);
    const SceneFile file = with(one.settings);
    file.scene();
    one.scene = file.text(options_.out / one.folder);
    if (sweep_.after) require_common_start(one);
    return one;
  }

  /// The stages before `after` have to be the same in all: only laws and what is written may
  /// differ.
  void require_common_start(const Combination& one) const {
    SceneFile own = with(one.settings), common = fresh();
    for (SceneFile* file : {&own, &common}) {
      file->end_after(*sweep_.after);
      for (const char* section : {"contact", "output"}) file->drop(section);
    }
    if (own.text(options_.out) != common.text(options_.out))
      throw SceneError(options_.scene.string() + ": sweep.after = '" + *sweep_.after +
                       "': a stage before which " + one.folder + " changes nothing but contacts");
  }

  Combination base() const {
    SceneFile file = fresh();
    file.end_after(*sweep_.after);
    return {{}, *sweep_.after, file.text(options_.out / *sweep_.after)};
  }

  fs::path folder_of(const Combination& one) const { return options_.out / one.folder; }
  std::optional<std::string> scene_in(const Combination& one) const {
    return read_whole(folder_of(one) / "scene.toml");
  }
  bool is_another(const Combination& one) const {
    return scene_in(one).value_or(one.scene) != one.scene;
  }

  /// @throws OutputError  where a folder has another scene, or results without one
  void require_own(const Combination& one) const {
    if (options_.replace || scene_in(one) == one.scene) return;
    const auto found = is_another(one) ? std::optional<std::string>("scene.toml")
                                       : first_result_in(folder_of(one));
    if (!found) return;
    throw OutputError("--out " + options_.out.string() + ": " + (folder_of(one) / *found).string() +
                      " is of another scene: --replace takes its results away; or another --out");
  }

  /// What a run is known by to be complete, or to go on from.
  void forget(const Combination& one) const {
    for (const char* file : {"summary.json", "final.state", "checkpoint.state"})
      fs::remove(folder_of(one) / file);
  }

  int run_in(const Combination& one, const std::optional<fs::path>& start,
             const std::string& which) const {
    const fs::path folder = folder_of(one);
    const bool is_same = scene_in(one) == one.scene;
    if (is_same && fs::exists(folder / "summary.json") && fs::exists(folder / "final.state")) {
      say(one.folder + " (" + which + ") is complete");
      return success;
    }
    say(one.folder + " (" + which + ")");
    RunOptions options = options_;
    options.scene = folder / "scene.toml";
    options.out = folder;
    options.resume = start;
    const bool goes_on = is_same && fs::exists(folder / "checkpoint.state");
    if (goes_on) options.resume = folder / "checkpoint.state";
    options.replace = !goes_on;  // the folder is this run's: what a kill left there is of no use
    for (const auto& [keys, value] : one.settings) options.settings.push_back(keys + "=" + value);
    if (!is_same) forget(one);  // before it would pass for the new scene's
    fs::create_directories(folder);
    write_whole(options.scene, one.scene);
    try {
      return dem::run(options, SceneFile(options.scene));
    } catch (const SceneError& error) {  // as of places drawn at random: others go on
      std::cerr << error.what() << std::endl;
      return tables::kRefused;
    }
  }

  void say(const std::string& what) const {
    if (!options_.quiet) std::cerr << "tangency-dem: run " << what << std::endl;
  }

  void write_table() const {
    std::vector<std::string> names;
    for (std::size_t k = 0; k < statuses_.size(); ++k)
      for (const auto& [name, value] : values_of(options_.out / combinations_[k].folder))
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    std::string table = "folder,status";
    for (const SweepAxis& axis : sweep_.axes) table += "," + column_of(axis.keys);
    for (const std::string& name : names) table += "," + name;
    table += '\n';
    for (std::size_t k = 0; k < statuses_.size(); ++k) {
      const Combination& one = combinations_[k];
      table += one.folder + "," + std::to_string(statuses_[k]);
      for (const Setting& setting : one.settings) table += "," + without_commas(setting.value);
      const auto values = values_of(options_.out / one.folder);
      for (const std::string& name : names) {
        const auto found = std::find_if(values.begin(), values.end(),
                                        [&](const auto& value) { return value.first == name; });
        table += "," + (found == values.end() ? "" : without_commas(found->second));
      }
      table += '\n';
    }
    write_whole(options_.out / "sweep.csv", table);
  }

  static std::string column_of(std::string keys) {
    std::erase(keys, ' ');
    std::replace(keys.begin(), keys.end(), ',', '+');
    return keys;
  }

  const RunOptions& options_;
  const SceneFile& file_;
  Sweep sweep_;
  std::vector<Combination> combinations_;
  std::optional<Combination> base_;
  std::vector<int> statuses_;  ///< of the combinations that have run
};

}  // namespace

int sweep(const RunOptions& options, const SceneFile& file) { return Study(options, file).run(); }

}  // namespace tangency::inline v0::dem
