// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A program as the subject of a hunt: tables in and out, a process a batch, as `grade` asks it.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <span>
#include <string>
#include <utility>

#include <tangency/verify/answers/tool_run.hpp>
#include <tangency/verify/hunt/subject.hpp>

namespace tangency::inline v0::verify {

/// What a tool answers is read as `grade` reads it: a row of its header's columns a pair, in any
/// order. An empty cell is not said, a cell that is neither empty nor a number or word of its
/// column makes the answer unreadable, and a row that is not there has no answer.
///
/// A batch that ends the program, hangs it or makes it print without end is asked again by halves,
/// so that one pair alone is without an answer. A batch that runs when the hunt has to end is ended
/// too, and its pairs are not answered.
class ToolSubject final : public Subject {
 public:
  /// @param command  for the shell
  /// @param seconds  that a batch may take
  /// @param stopped  the hunt has to end: no batch is begun any more
  ToolSubject(std::string command, double seconds, const std::atomic<bool>& stopped)
      : command_(std::move(command)), seconds_(seconds), stopped_(&stopped) {}

  Answers answers(std::span<const EllipsoidPair> pairs) override;

  /// The time at which a batch that runs is ended, and from which on none is begun.
  void end_at(std::chrono::steady_clock::time_point end) { end_ = end; }
  bool has_to_end() const { return *stopped_ || std::chrono::steady_clock::now() >= end_; }
  /// How often the program was started.
  std::size_t starts() const { return starts_; }
  /// How many pairs have an answer so far.
  std::size_t answered() const { return answered_; }
  /// How the last run ended that did not end by itself or answered nothing, with the program's last
  /// words; empty before that.
  const std::string& last_trouble() const { return trouble_; }
  /// A header was read?
  bool says_columns() const { return header_; }
  /// Has a column that is a word: relation or overlaps; a gap; a gap and its bound; a normal?
  bool says_words() const { return words_; }
  bool says_gaps() const { return gaps_; }
  bool says_bounds() const { return bounds_; }
  bool says_normals() const { return normals_; }

 private:
  void ask(std::span<const EllipsoidPair> pairs, Answers& answers);
  double time_left() const;
  void read(const ToolRun& run, std::size_t count, Answers& answers);
  std::string read_table(const std::string& text, Answers& answers);

  std::string command_;
  double seconds_;
  const std::atomic<bool>* stopped_;
  std::chrono::steady_clock::time_point end_ = std::chrono::steady_clock::time_point::max();
  std::size_t batch_ = 64;  // chosen: grows where the program is fast
  std::size_t starts_ = 0, answered_ = 0;
  std::string trouble_;
  bool header_ = false, words_ = false, gaps_ = false, bounds_ = false, normals_ = false;
};

}  // namespace tangency::inline v0::verify
