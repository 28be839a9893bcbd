// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/micro.hpp>

#include <tangency/dem/state_file.hpp>
#include <tangency/dem/tool/histogram.hpp>
#include <tangency/dem/tool/micro_json.hpp>
#include <tangency/dem/tool/micro_summary.hpp>
#include <tangency/dem/tool/micro_table.hpp>
#include <tangency/dem/tool/packing.hpp>
#include <tangency/dem/tool/run.hpp>
#include <tangency/dem/tool/strain_report.hpp>
#include <tangency/geometry/tables/command_line.hpp>
#include <tangency/geometry/tables/output_file.hpp>

namespace tangency::dem {
namespace {

void write(const std::string& file, const std::string& text) {
  tables::OutputFile out(file);
  out.write(text);
  out.commit();
}

}  // namespace

micromechanics::Classes::Kind partition_named(const std::string& name) {
  using Kind = micromechanics::Classes::Kind;
  return name == "polar" ? Kind::polar : Kind::near_uniform;
}

int micro(const MicroOptions& options) {
  if (options.json == "-" && options.histogram == "-")
    throw tables::UsageError("--json and --histogram: one of them may be -");
  const State state = load_state(options.state);
  const Packing packing = packing_of(state);
  if (!options.histogram.empty() && packing.dimensions == 2)
    throw StateError(options.state + ": a packing in the plane: --histogram is of space alone");
  const MicroSummary summary = micro_summary(packing, options.classes);
  const StrainReport strain =
      options.since.empty()
          ? strain_report(state, packing)
          : strain_report(state, packing, load_state(options.since), options.since);
  if (!options.json.empty()) write(options.json, micro_json(state, packing, summary, strain));
  if (!options.histogram.empty()) write(options.histogram, histogram_csv(packing, summary));
  if (options.json != "-" && options.histogram != "-")
    write("-", micro_table(summary) + "\n" + strain_table(strain));
  return success;
}

}  // namespace tangency::dem
