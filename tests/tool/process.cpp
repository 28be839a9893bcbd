// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/tests/tool/process.hpp>

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/eventfd.h>
#include <sys/inotify.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>
#include <utility>

namespace tangency::testing {
namespace {

struct Ends {
  int ours = -1;
  int theirs = -1;
};

Ends pipe_ends(bool we_write) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("pipe2 failed");
  return we_write ? Ends{ends[1], ends[0]} : Ends{ends[0], ends[1]};
}

Ends terminal_ends() {
  Ends ends;
  ends.ours = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
  if (ends.ours < 0 || ::grantpt(ends.ours) != 0 || ::unlockpt(ends.ours) != 0) {
    throw std::runtime_error("no pseudo-terminal");
  }
  ends.theirs = ::open(::ptsname(ends.ours), O_RDWR | O_NOCTTY | O_CLOEXEC);
  return ends;
}

void close_end(int& end) {
  if (end >= 0) ::close(std::exchange(end, -1));
}

/// Appends what is there; closes the end, and returns false, once there will be no more.
bool drain(int& end, std::string& text) {
  if (end < 0) return false;
  std::array<char, 1 << 16> buffer;
  const ssize_t got = ::read(end, buffer.data(), buffer.size());
  if (got > 0) {
    text.append(buffer.data(), static_cast<std::size_t>(got));
  } else {
    close_end(end);
  }
  return end >= 0;
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "tangency-test-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("mkdtemp failed");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() { std::filesystem::remove_all(path_); }

std::string TemporaryFolder::write(std::string_view name, std::string_view text) const {
  std::ofstream(path_ / name, std::ios::binary) << text;
  return path(name);
}

std::vector<std::string> TemporaryFolder::names() const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(path_)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string read_file(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

Process::Process(const std::vector<std::string>& arguments, const Place& place) {
  Ends input = pipe_ends(true);
  Ends output = pipe_ends(false);
  Ends error = place.error_is_terminal ? terminal_ends() : pipe_ends(false);
  if (!place.standard_output.empty()) {
    close_end(output.theirs);
    output.theirs = ::open(place.standard_output.c_str(), O_WRONLY | O_CLOEXEC);
  }
  if (place.reader_has_gone) close_end(output.ours);
  std::vector<char*> argv{const_cast<char*>(TANGENCY_TOOL)};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  pid_ = ::fork();
  if (pid_ == 0) {
    for (const int signal : {SIGPIPE, SIGINT, SIGTERM, SIGHUP}) ::signal(signal, SIG_DFL);
    if (place.ignores_hangup) ::signal(SIGHUP, SIG_IGN);
    ::dup2(input.theirs, STDIN_FILENO);
    ::dup2(output.theirs, STDOUT_FILENO);
    ::dup2(error.theirs, STDERR_FILENO);
    if (!place.folder.empty() && ::chdir(place.folder.c_str()) != 0) ::_exit(126);
    ::execv(argv[0], argv.data());
    ::_exit(127);
  }
  for (Ends* ends : {&input, &output, &error}) close_end(ends->theirs);
  input_ = input.ours;
  output_ = output.ours;
  error_ = error.ours;
}

Process::~Process() {
  close_end(input_);
  close_end(output_);
  close_end(error_);
  if (pid_ > 0) {
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
}

void Process::write_input(std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(input_, text.data(), text.size());
    if (written < 0) return;  // the tool has refused its input and gone
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

void Process::close_input() { close_end(input_); }

std::string Process::read_output_line() {
  std::string line;
  for (char c = 0; c != '\n' && ::read(output_, &c, 1) == 1;) line += c;
  return line;
}

void Process::send(int signal) { ::kill(pid_, signal); }

int Process::meet_at(const std::string& pipe, int how) {
  ::signal(SIGPIPE, SIG_IGN);  // of this process, where it writes to a tool that has gone
  const int met = ::eventfd(0, EFD_CLOEXEC);
  // An end of the tool shows on its standard output, and lets the pipe be opened in its place.
  std::thread watch([&] {
    std::array<pollfd, 2> events{{{output_, 0, 0}, {met, POLLIN, 0}}};
    ::poll(events.data(), events.size(), -1);
    if (events[1].revents != 0) return;
    const int other = ::open(pipe.c_str(), O_RDWR | O_CLOEXEC);
    ::poll(&events[1], 1, -1);
    ::close(other);
  });
  const int end = ::open(pipe.c_str(), how | O_CLOEXEC);
  const std::uint64_t one = 1;
  [[maybe_unused]] const auto told = ::write(met, &one, sizeof one);
  watch.join();
  ::close(met);
  return end;
}

Finished Process::wait() {
  Finished finished;
  std::thread errors([&] {
    while (drain(error_, finished.err)) {
    }
  });
  while (drain(output_, finished.out)) {
  }
  errors.join();
  int status = 0;
  struct rusage used {};
  ::wait4(std::exchange(pid_, -1), &status, 0, &used);
  finished.peak_bytes = static_cast<std::size_t>(used.ru_maxrss) * 1024;
  if (WIFEXITED(status)) finished.status = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) finished.signal = WTERMSIG(status);
  return finished;
}

std::string make_pipe(const std::string& path) {
  if (::mkfifo(path.c_str(), 0600) != 0) throw std::runtime_error("mkfifo failed");
  return path;
}

FullPipe::FullPipe(const std::string& path)
    : pipe_(::open(make_pipe(path).c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC)),
      events_(::inotify_init1(IN_CLOEXEC)) {
  const std::string some(4096, ' ');
  while (::write(pipe_, some.data(), some.size()) > 0) {
  }
  if (::inotify_add_watch(events_, path.c_str(), IN_OPEN) < 0) throw std::runtime_error("no watch");
}

FullPipe::~FullPipe() {
  ::close(pipe_);
  ::close(events_);
}

bool FullPipe::is_met_by(const Process& tool) const {
  std::array<pollfd, 2> events{{{events_, POLLIN, 0}, {tool.output_, 0, 0}}};
  while (::poll(events.data(), events.size(), -1) < 0) {
  }
  return events[0].revents != 0 && events[1].revents == 0;
}

std::string read_to_end(int pipe) {
  std::string text;
  while (drain(pipe, text)) {
  }
  return text;
}

FolderWatch::FolderWatch(const std::string& folder) : events_(::inotify_init1(IN_CLOEXEC)) {
  if (::inotify_add_watch(events_, folder.c_str(), IN_CREATE | IN_MOVED_TO) < 0) {
    throw std::runtime_error("no watch");
  }
}

FolderWatch::~FolderWatch() { ::close(events_); }

void FolderWatch::wait() const {
  alignas(inotify_event) std::array<char, 4096> some;
  if (::read(events_, some.data(), some.size()) <= 0) throw std::runtime_error("no event");
}

Finished run_tool(const std::vector<std::string>& arguments, std::string_view input,
                  const Process::Place& place) {
  ::signal(SIGPIPE, SIG_IGN);  // of this process, for a tool that does not read its input
  Process tool(arguments, place);
  std::thread writer([&] {
    tool.write_input(input);
    tool.close_input();
  });
  Finished finished = tool.wait();
  writer.join();
  return finished;
}

}  // namespace tangency::testing
