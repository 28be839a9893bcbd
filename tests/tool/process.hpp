// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Runs the built `tangency` as a user does: a process with arguments, files and pipes.
#pragma once

#include <sys/resource.h>
#include <sys/types.h>

#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tangency::testing {

/// An empty folder that is removed with everything in it.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string path(std::string_view name) const { return (path_ / name).string(); }
  /// Writes a file and returns its path.
  std::string write(std::string_view name, std::string_view text) const;
  /// Names of everything in the folder, sorted.
  std::vector<std::string> names() const;

 private:
  std::filesystem::path path_;
};

std::string read_file(const std::string& path);

struct Finished {
  int status = -1;             ///< exit status; -1 when a signal ended the process
  int signal = 0;              ///< that signal
  std::size_t peak_bytes = 0;  ///< of memory, never below the caller's own when it started the tool
  std::string out;
  std::string err;
};

/// `tangency ARGUMENTS` with a pipe as standard input and pipes for both outputs.
class Process {
 public:
  struct Place {
    std::string folder{};            ///< working directory
    std::string standard_output{};   ///< a file to open in place of the pipe
    bool error_is_terminal = false;  ///< standard error is a pseudo-terminal
    bool reader_has_gone = false;    ///< of standard output, before the tool starts
    bool ignores_hangup = false;     ///< as under nohup
  };

  explicit Process(const std::vector<std::string>& arguments) : Process(arguments, Place()) {}
  Process(const std::vector<std::string>& arguments, const Place& place);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  void write_input(std::string_view text);
  void close_input();
  /// One line of standard output; waits for it. Empty at the end of the output.
  std::string read_output_line();
  void send(int signal);
  pid_t id() const { return pid_; }
  /// Opens a named pipe, which waits until the tool opens its other end; it stays there until this
  /// end is read from or written to. Where the tool has ended instead, nothing comes from there.
  /// @param how  O_RDONLY or O_WRONLY
  int meet_at(const std::string& pipe, int how);
  /// Collects what is left of both outputs, then the exit status. Leaves the input open.
  Finished wait();

 private:
  friend class FullPipe;

  pid_t pid_ = -1;
  int input_ = -1;
  int output_ = -1;
  int error_ = -1;
};

/// A new named pipe. A tool that opens it stands still until a test opens the other end, however
/// slow the machine is.
std::string make_pipe(const std::string& path);

/// A new named pipe that is full: a tool that writes to it stands still in the middle of the write.
class FullPipe {
 public:
  explicit FullPipe(const std::string& path);
  ~FullPipe();
  FullPipe(const FullPipe&) = delete;
  FullPipe& operator=(const FullPipe&) = delete;

  /// Waits until the tool has opened it; false where it has ended instead.
  bool is_met_by(const Process& tool) const;

 private:
  int pipe_, events_;
};

/// Reads a pipe to its end and closes it: what was written to it.
std::string read_to_end(int pipe);

/// Names that appear in a folder from now on.
class FolderWatch {
 public:
  explicit FolderWatch(const std::string& folder);
  ~FolderWatch();
  FolderWatch(const FolderWatch&) = delete;
  FolderWatch& operator=(const FolderWatch&) = delete;

  /// Waits for the next one.
  void wait() const;

 private:
  int events_;
};

/// Runs to the end with the given text on standard input.
Finished run_tool(const std::vector<std::string>& arguments, std::string_view input = "",
                  const Process::Place& place = Process::Place());

/// As on a full disk: no file grows beyond `bytes` while this lives, in tools started here too.
/// Tools that count what they run (tests/coverage) do not say that they cannot write the counts.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : action_(::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    if (const char* file = std::getenv(kCounts)) {
      counts_ = file;
      ::setenv(kCounts, "/dev/null", 1);
    }
  }
  ~FileSizeLimit() {
    if (counts_) ::setenv(kCounts, counts_->c_str(), 1);
    ::setrlimit(RLIMIT_FSIZE, &before_);
    ::signal(SIGXFSZ, action_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  static constexpr const char* kCounts = "LLVM_PROFILE_FILE";
  void (*action_)(int);
  rlimit before_{};
  std::optional<std::string> counts_;
};

}  // namespace tangency::testing
