// SPDX-License-Identifier: MIT
#include <tangency/dem/scene/scene_particles.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <string>
#include <vector>

#include <tangency/dem/samples/body_sizes.hpp>

namespace tangency::inline v0::dem {
namespace {

using Rule = BodySizes::Rule;

Rule rule_named(const std::string& name) {
  return name == "uniform"     ? Rule::uniform
         : name == "normal"    ? Rule::normal
         : name == "lognormal" ? Rule::lognormal
         : name == "sieve"     ? Rule::sieve
                               : Rule::equal;
}

/// The least and the largest value of a key of two numbers.
std::array<double, 2> read_ends(const Section& section, const char* key,
                                const std::array<double, 2>& otherwise) {
  if (!section.has(key)) return otherwise;
  const std::vector<double> ends = section.reals(key);
  if (ends.size() != 2 || !(ends[0] < ends[1])) section.fail(key, "2 numbers, ascending");
  return {ends[0], ends[1]};
}

/// The ratio by `one`, or between the ends of `several`.
std::array<double, 2> read_ratio(const Section& section, const char* one, const char* several) {
  if (section.has(several)) section.forbid(one, std::string("not together with ") + several);
  const double all = section.real(one);
  return read_ends(section, several, {all, all});
}

BodyRatios read_ratios(const Section& section, int dimensions) {
  const BodyRatios ratios{read_ratio(section, "elongation", "elongations"),
                          read_ratio(section, "flatness", "flatnesses")};
  if (dimensions == 2) {
    section.forbid("flatnesses", "with dimensions = 2 none: flatness is 1");
    if (ratios.flatness[0] != 1.0) section.fail("flatness", "with dimensions = 2 it is 1");
  }
  return ratios;
}

bool ascends(const std::vector<double>& numbers, bool strictly) {
  return std::adjacent_find(numbers.begin(), numbers.end(), [&](double a, double b) {
           return strictly ? a >= b : a > b;
         }) == numbers.end();
}

void read_sieves(const Section& section, BodySizes& sizes) {
  for (const char* key : {"sieve_openings", "sieve_passing"})
    if (!section.has(key)) section.fail_missing(key);
  section.forbid("mean_radius", "not with sizes = \"sieve\"");
  sizes.openings = section.reals("sieve_openings");
  sizes.passing = section.reals("sieve_passing");
  if (sizes.openings.size() < 2 || !ascends(sizes.openings, true))
    section.fail("sieve_openings", "2 numbers or more, ascending (m)");
  if (sizes.passing.size() != sizes.openings.size() || !ascends(sizes.passing, false) ||
      sizes.passing.front() != 0.0 || sizes.passing.back() != 1.0)
    section.fail("sieve_passing", "one number an opening, ascending from 0 to 1");
}

void read_spread(const Section& section, BodySizes& sizes) {
  if (!section.has("size_spread")) section.fail_missing("size_spread");
  sizes.spread = section.real("size_spread");
  sizes.tails = section.real("size_tails");
  if (sizes.rule == Rule::uniform && !(sizes.spread < 1.0))
    section.fail("size_spread", "below 1 with sizes = \"uniform\"");
  const double most = 1.0 / normal_quantile(1.0 - sizes.tails);
  if (sizes.rule == Rule::normal && !(sizes.spread < most))
    section.fail("size_spread", "below " + short_text(most) +
                                    " with sizes = \"normal\" and size_tails = " +
                                    short_text(sizes.tails) + ": radii are > 0");
}

BodySizes read_sizes(const Section& section) {
  BodySizes sizes;
  sizes.rule = rule_named(section.text("sizes"));
  const bool spreads = sizes.rule != Rule::equal && sizes.rule != Rule::sieve;
  const bool has_tails = sizes.rule == Rule::normal || sizes.rule == Rule::lognormal;
  if (!spreads) section.forbid("size_spread", "with sizes = uniform, normal or lognormal alone");
  if (!has_tails) section.forbid("size_tails", "with sizes = normal or lognormal alone");
  if (sizes.rule == Rule::sieve) {
    read_sieves(section, sizes);
    return sizes;
  }
  for (const char* key : {"sieve_openings", "sieve_passing"})
    section.forbid(key, "with sizes = \"sieve\" alone");
  if (!section.has("mean_radius")) section.fail_missing("mean_radius");
  sizes.radius = section.real("mean_radius");
  if (spreads) read_spread(section, sizes);
  return sizes;
}

double mean_of_radii(const std::vector<Shape>& shapes) {
  double sum = 0.0;
  for (const Shape& shape : shapes) sum += shape.mean_radius;
  return sum / static_cast<double>(shapes.size());
}

}  // namespace

Batch read_batch(const Section& section, int dimensions) {
  const BodySizes sizes = read_sizes(section);
  const BodyRatios ratios = read_ratios(section, dimensions);
  const bool alike = sizes.rule == Rule::equal && ratios.elongation[0] == ratios.elongation[1] &&
                     ratios.flatness[0] == ratios.flatness[1];
  Batch batch{{sizes.radius, std::midpoint(ratios.elongation[0], ratios.elongation[1]),
               std::midpoint(ratios.flatness[0], ratios.flatness[1])},
              section.real("density"),
              static_cast<std::size_t>(section.integer("count"))};
  if (!alike) {
    batch.shapes = shapes_of(sizes, ratios, batch.count, dimensions);
    batch.shape.mean_radius = mean_of_radii(batch.shapes);
  }
  batch.layer = read_ends(section, "layer", batch.layer);
  return batch;
}

}  // namespace tangency::inline v0::dem
