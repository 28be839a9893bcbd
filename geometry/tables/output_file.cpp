// SPDX-License-Identifier: MIT
#include <tangency/geometry/tables/output_file.hpp>

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <mutex>
#include <string>
#include <system_error>

namespace tangency::inline v0::tables {
namespace {

/// A file that a signal must remove. Fixed storage, because a signal handler may neither allocate
/// nor read what another thread is freeing.
struct Unfinished {
  std::atomic<bool> claimed{false};
  std::atomic<bool> exists{false};
  std::array<char, PATH_MAX> path{};
};

// Chosen: a program writes one table, or a corpus and its truth, at a time.
std::array<Unfinished, 8> all_unfinished;

extern "C" void remove_unfinished_files(int signal) {
  for (const Unfinished& file : all_unfinished) {
    if (file.exists) ::unlink(file.path.data());
  }
  ::raise(signal);  // SA_RESETHAND has restored the default action, which ends the process
}

void install_signal_handlers() {
  for (const int signal : {SIGHUP, SIGINT, SIGTERM}) {
    struct sigaction action {};
    ::sigaction(signal, nullptr, &action);
    if (action.sa_handler != SIG_DFL) continue;  // ignored, as under nohup, or the program's own
    action.sa_handler = remove_unfinished_files;
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    ::sigaction(signal, &action, nullptr);
  }
}

/// No signal is handled between creating a file and noting that it exists.
class SignalsHeld {
 public:
  SignalsHeld() {
    sigset_t all;
    ::sigfillset(&all);
    ::pthread_sigmask(SIG_BLOCK, &all, &before_);
  }
  ~SignalsHeld() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalsHeld(const SignalsHeld&) = delete;
  SignalsHeld& operator=(const SignalsHeld&) = delete;

 private:
  sigset_t before_;
};

[[noreturn]] void fail_to_write(const std::string& name, int problem, bool is_standard_output) {
  const Fault fault{.file = name,
                    .rule = "cannot be written: " + std::generic_category().message(problem)};
  if (problem == EPIPE && is_standard_output) throw ReaderHasGone(fault);
  throw Error(fault);
}

}  // namespace

/// One entry of all_unfinished, held for as long as the file is not committed.
class OutputFile::Placeholder {
 public:
  Placeholder() {
    static std::once_flag handlers_installed;
    std::call_once(handlers_installed, install_signal_handlers);
    for (Unfinished& file : all_unfinished) {
      if (!file.claimed.exchange(true)) {
        file_ = &file;
        return;
      }
    }
    errno = EMFILE;
  }
  ~Placeholder() {
    if (file_ == nullptr) return;
    if (file_->exists) ::unlink(path());
    file_->exists = false;
    file_->claimed = false;
  }
  Placeholder(const Placeholder&) = delete;
  Placeholder& operator=(const Placeholder&) = delete;

  const char* path() const noexcept { return file_->path.data(); }

  /// Creates FILE.partial-PID, or with `+` behind it where that name is taken.
  Descriptor create(const std::string& target) {
    if (file_ == nullptr) return Descriptor();
    std::string name = target + ".partial-" + std::to_string(::getpid());
    for (int attempt = 0; attempt < 100; ++attempt, name += '+') {
      if (name.size() >= file_->path.size()) {
        errno = ENAMETOOLONG;
        return Descriptor();
      }
      std::copy_n(name.c_str(), name.size() + 1, file_->path.begin());
      const SignalsHeld held;
      const int output = ::open(path(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (output >= 0) file_->exists = true;
      if (output >= 0 || errno != EEXIST) return Descriptor(output);
    }
    return Descriptor();
  }

  bool rename_to(const std::string& target) noexcept {
    if (::rename(path(), target.c_str()) != 0) return false;
    file_->exists = false;
    return true;
  }

 private:
  Unfinished* file_ = nullptr;
};

void end_by_broken_pipe() noexcept {
  ::signal(SIGPIPE, SIG_DFL);
  sigset_t one;
  ::sigemptyset(&one);
  ::sigaddset(&one, SIGPIPE);
  ::pthread_sigmask(SIG_UNBLOCK, &one, nullptr);
  ::raise(SIGPIPE);
  ::_exit(128 + SIGPIPE);
}

void flush_standard_output() {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  fail_to_write(std::string(kStandardOutputName), errno != 0 ? errno : EIO, true);
}

OutputFile::OutputFile(const std::string& path) {
  if (path.empty() || path == "-") {
    name_ = kStandardOutputName;
    output_ = Descriptor(STDOUT_FILENO);
    return;
  }
  name_ = path;
  struct stat there {};
  const bool exists = ::stat(path.c_str(), &there) == 0;
  if (exists && !S_ISREG(there.st_mode)) {
    output_ = Descriptor(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
    if (!output_.is_open()) fail(errno);
    return;
  }
  std::error_code unresolved;
  target_ = exists ? std::filesystem::canonical(path, unresolved).string() : path;
  if (unresolved) fail(unresolved.value());
  placeholder_ = std::make_unique<Placeholder>();
  output_ = placeholder_->create(target_);
  if (!output_.is_open()) fail(errno);
  if (exists) ::fchmod(output_.get(), there.st_mode & 07777);
}

OutputFile::~OutputFile() = default;

void OutputFile::fail(int problem) const {
  fail_to_write(name_, problem, output_.get() == STDOUT_FILENO);
}

void OutputFile::write(std::string_view text) {
  if (!write_all(output_.get(), text)) fail(errno);
}

void OutputFile::commit() {
  if (!output_.close()) fail(errno);
  if (placeholder_ && !placeholder_->rename_to(target_)) fail(errno);
  placeholder_.reset();
}

bool OutputFile::is_terminal() const noexcept { return ::isatty(output_.get()) == 1; }

}  // namespace tangency::inline v0::tables
