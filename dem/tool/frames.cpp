// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/frames.hpp>

#include <fcntl.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

#include <tangency/dem/tool/cycle_files.hpp>
#include <tangency/dem/whole_file.hpp>
#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::dem {
namespace {

using tables::to_text;

template <class Vector>
std::string row(const Vector& v) {
  std::string text;
  for (Eigen::Index k = 0; k < v.size(); ++k) text += (k ? " " : "") + to_text(v[k]);
  return text;
}

Vec3 wrapped(const State& state, std::size_t i) {
  const Vec3& x = state.particles.position[i];
  return x - state.cell.translation(state.cell.image_of(x));
}

/// R diag(2a) R', row by row.
Eigen::Matrix<double, 9, 1> axes_tensor(const Particles& particles, std::size_t i) {
  const Mat3 rotation = particles.orientation[i].toRotationMatrix();
  const Mat3 tensor = rotation * (2.0 * particles.semi_axes[i]).asDiagonal() * rotation.transpose();
  return tensor.reshaped();
}

/// One array of a VTK XML file; `value(i)` is the text of item i.
template <class F>
void data_array(std::ostream& out, const std::string& attributes, std::size_t count, F&& value) {
  out << "<DataArray " << attributes << " format=\"ascii\">\n";
  for (std::size_t i = 0; i < count; ++i) out << value(i) << '\n';
  out << "</DataArray>\n";
}

std::string vtp_of(const State& state) {
  const Particles& p = state.particles;
  const std::size_t n = p.size();
  const std::vector<std::int32_t>& contacts = state.contacts.resultants().contacts;
  const std::vector<std::uint32_t> in_order = p.index_of_id();
  const std::string real = "type=\"Float64\" NumberOfComponents=";
  std::ostringstream out;
  // Of all particles in the order of the scene.
  const auto particle_array = [&](const std::string& attributes, auto&& value) {
    data_array(out, attributes, n, [&](std::size_t id) { return value(in_order[id]); });
  };
  out << "<?xml version=\"1.0\"?>\n"
         "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\">\n<PolyData>\n"
         "<FieldData>\n";
  data_array(out, real + "\"9\" NumberOfTuples=\"1\" Name=\"cell\"", 1,
             [&](std::size_t) { return row(state.cell.edges.reshaped()); });
  out << "</FieldData>\n<Piece NumberOfPoints=\"" << n << "\" NumberOfVerts=\"" << n
      << "\">\n<Points>\n";
  particle_array(real + "\"3\"", [&](std::size_t i) { return row(wrapped(state, i)); });
  out << "</Points>\n<Verts>\n";
  const std::string integer = "type=\"Int32\" Name=";
  data_array(out, integer + "\"connectivity\"", n, [](std::size_t i) { return to_text(i); });
  data_array(out, integer + "\"offsets\"", n, [](std::size_t i) { return to_text(i + 1); });
  out << "</Verts>\n<PointData Tensors=\"axes\">\n";
  particle_array(real + "\"9\" Name=\"axes\"",
                 [&](std::size_t i) { return row(axes_tensor(p, i)); });
  particle_array(real + "\"4\" Name=\"orientation\"",
                 [&](std::size_t i) { return row(p.orientation[i].coeffs()); });
  particle_array(real + "\"3\" Name=\"semi_axes\"",
                 [&](std::size_t i) { return row(p.semi_axes[i]); });
  particle_array(real + "\"3\" Name=\"velocity\"",
                 [&](std::size_t i) { return row(p.velocity[i]); });
  particle_array(integer + "\"type\"", [&](std::size_t i) { return to_text(p.type[i]); });
  particle_array(integer + "\"contacts\"", [&](std::size_t i) { return to_text(contacts[i]); });
  out << "</PointData>\n</Piece>\n</PolyData>\n</VTKFile>\n";
  return out.str();
}

std::string xyz_of(const Simulation& simulation) {
  const State& state = simulation.state();
  const Particles& p = state.particles;
  std::string periodic;
  for (std::size_t k = 0; k < 3; ++k)
    periodic += std::string(k ? " " : "") +
                (state.cell.walled[k] || (k == 2 && state.cell.dimensions == 2) ? "F" : "T");
  std::string text = to_text(p.size()) + "\nLattice=\"" + row(state.cell.edges.reshaped()) +
                     "\" pbc=\"" + periodic +
                     "\" Properties=species:S:1:pos:R:3:orientation:R:4:"
                     "aspherical_shape:R:3:velo:R:3 cycle=" +
                     to_text(state.cycle) + " Time=" + to_text(state.time) + "\n";
  for (const std::uint32_t i : p.index_of_id())
    text += simulation.scene().particle_types[static_cast<std::size_t>(p.type[i])].name + " " +
            row(wrapped(state, i)) + " " + row(p.orientation[i].coeffs()) + " " +
            row(p.semi_axes[i]) + " " + row(p.velocity[i]) + "\n";
  return text;
}

/// Of a frame for ParaView, seen from the directory of the results.
std::string file_of(std::int64_t cycle) { return "frames/" + to_text(cycle) + ".vtp"; }

/// The text between `before` and `after` in a line, if both are there.
std::optional<std::string> between(const std::string& line, const std::string& before,
                                   const std::string& after) {
  const std::size_t start = line.find(before);
  if (start == line.npos) return std::nullopt;
  const std::size_t end = line.find(after, start + before.size());
  if (end == line.npos) return std::nullopt;
  return line.substr(start + before.size(), end - start - before.size());
}

}  // namespace

Frames::Frames(const std::filesystem::path& directory, std::int64_t last_cycle, bool adds)
    : directory_(directory), adds_(adds) {
  if (!adds_ && !holds_any()) return;
  make_folder(directory_ / "frames");
  const std::vector<Entry> later = read_index(last_cycle);
  // All that may fail comes first: then nothing has been taken away yet.
  std::optional<WholeFile> index;
  if (!later.empty()) index.emplace(directory_ / "frames.pvd").write(index_text());
  keep_xyz(last_cycle);
  if (index) index->publish();
  for (const Entry& entry : later) std::filesystem::remove(directory_ / file_of(entry.cycle));
  if (adds_ || !entries_.empty()) return;
  xyz_.close();
  for (const char* name : {"frames.xyz.part", "frames.pvd"})
    std::filesystem::remove(directory_ / name);
  std::error_code error;  // another's files may be in it
  std::filesystem::remove(directory_ / "frames", error);
}

bool Frames::holds_any() const {
  const auto is_there = [&](const char* name) {
    return std::filesystem::exists(directory_ / name);
  };
  return is_there("frames.pvd") || is_there("frames.xyz") || is_there("frames.xyz.part");
}

std::vector<Frames::Entry> Frames::read_index(std::int64_t last_cycle) {
  std::vector<Entry> later;
  std::ifstream in(directory_ / "frames.pvd");
  for (std::string line; std::getline(in, line);) {
    const auto time = between(line, "timestep=\"", "\"");
    const auto cycle = between(line, "file=\"frames/", ".vtp\"");
    if (!time || !cycle) continue;
    const Entry entry{std::stoll(*cycle), std::stod(*time)};
    (entry.cycle <= last_cycle ? entries_ : later).push_back(entry);
  }
  return later;
}

void Frames::keep_xyz(std::int64_t last_cycle) {
  const auto part = directory_ / "frames.xyz.part", whole = directory_ / "frames.xyz";
  // A run that was killed has left its frames under the first name.
  std::ifstream in(std::filesystem::exists(part) ? part : whole);
  std::string kept;
  for (std::string count; std::getline(in, count);) {
    std::string frame = count + "\n", line;
    std::getline(in, line);
    const auto cycle = between(line, " cycle=", " ");
    if (!cycle || std::stoll(*cycle) > last_cycle) break;
    frame += line + "\n";
    for (long left = std::stol(count); left > 0 && std::getline(in, line); --left)
      frame += line + "\n";
    kept += frame;
  }
  in.close();
  write_whole(part, kept);
  xyz_ = tables::Descriptor(::open(part.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC));
  if (!xyz_.is_open()) throw WriteError(part, errno);
  std::filesystem::remove(whole);
}

void Frames::add(const Simulation& simulation) {
  if (!adds_) return;
  const State& state = simulation.state();
  if (!entries_.empty() && entries_.back().cycle == state.cycle) return;
  write_whole(directory_ / file_of(state.cycle), vtp_of(state));
  entries_.push_back({state.cycle, state.time});
  write_whole(directory_ / "frames.pvd", index_text());
  write_all(xyz_.get(), xyz_of(simulation), directory_ / "frames.xyz.part");
}

std::string Frames::index_text() const {
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n<Collection>\n";
  for (const Entry& entry : entries_)
    text += "<DataSet timestep=\"" + to_text(entry.time) + "\" part=\"0\" file=\"" +
            file_of(entry.cycle) + "\"/>\n";
  return text + "</Collection>\n</VTKFile>\n";
}

void Frames::finish() {
  if (!xyz_.is_open()) return;
  const auto part = directory_ / "frames.xyz.part";
  if (!xyz_.close()) throw WriteError(part, errno);
  std::filesystem::rename(part, directory_ / "frames.xyz");
}

}  // namespace tangency::inline v0::dem
