// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/answers/tool_run.hpp>

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/timerfd.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>
#include <string_view>
#include <system_error>
#include <utility>

#include <tangency/geometry/tables/csv.hpp>
#include <tangency/geometry/tables/descriptor.hpp>

namespace tangency::inline v0::verify {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kShell = "/bin/sh";

// Chosen: what is kept of standard error to find its last line in.
constexpr std::size_t kLastWords = 2000;

[[noreturn]] void fail(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

// From its start.
tables::Descriptor in_memory(std::string_view text) {
  tables::Descriptor table(::memfd_create("inputs", MFD_CLOEXEC));
  if (!table.is_open()) fail("no file in memory");
  if (!tables::write_all(table.get(), text)) fail("inputs cannot be kept in memory");
  ::lseek(table.get(), 0, SEEK_SET);
  return table;
}

struct Pipe {
  tables::Descriptor ours, theirs;
  Pipe() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) fail("no pipe");
    ours = tables::Descriptor(ends[0]);
    theirs = tables::Descriptor(ends[1]);
  }
};

// Those that end this program and are not ignored, held back while it lives: a tool in a group of
// its own is ended before they are obeyed. And SIGCHLD, which tells of the tool's end.
class HeldSignals {
 public:
  HeldSignals() {
    sigset_t held, child;
    ::sigemptyset(&held);
    for (const int signal : {SIGHUP, SIGINT, SIGTERM}) {
      struct sigaction action {};
      if (::sigaction(signal, nullptr, &action) != 0) fail("signals cannot be asked about");
      if (action.sa_handler != SIG_IGN) ::sigaddset(&held, signal);
    }
    ::sigemptyset(&child);
    ::sigaddset(&child, SIGCHLD);
    ::signal(SIGCHLD, SIG_DFL);  // ignored, it would tell nothing
    arrivals_ = tables::Descriptor(::signalfd(-1, &held, SFD_CLOEXEC));
    ends_ = tables::Descriptor(::signalfd(-1, &child, SFD_CLOEXEC | SFD_NONBLOCK));
    if (!arrivals_.is_open() || !ends_.is_open() ||
        ::sigprocmask(SIG_BLOCK, &held, &before_) != 0 ||
        ::sigprocmask(SIG_BLOCK, &child, nullptr) != 0) {
      fail("signals cannot be held back");
    }
  }
  ~HeldSignals() { restore(); }
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;

  void restore() const { ::sigprocmask(SIG_SETMASK, &before_, nullptr); }
  int arrivals() const { return arrivals_.get(); }  // readable once one has come
  int ends() const { return ends_.get(); }          // readable once a child has ended

 private:
  tables::Descriptor arrivals_, ends_;
  sigset_t before_{};
};

// Readable after so many seconds.
tables::Descriptor timer(double seconds) {
  constexpr double kLongest = 1e9;  // chosen: a life
  const double whole = std::floor(std::min(seconds, kLongest));
  itimerspec after{};
  after.it_value.tv_sec = static_cast<time_t>(whole);
  after.it_value.tv_nsec =
      std::max(1L, static_cast<long>(1e9 * (std::min(seconds, kLongest) - whole)));
  tables::Descriptor up(::timerfd_create(CLOCK_MONOTONIC, TFD_CLOEXEC));
  if (!up.is_open() || ::timerfd_settime(up.get(), 0, &after, nullptr) != 0) fail("no timer");
  return up;
}

pid_t start(const std::string& command, int input, int output, int error,
            const HeldSignals& signals) {
  const pid_t child = ::fork();
  if (child < 0) fail("no process for the tool");
  if (child > 0) {
    ::setpgid(child, child);  // whichever of the two comes first
    return child;
  }
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // a grade that is killed outright takes the shell along
  for (const int signal : {SIGPIPE, SIGINT, SIGTERM, SIGHUP}) ::signal(signal, SIG_DFL);
  signals.restore();
  ::dup2(input, STDIN_FILENO);
  ::dup2(output, STDOUT_FILENO);
  ::dup2(error, STDERR_FILENO);
  ::execl(kShell, "sh", "-c", command.c_str(), nullptr);
  ::_exit(127);
}

class Watch {
 public:
  Watch(pid_t tool, Pipe& output, Pipe& error, const HeldSignals& signals, ToolRun& run,
        const ToolLimits& limits)
      : tool_(tool), limits_(limits), run_(run) {
    output.theirs.close();
    error.theirs.close();
    if (limits.deadline < 0) timer_ = timer(limits.seconds);
    events_ = {{{output.ours.get(), POLLIN, 0},
                {error.ours.get(), POLLIN, 0},
                {signals.ends(), POLLIN, 0},
                {signals.arrivals(), POLLIN, 0},
                {limits.deadline < 0 ? timer_.get() : limits.deadline, POLLIN, 0}}};
  }

  // Then all that it started and that stayed in its group is ended too. What was written up to then
  // is read, and nothing that comes later.
  void until_it_ends() {
    while (!stopped_ && !ended_) wait_for_an_event();
    ::kill(-tool_, SIGKILL);
    if (!ended_) ::waitpid(tool_, &status_, 0);
    for (std::size_t i = 0; i < kPipes; ++i) read_what_is_left(i);
    if (!stopped_ && bytes_ > limits_.most_bytes) stop_at_bytes();
    if (!stopped_) describe_end();
    run_.seconds = elapsed();
    run_.last_words = last_line();
  }

 private:
  static std::string shown(double seconds) {
    std::string text = std::to_string(seconds);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.ends_with('.')) text.pop_back();
    return text;
  }
  double elapsed() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }
  void stop(std::string why) {
    stopped_ = true;
    run_.sound = false;
    run_.ending = std::move(why);
  }
  void describe_end() {
    const int code = WIFEXITED(status_) ? WEXITSTATUS(status_) : 0;
    // A shell tells of a signal that ended its program by 128 and the signal's number.
    const bool is_told = code > 128 && code <= 128 + SIGSYS;
    const int signal = !WIFEXITED(status_) ? WTERMSIG(status_) : is_told ? code - 128 : 0;
    run_.sound = signal == 0;
    run_.ending = run_.sound ? "ended with status " + std::to_string(code)
                             : "was ended by signal " + std::to_string(signal) + " (" +
                                   ::strsignal(signal) + ")";
  }
  void stop_at_bytes() {
    stop("printed more than " + std::to_string(limits_.most_bytes) + " bytes");
  }
  void wait_for_an_event() {
    // A closed end is asked no more: poll skips negative descriptors.
    if (::poll(events_.data(), events_.size(), -1) <= 0) return;
    for (std::size_t i = 0; i < kPipes; ++i) {
      if (events_[i].fd >= 0 && events_[i].revents != 0) read_some(i, buffer_.size());
    }
    if (bytes_ > limits_.most_bytes) stop_at_bytes();
    if (events_[kEnds].revents != 0) {
      signalfd_siginfo told;
      [[maybe_unused]] const ssize_t got = ::read(events_[kEnds].fd, &told, sizeof told);
      ended_ = ::waitpid(tool_, &status_, WNOHANG) == tool_;
    }
    if (!ended_ && events_[kDeadline].revents != 0) {
      stop("had not ended after " + shown(limits_.seconds) + " s");
    }
    if (events_[kArrivals].revents != 0) stop("was interrupted");
  }
  // False at the end.
  bool read_some(std::size_t i, std::size_t most) {
    const ssize_t got = ::read(events_[i].fd, buffer_.data(), std::min(most, buffer_.size()));
    if (got <= 0) {
      events_[i].fd = -1;
      return false;
    }
    keep(i == 0, {buffer_.data(), static_cast<std::size_t>(got)});
    return true;
  }
  // What a pipe holds: it may be filled again by what has left the group.
  void read_what_is_left(std::size_t i) {
    int left = 0;
    if (events_[i].fd < 0 || ::ioctl(events_[i].fd, FIONREAD, &left) != 0) return;
    const std::size_t end = read_ + static_cast<std::size_t>(left);
    while (read_ < end && read_some(i, end - read_)) {
    }
  }
  void keep(bool is_output, std::string_view text) {
    read_ += text.size();
    if (is_output) {
      bytes_ += text.size();
      run_.output += text;
    } else {
      words_ += text;
      if (words_.size() > kLastWords) words_.erase(0, words_.size() - kLastWords);
    }
  }
  std::string last_line() const {
    const std::size_t end = words_.find_last_not_of(" \t\r\n");
    if (end == std::string::npos) return {};
    std::string line = words_.substr(0, end + 1);
    line.erase(0, line.rfind('\n') + 1);
    for (char& c : line) c = static_cast<unsigned char>(c) < 0x20 ? '?' : c;
    return line;
  }

  pid_t tool_;
  ToolLimits limits_;
  ToolRun& run_;
  Clock::time_point begin_ = Clock::now();
  static constexpr std::size_t kPipes = 2, kEnds = 2, kArrivals = 3, kDeadline = 4;
  tables::Descriptor timer_;
  std::array<pollfd, 5> events_{};
  std::array<char, 1 << 16> buffer_{};
  std::size_t bytes_ = 0, read_ = 0;  // of standard output, and of both
  std::string words_;
  bool ended_ = false, stopped_ = false;
  int status_ = 0;
};

}  // namespace

std::string inputs_for_a_tool(std::string_view table) {
  std::string kept;
  while (!table.empty()) {
    const std::string_view line = table.substr(0, table.find('\n'));
    const std::size_t first = line.find_first_not_of(" \t");
    if (first == line.npos || line[first] != '#') kept.append(line) += '\n';
    table.remove_prefix(std::min(line.size() + 1, table.size()));
  }
  return kept;
}

ToolRun run_tool(const std::string& command, std::string_view inputs, const ToolLimits& limits) {
  if (::access(kShell, X_OK) != 0) {
    throw tables::Error({.file = "--tool",
                         .rule = std::string("there is no ") + kShell +
                                 " here, which starts a tool: run it elsewhere, and have its table "
                                 "graded with --answers"});
  }
  const tables::Descriptor table = in_memory(inputs_for_a_tool(inputs));
  ToolRun run{{}, false, {}, {}, 0};
  Pipe output, error;
  const HeldSignals signals;
  const pid_t tool = start(command, table.get(), output.theirs.get(), error.theirs.get(), signals);
  Watch(tool, output, error, signals, run, limits).until_it_ends();
  return run;
}

}  // namespace tangency::inline v0::verify
