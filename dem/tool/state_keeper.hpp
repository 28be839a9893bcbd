// SPDX-License-Identifier: MIT
/// @file
/// The states that a run keeps beside its last one, DIR/states/NAME.state and its like (`save`,
/// `save_strains`, `save_points` of a stage).
///
/// A state of a stage's end, or of its start, is that before the first cycle of the next stage:
/// another scene of the same particles goes on from it as from final.state. Others are those after
/// a cycle of their stage.
///
/// Points B, C and D of a shear are known only at its end. Their cycles are then run once more from
/// A. That takes time, and neither memory nor anything that a state would have to carry: a run that
/// was resumed comes to the same files as one that went through, since a cycle depends on the state
/// before it alone. Each state is compared with its row of history.csv.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <tangency/dem/simulation.hpp>
#include <tangency/dem/tool/history.hpp>
#include <tangency/dem/tool/shear_points.hpp>

namespace tangency::inline v0::dem {

/// Where A, B, C and D of a stage lie.
struct StagePoints {
  struct Point {
    std::int64_t cycle;
    double axial_strain;
    std::optional<std::size_t> row;  ///< of the history; none of A
  };
  std::array<Point, 4> points;
  bool d_is_last_row;
};
inline constexpr std::array kPointNames{"A", "B", "C", "D"};

/// The points of the last stage of that name in a history, by the state at its start in `folder`.
/// Nothing where that state is not there or of another run.
std::optional<StagePoints> points_of_stage(const History& history, const std::string& stage,
                                           const std::filesystem::path& folder);

/// The file of a point.
std::filesystem::path file_of_point(const std::filesystem::path& folder, const std::string& stage,
                                    std::size_t point);

class StateKeeper {
 public:
  /// @param last_cycle  states of later cycles are taken away; -1: all are
  StateKeeper(const std::filesystem::path& directory, std::int64_t last_cycle,
              const Simulation& simulation);

  /// DIR/states.
  const std::filesystem::path& folder() const { return folder_; }

  /// All that writes throws WriteError.
  ///
  /// When a run begins: the state it begins with, if that is one to keep. In the run's own
  /// directory, too, what the last cycle before it should have kept and could not write.
  void begin(const Simulation& simulation);
  /// When a run begins in its own directory: strains of the stage that were passed before and have
  /// no state, as those that the scene did not have then.
  const std::vector<double>& missed_strains() const { return missed_; }
  /// After each next_stage().
  void after_stage(const Simulation& simulation);
  void after_cycle(const Simulation& simulation);

  /// How points were kept.
  struct Outcome {
    bool was_stopped = false;  ///< nothing has changed then but files of points
    std::string problem{};     ///< why they could not be; empty where they were
  };
  /// B, C and D of the stage, which is at its end.
  /// @param history  up to the stage's last row
  /// @param goes_on  asked before each cycle that is run once more, with the share of them that is
  ///                 done; false stops
  Outcome keep_points(const Simulation& simulation, const History& history,
                      const std::function<bool(double share)>& goes_on);

 private:
  std::filesystem::path file_of(const std::string& stage, const std::string& suffix = {}) const;
  std::filesystem::path file_of_strain(const Stage& stage, std::size_t k) const;
  void keep(const Simulation& simulation, const std::filesystem::path& file) const;
  void keep_start(const Simulation& simulation) const;
  void make_up_for_stage(const Simulation& simulation);
  Outcome run_again(const Simulation& simulation, const History& history, const StagePoints& points,
                    const std::function<bool(double share)>& goes_on);

  std::filesystem::path folder_;
  bool carries_on_;              ///< in the run's own directory
  std::size_t next_strain_ = 0;  ///< of the stage's save_strains
  std::vector<double> missed_;
};

}  // namespace tangency::inline v0::dem
