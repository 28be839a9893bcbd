// SPDX-License-Identifier: MIT
/// @file
/// A run as far as its directory knows it, for its report: history.csv, and micro.csv and
/// summary.json where they are there.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tangency/dem/scene/units.hpp>
#include <tangency/dem/tool/chart.hpp>
#include <tangency/dem/tool/history.hpp>
#include <tangency/dem/tool/summary.hpp>

namespace tangency::inline v0::dem {

/// A change of a cell's shape.
struct Distortion {
  std::string_view strain;  ///< its column, in history.csv and micro.csv
  std::string_view name;    ///< "axial strain"
  /// Of a shear strain: the columns of the shear stress and of the normal stress across the layers
  /// of a simple shear; else empty.
  std::string_view shear_stress = {}, normal_stress = {};
};

/// The three of them that shear.
inline constexpr std::array<Distortion, 3> kShears{
    {{"shear_strain_xy", "shear strain xy", "s_xy", "s_yy"},
     {"shear_strain_yz", "shear strain yz", "s_yz", "s_zz"},
     {"shear_strain_zx", "shear strain zx", "s_zx", "s_zz"}}};

class ReportedRun {
 public:
  /// @throws OutputError    a history without a row
  /// @throws tables::Error  a file that cannot be read
  explicit ReportedRun(const std::filesystem::path& directory);

  /// Nothing of a run that is not complete.
  const std::optional<SummaryLines>& summary() const { return summary_; }
  /// Empty names where the scene had none, or the run is not complete.
  const Units& units() const { return units_; }
  const std::vector<StageRows>& stages() const { return stages_; }

  double value(std::string_view name, std::size_t row) const { return history_.column(name)[row]; }
  std::vector<double> column(std::string_view name, const StageRows& rows) const;
  /// All rows, as one stage.
  StageRows all() const { return {"", 0, history_.size()}; }

  /// Not a number where no contact bears a force: what friction there would be is then unknown.
  std::vector<double> friction_angle(const StageRows& rows) const;
  /// s1 >= s2 >= s3, compression positive; in the plane s1 and s2, and s3 is not a number.
  std::array<std::vector<double>, 3> principal_stresses(const StageRows& rows) const;
  /// 2, or 3; a plane assembly has no stress across its plane.
  int dimensions() const;
  /// The strain by which a stage changes the shape of its cell most, that which its charts are
  /// drawn over; nothing where the cell keeps its shape.
  std::optional<Distortion> distortion(const StageRows& stage) const;
  /// Of the three shear strains the one that is largest in size.
  double largest_shear(std::size_t row) const;
  /// What the assembly was given since the run began: by its boundary, by gravity and by growth, of
  /// each the largest of any row up to there. What goes to and fro comes to nothing in the end.
  double work_done(std::size_t row) const;
  /// Stages in time.
  std::vector<Band> bands() const;

  /// Of rows of micro.csv in a stage the values of columns, each of one length; of length 0 without
  /// the file.
  std::vector<std::vector<double>> micro(const StageRows& stage,
                                         const std::vector<std::string_view>& names) const;

 private:
  std::filesystem::path directory_;
  History history_;
  std::vector<StageRows> stages_;
  std::optional<SummaryLines> summary_;
  Units units_;
};

}  // namespace tangency::inline v0::dem
