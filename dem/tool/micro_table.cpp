// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/micro_table.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include <tangency/dem/micromechanics/harmonics.hpp>
#include <tangency/dem/tool/text_columns.hpp>

namespace tangency::inline v0::dem {
namespace {

namespace mm = micromechanics;

std::string line(const std::string& name, double value, const std::string& unit = "") {
  return left(name) + cell(value) + (unit.empty() ? "" : "  " + unit) + "\n";
}

std::string count_lines(const MicroSummary& summary) {
  const mm::Coordination& coordination = summary.coordination;
  std::string text;
  text += line("particles", static_cast<double>(summary.particles));
  text += line("contacts", static_cast<double>(summary.contacts), "between particles");
  if (summary.wall_contacts > 0)
    text += line("contacts with walls", static_cast<double>(summary.wall_contacts),
                 "in no average but the stress");
  text += line("coordination number", coordination.mean);
  text += line("  without rattlers", summary.coordination_without_rattlers,
               std::to_string(summary.rattlers) + " rattlers");
  text += line("  deviation", coordination.deviation);
  text += line("contact sides per volume", summary.averages.contact_density);
  text += line("classes", static_cast<double>(summary.averages.classes),
               std::to_string(summary.averages.empty_classes) + " of them empty");
  return text;
}

const char* meaning_of(const std::string& name) {
  constexpr std::array<std::pair<const char*, const char*>, 9> kMeanings{
      {{"r", "contact normals"},
       {"n", "normal force"},
       {"t", "tangential force"},
       {"z", "branch, normal"},
       {"zt", "branch, tangential"},
       {"len", "branch length"},
       {"E", "long axes"},
       {"lambda", "contact vectors"},
       {"cv", "contact vectors, in body"}}};
  for (const auto& [key, meaning] : kMeanings)
    if (name == key) return meaning;
  return "";
}

std::string tensor_lines(const MicroSummary& summary) {
  std::string text = left("Anisotropy");
  for (const char* head : {"magnitude", "error", "order 4", "xx", "yy", "zz"}) text += right(head);
  text += "\n";
  for (const auto& [name, x] : tensors_of(summary.averages)) {
    text += left(meaning_of(name));
    const double none = kNotDefined;
    text += cell(x ? mm::modulus(x->second) : none) + cell(x ? x->second_scatter() : none) +
            cell(x && x->fourth ? x->fourth->norm() : none);
    for (int k = 0; k < 3; ++k) text += cell(x ? x->second(k, k) : none);
    text += "\n";
  }
  return text;
}

std::string stress_lines(const MicroSummary& summary) {
  constexpr std::array<std::pair<const char*, const char*>, 6> kMeanings{
      {{"measured", "sum over contacts"},
       {"seven", "seven parts, published"},
       {"eight", "all parts of order 2"},
       {"fourth", "models of orders 2, 4"},
       {"noshape", "without branch tensors"},
       {"independent", "by means of classes"}}};
  std::string text = left("Stress");
  for (const char* head : {"mean", "s1", "s2", "s3", "a_s"}) text += right(head);
  text += "\n";
  for (std::size_t k = 0; k < summary.stresses.size(); ++k) {
    const StressSummary& stress = summary.stresses[k].second;
    text += left(kMeanings[k].second) + cell(stress.mean);
    for (const double value : stress.principal) text += cell(value);
    text += cell(stress.ratio) + "\n";
  }
  return text;
}

std::string share_lines(const MicroSummary& summary) {
  if (!summary.state) return "";
  const mm::ShearShares shares = shares_of(summary.state).seven;
  std::string head = left("Shares of a_s, %"), values = left("");
  for (const auto& [name, share] : named_shares(shares)) {
    if (name == "rfz") continue;
    head += right(name, 8);
    values += cell(100.0 * share / shares.sum(), 8);
  }
  return "\n" + head + "\n" + values + "\n";
}

std::string group_lines(const MicroSummary& summary) {
  std::string text = left("Contacts mainly along") + "   fraction      force\n";
  for (std::size_t k = 0; k < 3; ++k)
    text += left(std::string(1, "xyz"[k])) + cell(summary.axis_groups[k].fraction) +
            cell(summary.axis_groups[k].mean_normal_force) + "\n";
  return text;
}

}  // namespace

std::string micro_table(const MicroSummary& summary) {
  const mm::Averages& averages = summary.averages;
  std::string text = count_lines(summary);
  text += line("mean normal force, f0", mean_of(averages.force_normal), "over orientations");
  text += line("", summary.mean_normal_force, "over contacts");
  text += line("mean normal branch, z0", mean_of(averages.branch_normal), "over orientations");
  text += line("mean branch length", mean_of(averages.branch_length), "over orientations");
  text += "\n" + tensor_lines(summary);
  if (const auto& local = averages.local_contacts; local && averages.body_axis)
    text += line("a1", local->second(*averages.body_axis, *averages.body_axis),
                 "along the axis of the body");
  text += "\n" + stress_lines(summary) + share_lines(summary);
  if (summary.plane) {
    const PlaneRatios ratios = plane_ratios(summary.plane);
    text += line("sin(phi), small anisotropy", ratios.small);
    text += line("sin(phi), coaxial", ratios.coaxial);
  }
  text += "\n" + group_lines(summary);
  return text;
}

}  // namespace tangency::inline v0::dem
