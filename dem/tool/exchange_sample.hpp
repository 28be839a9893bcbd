// SPDX-License-Identifier: MIT
/// @file
/// A sample on its way to or from files of other programs: bodies in a cell, without contacts.
///
/// Units are those of the scene. Semi-axes are radii, orientations turn body axes to space, angular
/// velocities are in space axes. Bodies stand in the order of ids.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <tangency/dem/simulation.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::dem {

struct Sample {
  Mat3 edges = Mat3::Identity();  ///< columns: edges of the cell from its corner at the origin
  std::array<bool, 3> periodic{true, true, true};
  std::int64_t cycle = 0;
  double time = 0.0;
  std::vector<std::string> type_names;
  std::vector<std::int32_t> type;  ///< index into type_names
  std::vector<Vec3> position, semi_axes, velocity, angular_velocity;
  std::vector<Quaternion> orientation;
  std::vector<double> density;  ///< mass / volume

  std::size_t size() const { return position.size(); }
  /// A body at rest, aligned with the axes, of the density that scenes have by default.
  void add(std::int32_t of_type, const Vec3& centre, const Vec3& radii);
};

/// Of a state in space, whose types are called "1", "2" and so on where no names are given.
/// @throws StateError  of a plane state
Sample sample_of(const State& state, const std::vector<std::string>& type_names = {});

/// Turned, with all vectors, so that the first edge lies along x and the second in the plane of x
/// and y, as LAMMPS and HOOMD have cells; one that is so already stays as it is, to the bit.
Sample with_triangular_cell(Sample sample);

/// Centres that lie outside of the cell along periodic edges, put back into it.
Vec3 wrapped_into(const Mat3& edges, const std::array<bool, 3>& periodic, const Vec3& x,
                  std::array<std::int32_t, 3>& image);

/// Lines of a text, and what is refused in them.
class LineReader {
 public:
  LineReader(std::string file, std::string_view text) : file_(std::move(file)), rest_(text) {}

  /// The next line, without comments of `#` where these are skipped; false at the end.
  bool next();
  std::string_view line() const { return line_; }
  /// Parts of the line between blanks.
  const std::vector<std::string_view>& words() const { return words_; }
  const std::string& file() const { return file_; }
  bool at_end() const { return rest_.empty(); }

  /// @throws tables::Error  with file, line, name and rule
  double number(std::size_t word, std::string_view name) const;
  std::int64_t integer(std::size_t word, std::string_view name) const;
  double positive(std::size_t word, std::string_view name) const;
  [[noreturn]] void fail(std::string_view name, std::string_view value, std::string rule) const;
  /// @throws tables::Error  where the line has fewer words
  void require_words(std::size_t count, std::string_view what) const;

 private:
  std::string file_;
  std::string_view rest_, line_;
  std::size_t number_ = 0;
  std::vector<std::string_view> words_;
};

}  // namespace tangency::inline v0::dem
