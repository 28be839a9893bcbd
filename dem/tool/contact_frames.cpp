// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/contact_frames.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <tangency/dem/tool/contact_fields.hpp>
#include <tangency/dem/tool/vtk_file.hpp>
#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::dem {
namespace {

using Of = VtkPolyData::Of;

/// Numbers of all contacts, `repeat` times each.
template <class Number, class F>
std::vector<Number> numbers(const Packing& packing, F&& value, int repeat = 1) {
  std::vector<Number> all;
  for (std::size_t k = 0; k < packing.contacts.size(); ++k)
    for (int time = 0; time < repeat; ++time) all.push_back(static_cast<Number>(value(k)));
  return all;
}

template <class Number, class F>
std::vector<Number> vectors(const Packing& packing, F&& value) {
  std::vector<Number> all;
  for (std::size_t k = 0; k < packing.contacts.size(); ++k)
    for (const double x : value(k)) all.push_back(static_cast<Number>(x));
  return all;
}

/// What points and lines have in common.
void add_names(VtkPolyData& file, Of of, const Packing& packing, const Units& units) {
  const PackingContacts& all = packing.contacts;
  file.add(of, "a", 1,
           numbers<std::int32_t>(packing, [&](std::size_t k) { return all.bodies[k][0]; }));
  file.add(of, "b", 1,
           numbers<std::int32_t>(packing, [&](std::size_t k) { return all.bodies[k][1]; }));
  file.add(of, "sliding", 1,
           numbers<std::int32_t>(packing, [&](std::size_t k) { return all.sliding[k]; }));
  file.add(of, "normal_force", 1,
           numbers<float>(packing, [&](std::size_t k) { return all.normal_force[k]; }),
           units.force);
}

const Vec3& centre_of_a(const Packing& packing, std::size_t contact) {
  return packing.particles.position[static_cast<std::size_t>(packing.contacts.bodies[contact][0])];
}

}  // namespace

std::string unit_of_velocity(const Units& units) {
  return units.length.empty() ? "" : units.length + "/" + units.time;
}

std::string contacts_vtp(const State& state, const Packing& packing, const Units& units) {
  const PackingContacts& all = packing.contacts;
  const std::vector<Vec3> velocity = contact_velocities(packing, state.cell);
  VtkPolyData file(VtkPolyData::Cells::points, all.size());
  file.places(vectors<double>(packing,
                              [&](std::size_t k) {
                                return Vec3(all.point[k] - state.cell.translation(
                                                               state.cell.image_of(all.point[k])));
                              }),
              units.length);
  add_names(file, Of::points, packing, units);
  const auto add = [&](const char* name, const std::string& unit, auto&& value) {
    file.add(Of::points, name, 3, vectors<float>(packing, value), unit);
  };
  add("normal", "", [&](std::size_t k) { return all.normal[k]; });
  add("force", units.force, [&](std::size_t k) { return all.force[k]; });
  add("shear_force", units.force, [&](std::size_t k) { return shear_force(all, k); });
  add("velocity", unit_of_velocity(units), [&](std::size_t k) { return velocity[k]; });
  file.add(Of::points, "gap", 1, numbers<float>(packing, [&](std::size_t k) { return all.gap[k]; }),
           units.length);
  file.add(Of::points, "curvature", 2,
           vectors<float>(packing, [&](std::size_t k) { return relative_curvatures(packing, k); }),
           units.length.empty() ? "" : "1/" + units.length);
  return file.text();
}

std::string chains_vtp(const State& state, const Packing& packing, const Units& units) {
  const PackingContacts& all = packing.contacts;
  VtkPolyData file(VtkPolyData::Cells::lines, 2 * all.size());
  file.places(vectors<double>(
                  packing,
                  [&](std::size_t k) {
                    const Vec3& centre = centre_of_a(packing, k);
                    const Vec3 start = centre - state.cell.translation(state.cell.image_of(centre));
                    const Vec3 end = start + all.branch[k];
                    return std::array{start[0], start[1], start[2], end[0], end[1], end[2]};
                  }),
              units.length);
  file.add(Of::points, "normal_force", 1,
           numbers<float>(
               packing, [&](std::size_t k) { return all.normal_force[k]; }, 2),
           units.force);
  add_names(file, Of::cells, packing, units);
  const auto add = [&](const char* name, auto&& value) {
    file.add(Of::cells, name, 1, numbers<float>(packing, value), units.force);
  };
  add("force_size", [&](std::size_t k) { return all.force[k].norm(); });
  add("shear_size", [&](std::size_t k) { return shear_force(all, k).norm(); });
  return file.text();
}

std::string bonds_dump(const State& state, const Packing& packing) {
  const PackingContacts& all = packing.contacts;
  std::string text = "ITEM: TIMESTEP\n" + tables::to_text(state.cycle) +
                     "\nITEM: NUMBER OF BONDS\n" + tables::to_text(all.size()) +
                     "\nITEM: BONDS id1 id2 px py pz normal_force shear_force sliding\n";
  const auto image_of = [&](std::int64_t id) {
    return state.cell.image_of(packing.particles.position[static_cast<std::size_t>(id)]);
  };
  const auto add = [&](auto number) {
    tables::append_text(text, number);
    text += ' ';
  };
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto& [a, b] = all.bodies[k];
    const Image of_a = image_of(a), of_b = image_of(b);
    add(a + 1);
    add(b + 1);
    for (std::size_t axis = 0; axis < 3; ++axis) add(all.image[k][axis] + of_b[axis] - of_a[axis]);
    add(static_cast<float>(all.normal_force[k]));
    add(static_cast<float>(shear_force(all, k).norm()));
    text += tables::to_text(int{all.sliding[k]}) + '\n';
  }
  return text;
}

}  // namespace tangency::inline v0::dem
