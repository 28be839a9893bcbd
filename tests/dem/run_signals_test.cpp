// SPDX-License-Identifier: GPL-3.0-or-later
/// Signals to a running `tangency-dem`, and its name among the processes.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <thread>

#include "../tool/process.hpp"
#include "scenes.hpp"

namespace tangency::test {
namespace {

/// `tangency-dem run SCENE --out OUT --quiet` with HUP as given, caught up with once it catches
/// signals.
class Started {
 public:
  Started(const std::string& scene, const std::string& out, void (*on_hup)(int)) {
    pid_ = ::fork();
    if (pid_ == 0) {
      for (const int number : {SIGINT, SIGTERM}) ::signal(number, SIG_DFL);
      ::signal(SIGHUP, on_hup);
      ::unsetenv("OMP_WAIT_POLICY");
      ::dup2(::open("/dev/null", O_WRONLY), STDERR_FILENO);
      ::execl(TANGENCY_TOOL, TANGENCY_TOOL, "run", scene.c_str(), "--out", out.c_str(), "--quiet",
              nullptr);
      ::_exit(127);
    }
    while (!is_in("SigCgt:", SIGINT) && !is_gone())
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  ~Started() {
    if (pid_ > 0) ::kill(pid_, SIGKILL), ::waitpid(pid_, nullptr, 0);
  }
  Started(const Started&) = delete;
  Started& operator=(const Started&) = delete;

  std::string of_proc(const std::string& file) const {
    return read_file("/proc/" + std::to_string(pid_) + "/" + file);
  }
  /// Is the signal in a set of /proc/PID/status?
  bool is_in(const std::string& set, int number) const {
    const std::string status = of_proc("status");
    const std::size_t at = status.find(set);
    return at != status.npos &&
           (std::stoull(status.substr(at + set.size()), nullptr, 16) >> (number - 1) & 1u) != 0;
  }
  /// Sends a signal; the exit status.
  int end_by(int number) {
    ::kill(pid_, number);
    int status = 0;
    ::waitpid(pid_, &status, 0);
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  bool is_gone() const { return of_proc("status").find("Z (zombie)") != std::string::npos; }

  pid_t pid_ = -1;
};

std::string scene_of(const TemporaryFolder& folder, const std::string& count) {
  return folder.write("scene.toml", with(small_scene(), "count = 27", "count = " + count));
}

TEST(RunSignals, EndARunThatTheyFindInItsCycles) {
  for (const int number : {SIGHUP, SIGINT, SIGTERM}) {
    const TemporaryFolder folder;
    Started run(scene_of(folder, "1000"), folder.path("out"), SIG_DFL);
    while (!std::filesystem::exists(folder.path("out/frames.pvd")))
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    EXPECT_EQ(run.end_by(number), 128 + number);
    EXPECT_TRUE(std::filesystem::exists(folder.path("out/checkpoint.state")));
  }
}

TEST(RunSignals, WhileTheSampleIsPlacedLeaveEarlierResultsAlone) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path("out"));
  folder.write("out/summary.json", "earlier");
  Started run(scene_of(folder, "200000"), folder.path("out"), SIG_DFL);
  EXPECT_EQ(run.end_by(SIGINT), 128 + SIGINT);
  EXPECT_EQ(read_file(folder.path("out/summary.json")), "earlier");
}

TEST(RunSignals, ThatTheParentIgnoredStayIgnored) {
  const TemporaryFolder folder;
  Started run(scene_of(folder, "1000"), folder.path("out"), SIG_IGN);
  EXPECT_TRUE(run.is_in("SigCgt:", SIGTERM));
  EXPECT_TRUE(run.is_in("SigIgn:", SIGHUP));
  EXPECT_TRUE(run.is_in("SigIgn:", SIGPIPE));  // a reader of the progress that has gone
  EXPECT_TRUE(run.is_in("SigIgn:", SIGXFSZ));
  EXPECT_EQ(run.end_by(SIGTERM), 128 + SIGTERM);
}

TEST(RunSignals, FindTheProcessUnderItsName) {
  const TemporaryFolder folder;
  Started run(scene_of(folder, "1000"), folder.path("out"), SIG_DFL);
  EXPECT_EQ(run.of_proc("comm"), "tangency-dem\n");
  EXPECT_NE(run.of_proc("environ").find("OMP_WAIT_POLICY"), std::string::npos) << "started again";
}

}  // namespace
}  // namespace tangency::test
