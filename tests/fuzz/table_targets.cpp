// SPDX-License-Identifier: GPL-3.0-or-later
/// The subcommands of `tangency`, each as a whole, in this process: its command line, readers,
/// answers and writers.
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <tangency/geometry/tables/command_line.hpp>
#include <tangency/geometry/tables/csv.hpp>
#include <tangency/geometry/tool/command_line.hpp>
#include <tangency/tests/fuzz/memory_file.hpp>
#include <tangency/tests/fuzz/mutate.hpp>
#include <tangency/tests/fuzz/target.hpp>

namespace tangency::testing::fuzz {
namespace {

struct Call {
  std::string name;  ///< of the target
  void (*add)(tables::Program& program);
  std::vector<std::string> arguments;       ///< subcommand and options
  std::vector<std::string> corpora;         ///< of verify/corpora, whose first lines are the seeds
  bool by_rows = true;                      ///< a line of answers for every row
  bool (*is_asked)(Bytes table) = nullptr;  ///< null: of any table
};

/// No cell of the table is a number beyond 64: in a cell of 80 x 16 x 8 a body of the size s has
/// some s^3 / 2000 images of itself and of every other, and all of them are listed.
bool is_small(Bytes table) {
  std::string_view rest(reinterpret_cast<const char*>(table.data()), table.size());
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.size(), rest.find_first_of(",\n\r\" \t"));
    double number = 0;
    if (!tables::parse_number(rest.substr(0, end), number) && std::abs(number) > 64) return false;
    rest.remove_prefix(std::min(rest.size(), end + 1));
  }
  return true;
}

const std::vector<Call>& calls() {
  using namespace tool;
  static const std::vector<Call> all{
      {"contact",
       add_contact,
       {"contact", "--columns", "F,mu,clearance,margin,curvature_min"},
       {"near", "nested", "extreme", "matrices", "touching"}},
      {"trace", add_contact, {"contact", "--method", "trace"}, {"classes", "deep"}},
      {"overlap", add_overlap, {"overlap"}, {"classes", "matrices", "float32"}},
      {"classify", add_classify, {"classify", "--mixed-terms", "full"}, {"quadrics"}},
      {"ellipse", add_ellipse, {"ellipse"}, {"ellipses"}},
      {"point", add_point, {"point"}, {"points"}},
      {"ellipse-point", add_ellipse_point, {"ellipse-point"}, {}},
      {"wall", add_wall, {"wall"}, {"walls"}},
      {"ray", add_ray, {"ray"}, {"rays"}},
      {"time", add_time, {"time"}, {"times"}},
      {"neighbours",
       add_neighbours,
       {"neighbours", "--contacts", "--reach", "0.25"},
       {"neighbours"},
       false},
      {"images",
       add_neighbours,
       {"neighbours", "--contacts", "--reach", "0.25", "--periodic", "80,16,8"},
       {"neighbours-periodic", "neighbours"},
       false,
       is_small}};
  return all;
}

struct Outcome {
  int status;
  std::string out, err;
};

/// A subcommand with its options, ready to be run again and again.
class Command {
 public:
  explicit Command(const Call& call, const std::vector<std::string>& options = {})
      : program_("tangency", "") {
    call.add(program_);
    words_ = {"tangency"};
    for (const auto* some : {&call.arguments, &options})
      words_.insert(words_.end(), some->begin(), some->end());
    words_.push_back(input_.path());
    for (const std::string& word : words_) arguments_.push_back(word.c_str());
  }

  Outcome run(Bytes table) {
    input_.set(table);
    Outcome outcome{};
    {
      const Diverted out(1, out_), err(2, err_);
      outcome.status = program_.run(static_cast<int>(arguments_.size()), arguments_.data());
    }
    outcome.out = out_.text();
    outcome.err = err_.text();
    return outcome;
  }

  /// What messages call the table.
  const std::string& name_of_table() const { return words_.back(); }

 private:
  tables::Program program_;
  MemoryFile input_, out_, err_;
  std::vector<std::string> words_;
  std::vector<const char*> arguments_;
};

std::size_t lines_of(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count(text, '\n'));
}

/// No number that is none, and rows that are counted from 0.
bool is_table(const std::string& text, bool by_rows) {
  if (!text.ends_with('\n')) return false;
  std::size_t row = 0;
  for (std::size_t at = text.find('\n') + 1; at < text.size();
       at = text.find('\n', at) + 1, ++row) {
    const std::string_view line = std::string_view(text).substr(at, text.find('\n', at) - at);
    if (by_rows && !line.starts_with(std::to_string(row) + ',')) return false;
    for (const std::string_view word : {",nan", ",-nan", ",inf", ",-inf"}) {
      const std::size_t found = line.find(word);
      if (found == std::string_view::npos) continue;
      const std::size_t end = found + word.size();
      if (end == line.size() || line[end] == ',') return false;
    }
  }
  return true;
}

bool is_one_line(const std::string& text) {
  return text.size() > 1 && text.ends_with('\n') &&
         std::none_of(text.begin(), text.end() - 1,
                      [](char c) { return std::iscntrl(static_cast<unsigned char>(c)); });
}

void run_call(const Call& call, Bytes input) {
  static std::map<std::string, std::unique_ptr<Command>> commands, going_on, in_threads;
  const auto ready = [&](auto& some, const std::vector<std::string>& options) -> Command& {
    std::unique_ptr<Command>& one = some[call.name];
    if (!one) one = std::make_unique<Command>(call, options);
    return *one;
  };
  if (call.is_asked != nullptr && !call.is_asked(input)) return count("not asked");
  Command& command = ready(commands, {"--threads", "1"});
  const Outcome outcome = command.run(input);
  const auto hold = [&](bool holds, const std::string& what) {
    require(holds, call.name,
            what + "; status " + std::to_string(outcome.status) + ", error: " + outcome.err);
  };
  hold(outcome.status >= 0 && outcome.status <= tables::kRefused, "exit status");
  if (outcome.status == tables::kRefused) {
    hold(is_one_line(outcome.err), "a refusal is one line");
    hold(outcome.err.starts_with(command.name_of_table()), "a refusal names the file");
    count("refused");
  } else {
    hold(outcome.err.empty(), "a message without a refusal");
    count(outcome.status == 0 ? "answered" : "some unanswered");
    count("rows", lines_of(outcome.out) - 1);
  }
  hold(outcome.out.empty() || is_table(outcome.out, call.by_rows), "the output is a table");
  if (!call.by_rows) return;
  const std::uint64_t hash = hash_of(input);
  if (hash % 8 == 0) {
    const Outcome other = ready(going_on, {"--threads", "1", "--keep-going"}).run(input);
    hold(outcome.status == tables::kRefused || other.out == outcome.out, "--keep-going");
    // Of a table that is no table at all nothing is answered.
    hold(other.out.empty() || is_table(other.out, true), "the output of --keep-going is a table");
  }
  if (hash % 64 == 1) {
    const Outcome other = ready(in_threads, {"--threads", "3"}).run(input);
    hold(other.status == outcome.status && other.out == outcome.out, "threads");
  }
}

std::vector<std::string> seeds_of(const Call& call) {
  constexpr std::size_t kLines = 12;
  std::vector<std::string> seeds;
  for (const std::string& corpus : call.corpora)
    seeds.push_back(source_file("verify/corpora/" + corpus + ".csv", kLines));
  const auto add = [&](const char* header, const char* row) {
    seeds.push_back(std::string(header) + '\n' + row + '\n' + row + '\n');
  };
  if (call.name == "ellipse-point") add("a.x,a.y,a.r1,a.r2,a.angle,p.x,p.y", "0,0.5,2,1,0.25,1,-3");
  if (call.name == "ellipse") {
    add("a.x,a.y,a.m.xx,a.m.yy,a.m.xy,b.A,b.B,b.C,b.D,b.E,b.F", "1,0,2,1,0.5,1,0,2,-1,0,-3");
    add("a.x,a.y,a.p.xx,a.p.yy,a.p.xy,a.level,b.x,b.y,b.r1,b.r2", "1,0,2,1,0.5,3,1,0,2,1");
  }
  if (call.name == "overlap" || call.name == "contact") {
    add("a.x,a.y,a.z,a.p.xx,a.p.yy,a.p.zz,a.p.xy,a.p.yz,a.p.zx,a.confidence,b.x,b.y,b.z,b.u1.x,"
        "b.u1.y,b.u1.z,b.u2.x,b.u2.y,b.u2.z,b.u3.x,b.u3.y,b.u3.z",
        "0,0,0,1,2,3,0.5,0,0.25,0.95,2,0,0,1,1,0,-1,1,0,0,0,2");
    add("\"a.x\",a.y,a.z,a.r1,a.r2,a.r3,,b.x,b.y,b.z,b.r1,b.r2,b.r3,note",
        "0,0,0,1,1,1,,\"2\",0,0,1,1,1,\"a, \"\"b\"\"\"");
  }
  if (call.name == "time")
    add("a.x,a.y,a.z,a.r1,a.r2,a.r3,a.vx,a.vy,a.vz,a.wx,a.wy,a.wz,b.x,b.y,b.z,b.r1,b.r2,b.r3,"
        "b.vx,b.vy,b.vz,b.wx,b.wy,b.wz,horizon,tolerance",
        "0,0,0,1,2,3,0,0,0,1,0,0,6,0,0,1,1,2,-1,0,0,0,0,3,8,1e-6");
  return seeds;
}

}  // namespace

std::vector<Target> table_targets() {
  constexpr std::size_t kMostBytes = 8192;
  std::vector<Target> list;
  for (const Call& call : calls())
    list.push_back({call.name, "tangency " + call.arguments.front() + " on any table", kMostBytes,
                    [&call] { return seeds_of(call); },
                    [&call](Bytes input) { run_call(call, input); }, mutate_text});
  return list;
}

}  // namespace tangency::testing::fuzz
