// SPDX-License-Identifier: GPL-3.0-or-later
/// `tangency-dem` from outside: refusals, results, interruption, resumption.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <csignal>
#include <cstddef>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <tangency/dem/observe.hpp>

#include "../tool/process.hpp"
#include "csv_columns.hpp"
#include "scenes.hpp"

namespace tangency::testing {
namespace {

using Arguments = std::vector<std::string>;

std::size_t lines_in(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// Runs a scene that must be refused; the message, without its end of line.
std::string refused_message(const TemporaryFolder& folder, const std::string& scene,
                            Arguments more = {}) {
  const auto before = folder.names();
  Arguments arguments{"run", scene, "--out", folder.path("out")};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Finished run = run_tool(arguments);
  EXPECT_EQ(run.status, 2) << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(lines_in(run.err), 1u) << run.err;
  EXPECT_EQ(folder.names(), before) << "something was left behind";
  return run.err.substr(0, run.err.find('\n'));
}

std::string refused_change(const std::string& before, const std::string& after) {
  const TemporaryFolder folder;
  const std::string path = folder.write("scene.toml", with(small_scene(), before, after));
  const std::string message = refused_message(folder, path);
  EXPECT_EQ(message.find(path), 0u) << message;
  return message.substr(std::min(message.size(), path.size()));
}

TEST(RunCommand, RefusesAnImpossibleValue) {
  EXPECT_EQ(refused_change("count = 27", "count = -1"),
            ":4: particles.grain.count = -1: an integer from 1 to 1000000");
}

TEST(RunCommand, RefusesAWrongType) {
  EXPECT_EQ(refused_change("count = 27", "count = \"many\""),
            ":4: particles.grain.count = 'many': an integer from 1 to 1000000");
}

TEST(RunCommand, RefusesAnUnknownKey) {
  EXPECT_EQ(refused_change("frame_interval", "frames"),
            ":21: output.frames: no such key; allowed are history_interval, frame_interval, "
            "history_strain, frame_strain, contact_frames, contact_interval, micro_interval, "
            "partition, classes, checkpoint_interval, checkpoint_seconds");
}

TEST(RunCommand, RefusesAMissingKey) {
  EXPECT_EQ(refused_change("mean_radius = 10.0\n", ""),
            ":3: particles.grain.mean_radius is missing: a finite number from 1e-30 to 1e+30 (m)");
}

TEST(RunCommand, RefusesABadKeyOfThePlaneAndOfGrowth) {
  EXPECT_EQ(refused_change("[cell]", "[cell]\ndimensions = 4"),
            ":3: cell.dimensions = 4: an integer from 2 to 3");
  EXPECT_EQ(refused_change("kind = \"compress\"", "kind = \"grow\"\nelongation = 0.5"),
            ":14: stage[1].elongation = 0.5: a finite number from 1 to 10000");
}

TEST(RunCommand, RefusesWhatIsNoToml) {
  EXPECT_EQ(refused_change("[cell]", "[cell").find(":2: not TOML: "), 0u);
}

TEST(RunCommand, RefusesAMissingFileAndAFolder) {
  const TemporaryFolder folder;
  EXPECT_EQ(refused_message(folder, folder.path("none.toml")),
            folder.path("none.toml") + ": cannot be read: No such file or directory");
  EXPECT_EQ(refused_message(folder, folder.path("")),
            folder.path("") + ": cannot be read: Is a directory");
}

TEST(RunCommand, RefusesAnOutputThatCannotBeWritten) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.toml", small_scene());
  const std::string file = folder.write("file", "");
  for (const std::string& out : {file, file + "/below"}) {
    const Finished run = run_tool({"run", scene, "--out", out});
    EXPECT_EQ(run.status, 2);
    EXPECT_EQ(run.err, "--out " + out + ": cannot be written: Not a directory\n");
  }
  EXPECT_EQ(run_tool({"run", scene, "--out", "/proc/none"}).err,
            "--out /proc/none: cannot be written: No such file or directory\n");
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"file", "scene.toml"}));
}

TEST(RunCommand, RefusesAStateThatIsNone) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.toml", small_scene());
  EXPECT_EQ(refused_message(folder, scene, {"--resume", scene}),
            scene + ": no state of tangency-dem: final.state or checkpoint.state of a run");
}

TEST(RunCommand, RefusesAStateOfOtherParticles) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.toml", small_scene());
  ASSERT_EQ(run_tool({"run", scene, "--out", folder.path("first"), "--quiet"}).status, 0);
  const std::string state = folder.path("first/final.state");
  const std::string other =
      folder.write("other.toml", with(small_scene(), "mean_radius = 10.0", "mean_radius = 12.0"));
  EXPECT_EQ(refused_message(folder, other, {"--resume", state}),
            state + ": a state with particles.grain.mean_radius = 10; the scene has 12");
}

TEST(RunCommand, SaysWhereHelpIsWhenTheCommandLineIsRefused) {
  EXPECT_EQ(
      run_tool({}).err,
      "tangency-dem: A subcommand is required (`tangency-dem --help` says what is allowed)\n");
}

TEST(RunCommand, HelpNamesTheProgramTheFilesAndEveryColumn) {
  const std::string help = run_tool({"run", "--help"}).out;
  for (const auto& field : dem::history_fields(0, 0.0, "", 0, dem::Observation{}))
    EXPECT_NE(help.find(field.name), help.npos) << field.name;
  for (const char* word :
       {"history.csv", "summary.json", "final.state", "checkpoint.state", "frames.pvd",
        "frames.xyz", "wall_seconds", "ns_per_listed_pair_per_cycle", "listed_pairs", "threads",
        "state_hash", "rattlers", "largest_unbalanced_moment_ratio", "128 + N"})
    EXPECT_NE(help.find(word), help.npos) << word;
  EXPECT_EQ(help.find(TANGENCY_TOOL), help.npos) << "the plain name of the program";
  EXPECT_EQ(run_tool({"--help"}).out.find(TANGENCY_TOOL), std::string::npos);
}

TEST(RunCommand, VersionAndHelpThatCannotBeWrittenAreNoSuccess) {
  const Finished version = run_tool({"--version"});
  EXPECT_EQ(version.status, 0);
  EXPECT_EQ(version.out, "tangency-dem " TANGENCY_VERSION "\n");
  Process::Place full;
  full.standard_output = "/dev/full";
  for (const char* argument : {"--version", "--help", "schema"}) {
    const Finished run = run_tool({argument}, "", full);
    EXPECT_EQ(run.status, 2) << argument;
    EXPECT_EQ(run.err, "<stdout>: cannot be written: No space left on device\n") << argument;
  }
}

TEST(RunCommand, AReaderThatHasGoneEndsEverySubcommandWithoutAWord) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.toml", small_scene()), out = folder.path("out");
  ASSERT_EQ(run_tool({"run", scene, "--out", out, "--quiet"}).status, 0);
  Process::Place gone;
  gone.reader_has_gone = true;
  for (const Arguments& arguments : {Arguments{"--version"}, Arguments{"--help"},
                                     Arguments{"schema"}, Arguments{"report", out}}) {
    const Finished run = run_tool(arguments, "", gone);
    EXPECT_EQ(run.signal, SIGPIPE) << arguments[0];
    EXPECT_EQ(run.err, "") << arguments[0];
  }
  EXPECT_TRUE(std::filesystem::exists(out + "/report.html")) << "done before";
}

TEST(RunCommand, NamesAMistypedSubcommandAndTheNearest) {
  const std::string end = " (`tangency-dem --help` says what is allowed)\n";
  EXPECT_EQ(run_tool({"rnu", "scene.toml", "--out", "x"}).err,
            "tangency-dem: rnu is no subcommand; the nearest is run" + end);
  EXPECT_EQ(run_tool({"shcema"}).err,
            "tangency-dem: shcema is no subcommand; the nearest is schema" + end);
  EXPECT_EQ(run_tool({"fly"}).err,
            "tangency-dem: fly is no subcommand; run, check, report, contacts, particles, export, "
            "import, micro and schema are" +
                end);
}

std::map<std::string, std::string> files_below(const std::string& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files[entry.path()] = read_file(entry.path());
  return files;
}

TEST(RunCommand, ResumedOnAFullDiskLeavesEveryEarlierResult) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.toml", small_scene());
  const std::string out = folder.path("out");
  ASSERT_EQ(run_tool({"run", scene, "--out", out, "--quiet"}).status, 0);
  const auto before = files_below(out);
  ASSERT_GT(before.at(out + "/frames.xyz").size(), 4096u);
  for (const rlim_t bytes : {rlim_t{0}, rlim_t{4096}}) {
    const auto resumed = [&] {
      const FileSizeLimit full(bytes);
      return run_tool({"run", scene, "--out", out, "--quiet", "--resume", out + "/final.state"});
    }();
    EXPECT_EQ(resumed.status, 2);
    EXPECT_EQ(lines_in(resumed.err), 1u) << resumed.err;
    EXPECT_NE(resumed.err.find(": cannot be written"), resumed.err.npos) << resumed.err;
    EXPECT_TRUE(files_below(out) == before) << bytes;
  }
}

TEST(RunCommand, WarnsOfParticlesThatOverlapTooMuch) {
  const TemporaryFolder folder;
  const std::string scene =
      folder.write("scene.toml", with(small_scene(), "stiffness = 1.5e10", "stiffness = 1e9"));
  const Finished run = run_tool({"run", scene, "--out", folder.path("out"), "--quiet"});
  EXPECT_EQ(run.status, 0);
  EXPECT_NE(run.err.find("tangency-dem: stage relax ended with mean overlap 0."), run.err.npos)
      << run.err;
  EXPECT_NE(run.err.find("; sound are at most 0.1 and at least 0"), run.err.npos) << run.err;
}

TEST(RunCommand, WarnsOfAStressThatWasNotHeldAndSaysWhatToChange) {
  const TemporaryFolder folder;
  const std::string shear =
      "[[stage]]\nkind = \"shear\"\nmean_stress = 10e6\naxial_strain_rate = 0.005\n"
      "axial_strain = 0.03\n[output]\n";
  const std::string held = with(small_scene(), "[output]\n", shear);
  const std::string missed = with(held, "axial_strain_rate",
                                  "servo_gain = 0.005\nmax_strain_rate = 0.001\naxial_strain_rate");
  const auto warnings = [&](const std::string& scene) {
    return run_tool({"run", folder.write("scene.toml", scene), "--out", folder.path("out"),
                     "--replace", "--quiet"})
        .err;
  };
  EXPECT_EQ(warnings(held).find("did not hold"), std::string::npos);
  const std::string text = warnings(missed);
  EXPECT_EQ(text.find("tangency-dem: stage shear did not hold mean stress at 1e+07: it was off by "
                      "more than 1 % in "),
            0u)
      << text;
  EXPECT_NE(text.find("; raise max_strain_rate from 0.001 to 0.25\n"), text.npos) << text;
}

TEST(RunCommand, ResumedUnderAnotherStiffnessSaysSo) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.toml", small_scene());
  ASSERT_EQ(run_tool({"run", scene, "--out", folder.path("out"), "--quiet"}).status, 0);
  const std::string stiff =
      folder.write("stiff.toml", with(small_scene(), "stiffness = 1.5e10", "stiffness = 2e10"));
  const Finished resumed = run_tool({"run", stiff, "--out", folder.path("again"), "--quiet",
                                     "--resume", folder.path("out/final.state")});
  EXPECT_EQ(resumed.status, 0);
  EXPECT_EQ(resumed.err.find("tangency-dem: goes on under other contact laws: the state was made "
                             "with contact.grain-grain.normal_stiffness = 1.5e+10, and here 2e+10"),
            0u)
      << resumed.err;
}

TEST(RunCommand, RefusesABadCommandLine) {
  for (const Arguments& arguments : {Arguments{}, Arguments{"run"}, Arguments{"walk"},
                                     Arguments{"run", "a.toml", "--threads", "0"}})
    EXPECT_EQ(run_tool(arguments).status, 2);
}

TEST(RunCommand, LeavesHistorySummaryStatesAndFrames) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.toml", small_scene());
  const std::string out = folder.path("out");
  const Finished run = run_tool({"run", scene, "--out", out, "--quiet"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err, "");

  const auto summary = nlohmann::json::parse(read_file(out + "/summary.json"));
  EXPECT_NEAR(summary["mean_stress"].get<double>(), 10e6, 0.01 * 10e6);
  EXPECT_LT(summary["largest_unbalanced_ratio"].get<double>(), 0.01);
  EXPECT_EQ(summary["particles"], 27);
  for (const char* key : {"cycles", "wall_seconds", "ns_per_listed_pair_per_cycle", "listed_pairs",
                          "threads", "state_hash", "rattlers"})
    EXPECT_TRUE(summary.contains(key)) << key;
  EXPECT_FALSE(summary.contains("peak_friction_angle_deg")) << "no stage sheared";

  // The last row of the history is the head of the summary, number by number.
  const Columns history = columns_of(read_file(out + "/history.csv"));
  ASSERT_FALSE(history.at("cycle").empty());
  for (const auto& [name, cells] : history) {
    for (const std::string& cell : cells) EXPECT_NE(cell, "-0") << name;
    const std::string& value = cells.back();
    if (name == "stage") {
      EXPECT_EQ(summary[name], value);
    } else {
      EXPECT_EQ(summary[name].get<double>(), std::stod(value)) << name;
    }
  }

  EXPECT_EQ(read_file(out + "/final.state"), read_file(out + "/checkpoint.state"));
  const std::string pvd = read_file(out + "/frames.pvd");
  EXPECT_NE(pvd.find("file=\"frames/0.vtp\""), pvd.npos);
  EXPECT_NE(read_file(out + "/frames/0.vtp").find("Name=\"orientation\""), std::string::npos);
  const std::string xyz = read_file(out + "/frames.xyz");
  EXPECT_EQ(xyz.substr(0, 3), "27\n");
  EXPECT_NE(xyz.find("orientation:R:4:aspherical_shape:R:3"), xyz.npos);
  EXPECT_EQ(lines_in(xyz) % 29, 0u);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(out))
    EXPECT_NE(entry.path().extension(), ".part");
}

TEST(RunCommand, ShowsPlainLinesOffATerminalAndABarOnOne) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.toml", small_scene());
  Process::Place terminal;
  terminal.error_is_terminal = true;
  const Finished on = run_tool({"run", scene, "--out", folder.path("on")}, "", terminal);
  const Finished off = run_tool({"run", scene, "--out", folder.path("off")});
  EXPECT_NE(on.err.find("\r[##"), on.err.npos);
  EXPECT_EQ(off.err.find('\r'), off.err.npos);
  EXPECT_EQ(off.err.find("0 %: compress, cycle 1,"), 0u) << off.err;
  EXPECT_NE(off.err.find("\n100 %: relax, cycle "), off.err.npos) << off.err;
}

TEST(RunCommand, FailsWithItsReasonWhenAStageDoesNotEnd) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.toml", with(small_scene(), "kind = \"compress\"",
                                                            "kind = \"compress\"\nmax_cycles = 9"));
  const Finished run = run_tool({"run", scene, "--out", folder.path("out"), "--quiet"});
  EXPECT_EQ(run.status, 1);
  EXPECT_EQ(run.err,
            "tangency-dem: stage compress did not end within max_cycles = 9: mean stress 0 of "
            "1e+07; raise max_cycles to 2200\n");
  EXPECT_FALSE(std::filesystem::exists(folder.path("out") + "/summary.json"));
  EXPECT_TRUE(std::filesystem::exists(folder.path("out") + "/checkpoint.state"));
}

// A run that has frames already keeps them, up to where it goes on.
TEST(RunCommand, WithoutAFrameIntervalWritesNoFrames) {
  const TemporaryFolder folder;
  const std::string without = folder.write(
      "without.toml", with(small_scene(), "frame_interval = 1000000", "frame_interval = 0"));
  const std::string with_frames = folder.write("with.toml", small_scene());
  const std::string out = folder.path("out");
  const auto has = [&](const char* name) { return std::filesystem::exists(out + "/" + name); };
  const auto run = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "run");
    arguments.insert(arguments.end(), {"--out", out, "--quiet"});
    const Finished finished = run_tool(arguments);
    ASSERT_EQ(finished.status, 0) << finished.err;
  };
  run({without});
  for (const char* name : {"frames", "frames.pvd", "frames.xyz", "frames.xyz.part"})
    EXPECT_FALSE(has(name)) << name;
  EXPECT_TRUE(has("final.state"));

  run({with_frames, "--replace"});
  const std::string pvd = read_file(out + "/frames.pvd"), xyz = read_file(out + "/frames.xyz");
  run({without, "--resume", out + "/final.state"});
  EXPECT_EQ(read_file(out + "/frames.pvd"), pvd);
  EXPECT_EQ(read_file(out + "/frames.xyz"), xyz);

  run({without, "--replace"});
  for (const char* name : {"frames", "frames.pvd", "frames.xyz", "frames.xyz.part"})
    EXPECT_FALSE(has(name)) << name;
}

// Where there are hard links the end's state takes room once; the next run's is another file.
TEST(RunCommand, EndsWithOneStateUnderTwoNames) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.toml", small_scene()), out = folder.path("out");
  const std::string final_state = out + "/final.state", checkpoint = out + "/checkpoint.state";
  const std::string kept = folder.path("kept.state");
  ASSERT_EQ(run_tool({"run", scene, "--out", out, "--quiet"}).status, 0);
  std::filesystem::create_hard_link(final_state, kept);
  EXPECT_TRUE(std::filesystem::equivalent(final_state, checkpoint));
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"kept.state", "out", "scene.toml"}));
  EXPECT_FALSE(std::filesystem::exists(final_state + ".part"));
  const std::string bytes = read_file(kept);

  const std::string longer =
      folder.write("longer.toml", small_scene() +
                                      "[[stage]]\nkind = \"relax\"\nmean_stress = 11e6\n"
                                      "max_strain_rate = 0.05\n");
  ASSERT_EQ(run_tool({"run", longer, "--out", out, "--quiet", "--resume", final_state}).status, 0);
  EXPECT_TRUE(read_file(kept) == bytes) << "no state is written in its place";
  EXPECT_FALSE(std::filesystem::equivalent(final_state, kept));
  EXPECT_TRUE(std::filesystem::equivalent(final_state, checkpoint));
}

// Interrupted in the middle, then resumed in its own directory: every file is as if
// the run had gone through.
TEST(RunCommand, ContinuesAnInterruptedRunToTheSameFiles) {
  const TemporaryFolder folder;
  const std::string text =
      with(with(small_scene(), "count = 27", "count = 125"), "frame_interval = 1000000",
           "frame_interval = 300\ncheckpoint_interval = 350");
  const std::string scene = folder.write("scene.toml", text);
  const std::string whole = folder.path("whole"), halves = folder.path("halves");
  ASSERT_EQ(run_tool({"run", scene, "--out", whole, "--quiet"}).status, 0);

  // It stands still in its first checkpoint, between the history's write and the state's.
  std::filesystem::create_directory(halves);
  const std::string history = make_pipe(halves + "/history.csv.part"),
                    state = make_pipe(halves + "/checkpoint.state.part");
  Process first({"run", scene, "--out", halves, "--quiet"});
  const int reader = first.meet_at(history, O_RDONLY);
  first.send(SIGINT);
  EXPECT_NE(read_to_end(reader), "");
  EXPECT_NE(read_to_end(first.meet_at(state, O_RDONLY)), "");
  const Finished interrupted = first.wait();
  ASSERT_EQ(interrupted.status, 128 + SIGINT) << interrupted.err;
  EXPECT_FALSE(std::filesystem::exists(halves + "/summary.json"));

  ASSERT_EQ(
      run_tool({"run", scene, "--out", halves, "--quiet", "--resume", halves + "/checkpoint.state"})
          .status,
      0);
  for (const char* file : {"final.state", "history.csv", "frames.xyz", "frames.pvd"})
    EXPECT_TRUE(read_file(whole + "/" + file) == read_file(halves + "/" + file)) << file;
}

TEST(SchemaCommand, PrintsEverySection) {
  const Finished run = run_tool({"schema"});
  EXPECT_EQ(run.status, 0);
  for (const char* word : {"[cell]", "[particles.NAME]", "[contact]", "[[stage]]", "[output]",
                           "mean_radius", "required", "max_unbalanced_ratio"})
    EXPECT_NE(run.out.find(word), run.out.npos) << word;
}

// The meaning of every key begins where its head does, two blanks behind what is allowed.
TEST(SchemaCommand, RunsNoTwoColumnsTogether) {
  std::istringstream lines(run_tool({"schema"}).out);
  std::size_t meaning = std::string::npos, keys = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.find("  key ") == 0) meaning = line.rfind("meaning");
    if (line.find("  ") != 0) continue;
    EXPECT_EQ(line.substr(meaning - 2, 2), "  ") << line;
    EXPECT_NE(line.at(meaning), ' ') << line;
    ++keys;
  }
  EXPECT_GT(keys, 40u);
}

}  // namespace
}  // namespace tangency::testing
