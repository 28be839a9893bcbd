// SPDX-License-Identifier: GPL-3.0-or-later
/// `tangency-dem report`, and the peaks in summary.json that it shows.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <tangency/dem/observe.hpp>

#include "../tool/process.hpp"
#include "scenes.hpp"

namespace tangency::testing {
namespace {

/// A shear test of 27 grains, of some 2000 cycles.
std::string shearing_scene() {
  return with(small_scene(), "[output]\n",
              "[[stage]]\nkind = \"shear\"\nmean_stress = 10e6\naxial_strain_rate = 0.05\n"
              "axial_strain = 0.1\ntime_step_factor = 0.3\n[output]\nhistory_interval = 10\n");
}

/// A directory with a history of rows {stage, cycle, cycle of the stage, axial strain, friction
/// angle, contacts, mean stress}, all else 0.
struct MadeRow {
  const char* stage;
  int cycle, stage_cycle;
  double strain, angle;
  int contacts = 1;
  const char* stress = "1";
  double shear = 0.0;  // of zx
};
std::string history_of(const std::vector<MadeRow>& rows) {
  std::string text;
  for (const auto& field : dem::history_fields(0, 0.0, "", 0, dem::Observation{}))
    text += (text.empty() ? "" : ",") + field.name;
  text += "\n";
  for (const MadeRow& row : rows) {
    dem::Observation seen{};
    seen.axial_strain = row.strain;
    std::string line;
    for (const auto& field : dem::history_fields(row.cycle, row.cycle, row.stage, 0, seen)) {
      const std::string number = field.name == "cycle" || field.name == "time"
                                     ? std::to_string(row.cycle)
                                 : field.name == "stage"        ? row.stage
                                 : field.name == "stage_cycle"  ? std::to_string(row.stage_cycle)
                                 : field.name == "axial_strain" ? std::to_string(row.strain)
                                 : field.name == "friction_angle_deg" ? std::to_string(row.angle)
                                 : field.name == "contacts"           ? std::to_string(row.contacts)
                                 : field.name == "mean_stress"        ? row.stress
                                 : field.name == "s_zx"               ? "30"
                                 : field.name == "s_zz"               ? "100"
                                 : field.name == "shear_strain_zx"    ? std::to_string(row.shear)
                                                                      : "0";
      line += (line.empty() ? "" : ",") + number;
    }
    text += line + "\n";
  }
  return text;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(ReportCommand, PrintsALineAStageWithTheValuesAtItsEnd) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path("out"));
  folder.write("out/history.csv", history_of({{"place", 0, 0, 0.0, 0.0},
                                              {"press", 50, 50, 0.05, 1.0},
                                              {"press", 120, 120, 0.1, 7.25},
                                              {"shear", 150, 30, 0.01, 31.0},
                                              {"shear", 400, 280, 0.02, 28.5},
                                              {"shear", 450, 50, 0.021, 3.5}}));
  const Finished report = run_tool({"report", folder.path("out")});
  ASSERT_EQ(report.status, 0) << report.err;
  const auto lines = lines_of(report.out);
  ASSERT_EQ(lines.size(), 6u) << report.out;
  const auto words = [&](std::size_t k) {
    std::istringstream in(lines[k]);
    std::vector<std::string> all;
    for (std::string word; in >> word;) all.push_back(word);
    return all;
  };
  EXPECT_EQ(words(1)[0], "place");
  EXPECT_EQ(words(2)[0] + " " + words(2)[1] + " " + words(2)[3], "press 120 7.25");
  EXPECT_EQ(words(3)[0] + " " + words(3)[1] + " " + words(3)[3], "shear 280 28.50");
  EXPECT_EQ(words(4)[0] + " " + words(4)[1], "shear 50") << "the second of that name";
}

// Resumed in a directory of its own, whose history begins there.
TEST(ReportCommand, OfAResumedRunShowsTheStagesOwnCycles) {
  const TemporaryFolder folder;
  const std::string first = folder.write("first.toml", small_scene());
  const std::string scene = folder.write("scene.toml", shearing_scene());
  ASSERT_EQ(run_tool({"run", first, "--out", folder.path("first"), "--quiet"}).status, 0);
  ASSERT_EQ(run_tool({"run", scene, "--out", folder.path("whole"), "--quiet"}).status, 0);
  ASSERT_EQ(run_tool({"run", scene, "--out", folder.path("rest"), "--quiet", "--resume",
                      folder.path("first/final.state")})
                .status,
            0);
  const auto whole = lines_of(run_tool({"report", folder.path("whole")}).out);
  const auto rest = lines_of(run_tool({"report", folder.path("rest")}).out);
  ASSERT_EQ(rest.size(), 3u) << "the head, the shear and where the charts are";
  std::istringstream of_rest(rest[1]), of_whole(whole[whole.size() - 2]);
  for (std::string a, b; of_whole >> a;) {
    of_rest >> b;
    EXPECT_EQ(a, b);
  }
}

/// Scenes that move on purpose: an impact, whose contact bears nothing just before it opens, and a
/// ball that rolls down a plane.
class SceneOfMotion : public ::testing::TestWithParam<std::string> {};

TEST_P(SceneOfMotion, RunsWithoutAWarningAndIsReported) {
  const TemporaryFolder folder;
  const std::string out = folder.path("out");
  const Finished run = run_tool(
      {"run", std::string(TANGENCY_SCENES) + "/" + GetParam() + ".toml", "--out", out, "--quiet"});
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.err, "");
  const Finished report = run_tool({"report", out});
  EXPECT_EQ(report.status, 0) << report.err;
  EXPECT_NE(report.out.find("inertial fraction"), report.out.npos) << report.out;
}
INSTANTIATE_TEST_SUITE_P(Scenes, SceneOfMotion, ::testing::Values("impact", "slope"));

/// A page without what its scripts hold: the code of the view of the sample, and frames as they
/// are.
std::string without_scripts(std::string page) {
  for (std::size_t at = 0; (at = page.find("<script", at)) != page.npos;) {
    const std::size_t begin = page.find('>', at) + 1, end = page.find("</script>", begin);
    page.erase(begin, end - begin);
    at = begin;
  }
  return page;
}

/// A page is sound markup: every tag that is opened is closed in its turn.
void expect_balanced(const std::string& page) {
  std::vector<std::string> open;
  for (std::size_t at = page.find('<', 15); at != page.npos; at = page.find('<', at + 1)) {
    const std::size_t end = page.find('>', at);
    ASSERT_NE(end, page.npos);
    const std::string tag = page.substr(at + 1, end - at - 1);
    const std::string name = tag.substr(tag[0] == '/', tag.find(' ') - (tag[0] == '/'));
    if (tag.back() == '/' || name == "meta" || name == "br") continue;
    if (tag[0] != '/') {
      open.push_back(name);
      continue;
    }
    ASSERT_FALSE(open.empty()) << tag;
    ASSERT_EQ(open.back(), name);
    open.pop_back();
  }
  EXPECT_TRUE(open.empty());
}

TEST(ReportCommand, OfAShearTestHasItsChartsAndTheSummary) {
  const TemporaryFolder folder;
  const std::string scene = folder.write(
      "scene.toml", with(shearing_scene(), "[output]\n", "[output]\nmicro_interval = 50\n"));
  const std::string out = folder.path("out");
  ASSERT_EQ(run_tool({"run", scene, "--out", out, "--quiet"}).status, 0);
  const Finished report = run_tool({"report", out});
  ASSERT_EQ(report.status, 0) << report.err;
  const std::string page = without_scripts(read_file(out + "/report.html"));
  expect_balanced(page);
  for (const char* word :
       {"Principal stresses: shear", "Stress path: shear", "Volumetric strain: shear",
        "Coordination number: shear", "Fabric: shear", "Coordination and porosity",
        "Inertial fraction", "Energy account", "peak_friction_angle_deg", "A complete run."})
    EXPECT_NE(page.find(word), page.npos) << word;
  EXPECT_EQ(page.find("stresses: compress"), page.npos) << "a stage that keeps its shape";
  EXPECT_EQ(page.find("shear strain"), page.npos) << "its cell stays a box";
  EXPECT_EQ(page.find("http"), page.find("http://www.w3.org/2000/svg")) << "needs no network";
  EXPECT_EQ(page.find("nan"), page.npos);
  // The energy error of the sheared end is that of the last row over the work done.
  const auto summary = nlohmann::json::parse(read_file(out + "/summary.json"));
  const double share =
      summary["energy_error"].get<double>() / std::abs(summary["boundary_work"].get<double>());
  std::ostringstream shown;
  shown.precision(1);
  shown << std::scientific << share;
  EXPECT_NE(report.out.find(shown.str()), report.out.npos) << shown.str() << "\n" << report.out;
}

/// The chart of that title.
std::string chart_of(const std::string& page, const std::string& title) {
  const std::size_t at = page.rfind("<svg", page.find("aria-label=\"" + title));
  EXPECT_NE(at, page.npos) << title;
  return page.substr(at, page.find("</svg>", at) - at);
}

/// The lines of curves, those of the legend after them.
std::vector<std::string> paths_of(const std::string& chart) {
  std::vector<std::string> paths;
  for (std::size_t at = 0; (at = chart.find("<path d=\"", at)) != chart.npos; ++at)
    paths.push_back(chart.substr(at + 9, chart.find("/>", at) - at - 9));
  return paths;
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != text.npos; ++at) ++count;
  return count;
}

std::string page_of(const TemporaryFolder& folder, const std::vector<MadeRow>& rows) {
  std::filesystem::create_directory(folder.path("out"));
  folder.write("out/history.csv", history_of(rows));
  EXPECT_EQ(run_tool({"report", folder.path("out")}).status, 0);
  return without_scripts(read_file(folder.path("out/report.html")));
}

// A line from the last strain of a stage to the first of the next would be of no motion.
TEST(ReportCommand, PartsStrainsWhereAStageBeginsThemAnew) {
  const TemporaryFolder folder;
  const std::string page = page_of(folder, {{"place", 0, 0, 0.0, 0.0},
                                            {"press", 50, 50, 0.05, 1.0},
                                            {"press", 120, 120, 0.1, 7.25},
                                            {"shear", 150, 30, 0.01, 31.0},
                                            {"shear", 400, 280, 0.02, 28.5}});
  const auto strains = paths_of(chart_of(page, "Strains, from the start of each stage"));
  ASSERT_EQ(strains.size(), 4u) << "two curves, and the legend's two lines";
  const std::string& axial = strains.front();
  ASSERT_EQ(count_of(axial, "M"), 3u) << "place, press and shear: " << axial;
  // Each begins at the height of no strain, that of the first point.
  const auto height = [&](std::size_t at) {
    return axial.substr(axial.find(' ', at),
                        axial.find_first_of("ML\"", at + 1) - axial.find(' ', at));
  };
  for (std::size_t at = 0; (at = axial.find('M', at)) != axial.npos; ++at)
    EXPECT_EQ(height(at), height(0)) << axial;
  const auto stress = paths_of(chart_of(page, "Stress and friction angle"));
  EXPECT_EQ(count_of(stress.front(), "M"), 1u) << "what goes on is one line";
}

/// The text of the axis below a chart.
std::string across(const std::string& chart) {
  const std::size_t end = chart.find("</text>", chart.find("y=\"290"));
  const std::size_t begin = chart.rfind('>', end) + 1;
  return chart.substr(begin, end - begin);
}

// Its axial strain is rounding, which once was the axis of its charts.
TEST(ReportCommand, DrawsASimpleShearOverItsShearStrain) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path("out"));
  folder.write("out/micro.csv",
               "cycle,stage,stage_cycle,axial_strain,A_r,A_n,A_t,shear_strain_zx\n"
               "0,place,0,0,0.1,0.1,0.1,0\n150,slide,30,0,0.2,0.3,0.1,0.2\n"
               "400,slide,280,0,0.3,0.4,0.1,0.4\n");
  const std::string page = page_of(folder, {{"place", 0, 0, 0.0, 0.0},
                                            {"press", 120, 120, 0.1, 7.25, 1, "1", 0.0005},
                                            {"slide", 150, 30, 1e-18, 31.0, 1, "1", 0.2},
                                            {"slide", 400, 280, -1e-18, 28.5, 1, "1", 0.4}});
  for (const char* title : {"Principal stresses: ", "Shear and normal stress: ",
                            "Volumetric strain: ", "Coordination number: ", "Fabric: "}) {
    const std::string chart = chart_of(page, title + std::string("slide"));
    EXPECT_EQ(across(chart), "shear strain zx") << title;
    for (const char* tick : {">0.2<", ">0.4<"}) EXPECT_NE(chart.find(tick), chart.npos) << title;
  }
  const std::string stresses = chart_of(page, "Shear and normal stress: slide");
  for (const char* name : {">s_zx<", ">s_zz<", ">s_zx / s_zz (right)<"})
    EXPECT_NE(stresses.find(name), stresses.npos) << name;
  EXPECT_EQ(across(chart_of(page, "Principal stresses: press")), "axial strain");
  EXPECT_EQ(page.find("Shear and normal stress: press"), page.npos);
  EXPECT_EQ(count_of(chart_of(page, "Strains, from the start"), "<path"), 6u) << "with its legend";
  const auto lines = lines_of(run_tool({"report", folder.path("out")}).out);
  const std::size_t at = lines[0].find("shear strain (largest component)");
  ASSERT_NE(at, lines[0].npos) << lines[0];
  EXPECT_EQ(lines[3].substr(at, 32), std::string(29, ' ') + "0.4") << lines[3];
}

TEST(ReportCommand, DrawsAFrictionAngleOnlyWhereThereIsAContact) {
  const TemporaryFolder folder;
  const std::string page = page_of(folder, {{"place", 0, 0, 0.0, 90.0, 0},
                                            {"press", 50, 50, 0.05, 90.0, 0},
                                            {"press", 120, 120, 0.1, 7.25},
                                            {"press", 150, 150, 0.11, 31.0},
                                            {"press", 400, 400, 0.2, 90.0, 0}});
  const auto lines = paths_of(chart_of(page, "Stress and friction angle"));
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(count_of(lines[0], "L"), 4u) << "the stress, at all times";
  EXPECT_EQ(count_of(lines[1], "M"), 1u) << lines[1];
  EXPECT_EQ(count_of(lines[1], "L"), 1u) << lines[1];
  const auto words = lines_of(run_tool({"report", folder.path("out")}).out);
  EXPECT_NE(words[1].find("  -  "), words[1].npos) << words[1];
}

// Two neighbours of the grid of doubles: ticks a part of that apart would be one number.
TEST(ReportCommand, OfAStressThatIsConstantButForRoundingHasAnAxis) {
  const TemporaryFolder folder;
  const std::string page =
      page_of(folder, {{"place", 0, 0, 0.0, 1.0, 1, "100"},
                       {"press", 120, 120, 0.1, 7.25, 1, "100.00000000000001"}});
  const std::string chart = chart_of(page, "Stress and friction angle");
  EXPECT_EQ(count_of(paths_of(chart).front(), "L"), 1u);
  EXPECT_LT(count_of(chart, "<text"), 40u);
}

TEST(ReportCommand, ItsLegendsShowTheLinesAsTheyAreDrawn) {
  const TemporaryFolder folder;
  const std::string page =
      page_of(folder, {{"place", 0, 0, 0.0, 1.0}, {"press", 120, 120, 0.1, 7.25}});
  for (const char* title : {"Stress and friction angle", "Coordination and porosity"}) {
    const auto lines = paths_of(chart_of(page, title));
    ASSERT_EQ(lines.size(), 4u) << title;
    const auto pen = [](const std::string& line) { return line.substr(line.find('"')); };
    for (std::size_t k = 0; k < 2; ++k) EXPECT_EQ(pen(lines[k]), pen(lines[k + 2])) << title;
    EXPECT_NE(pen(lines[1]).find("stroke-dasharray"), std::string::npos);
    EXPECT_EQ(pen(lines[0]).find("stroke-dasharray"), std::string::npos);
  }
}

TEST(ReportCommand, OfARunThatIsNotCompleteSaysSo) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path("out"));
  folder.write("out/history.csv", history_of({{"place", 0, 0, 0.0, 0.0}}));
  ASSERT_EQ(run_tool({"report", folder.path("out")}).status, 0);
  const std::string page = without_scripts(read_file(folder.path("out/report.html")));
  expect_balanced(page);
  EXPECT_NE(page.find("A run that is not complete."), page.npos);
  EXPECT_EQ(page.find("names no units"), page.npos) << "which is known of a complete run alone";
}

TEST(ReportCommand, OfABadDirectoryIsRefusedInOneLine) {
  const TemporaryFolder folder;
  for (const char* name : {"empty", "none_yet", "bad", "other"})
    std::filesystem::create_directory(folder.path(name));
  folder.write("none_yet/history.csv", history_of({}));
  folder.write("bad/history.csv", with(history_of({{"place", 0, 0, 0.25, 0.0}}), "0.25", "many"));
  folder.write("other/history.csv", "a,b\n1,2\n");
  const std::vector<std::pair<std::string, std::string>> cases{
      {folder.path("missing"), "/history.csv: cannot be read"},
      {folder.path("empty"), "/history.csv: cannot be read"},
      {folder.path("none_yet"), "/history.csv: no row"},
      {folder.path("bad"), "/history.csv:2: axial_strain = many"},
      {folder.path("other"), "/history.csv:1: "}};
  for (const auto& [directory, message] : cases) {
    const Finished report = run_tool({"report", directory});
    EXPECT_EQ(report.status, 2);
    EXPECT_EQ(report.out, "");
    EXPECT_EQ(report.err.find(directory + message), 0u) << report.err;
    EXPECT_EQ(lines_of(report.err).size(), 1u) << report.err;
    EXPECT_FALSE(std::filesystem::exists(directory + "/report.html"));
  }
  EXPECT_EQ(run_tool({"report"}).status, 2);
}

/// The rows of a stage, of three columns, read off the file by its own header.
struct Sheared {
  std::vector<double> strain, volume, angle;

  Sheared(const std::string& history, const std::string& stage) {
    const auto lines = lines_of(history);
    const auto cells = [](const std::string& line) {
      std::vector<std::string> all;
      std::istringstream in(line);
      for (std::string cell; std::getline(in, cell, ',');) all.push_back(cell);
      return all;
    };
    const auto names = cells(lines[0]);
    const auto place = [&](const char* name) {
      return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
    };
    for (std::size_t k = 1; k < lines.size(); ++k) {
      const auto row = cells(lines[k]);
      if (row[place("stage")] != stage) continue;
      strain.push_back(std::stod(row[place("axial_strain")]));
      volume.push_back(std::stod(row[place("volumetric_strain")]));
      angle.push_back(std::stod(row[place("friction_angle_deg")]));
    }
  }
};

TEST(SummaryPeaks, AreThoseOfTheHistorysRowsAlsoOfAResumedRun) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.toml", shearing_scene());
  const std::string out = folder.path("out");
  ASSERT_EQ(run_tool({"run", scene, "--out", out, "--quiet"}).status, 0);
  const auto summary = nlohmann::json::parse(read_file(out + "/summary.json"));
  const Sheared rows(read_file(out + "/history.csv"), "shear");
  // The highest mean over as many rows as lie within 0.01 of strain: of equal steps, all full.
  double highest = 0.0, strain_there = 0.0;
  for (std::size_t first = 0; first < rows.strain.size(); ++first) {
    double angle = 0.0, strain = 0.0, count = 0.0;
    for (std::size_t k = first; k < rows.strain.size(); ++k) {
      if (rows.strain[k] > rows.strain[first] + 0.01) break;
      angle += rows.angle[k];
      strain += rows.strain[k];
      count += 1.0;
    }
    if (rows.strain[first] + 0.01 > rows.strain.back() || angle / count <= highest) continue;
    highest = angle / count;
    strain_there = strain / count;
  }
  EXPECT_NEAR(summary["peak_friction_angle_deg"].get<double>(), highest, 1e-9);
  EXPECT_NEAR(summary["strain_at_peak_friction"].get<double>(), strain_there, 1e-9);
  EXPECT_LT(highest, *std::max_element(rows.angle.begin(), rows.angle.end()));
  // The rate's mean over its window is near the chord of the volume there.
  const double rate = summary["peak_dilation_rate"].get<double>();
  const double at = summary["strain_at_peak_dilation"].get<double>();
  std::size_t from = 0, to = 0;
  for (std::size_t k = 0; k < rows.strain.size(); ++k) {
    if (rows.strain[k] < at - 0.005) from = k;
    if (rows.strain[k] <= at + 0.005) to = k;
  }
  const double chord =
      (rows.volume[to] - rows.volume[from]) / (rows.strain[to] - rows.strain[from]);
  EXPECT_NEAR(rate, chord, 0.15 * std::abs(chord) + 0.02);

  // Given up early in the shear and gone on with in the same directory: the same peaks.
  const std::string again = folder.path("again");
  const std::string early = folder.write(
      "early.toml",
      with(shearing_scene(), "axial_strain = 0.1", "max_cycles = 200\naxial_strain = 0.1"));
  ASSERT_EQ(run_tool({"run", early, "--out", again, "--quiet"}).status, 1);
  ASSERT_FALSE(std::filesystem::exists(again + "/summary.json"));
  const std::string state = again + "/checkpoint.state";
  ASSERT_EQ(run_tool({"run", scene, "--out", again, "--quiet", "--resume", state}).status, 0);
  const auto resumed = nlohmann::json::parse(read_file(again + "/summary.json"));
  for (const char* key : {"peak_dilation_rate", "strain_at_peak_dilation"})
    EXPECT_EQ(resumed[key], summary[key]) << key;
  // The row in which it was given up is one more of the dozen in a window at the peak, each up to 2
  // degrees off their mean.
  EXPECT_NEAR(resumed["peak_friction_angle_deg"].get<double>(), highest, 2.0 / 12.0);
  EXPECT_NEAR(resumed["strain_at_peak_friction"].get<double>(), strain_there, 0.01);
}

}  // namespace
}  // namespace tangency::testing
