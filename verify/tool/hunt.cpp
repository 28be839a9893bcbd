// SPDX-License-Identifier: GPL-3.0-or-later
#include <signal.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <tangency/geometry/tables/csv.hpp>
#include <tangency/geometry/tables/number_text.hpp>
#include <tangency/geometry/tables/output_file.hpp>
#include <tangency/geometry/tables/progress.hpp>
#include <tangency/verify/hunt/findings.hpp>
#include <tangency/verify/hunt/found_corpus.hpp>
#include <tangency/verify/hunt/tool_subject.hpp>
#include <tangency/verify/tool/command_line.hpp>
#include <tangency/verify/tool/row_choice.hpp>

namespace tangency::inline v0::verify {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr const char* kHelp = R"(
The tool is asked as by `tangency-verify grade`: tables on its standard input and output, some
hundred pairs a time. Pairs come from the corpora, from their families with a seed of their
own, and from pairs before them, moved towards what contact codes fear: touches, equal axes,
needles and discs, bodies of unlike size, parallel axes, deep overlaps, far origins. What is
true of them is worked out by exact numbers while the hunt goes on.

Goals, each with its faults; a wrong relation is a fault of all:
  relation     relation or overlaps are wrong, or for a tool that has neither the gap's sign
  gap          the gap is off by more than --max-gap-error times L, the distance of the centres
               and both largest semi-axes
  normal       the normal is off by more than --max-normal-error, or reversed
  certificate  the gap is off by more than the gap_error that the tool claims

With --not-claimed FEATURE,... the pairs that have one of these features are not judged, and none
is a start of others. Features are those of `grade` (touching, near, nested, deep); extreme is a
pair with a semi-axis 1000 times another of its body, bodies 1000 times as large as each other,
centres a million times L from the origin, or L beyond 1e-6 to 1e6.

Of every kind of fault the simplest pairs are kept, and made simpler as long as the fault stays:
round bodies at the origin, numbers of few digits. They are printed, and appended to
DIR/hunt.csv and DIR/hunt.truth.csv, which `grade --corpora DIR --corpus hunt` grades by. Rows
that are there stay; a pair that has a row gets no second one.

The same seed and tool give the same findings. Ctrl-C ends the search and shows what was found; a
second one ends at once. With --seconds S the search ends after S, and making its findings simple
after half of S more; a batch that then runs is ended and does not count. With --state the same
command later goes on where it was, and finds what it would have found without the break.

Exit status: 0 nothing found; 1 found; 2 refused command line or state, a tool that answers
nothing or nothing of the goal, no answer within --seconds or none that is claimed, or a failed
write.

Example:
  $ tangency-verify hunt --tool 'tangency contact' --goal certificate --answers 5000
)";

struct Options {
  std::string tool, corpora, state, out, not_claimed, goal = "relation";
  std::vector<std::string> from;
  Limits limits;
  std::uint64_t seed = 1;
  std::size_t answers = 20000;
  std::optional<double> seconds;
  double time_limit = 60;  // chosen: a batch of a slow tool takes some seconds
};

constexpr std::array<std::pair<std::string_view, Goal>, 4> kGoals{
    {{"relation", Goal::relation},
     {"gap", Goal::gap},
     {"normal", Goal::normal},
     {"certificate", Goal::certificate}}};

std::string check_goal(const std::string& name) {
  for (const auto& [known, goal] : kGoals) {
    if (name == known) return {};
  }
  return name + " is not a goal; relation, gap, normal and certificate are";
}

Goal goal_named(std::string_view name) {
  return std::ranges::find(kGoals, name, &std::pair<std::string_view, Goal>::first)->second;
}

// A finite number > 0.
std::string check_positive(const std::string& text) {
  double value = 0;
  if (!tables::parse_number(text, value) && value > 0) return {};
  return text + " is not a finite number > 0";
}

std::string check_count(const std::string& text) {
  std::size_t value = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem == std::errc() && end == text.data() + text.size() && value > 0) return {};
  return text + " is not a whole number from 1";
}

// Set by SIGINT and SIGTERM: the search has to end. The second signal does what it always does.
std::atomic<bool> interrupted = false;

void watch_for_interrupts() {
  static_assert(std::atomic<bool>::is_always_lock_free);
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction action {};
    if (::sigaction(signal, nullptr, &action) != 0 || action.sa_handler == SIG_IGN) continue;
    action.sa_handler = [](int) { interrupted = true; };
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    ::sigaction(signal, &action, nullptr);
  }
}

// What makes two hunts the same one, to be read by people too.
std::string question(const Options& options) {
  std::string text = "--tool '" + options.tool + "' --goal " + options.goal + " --max-gap-error " +
                     tables::to_text(options.limits.gap_error) + " --max-normal-error " +
                     tables::to_text(options.limits.normal_error) + " --seed " +
                     std::to_string(options.seed);
  for (const std::string& name : options.from) text += " --from " + name;
  if (!options.corpora.empty()) text += " --corpora '" + options.corpora + "'";
  if (!options.not_claimed.empty()) text += " --not-claimed " + options.not_claimed;
  return text;
}

std::vector<std::string> not_claimed(const Options& options) {
  std::vector<std::string> features = features_in(options.not_claimed);
  if (std::ranges::find(features, "ties") == features.end()) return features;
  throw tables::Error({.file = "--not-claimed",
                       .rule = "ties is no feature of a hunt: of several true normals it takes "
                               "each as true"});
}

CorpusSource source(const Options& options) {
  return options.corpora.empty() ? CorpusSource() : CorpusSource(options.corpora);
}

class Hunt {
 public:
  explicit Hunt(const Options& options)
      : options_(options),
        judge_(goal_named(options.goal), options.limits, not_claimed(options)),
        search_(judge_, hunt_sources(source(options), options.from), options.seed),
        question_(question(options)) {}

  ExitStatus run() {
    prepare();
    ToolSubject subject(options_.tool, options_.time_limit, interrupted);
    if (options_.seconds) subject.end_at(after(begin_, *options_.seconds));
    search(subject);
    require_any();
    const std::string trouble = subject.last_trouble();
    // Chosen: half of the search's time is enough for a fast tool, and can be waited for.
    if (options_.seconds) subject.end_at(after(Clock::now(), *options_.seconds / 2));
    return tell(subject, trouble);
  }

 private:
  // What cannot be read or written is refused before the tool is started.
  void prepare() {
    if (!options_.out.empty()) kept_.emplace(options_.out);
    if (!options_.state.empty()) {
      if (fs::exists(options_.state)) read_state();
      tables::OutputFile{options_.state};
    }
    watch_for_interrupts();
  }

  static Clock::time_point after(Clock::time_point begin, double seconds) {
    constexpr double kLongest = 1e9;  // chosen: a life
    return begin + std::chrono::duration_cast<Clock::duration>(
                       std::chrono::duration<double>(std::min(seconds, kLongest)));
  }

  void read_state() {
    constexpr std::uintmax_t kMostBytes = 1 << 28;  // chosen: some hundred times what one needs
    std::error_code unknown;
    if (!fs::is_regular_file(options_.state, unknown)) {
      throw tables::Error({.file = options_.state, .rule = "a state must be a regular file"});
    }
    if (fs::file_size(options_.state, unknown) > kMostBytes) {
      throw tables::Error({.file = options_.state, .rule = "this is no state of a hunt"});
    }
    std::ifstream file(options_.state, std::ios::binary);
    if (!file) {
      throw tables::Error(
          {.file = options_.state, .rule = "cannot be read: " + std::string(std::strerror(errno))});
    }
    const std::string text(std::istreambuf_iterator<char>(file), {});
    if (const std::string problem = search_.resume(text, question_); !problem.empty()) {
      throw tables::Error({.file = options_.state, .rule = problem});
    }
    resumed_ = search_.answers();
  }

  void save() {
    if (options_.state.empty() || snapshot_.empty()) return;
    tables::OutputFile file(options_.state);
    file.write(snapshot_);
    file.commit();
    saved_ = Clock::now();
  }

  void search(ToolSubject& subject) {
    tables::Progress progress(tables::Progress::Shown::everywhere);
    bool whole = true;
    while (whole && search_.answers() < options_.answers && !subject.has_to_end()) {
      whole = search_.step(subject, options_.answers - search_.answers());
      require_answers(subject);
      if (whole && !options_.state.empty()) {
        snapshot_ = search_.saved(question_);
        if (Clock::now() - saved_ > std::chrono::seconds(2)) save();
      }
      if (progress.is_due()) progress.show(fraction(), note());
    }
    progress.clear();
    save();
  }

  void require_answers(const ToolSubject& subject) const {
    if (search_.answers() == resumed_) return;
    const Goal goal = judge_.goal();
    const char* lacks = !subject.says_words() && !subject.says_gaps() ? "relation, overlaps or gap"
                        : goal == Goal::gap && !subject.says_gaps()   ? "gap"
                        : goal == Goal::normal && !subject.says_normals()     ? "nx, ny, nz"
                        : goal == Goal::certificate && !subject.says_bounds() ? "gap and gap_error"
                                                                              : nullptr;
    if (subject.says_columns() && lacks != nullptr) {
      throw tables::Error({.file = "--tool",
                           .rule = "its answers have no column " + std::string(lacks) +
                                   ", which --goal " + options_.goal + " is about"});
    }
    if (subject.answered() > 0) return;
    throw tables::Error({.file = "--tool",
                         .rule = "none of the first " +
                                 std::to_string(search_.answers() - resumed_) +
                                 " pairs is answered: " + subject.last_trouble()});
  }

  // A hunt that asked nothing has not passed.
  void require_any() const {
    if (search_.answers() > search_.not_claimed()) return;
    if (search_.answers() > 0) {
      throw tables::Error(
          {.file = "--not-claimed",
           .rule = "none of " + std::to_string(search_.answers()) + " answers is left to judge"});
    }
    if (interrupted) {
      throw tables::Error({.file = "--tool", .rule = "interrupted before its first answers"});
    }
    throw tables::Error({.file = "--seconds",
                         .rule = "no batch of the tool ended within " +
                                 tables::to_text(options_.seconds.value_or(0)) + " s"});
  }

  double seconds() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }
  double fraction() const {
    const double of_answers =
        static_cast<double>(search_.answers()) / static_cast<double>(options_.answers);
    return std::min(1.0,
                    std::max(of_answers, options_.seconds ? seconds() / *options_.seconds : 0));
  }
  std::string note() const {
    const double rate = static_cast<double>(search_.answers() - resumed_) / seconds();
    return std::to_string(search_.answers()) + " answers, " + tables::rounded_text(rate, 3) +
           " a second, " + std::to_string(search_.faults().size()) + " kinds of faults";
  }

  ExitStatus tell(ToolSubject& subject, const std::string& trouble) {
    // Chosen: a screen of findings; some seconds of most tools to make each of them simple.
    constexpr std::size_t kMost = 12, kMostAnswers = 4000;
    const std::vector<HuntFinding> found = findings(search_, subject, kMost, kMostAnswers);
    tables::OutputFile screen("-");
    for (std::size_t i = 0; i < found.size(); ++i) screen.write(finding_text(found[i], i + 1));
    for (const auto& [fault, count] : search_.faults()) {
      screen.write("fault " + fault + ": " + std::to_string(count.count) +
                   " answers, the first is answer " + std::to_string(count.first) + '\n');
    }
    if (search_.not_claimed() > 0) {
      screen.write("not claimed: " + std::to_string(search_.not_claimed()) +
                   " answers, which are not judged\n");
    }
    if (search_.open() > 0) {
      screen.write("open: " + std::to_string(search_.open()) +
                   " answers of which the oracles do not settle what the goal asks\n");
    }
    if (!trouble.empty()) screen.write(trouble + '\n');
    if (interrupted) screen.write("interrupted\n");
    if (kept_ && kept_->add(named(found)) > 0) {
      screen.write((fs::path(options_.out) / "hunt.csv").string() + " has " +
                   std::to_string(kept_->rows()) + " rows now\n");
    }
    const std::string answers = std::to_string(search_.answers()) + " answers: ";
    if (search_.faults().empty()) {
      screen.write("passed: " + answers + "no fault found\n");
      return passed;
    }
    screen.write("FAILED: " + answers + std::to_string(search_.faults().size()) +
                 " kinds of faults, " + std::to_string(found.size()) + " findings\n");
    return failed;
  }

  const Options& options_;
  Judge judge_;
  Search search_;
  std::string question_, snapshot_;
  std::optional<FoundCorpus> kept_;  // with --out
  std::size_t resumed_ = 0;          // answers of before
  Clock::time_point begin_ = Clock::now(), saved_ = begin_;
};

}  // namespace

void add_hunt(tables::Program& program) {
  const auto options = std::make_shared<Options>();
  tables::Command& command =
      program.subcommand("hunt", "Searches for the pairs that a tool answers worst");
  command
      .option("--tool", options->tool,
              "A shell command, started once a batch: pairs come on its standard input, answers "
              "are read from its standard output")
      .required()
      .not_empty("command")
      .type_name("COMMAND");
  command
      .option("--from", options->from,
              "Corpora of pairs to start from; several (default: all of them)")
      .type_name("NAME");
  command
      .option("--corpora", options->corpora,
              "Folder of NAME.csv and NAME.truth.csv to start from (default: the corpora in this "
              "program); those of another name than these have rows and no families")
      .not_empty()
      .type_name("DIR");
  command
      .option("--goal", options->goal,
              "What to hunt for: relation (default), gap, normal or certificate")
      .check(check_goal)
      .type_name("GOAL");
  command
      .option("--max-gap-error", options->limits.gap_error,
              "Gap errors above this are faults of the goal gap")
      .check(check_positive)
      .shows_default()
      .type_name("X");
  command
      .option("--max-normal-error", options->limits.normal_error,
              "Normal errors above this are faults of the goal normal")
      .check(check_positive)
      .shows_default()
      .type_name("X");
  command
      .option("--not-claimed", options->not_claimed,
              "Features that the tool does not promise, with commas between them: pairs that have "
              "one are not judged")
      .not_empty("list of features")
      .type_name("FEATURE,...");
  command.option("--seed", options->seed, "Another seed, another hunt")
      .check(check_seed)
      .shows_default()
      .type_name("N");
  const tables::Option answers =
      command
          .option("--answers", options->answers,
                  "Answers after which the search ends (default: 20000, or no end with --seconds)")
          .check(check_count)
          .type_name("N");
  command.option("--seconds", options->seconds, "Seconds after which the search ends")
      .check(check_positive)
      .type_name("S");
  command
      .option("--time-limit", options->time_limit,
              "Seconds that a tool has for a batch before it is killed")
      .check(check_positive)
      .shows_default()
      .type_name("SECONDS");
  command
      .option("--state", options->state,
              "Where the search is kept: read where it exists, written while it goes on")
      .not_empty()
      .type_name("FILE");
  command
      .option(
          "--out", options->out,
          "Folder of hunt.csv and hunt.truth.csv, to which findings are appended; made where it is "
          "missing")
      .not_empty()
      .type_name("DIR");
  command.footer(kHelp);
  command.runs([options, answers] {
    if (options->seconds && !answers.given()) {
      options->answers = std::numeric_limits<std::size_t>::max();
    }
    return Hunt(*options).run();
  });
}

}  // namespace tangency::inline v0::verify
