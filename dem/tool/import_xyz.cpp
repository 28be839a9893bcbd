// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <tangency/dem/particles.hpp>
#include <tangency/dem/tool/import_text.hpp>
#include <tangency/geometry/tables/csv.hpp>
#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::dem {
namespace {

using tables::to_text;

/// The value of KEY=VALUE or KEY="VALUE" in a line; nothing where the key is not there.
std::optional<std::string> value_of(std::string_view line, const std::string& key) {
  for (std::size_t at = line.find(key + "="); at != line.npos; at = line.find(key + "=", at + 1)) {
    if (at > 0 && line[at - 1] != ' ' && line[at - 1] != '\t') continue;
    std::string_view value = line.substr(at + key.size() + 1);
    const bool quoted = !value.empty() && value[0] == '"';
    if (quoted) value.remove_prefix(1);
    return std::string(value.substr(0, value.find_first_of(quoted ? "\"" : " \t\r")));
  }
  return std::nullopt;
}

std::vector<std::string> parts_of(const std::string& text, char between) {
  std::vector<std::string> parts;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(between, at), text.size());
    if (end > at) parts.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return parts;
}

class ExtendedXyz {
 public:
  ExtendedXyz(const std::string& file, std::string_view text) : in_(file, text) {}

  Sample read(std::optional<int> wanted) {
    Sample last;
    int frame = -1;
    while (in_.next()) {
      if (in_.words().empty()) continue;
      const std::int64_t count = in_.integer(0, "number of particles");
      in_.next();
      last = read_frame(count);
      if (++frame == wanted) return last;
    }
    if (wanted)
      in_.fail("--frame", to_text(*wanted), "from 0 to " + to_text(frame) + ", the last one");
    return last;
  }

 private:
  struct Property {
    std::size_t first, count;  ///< its words of a row
  };

  Sample read_frame(std::int64_t count) {
    Sample sample;
    const std::string line(in_.line());
    read_cell(line, sample);
    read_properties(line);
    if (const auto time = value_of(line, "Time")) sample.time = number_of(*time, "Time");
    std::map<std::string, std::int32_t> types;
    for (std::int64_t k = 0; k < count; ++k) {
      if (!in_.next() || in_.words().size() != width_)
        in_.fail("row", in_.line(), to_text(count) + " rows of " + to_text(width_) + " values");
      read_row(sample, types);
    }
    return sample;
  }

  double number_of(const std::string& text, std::string_view name) const {
    double value = 0.0;
    if (const auto rule = tables::parse_number(text, value))
      in_.fail(name, text, std::string(*rule));
    return value;
  }

  void read_cell(const std::string& line, Sample& sample) const {
    const auto lattice = value_of(line, "Lattice");
    const auto numbers = parts_of(lattice.value_or(""), ' ');
    if (numbers.size() != 9) in_.fail("Lattice", lattice.value_or(""), "9 numbers, edge by edge");
    for (std::size_t k = 0; k < 9; ++k)
      sample.edges(static_cast<Eigen::Index>(k % 3), static_cast<Eigen::Index>(k / 3)) =
          number_of(numbers[k], "Lattice");
    if (!(sample.edges.determinant() > 0.0))
      in_.fail("Lattice", *lattice, "3 edges of a right-handed cell");
    const auto flags = parts_of(value_of(line, "pbc").value_or("T T T"), ' ');
    if (flags.size() != 3) in_.fail("pbc", line, "3 of T and F");
    for (std::size_t k = 0; k < 3; ++k) sample.periodic[k] = flags[k] == "T" || flags[k] == "1";
  }

  void read_properties(const std::string& line) {
    properties_.clear();
    width_ = 0;
    const auto text = value_of(line, "Properties");
    const auto parts = parts_of(text.value_or(""), ':');
    for (std::size_t k = 0; k + 2 < parts.size(); k += 3) {
      const auto count = static_cast<std::size_t>(number_of(parts[k + 2], "Properties"));
      properties_[parts[k]] = {width_, count};
      width_ += count;
    }
    const auto require = [&](const std::string& name, std::size_t count) {
      const auto found = properties_.find(name);
      if (found == properties_.end() || found->second.count != count)
        in_.fail("Properties", text.value_or(""),
                 "with " + name + " of " + to_text(count) + " numbers");
    };
    require("pos", 3);
    if (has("radius"))
      require("radius", 1);
    else
      require("aspherical_shape", 3);
    for (const auto& [name, count] :
         {std::pair{"orientation", 4}, {"velo", 3}, {"angular_velocity", 3}, {"mass", 1}})
      if (has(name)) require(name, static_cast<std::size_t>(count));
  }

  bool has(const std::string& name) const { return properties_.contains(name); }
  double number(const std::string& name, std::size_t part = 0) const {
    return in_.number(properties_.at(name).first + part, name);
  }
  double positive(const std::string& name, std::size_t part = 0) const {
    return in_.positive(properties_.at(name).first + part, name);
  }
  Vec3 vector(const std::string& name) const {
    return {number(name), number(name, 1), number(name, 2)};
  }

  void read_row(Sample& sample, std::map<std::string, std::int32_t>& types) const {
    const char* name = has("species") ? "species" : "type";
    const std::string species =
        has(name) ? std::string(in_.words()[properties_.at(name).first]) : "1";
    const auto [type, is_new] = types.emplace(species, static_cast<std::int32_t>(types.size()));
    if (is_new) sample.type_names.push_back(species);
    const Vec3 radii = has("radius")
                           ? Vec3(Vec3::Constant(positive("radius")))
                           : Vec3(positive("aspherical_shape"), positive("aspherical_shape", 1),
                                  positive("aspherical_shape", 2));
    sample.add(type->second, vector("pos"), radii);
    if (has("orientation")) {
      const Quaternion q(number("orientation", 3), number("orientation"), number("orientation", 1),
                         number("orientation", 2));
      if (q.coeffs().isZero(0.0)) in_.fail("orientation", in_.line(), "4 numbers, not all 0");
      sample.orientation.back() = q;
    }
    if (has("velo")) sample.velocity.back() = vector("velo");
    if (has("angular_velocity")) sample.angular_velocity.back() = vector("angular_velocity");
    if (has("mass")) sample.density.back() = positive("mass") / volume_of(radii);
  }

  LineReader in_;
  std::map<std::string, Property> properties_;
  std::size_t width_ = 0;
};

}  // namespace

Sample read_extended_xyz(const std::string& file, std::string_view text, std::optional<int> frame) {
  return ExtendedXyz(file, text).read(frame);
}

}  // namespace tangency::inline v0::dem
