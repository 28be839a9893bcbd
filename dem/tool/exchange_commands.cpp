// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/exchange_commands.hpp>

#include <cctype>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tangency/dem/saved/state_file.hpp>
#include <tangency/dem/simulation.hpp>
#include <tangency/dem/tool/cycle_files.hpp>
#include <tangency/dem/tool/exchange_sample.hpp>
#include <tangency/dem/tool/export_lammps.hpp>
#include <tangency/dem/tool/export_text.hpp>
#include <tangency/dem/tool/gsd_file.hpp>
#include <tangency/dem/tool/import_scene.hpp>
#include <tangency/dem/tool/import_text.hpp>
#include <tangency/dem/tool/run.hpp>
#include <tangency/dem/whole_file.hpp>
#include <tangency/geometry/tables/csv.hpp>
#include <tangency/geometry/tables/output_file.hpp>

namespace tangency::inline v0::dem {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kFormats{"lammps-data", "lammps-dump", "gsd", "xyz"};

constexpr const char* kExportHelp = R"(
STATE is a final.state, checkpoint.state or one of states/ of a run in space. Bodies stand in the
order of the scene; contacts are not in these files (tangency-dem contacts). Beware of sizes and
quaternions, which no two formats give alike:
  lammps-data  atom_style ellipsoid: DIAMETERS, quaternion W X Y Z, density, and angular momentum in
               place of angular velocity; ids and types from 1. It reads back to the same double but
               for angular velocities, to rounding
  lammps-dump  dump of style custom, also for OVITO: DIAMETERS as shapex shapey shapez, quaternion
               W X Y Z as quatw quati quatj quatk, angular velocity as omegax omegay omegaz, mass;
               it reads back to the same double, and density to rounding
  gsd          HOOMD's schema 1.4: RADII a b c in particles/type_shapes, quaternion W X Y Z, numbers
               of 32 bits: it reads back to 7 digits. Each shape of a type is a type of its own; the
               origin is the centre of the box
  xyz          extended XYZ, for OVITO and ASE: RADII as aspherical_shape, quaternion X Y Z W as
               orientation, angular_velocity, mass; as lammps-dump reads back
--lammps writes a whole run for tangency-lammps, the program of dem/lammps, into a folder: NAME.data
as lammps-data, and the script in.NAME, which does the stages of --scene that are left, each by fix
tangency/servo and fix tangency/move, with the same laws, steps, rates, stresses and ends. NAME is
that of the scene, with _ for what is no letter and no digit. Without STATE it begins where the
scene places its bodies:
  tangency-dem export --lammps cluster --scene shear.toml
  cd cluster && mpirun -np 2 tangency-lammps -in in.shear
Shear forces of contacts do not go into the data file: a message says where a state has some. Walls
go where no stage strains the cell, each as fix wall/tangency; those that hold a stress, plane scenes
and stages that grow particles or have a ramp do not go to LAMMPS.
LAMMPS and HOOMD have cells with the first edge along x and the second in the plane of x and y. A
cell that shear has tilted otherwise is turned into that, with all vectors: it then does not read
back to the same double, and LAMMPS may ask for `box tilt large`.

Exit status:
  0    done
  2    STATE is no state of this program's version, one in the plane, or not one of SCENE; SCENE has
       what LAMMPS has not; or a file cannot be written
)";

constexpr const char* kImportHelp = R"(
Reads a sample of another program and writes a table of its bodies, from which a scene places them.
The format is told by FILE's first bytes, else by --format. Beware of sizes and quaternions:
  lammps-data  atom_style ellipsoid (DIAMETERS, quaternion W X Y Z) or sphere (diameters). The cell
               counts as periodic
  lammps-dump  columns id; xu yu zu, x y z, xsu ysu zsu or xs ys zs; shapex shapey shapez (DIAMETERS),
               diameter or radius; and if so wanted type, vx vy vz, omegax omegay omegaz, quatw quati
               quatj quatk (W X Y Z), mass. Boundaries that are not periodic become walls
  gsd          RADII of type_shapes Ellipsoid, diameters of Sphere; quaternion W X Y Z; places are
               those of the image that particles/image says
  xyz          extended XYZ: pos; aspherical_shape (RADII) or radius; and if so wanted species or
               type, orientation (X Y Z W), velo, angular_velocity, mass; pbc F becomes walls
Without a mass the density is 1000, and of gsd the mass is 1, as HOOMD has it. Centres count from the
cell's corner. Columns of the table:
  type        name of the kind of body: each type, semi-axes and density is a kind
  x y z       centre;  qw qx qy qz  quaternion, body to space, of the length it had
  vx vy vz wx wy wz
              velocity and angular velocity
  r1 r2 r3    semi-axes in descending order: body axes are turned where they were not
  density     mass over volume
--scene writes the beginning of a scene beside it: [cell], a [particles.NAME] a kind, and the stage
that places the table. Add [contact] and further stages, and run it:
  tangency-dem import grains.data --out grains.csv --scene grains.toml
  cat loading.toml >> grains.toml && tangency-dem run grains.toml

Exit status:
  0    done
  2    FILE is refused, in one line that says where, what and what is allowed; or a file cannot be
       written
)";

std::string exported(const Sample& sample, const std::string& format) {
  if (format == "xyz") return extended_xyz(sample);
  const Sample turned = with_triangular_cell(sample);
  if (format == "lammps-data") return lammps_data(turned);
  return format == "gsd" ? gsd_file(turned) : lammps_dump(turned);
}

std::string format_of(std::string_view text) {
  if (is_gsd(text)) return "gsd";
  if (text.substr(0, 5) == "ITEM:") return "lammps-dump";
  const std::size_t first = text.find('\n');
  const std::string_view second =
      first == text.npos ? "" : text.substr(first + 1, text.find('\n', first + 1) - first - 1);
  return second.find("Lattice=") != second.npos ? "xyz" : "lammps-data";
}

Sample read_of_kind(const std::string& kind, const std::string& name, const std::string& text,
                    std::optional<int> frame) {
  if (kind == "gsd") return read_gsd(name, text, frame);
  if (kind == "lammps-dump") return read_lammps_dump(name, text, frame);
  return kind == "xyz" ? read_extended_xyz(name, text, frame) : read_lammps_data(name, text);
}

/// Numbers of a file are finite; quotients of them may not be.
void require_finite(const std::string& name, const Sample& sample) {
  const auto check = [&](const auto& columns, const char* column, const auto& is_finite) {
    for (std::size_t k = 0; k < columns.size(); ++k) {
      if (is_finite(columns[k])) continue;
      throw tables::Error({.file = name,
                           .column = "body " + std::to_string(k) + ", " + column,
                           .value = "inf",
                           .rule = "must be a double, from the numbers of its mass and size"});
    }
  };
  const auto all_finite = [](const Vec3& v) { return v.allFinite(); };
  check(sample.position, "place", all_finite);
  check(sample.velocity, "velocity", all_finite);
  check(sample.angular_velocity, "angular velocity", all_finite);
  check(sample.density, "density", [](double v) { return std::isfinite(v); });
}

/// @param file  `-` is standard input
Sample imported(const std::string& file, const std::string& format, std::optional<int> frame) {
  const bool is_input = file == "-";
  const std::string text = bytes_of_file(is_input ? "/dev/stdin" : file);
  const std::string name = is_input ? std::string(tables::kStandardInputName) : file;
  if (text.empty()) throw tables::Error({.file = name, .rule = "empty: a sample must be there"});
  const std::string kind = format.empty() ? format_of(text) : format;
  if (frame && kind == "lammps-data")
    throw tables::UsageError("--frame: a data file of LAMMPS has but one");
  Sample sample = read_of_kind(kind, name, text, frame);
  require_finite(name, sample);
  return sample;
}

void write(const std::string& file, const std::string& text) {
  tables::OutputFile out(file);
  out.write(text);
  out.commit();
}

struct ExportWords {
  std::string state, format, out, folder, scene;
};

/// @throws tables::UsageError, and what the files are refused for
int export_script(const ExportWords& words) {
  if (words.scene.empty())
    throw tables::UsageError("--lammps needs --scene, whose stages are done");
  if (!words.format.empty() || !words.out.empty())
    throw tables::UsageError("--lammps: without --format and --out");
  RunOptions options;
  options.scene = words.scene;
  if (!words.state.empty()) options.resume = words.state;
  options.quiet = true;
  const Simulation run = simulation_of(options, scene_file_of(options));
  std::string name = fs::path(words.scene).stem().string();
  for (char& c : name)  // LAMMPS divides words at blanks and reads $ as variables
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '.' && c != '-') c = '_';
  const std::string script = lammps_script(run, name, words.scene);
  std::vector<std::string> types;
  for (const ParticleType& type : run.scene().particle_types) types.push_back(type.name);
  const std::string data = lammps_data(with_triangular_cell(sample_of(run.state(), types)));
  make_folder(words.folder);
  tables::OutputFile script_out(words.folder + "/in." + name),
      data_out(words.folder + "/" + name + ".data");
  script_out.write(script);
  data_out.write(data);
  data_out.commit();
  script_out.commit();
  for (const std::string& lost : lost_in_lammps(run.state()))
    std::cerr << "tangency-dem: " << words.state << ": " << lost << std::endl;
  return success;
}

/// @throws tables::UsageError, and what STATE is refused for
int export_bodies(const ExportWords& words) {
  if (words.state.empty()) throw tables::UsageError("STATE: missing");
  if (words.format.empty()) throw tables::UsageError("--format or --lammps: one of them is needed");
  if (!words.scene.empty()) throw tables::UsageError("--scene: with --lammps alone");
  write(words.out.empty() ? "-" : words.out,
        exported(sample_of(load_state(words.state)), words.format));
  return success;
}

struct ImportWords {
  std::string file, format, out, scene;
  int frame = 0;
};

/// @throws tables::UsageError  where the scene could not name the table, or is the table
void require_two_files(const std::string& table, const std::string& scene) {
  if (table == "-")
    throw tables::UsageError("--out = -: with --scene a file, which the scene names");
  if (scene == "-") throw tables::UsageError("--scene = -: a file, which lies beside the table");
  if (fs::weakly_canonical(fs::absolute(table)) == fs::weakly_canonical(fs::absolute(scene)))
    throw tables::UsageError("--scene = " + scene + ": another file than --out");
}

int import_file(const ImportWords& words, bool has_frame) {
  if (!words.scene.empty() && words.out.empty())
    throw tables::UsageError("--scene needs --out, the table that the scene names");
  const Sample sample = with_descending_axes(imported(
      words.file, words.format, has_frame ? std::optional<int>(words.frame) : std::nullopt));
  const BodyKinds kinds = kinds_of(sample);
  if (words.scene.empty()) {
    write(words.out.empty() ? "-" : words.out, body_table(sample, kinds));
    return success;
  }
  require_two_files(words.out, words.scene);
  const fs::path folder = fs::absolute(words.scene).parent_path();
  const std::string table = fs::absolute(words.out).lexically_relative(folder).string();
  const std::string scene = scene_of(sample, kinds, words.file, table);
  tables::OutputFile table_out(words.out), scene_out(words.scene);
  table_out.write(body_table(sample, kinds));
  scene_out.write(scene);
  table_out.commit();
  scene_out.commit();
  return success;
}

}  // namespace

void add_export(tables::Program& program) {
  const auto words = std::make_shared<ExportWords>();
  tables::Command& command = program.subcommand(
      "export", "A state's bodies, or the rest of a run, as files of another program");
  command.option("STATE", words->state, "State of a run; not needed with --lammps");
  command.option("--format", words->format, "Which").one_of(kFormats);
  command.option("--out", words->out, "File to write [standard output]")
      .type_name("FILE")
      .not_empty();
  command.option("--lammps", words->folder, "Folder for a script of LAMMPS and its data file")
      .type_name("DIR")
      .not_empty();
  command.option("--scene", words->scene, "Scene of the run, whose stages the script does")
      .type_name("FILE")
      .not_empty();
  command.footer(kExportHelp);
  command.runs(
      [words] { return words->folder.empty() ? export_bodies(*words) : export_script(*words); });
}

void add_import(tables::Program& program) {
  const auto words = std::make_shared<ImportWords>();
  tables::Command& command =
      program.subcommand("import", "Bodies of another program's file as a table for scenes");
  command.option("FILE", words->file, "File of another program; - is standard input").required();
  command.option("--format", words->format, "Which [by the file's first bytes]").one_of(kFormats);
  const tables::Option frame =
      command.option("--frame", words->frame, "Frame, from 0 [the last one]")
          .between(0, 1'000'000'000);
  command.option("--out", words->out, "File for the table [standard output]")
      .type_name("FILE")
      .not_empty();
  command.option("--scene", words->scene, "Scene to write, which places the table's bodies")
      .type_name("FILE")
      .not_empty();
  command.footer(kImportHelp);
  command.runs([words, frame] { return import_file(*words, frame.given()); });
}

}  // namespace tangency::inline v0::dem
