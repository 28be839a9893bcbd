// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/frames.hpp>

#include <fcntl.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <fstream>
#include <span>
#include <string>
#include <system_error>
#include <vector>

#include <tangency/dem/tool/contact_frames.hpp>
#include <tangency/dem/tool/contact_tables.hpp>
#include <tangency/dem/tool/cycle_files.hpp>
#include <tangency/dem/tool/packing.hpp>
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
Eigen::Matrix<float, 9, 1> axes_tensor(const Particles& particles, std::size_t i) {
  const Mat3 rotation = particles.orientation[i].toRotationMatrix();
  const Mat3 tensor = rotation * (2.0 * particles.semi_axes[i]).asDiagonal() * rotation.transpose();
  return tensor.reshaped().cast<float>();
}

std::string particles_vtp(const State& state, const Units& units) {
  const Particles& p = state.particles;
  const std::vector<std::int32_t>& contacts = state.contacts.resultants().contacts;
  const std::vector<std::uint32_t> in_order = p.index_of_id();
  using Of = VtkPolyData::Of;
  VtkPolyData file(VtkPolyData::Cells::points, p.size(), "axes");
  // Of all particles in the order of the scene.
  const auto numbers = [&]<class Number>(Number, auto&& value) {
    std::vector<Number> all;
    for (const std::uint32_t i : in_order)
      for (const Number x : value(i)) all.push_back(x);
    return all;
  };
  const auto integers = [&](const std::vector<std::int32_t>& of_particles) {
    std::vector<std::int32_t> all;
    for (const std::uint32_t i : in_order) all.push_back(of_particles[i]);
    return all;
  };
  const Eigen::Matrix<double, 9, 1> edges = state.cell.edges.reshaped();
  file.add(Of::whole, "cell", 9, std::span<const double>(edges.data(), 9), units.length);
  std::vector<double> walls;
  for (const PlaneWall& wall : state.cell.planes)
    walls.insert(walls.end(), {wall.normal[0], wall.normal[1], wall.normal[2], wall.offset});
  const std::array<std::int32_t, 1> plane{2};
  if (state.cell.dimensions == 2) file.add(Of::whole, "dimensions", 1, plane);
  if (!walls.empty()) file.add(Of::whole, "walls", 4, walls);
  file.places(numbers(0.0, [&](std::size_t i) { return wrapped(state, i); }), units.length);
  file.add(Of::points, "axes", 9, numbers(0.0F, [&](std::size_t i) { return axes_tensor(p, i); }),
           units.length);
  file.add(Of::points, "orientation", 4,
           numbers(0.0, [&](std::size_t i) { return p.orientation[i].coeffs(); }));
  file.add(Of::points, "semi_axes", 3, numbers(0.0, [&](std::size_t i) { return p.semi_axes[i]; }),
           units.length);
  file.add(Of::points, "velocity", 3, numbers(0.0, [&](std::size_t i) { return p.velocity[i]; }),
           unit_of_velocity(units));
  file.add(Of::points, "type", 1, integers(p.type));
  file.add(Of::points, "contacts", 1, integers(contacts));
  return file.text();
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
                     "aspherical_shape:R:3:velo:R:3:id:I:1 cycle=" +
                     to_text(state.cycle) + " Time=" + to_text(state.time) + "\n";
  for (const std::uint32_t i : p.index_of_id())
    text += simulation.scene().particle_types[static_cast<std::size_t>(p.type[i])].name + " " +
            row(wrapped(state, i)) + " " + row(p.orientation[i].coeffs()) + " " +
            row(p.semi_axes[i]) + " " + row(p.velocity[i]) + " " + to_text(p.id[i] + 1) + "\n";
  return text;
}

}  // namespace

Frames::Frames(const std::filesystem::path& directory, std::int64_t last_cycle, bool adds,
               bool adds_contacts)
    : directory_(directory), adds_(adds), adds_contacts_(adds && adds_contacts) {
  if (!adds_ && !holds_any()) return;
  make_folder(directory_ / "frames");
  // All that may fail comes first: then nothing has been taken away yet.
  std::deque<WholeFile> indices;
  std::vector<std::filesystem::path> later;
  for (Kind& kind : kinds_) {
    const std::vector<VtkEntry> removed = read_index(kind, last_cycle);
    if (!removed.empty()) indices.emplace_back(directory_ / kind.index).write(index_of(kind));
    for (const VtkEntry& entry : removed) {
      later.push_back(file_of(kind, entry.cycle));
      if (kind.has_bonds) later.push_back(bonds_of(entry.cycle));
    }
  }
  keep_xyz(last_cycle);
  for (WholeFile& index : indices) index.publish();
  for (const auto& file : later) std::filesystem::remove(file);
  for (const Kind& kind : kinds_)
    if (kind.entries.empty()) std::filesystem::remove(directory_ / kind.index);
  if (adds_ || !kinds_.front().entries.empty()) return;
  xyz_.close();
  std::filesystem::remove(directory_ / "frames.xyz.part");
  std::error_code error;  // another's files may be in it
  std::filesystem::remove(directory_ / "frames", error);
}

bool Frames::holds_any() const {
  for (const char* name : {"frames.pvd", "frames.xyz", "frames.xyz.part"})
    if (std::filesystem::exists(directory_ / name)) return true;
  return false;
}

std::filesystem::path Frames::file_of(const Kind& kind, std::int64_t cycle) const {
  return directory_ / "frames" / (to_text(cycle) + kind.ending);
}

std::filesystem::path Frames::bonds_of(std::int64_t cycle) const {
  return directory_ / "frames" / (to_text(cycle) + ".bonds");
}

std::string Frames::index_of(const Kind& kind) const {
  return vtk_collection(kind.entries, "frames", kind.ending);
}

std::vector<VtkEntry> Frames::read_index(Kind& kind, std::int64_t last_cycle) const {
  std::vector<VtkEntry> later;
  std::ifstream in(directory_ / kind.index);
  for (const VtkEntry& entry : vtk_entries(in, "frames", kind.ending))
    (entry.cycle <= last_cycle ? kind.entries : later).push_back(entry);
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
    long left = std::stol(count);
    for (; left > 0 && std::getline(in, line); --left) frame += line + "\n";
    if (left > 0 || in.eof()) break;  // cut short
    kept += frame;
    xyz_cycle_ = std::stoll(*cycle);
  }
  in.close();
  write_whole(part, kept);
  xyz_ = tables::Descriptor(::open(part.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC));
  if (!xyz_.is_open()) throw WriteError(part, errno);
  std::filesystem::remove(whole);
}

bool Frames::has(const Kind& kind, std::int64_t cycle) {
  return !kind.entries.empty() && kind.entries.back().cycle == cycle;
}

void Frames::add_to(Kind& kind, const State& state, const std::string& file) {
  write_whole(file_of(kind, state.cycle), file);
  kind.entries.push_back({state.cycle, state.time});
  write_whole(directory_ / kind.index, index_of(kind));
}

void Frames::add(const Simulation& simulation) {
  const State& state = simulation.state();
  const Units units = simulation.scene().units.value_or(Units());
  auto& [particles, contacts, chains] = kinds_;
  if (adds_contacts_ && !has(chains, state.cycle)) {
    const Packing packing = packing_of(state, laws_of(simulation));
    write_whole(bonds_of(state.cycle), bonds_dump(state, packing));
    if (!has(contacts, state.cycle)) add_to(contacts, state, contacts_vtp(state, packing, units));
    add_to(chains, state, chains_vtp(state, packing, units));
  }
  if (!adds_) return;
  if (!has(particles, state.cycle)) add_to(particles, state, particles_vtp(state, units));
  if (xyz_cycle_ == state.cycle) return;
  write_all(xyz_.get(), xyz_of(simulation), directory_ / "frames.xyz.part");
  xyz_cycle_ = state.cycle;
}

void Frames::finish() {
  if (!xyz_.is_open()) return;
  const auto part = directory_ / "frames.xyz.part";
  if (!xyz_.close()) throw WriteError(part, errno);
  std::filesystem::rename(part, directory_ / "frames.xyz");
}

}  // namespace tangency::inline v0::dem
