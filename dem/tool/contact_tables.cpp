// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/contact_tables.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include <tangency/dem/tool/contact_fields.hpp>
#include <tangency/dem/tool/csv_text.hpp>
#include <tangency/dem/tool/cycle_files.hpp>
#include <tangency/dem/tool/packing.hpp>
#include <tangency/dem/whole_file.hpp>
#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::dem {
namespace {

constexpr std::array<std::string_view, 31> kContactColumns{"a",
                                                           "b",
                                                           "ix",
                                                           "iy",
                                                           "iz",
                                                           "x",
                                                           "y",
                                                           "z",
                                                           "nx",
                                                           "ny",
                                                           "nz",
                                                           "gap",
                                                           "bx",
                                                           "by",
                                                           "bz",
                                                           "ax",
                                                           "ay",
                                                           "az",
                                                           "fn",
                                                           "fx",
                                                           "fy",
                                                           "fz",
                                                           "sliding",
                                                           "sx",
                                                           "sy",
                                                           "sz",
                                                           "vx",
                                                           "vy",
                                                           "vz",
                                                           "curvature_min",
                                                           "curvature_max"};
constexpr std::array<std::string_view, 25> kParticleColumns{
    "id", "type", "x",  "y",  "z",  "r1",       "r2",   "r3",   "qw",   "qx",   "qy",   "qz",  "vx",
    "vy", "vz",   "wx", "wy", "wz", "contacts", "s_xx", "s_yy", "s_zz", "s_xy", "s_yz", "s_zx"};

template <std::size_t N>
CsvText with_header(const std::array<std::string_view, N>& columns) {
  CsvText text;
  for (const std::string_view name : columns) text.add(name);
  text.end_row();
  return text;
}

}  // namespace

ContactLaws laws_of(const Simulation& simulation) {
  const Scene& scene = simulation.scene();
  const State& state = simulation.state();
  const bool begins = !simulation.finished() && state.stage_cycle == 0 && state.stage > 1;
  if (!begins && !simulation.finished()) return simulation.laws();
  const Stage& was = begins ? scene.stages[state.stage - 1] : simulation.stage();
  const auto friction = was.drive ? was.drive->friction_coefficient : std::nullopt;
  return friction ? with_friction(scene.laws, *friction) : scene.laws;
}

std::string contact_table(const State& state, const ContactLaws& laws) {
  const Packing packing = packing_of(state, laws);
  const PackingContacts& contacts = packing.contacts;
  const std::vector<Vec3> velocities = contact_velocities(packing, state.cell);
  CsvText text = with_header(kContactColumns);
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    for (const std::int64_t body : contacts.bodies[k]) text.add(body);
    for (const std::int32_t edges : contacts.image[k]) text.add(std::int64_t{edges});
    text.add(contacts.point[k]);
    text.add(contacts.normal[k]);
    text.add(contacts.gap[k]);
    text.add(contacts.branch[k]);
    text.add(contacts.arm[k]);
    text.add(contacts.normal_force[k]);
    text.add(contacts.force[k]);
    text.add(std::int64_t{contacts.sliding[k]});
    text.add(shear_force(contacts, k));
    text.add(velocities[k]);
    for (const double curvature : relative_curvatures(packing, k)) text.add(curvature);
    text.end_row();
  }
  return std::string(text.view());
}

std::string particle_table(const State& state) {
  const PackingParticles particles = packing_of(state).particles;
  const std::vector<Mat3> stresses = particle_stresses(state);
  CsvText text = with_header(kParticleColumns);
  for (std::size_t id = 0; id < particles.size(); ++id) {
    text.add(static_cast<std::int64_t>(id));
    text.add(std::int64_t{particles.type[id]});
    text.add(particles.position[id]);
    text.add(particles.semi_axes[id]);
    const Quaternion& q = particles.orientation[id];
    for (const double part : {q.w(), q.x(), q.y(), q.z()}) text.add(part);
    text.add(particles.velocity[id]);
    text.add(particles.angular_velocity[id]);
    text.add(std::int64_t{particles.contacts[id]});
    const Mat3& s = stresses[id];
    for (const double part : {s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(2, 0)}) text.add(part);
    text.end_row();
  }
  return std::string(text.view());
}

ContactTables::ContactTables(const std::filesystem::path& directory, std::int64_t last_cycle,
                             bool adds)
    : folder_(directory / "contacts"), adds_(adds), last_cycle_(-1) {
  remove_later_files(folder_, last_cycle, cycle_of_contact_table);
  // One that is there was made with the laws of the stage that it is of.
  if (std::filesystem::exists(file_of(last_cycle))) last_cycle_ = last_cycle;
}

std::filesystem::path ContactTables::file_of(std::int64_t cycle) const {
  return folder_ / (tables::to_text(cycle) + ".csv");
}

void ContactTables::add(const Simulation& simulation) {
  const State& state = simulation.state();
  if (!adds_ || state.cycle == last_cycle_) return;
  make_folder(folder_);
  write_whole(file_of(state.cycle), contact_table(state, laws_of(simulation)));
  last_cycle_ = state.cycle;
}

}  // namespace tangency::inline v0::dem
