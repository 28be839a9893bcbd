// SPDX-License-Identifier: MIT
/// @file
/// Whole files: read at once, and written so that they appear whole or not at all.
#pragma once

#include <cerrno>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace tangency::inline v0::dem {

/// A file that cannot be read or written; what() is one line that starts with its name and ends
/// with the system's reason.
class FileError : public std::runtime_error {
 public:
  /// @param file  its path
  /// @param done     "read", "written"
  /// @param problem  an errno
  FileError(const std::filesystem::path& file, const char* done, int problem);
  /// As errno has it.
  int problem() const noexcept { return problem_; }

 private:
  int problem_;
};

/// A file that cannot be read.
class ReadError : public FileError {
 public:
  /// @param file  its path
  /// @param problem  as errno has it
  ReadError(const std::filesystem::path& file, int problem) : FileError(file, "read", problem) {}
};

/// A file that cannot be written.
class WriteError : public FileError {
 public:
  /// @param file  its path
  /// @param problem  as errno has it
  explicit WriteError(const std::filesystem::path& file, int problem = errno)
      : FileError(file, "written", problem) {}
};

/// A file's bytes; a pipe's until it is closed.
/// @throws ReadError
std::string bytes_of_file(const std::filesystem::path& file);

/// The same; nothing for a file that cannot be read.
std::optional<std::string> read_whole(const std::filesystem::path& file);

/// A file that is being written as FILE.part: a failure leaves an old file as it was.
class WholeFile {
 public:
  /// @throws WriteError  as all that writes
  explicit WholeFile(std::filesystem::path file);
  /// Without publish() takes the part away.
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  /// Appends bytes. @throws WriteError
  void write(std::string_view bytes);
  /// Gives the file its name.
  void publish();

 private:
  std::filesystem::path file_, part_;
  int out_ = -1;  ///< open until published
};

/// The same of bytes that are there.
/// @throws WriteError
void write_whole(const std::filesystem::path& file, std::string_view bytes);

/// Makes `to` a second name of a file: a hard link, which takes no room. False where that cannot
/// be, as between file systems; `to` is then as it was.
bool link_whole(const std::filesystem::path& file, const std::filesystem::path& to) noexcept;

/// Writes to an open file, `name` in messages.
/// @throws WriteError
void write_all(int file, std::string_view bytes, const std::filesystem::path& name);

}  // namespace tangency::inline v0::dem
