// SPDX-License-Identifier: MIT
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <iostream>
#include <tangency/dem/scene_keys.hpp>
#include <tangency/dem/state_file.hpp>
#include <tangency/dem/tool/results.hpp>
#include <tangency/dem/tool/run.hpp>

namespace {

using namespace tangency::dem;

int refuse(const std::string& message) {
  std::cerr << message << std::endl;
  return refused;
}

/// DIR where none is given: the scene's name without its ending, in the working directory.
std::filesystem::path default_directory(const std::filesystem::path& scene) {
  return scene.stem().string() + "-out";
}

/// Starts the program again with OpenMP's threads sleeping while they wait, unless the user chose:
/// libgomp reads the choice when it is loaded. A cycle is so short that threads which wait busily
/// on a machine with other work slow it by a factor of ten and more (measured: assembly-125 with 2
/// threads on 2 cores under load, 47 s against 3 s).
void let_idle_threads_sleep(char** argv) {
  if (std::getenv("OMP_WAIT_POLICY") || std::getenv("GOMP_SPINCOUNT")) return;
  setenv("OMP_WAIT_POLICY", "passive", 1);
  execv("/proc/self/exe", argv);  // returns only where it failed: then go on, slower
}

}  // namespace

int main(int argc, char** argv) {
  let_idle_threads_sleep(argv);
  CLI::App app{"tangency-dem: assemblies of ellipsoids by the discrete element method"};
  app.require_subcommand(1);

  RunOptions options;
  std::string scene, out, resume;
  CLI::App* run_command = app.add_subcommand("run", "Run a scene");
  run_command->add_option("SCENE", scene, "Scene in TOML; its keys: tangency-dem schema")
      ->required();
  run_command->add_option("--out", out, "Directory for the results [SCENE's name + -out]");
  run_command->add_option("--threads", options.threads, "Number of threads [all]")
      ->check(CLI::Range(1, 1024));
  run_command->add_option("--resume", resume, "Continue from a final.state or checkpoint.state");
  run_command->add_flag("--quiet", options.quiet, "No progress");
  CLI::App* schema_command = app.add_subcommand("schema", "Print every key of a scene");

  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    return refuse(std::string("tangency-dem: ") + error.what());
  }

  if (schema_command->parsed()) {
    print_schema(std::cout);
    return std::cout.flush() ? success : not_reached;
  }
  options.scene = scene;
  options.out = out.empty() ? default_directory(scene) : std::filesystem::path(out);
  if (!resume.empty()) options.resume = resume;
  try {
    return run(options);
  } catch (const SceneError& error) {
    return refuse(error.what());
  } catch (const StateError& error) {
    return refuse(error.what());
  } catch (const OutputError& error) {
    return refuse(error.what());
  } catch (const std::exception& error) {
    std::cerr << "tangency-dem: " << error.what() << std::endl;
    return not_reached;
  }
}
