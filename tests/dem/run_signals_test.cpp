// SPDX-License-Identifier: GPL-3.0-or-later
/// Signals to a running `tangency-dem`, and its name among the processes.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "../tool/process.hpp"
#include "scenes.hpp"

namespace tangency::testing {
namespace {

/// `tangency-dem run SCENE --out OUT --quiet`, caught up with where it reads its scene, which it
/// does once it catches signals. There it stands still until give_scene().
class Started {
 public:
  explicit Started(const TemporaryFolder& folder, bool ignores_hangup = false)
      : run_(arguments(folder), place(ignores_hangup)),
        scene_(run_.meet_at(folder.path("scene.toml"), O_WRONLY)) {
    EXPECT_GE(scene_, 0);
  }
  ~Started() { ::close(scene_); }
  Started(const Started&) = delete;
  Started& operator=(const Started&) = delete;

  std::string of_proc(const std::string& file) const {
    return read_file("/proc/" + std::to_string(run_.id()) + "/" + file);
  }
  /// Is the signal in a set of /proc/PID/status?
  bool is_in(const std::string& set, int number) const {
    const std::string status = of_proc("status");
    const std::size_t at = status.find(set);
    return at != status.npos &&
           (std::stoull(status.substr(at + set.size()), nullptr, 16) >> (number - 1) & 1u) != 0;
  }
  Process& process() { return run_; }
  void give_scene(const std::string& text) {
    ASSERT_EQ(::write(scene_, text.data(), text.size()), std::ssize(text));
    ::close(std::exchange(scene_, -1));
  }

 private:
  static std::vector<std::string> arguments(const TemporaryFolder& folder) {
    return {"run", make_pipe(folder.path("scene.toml")), "--out", folder.path("out"), "--quiet"};
  }
  static Process::Place place(bool ignores_hangup) {
    Process::Place place;
    place.ignores_hangup = ignores_hangup;
    return place;
  }

  Process run_;
  int scene_;
};

TEST(RunSignals, EndARunThatTheyFindInItsCycles) {
  for (const int number : {SIGHUP, SIGINT, SIGTERM}) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder.path("out"));
    // Signalled in its first checkpoint, between the write of the history and that of the state.
    const std::string history = make_pipe(folder.path("out/history.csv.part")),
                      state = make_pipe(folder.path("out/checkpoint.state.part"));
    Started run(folder);
    std::string scene = small_scene();
    scene += "checkpoint_interval = 50\n";
    run.give_scene(scene);
    const int reader = run.process().meet_at(history, O_RDONLY);
    run.process().send(number);
    read_to_end(reader);
    read_to_end(run.process().meet_at(state, O_RDONLY));
    EXPECT_EQ(run.process().wait().status, 128 + number);
    EXPECT_TRUE(std::filesystem::is_regular_file(folder.path("out/checkpoint.state")));
  }
}

TEST(RunSignals, BeforeTheFirstCycleLeaveEarlierResultsAlone) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path("out"));
  folder.write("out/summary.json", "earlier");
  Started run(folder);
  run.process().send(SIGINT);
  run.give_scene(small_scene());
  const Finished ended = run.process().wait();
  EXPECT_EQ(ended.status, 128 + SIGINT);
  EXPECT_EQ(ended.err, "tangency-dem: interrupted before the first cycle; nothing was written\n");
  EXPECT_EQ(read_file(folder.path("out/summary.json")), "earlier");
}

TEST(RunSignals, ThatTheParentIgnoredStayIgnored) {
  const TemporaryFolder folder;
  Started run(folder, true);
  EXPECT_TRUE(run.is_in("SigCgt:", SIGTERM));
  EXPECT_TRUE(run.is_in("SigIgn:", SIGHUP));
  EXPECT_TRUE(run.is_in("SigIgn:", SIGPIPE));  // a reader of the progress that has gone
  EXPECT_TRUE(run.is_in("SigIgn:", SIGXFSZ));
  run.process().send(SIGHUP);
  run.process().send(SIGTERM);
  run.give_scene(small_scene());
  EXPECT_EQ(run.process().wait().status, 128 + SIGTERM);
}

}  // namespace
}  // namespace tangency::testing
