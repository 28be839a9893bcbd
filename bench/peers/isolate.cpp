// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/bench/peers/isolate.hpp>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <new>
#include <system_error>
#include <type_traits>

namespace tangency::peers {
namespace {

static_assert(std::is_trivially_copyable_v<Isolated>, "written by one process, read by another");

/// Memory that children share: the answers, and how many pairs were begun.
class SharedAnswers {
 public:
  explicit SharedAnswers(std::size_t count)
      : bytes_(sizeof(std::size_t) + count * sizeof(Isolated)) {
    memory_ = mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory_ == MAP_FAILED) throw std::system_error(errno, std::generic_category(), "mmap");
    begun_ = new (memory_) std::size_t(0);
    answers_ = new (static_cast<char*>(memory_) + sizeof(std::size_t)) Isolated[count];
  }
  ~SharedAnswers() { munmap(memory_, bytes_); }
  SharedAnswers(const SharedAnswers&) = delete;
  SharedAnswers& operator=(const SharedAnswers&) = delete;

  std::size_t& begun() { return *begun_; }
  Isolated* answers() { return answers_; }

 private:
  std::size_t bytes_;
  void* memory_;
  std::size_t* begun_;
  Isolated* answers_;
};

void set_timer(double seconds) {
  itimerval timer{};
  timer.it_value.tv_sec = static_cast<time_t>(seconds);
  timer.it_value.tv_usec =
      static_cast<suseconds_t>((seconds - static_cast<double>(timer.it_value.tv_sec)) * 1e6);
  setitimer(ITIMER_PROF, &timer, nullptr);
}

/// The child: asks from the first pair that was not begun, until it ends or is ended.
[[noreturn]] void ask(std::span<const std::unique_ptr<PeerPair>> pairs, SharedAnswers& shared,
                      double patience) {
  std::signal(SIGABRT, SIG_DFL);
  std::signal(SIGPROF, SIG_DFL);
  dup2(open("/dev/null", O_WRONLY), STDERR_FILENO);
  while (shared.begun() < pairs.size()) {
    const std::size_t i = shared.begun()++;
    set_timer(patience);
    const auto contact = pairs[i]->contact();
    shared.answers()[i] = {contact ? Outcome::answered : Outcome::failed, contact};
  }
  _exit(0);
}

}  // namespace

std::vector<Isolated> ask_isolated(std::span<const std::unique_ptr<PeerPair>> pairs,
                                   double patience) {
  SharedAnswers shared(pairs.size());
  while (shared.begun() < pairs.size()) {
    const pid_t child = fork();
    if (child < 0) throw std::system_error(errno, std::generic_category(), "fork");
    if (child == 0) ask(pairs, shared, patience);
    int status = 0;
    waitpid(child, &status, 0);
    if (WIFSIGNALED(status) && shared.begun() > 0) {
      shared.answers()[shared.begun() - 1].outcome =
          WTERMSIG(status) == SIGPROF ? Outcome::hung : Outcome::aborted;
    }
  }
  return {shared.answers(), shared.answers() + pairs.size()};
}

}  // namespace tangency::peers
