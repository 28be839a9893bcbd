// SPDX-License-Identifier: MIT
/// @file
/// A file that appears whole or not at all; and standard output, whose reader may go.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include <tangency/geometry/tables/csv.hpp>
#include <tangency/geometry/tables/descriptor.hpp>

namespace tangency::inline v0::tables {

/// What standard output is called in messages.
inline constexpr std::string_view kStandardOutputName = "<stdout>";

/// Standard output is a pipe that nobody reads any longer, as of `| head`: no failure to speak of.
class ReaderHasGone : public Error {
 public:
  using Error::Error;
};

/// Ends the process as if it had never ignored SIGPIPE, without a word and with what shells call
/// status 141. main() calls it for ReaderHasGone, once nothing is left to clean up.
[[noreturn]] void end_by_broken_pipe() noexcept;

/// Writes out what std::printf and std::cout still hold.
/// @throws Error, ReaderHasGone  for this or for what they could not write before
void flush_standard_output();

/// Written beside its final place under a name of its own and renamed by commit(), so that a file
/// that was there before stays as it was until then. The unfinished file is removed by the
/// destructor and on SIGHUP, SIGINT and SIGTERM, whose default action then follows; only a process
/// that is killed outright leaves it, as FILE.partial-PID.
///
/// A place that is no regular file, /dev/null or a named pipe, is written to directly. A symbolic
/// link stays one. A program whose output may be a pipe ignores SIGPIPE, so that a reader that has
/// gone is an Error here, of standard output a ReaderHasGone.
class OutputFile {
 public:
  /// @param path  `-` or nothing for standard output
  /// @throws Error  the file cannot be created
  explicit OutputFile(const std::string& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// @throws Error  naming the file and the system's reason: a full disk
  /// @throws ReaderHasGone
  void write(std::string_view text);
  /// Gives the file its name. Nothing may be written afterwards.
  /// @throws Error
  void commit();

  /// As given, or `<stdout>`.
  const std::string& name() const noexcept { return name_; }
  bool is_terminal() const noexcept;

 private:
  class Placeholder;

  [[noreturn]] void fail(int problem) const;

  std::string name_;
  std::string target_;
  Descriptor output_;
  std::unique_ptr<Placeholder> placeholder_;  // empty when written to directly
};

}  // namespace tangency::inline v0::tables
