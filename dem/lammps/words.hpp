// SPDX-License-Identifier: GPL-2.0-or-later
/// @file
/// The words of a command, read one after the other, and how wrong ones are refused.
#pragma once

#include <pointers.h>

#include <string>
#include <utility>

namespace tangency::inline v0::lammps {

/// What a command says after its first words. What is refused ends LAMMPS on all ranks with one
/// line,
///     fix tangency/move: damping = -1: a number >= 0
/// so every rank has to read the same words.
class Words : protected LAMMPS_NS::Pointers {
 public:
  /// @param lammps  whose errors end it
  /// @param command  in messages, as "fix tangency/move"
  /// @param count  of the words
  /// @param words  of the command, which has to outlive this
  /// @param from  where the first to read is
  Words(LAMMPS_NS::LAMMPS* lammps, std::string command, int count, char** words, int from)
      : Pointers(lammps), command_(std::move(command)), count_(count), words_(words), at_(from) {}

  /// Are there words left?
  bool any() const { return at_ < count_; }
  /// The next word. @param what  it should be, in the message where there is none
  std::string next(const std::string& what);
  /// Passes the next word where it is this one.
  bool skip(const std::string& word);
  /// The next word as a finite number.
  double number(const std::string& key);
  /// The same, >= 0.
  double not_negative(const std::string& key);
  /// The same, > 0.
  double positive(const std::string& key);
  /// The same, in [least, most]. @param allowed  that range, in the message
  double within(const std::string& key, double least, double most, const std::string& allowed);
  /// The next word, yes or no.
  bool yes(const std::string& key);

  /// Ends LAMMPS: `value` of `key` is not what is allowed.
  [[noreturn]] void refuse(const std::string& key, const std::string& value,
                           const std::string& allowed);
  /// Ends LAMMPS with a message of its own.
  [[noreturn]] void refuse(const std::string& message);

 private:
  std::string command_;
  int count_;
  char** words_;
  int at_;
};

}  // namespace tangency::inline v0::lammps
