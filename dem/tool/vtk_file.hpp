// SPDX-License-Identifier: MIT
/// @file
/// Files of VTK's XML format PolyData, .vtp, as ParaView reads them: the arrays follow the XML text
/// as raw bytes in the order of the machine, which the file names, each in blocks compressed by
/// zlib.
///
/// (1) A file's bytes depend on what was added alone, not on the number of threads.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tangency::inline v0::dem {

/// Points, and a cell a point or a line a pair of points, with named arrays.
class VtkPolyData {
 public:
  enum class Cells { points, lines };
  /// Where an array belongs: to the whole, to each point, or to each cell.
  enum class Of { whole, points, cells };

  /// @param points  their number; of lines twice that of the cells, whose ends follow each other
  /// @param tensors  the name of the array of points that filters take for a tensor; or nothing
  VtkPolyData(Cells cells, std::size_t points, std::string tensors = "");

  /// x, y, z of each point.
  /// @param unit  what the array's key UNITS_LABEL says, as VTK reads it; "": no key
  void places(std::span<const double> values, const std::string& unit = "");
  /// @param values  `components` numbers an item
  void add(Of of, const std::string& name, int components, std::span<const double> values,
           const std::string& unit = "");
  void add(Of of, const std::string& name, int components, std::span<const float> values,
           const std::string& unit = "");
  void add(Of of, const std::string& name, int components, std::span<const std::int32_t> values);

  /// The whole file.
  std::string text() const;

 private:
  template <class Number>
  std::string array(const std::string& name, int components, std::span<const Number> values,
                    const std::string& unit = "", bool is_field = false);
  std::string append(std::string_view bytes);

  Cells cells_;
  std::size_t points_;
  std::string tensors_;
  std::array<std::string, 3> data_;  ///< XML of the arrays, by Of
  std::string places_, topology_;
  std::string appended_;
};

/// An index of frames, .pvd: files and their times.
struct VtkEntry {
  std::int64_t cycle;
  double time;
};
/// The file of a cycle is folder/CYCLE + ending.
/// @param entries  in the order of the index
/// @param folder  without a slash at its end
/// @param ending  with its point
std::string vtk_collection(std::span<const VtkEntry> entries, const std::string& folder,
                           const std::string& ending);
/// The entries of such an index; a line that is none is passed over.
std::vector<VtkEntry> vtk_entries(std::istream& index, const std::string& folder,
                                  const std::string& ending);

/// The text between `before` and `after` in a line, if both are there.
std::optional<std::string> between(const std::string& line, const std::string& before,
                                   const std::string& after);

}  // namespace tangency::inline v0::dem
