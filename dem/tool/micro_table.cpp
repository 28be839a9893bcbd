// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/micro_table.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include <tangency/dem/micromechanics/harmonics.hpp>
#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::dem {
namespace {

namespace mm = micromechanics;

std::string cell(double x, int width = 11) {
  const std::string text = std::isfinite(x) ? tables::rounded_text(x, 4) : "-";
  return std::string(text.size() < static_cast<std::size_t>(width)
                         ? static_cast<std::size_t>(width) - text.size()
                         : 1,
                     ' ') +
         text;
}

std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(width, text.size()), ' ');
  return text;
}

constexpr std::size_t kNameWidth = 26;

std::string line(const std::string& name, double value, const std::string& unit = "") {
  return padded(name, kNameWidth) + cell(value) + (unit.empty() ? "" : "  " + unit) + "\n";
}

std::string count_lines(const MicroSummary& summary) {
  const mm::Coordination& coordination = summary.coordination;
  std::string text;
  text += line("particles", static_cast<double>(summary.particles));
  text += line("contacts", static_cast<double>(summary.contacts), "between particles");
  if (summary.wall_contacts > 0)
    text += line("contacts with walls", static_cast<double>(summary.wall_contacts),
                 "in no average below");
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
  std::string text = padded("Anisotropy", kNameWidth);
  for (const char* head : {"magnitude", "error", "order 4", "xx", "yy", "zz"})
    text += std::string(11 - std::string(head).size(), ' ') + head;
  text += "\n";
  for (const auto& [name, x] : tensors_of(summary.averages)) {
    text += padded(meaning_of(name), kNameWidth);
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
  std::string text = padded("Stress", kNameWidth);
  for (const char* head : {"mean", "s1", "s2", "s3", "a_s"})
    text += std::string(11 - std::string(head).size(), ' ') + head;
  text += "\n";
  for (std::size_t k = 0; k < summary.stresses.size(); ++k) {
    const StressSummary& stress = summary.stresses[k].second;
    text += padded(kMeanings[k].second, kNameWidth) + cell(stress.mean);
    for (const double value : stress.principal) text += cell(value);
    text += cell(stress.ratio) + "\n";
  }
  return text;
}

std::string share_lines(const MicroSummary& summary) {
  if (!summary.state) return "";
  const mm::ShearShares shares = shares_of(summary.state).seven;
  std::string head = padded("Shares of a_s, %", kNameWidth), values = padded("", kNameWidth);
  for (const auto& [name, share] : named_shares(shares)) {
    if (name == "rfz") continue;
    head += std::string(8 - name.size(), ' ') + name;
    values += cell(100.0 * share / shares.sum(), 8);
  }
  return "\n" + head + "\n" + values + "\n";
}

std::string group_lines(const MicroSummary& summary) {
  std::string text = padded("Contacts mainly along", kNameWidth) + "   fraction      force\n";
  for (std::size_t k = 0; k < 3; ++k)
    text += padded(std::string(1, "xyz"[k]), kNameWidth) + cell(summary.axis_groups[k].fraction) +
            cell(summary.axis_groups[k].mean_normal_force) + "\n";
  return text;
}

}  // namespace

std::string micro_table(const MicroSummary& summary) {
  const mm::Averages& averages = summary.averages;
  const auto mean = [](const mm::Averages::Tensor& x) { return x ? x->mean : kNotDefined; };
  std::string text = count_lines(summary);
  text += line("mean normal force, f0", mean(averages.force_normal), "over orientations");
  text += line("", summary.mean_normal_force, "over contacts");
  text += line("mean normal branch, z0", mean(averages.branch_normal), "over orientations");
  text += line("mean branch length", mean(averages.branch_length), "over orientations");
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

}  // namespace tangency::dem
