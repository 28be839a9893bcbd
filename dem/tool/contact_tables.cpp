// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/contact_tables.hpp>

#include <array>
#include <cstddef>
#include <string_view>

#include <tangency/dem/tool/cycle_files.hpp>
#include <tangency/dem/tool/packing.hpp>
#include <tangency/dem/whole_file.hpp>
#include <tangency/geometry/tables/csv.hpp>
#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::dem {
namespace {

using tables::RowText;

constexpr std::array<std::string_view, 23> kContactColumns{
    "a",  "b",  "ix", "iy", "iz", "x",  "y",  "z",  "nx", "ny", "nz",     "gap",
    "bx", "by", "bz", "ax", "ay", "az", "fn", "fx", "fy", "fz", "sliding"};
constexpr std::array<std::string_view, 19> kParticleColumns{
    "id", "type", "x",  "y",  "z",  "r1", "r2", "r3", "qw",      "qx",
    "qy", "qz",   "vx", "vy", "vz", "wx", "wy", "wz", "contacts"};

void add_numbers(RowText& text, const Vec3& v) {
  for (int k = 0; k < 3; ++k) text.number(v[k]);
}

void add_integer(RowText& text, std::int64_t k) { text.text(tables::to_text(k)); }

}  // namespace

std::string contact_table(const State& state, const ContactLaws& laws) {
  const PackingContacts contacts = packing_of(state, laws).contacts;
  RowText text;
  text.header(kContactColumns);
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    for (const std::int64_t body : contacts.bodies[k]) add_integer(text, body);
    for (const std::int32_t edges : contacts.image[k]) add_integer(text, edges);
    add_numbers(text, contacts.point[k]);
    add_numbers(text, contacts.normal[k]);
    text.number(contacts.gap[k]);
    add_numbers(text, contacts.branch[k]);
    add_numbers(text, contacts.arm[k]);
    text.number(contacts.normal_force[k]);
    add_numbers(text, contacts.force[k]);
    add_integer(text, contacts.sliding[k]);
    text.end_row();
  }
  return std::string(text.view());
}

std::string particle_table(const State& state) {
  const PackingParticles particles = packing_of(state).particles;
  RowText text;
  text.header(kParticleColumns);
  for (std::size_t id = 0; id < particles.size(); ++id) {
    text.integer(id);
    add_integer(text, particles.type[id]);
    add_numbers(text, particles.position[id]);
    add_numbers(text, particles.semi_axes[id]);
    const Quaternion& q = particles.orientation[id];
    for (const double part : {q.w(), q.x(), q.y(), q.z()}) text.number(part);
    add_numbers(text, particles.velocity[id]);
    add_numbers(text, particles.angular_velocity[id]);
    add_integer(text, particles.contacts[id]);
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
  std::filesystem::create_directories(folder_);
  write_whole(file_of(state.cycle), contact_table(state, simulation.laws()));
  last_cycle_ = state.cycle;
}

}  // namespace tangency::dem
