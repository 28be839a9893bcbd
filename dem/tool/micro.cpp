// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/micro.hpp>

#include <cstdint>
#include <iostream>
#include <memory>
#include <ostream>
#include <utility>
#include <vector>

#include <tangency/dem/saved/state_file.hpp>
#include <tangency/dem/tool/contact_tables.hpp>
#include <tangency/dem/tool/histogram.hpp>
#include <tangency/dem/tool/micro_json.hpp>
#include <tangency/dem/tool/micro_summary.hpp>
#include <tangency/dem/tool/micro_table.hpp>
#include <tangency/dem/tool/packing.hpp>
#include <tangency/dem/tool/run.hpp>
#include <tangency/dem/tool/strain_report.hpp>
#include <tangency/geometry/tables/command_line.hpp>
#include <tangency/geometry/tables/output_file.hpp>

namespace tangency::inline v0::dem {
namespace {

/// Files that appear all or not at all.
class Outputs {
 public:
  void write(const std::string& file, const std::string& text) {
    files_.push_back(std::make_unique<tables::OutputFile>(file));
    files_.back()->write(text);
  }
  void commit() {
    for (const auto& file : files_) file->commit();
  }

 private:
  std::vector<std::unique_ptr<tables::OutputFile>> files_;
};

/// The laws may be those of another friction than the stage's.
void warn_of_shear_above_limit(const MicroOptions& options, const State& state) {
  const std::int64_t above = contacts_above_limit(state, state.laws);
  if (above > 0)
    std::cerr << "tangency-dem: " << options.state << ": " << above
              << " contacts bear more shear than their friction lets them; what slides is known "
                 "with --scene, the scene of the run, or with --friction"
              << std::endl;
}

}  // namespace

micromechanics::Classes::Kind partition_named(const std::string& name) {
  using Kind = micromechanics::Classes::Kind;
  return name == "polar" ? Kind::polar : Kind::near_uniform;
}

ContactLaws laws_of(const State& state, const std::string& file, const StateFriction& friction) {
  if (friction.given) return with_friction(state.laws, *friction.given);
  if (friction.scene.empty()) {
    if (friction.settings.empty()) return state.laws;
    throw tables::UsageError("--set: changes keys of a --scene, which is not given");
  }
  RunOptions options;
  options.scene = friction.scene;
  options.settings = friction.settings;
  options.resume = file;
  options.quiet = true;
  return laws_of(simulation_of(options, scene_file_of(options), state));
}

int micro(const MicroOptions& options) {
  if (!options.json.empty() && options.json == options.histogram)
    throw tables::UsageError(options.json == "-" ? "--json and --histogram: one of them may be -"
                                                 : "--json and --histogram: two files, not " +
                                                       options.json + " for both");
  State state = load_state(options.state);
  state.laws = laws_of(state, options.state, options.friction);
  warn_of_shear_above_limit(options, state);
  const Packing packing = packing_of(state);
  if (!options.histogram.empty() && packing.dimensions == 2)
    throw StateError(options.state + ": a packing in the plane: --histogram is of space alone");
  const MicroSummary summary = micro_summary(packing, options.classes);
  const StrainReport strain =
      options.since.empty()
          ? strain_report(state, packing)
          : strain_report(state, packing, load_state(options.since), options.since);
  Outputs out;
  if (!options.json.empty()) out.write(options.json, micro_json(state, packing, summary, strain));
  if (!options.histogram.empty()) out.write(options.histogram, histogram_csv(packing, summary));
  if (options.json != "-" && options.histogram != "-")
    out.write("-", micro_table(summary) + "\n" + strain_table(strain));
  out.commit();
  return success;
}

}  // namespace tangency::inline v0::dem
