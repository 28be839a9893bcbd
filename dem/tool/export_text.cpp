// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/export_text.hpp>

#include <algorithm>
#include <cstddef>

#include <tangency/dem/particles.hpp>
#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::dem {
namespace {

using tables::to_text;

/// A line of numbers, with blanks between them.
class Row {
 public:
  explicit Row(std::string& text) : text_(text), start_(text.size()) {}
  ~Row() { text_ += '\n'; }
  Row(const Row&) = delete;
  Row& operator=(const Row&) = delete;

  template <class... Numbers>
  Row& add(Numbers... numbers) {
    (one(numbers), ...);
    return *this;
  }
  Row& add(const Vec3& v) { return add(v[0], v[1], v[2]); }
  Row& add(const std::string& word) {
    separate();
    text_ += word;
    return *this;
  }

 private:
  void separate() {
    if (text_.size() > start_) text_ += ' ';
  }
  template <class Number>
  void one(Number number) {
    separate();
    tables::append_text(text_, number);
  }

  std::string& text_;
  std::size_t start_;
};

bool is_tilted(const Sample& sample) { return !sample.edges.isDiagonal(0.0); }

double mass_of(const Sample& sample, std::size_t i) {
  return sample.density[i] * volume_of(sample.semi_axes[i]);
}

Vec3 angular_momentum(const Sample& sample, std::size_t i) {
  const Mat3 rotation = sample.orientation[i].toRotationMatrix();
  const Vec3 inertia = principal_inertia(mass_of(sample, i), sample.semi_axes[i]);
  return rotation * inertia.cwiseProduct(rotation.transpose() * sample.angular_velocity[i]);
}

void add_ellipsoids(std::string& text, const Sample& sample) {
  text += "\nEllipsoids\n\n";
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const Quaternion& q = sample.orientation[i];
    Row(text).add(i + 1).add(Vec3(2.0 * sample.semi_axes[i])).add(q.w(), q.x(), q.y(), q.z());
  }
}

/// Of a dump the bounds are those of the box around a tilted cell.
void add_bounds(std::string& text, const Mat3& edges) {
  const double xy = edges(0, 1), xz = edges(0, 2), yz = edges(1, 2);
  const double low_x = std::min({0.0, xy, xz, xy + xz}), high_x = std::max({0.0, xy, xz, xy + xz});
  Row(text).add(low_x, edges(0, 0) + high_x, xy);
  Row(text).add(std::min(0.0, yz), edges(1, 1) + std::max(0.0, yz), xz);
  Row(text).add(0.0, edges(2, 2), yz);
}

}  // namespace

std::string lammps_data(const Sample& sample) {
  const std::string count = to_text(sample.size());
  std::string text =
      "LAMMPS data file by tangency-dem: atom_style ellipsoid, diameters, quaternions w x y z\n\n" +
      count + " atoms\n" + count + " ellipsoids\n" + to_text(sample.type_names.size()) +
      " atom types\n\n";
  const char* axes = "xyz";
  for (Eigen::Index k = 0; k < 3; ++k)
    Row(text).add(0.0, sample.edges(k, k)).add(std::string{axes[k]} + "lo " + axes[k] + "hi");
  if (is_tilted(sample))
    Row(text)
        .add(sample.edges(0, 1), sample.edges(0, 2), sample.edges(1, 2))
        .add(std::string("xy xz yz"));
  text += "\nAtoms # ellipsoid\n\n";
  for (std::size_t i = 0; i < sample.size(); ++i)
    Row(text).add(i + 1, sample.type[i] + 1, 1, sample.density[i]).add(sample.position[i]);
  text += "\nVelocities\n\n";
  for (std::size_t i = 0; i < sample.size(); ++i)
    Row(text).add(i + 1).add(sample.velocity[i]).add(angular_momentum(sample, i));
  add_ellipsoids(text, sample);
  return text;
}

std::string lammps_dump(const Sample& sample) {
  std::string text = "ITEM: TIMESTEP\n" + to_text(sample.cycle) + "\nITEM: NUMBER OF ATOMS\n" +
                     to_text(sample.size()) + "\nITEM: BOX BOUNDS";
  const bool tilted = is_tilted(sample);
  if (tilted) text += " xy xz yz";
  for (const bool periodic : sample.periodic) text += periodic ? " pp" : " ff";
  text += '\n';
  if (tilted)
    add_bounds(text, sample.edges);
  else
    for (Eigen::Index k = 0; k < 3; ++k) Row(text).add(0.0, sample.edges(k, k));
  text +=
      "ITEM: ATOMS id type xu yu zu vx vy vz omegax omegay omegaz shapex shapey shapez "
      "quatw quati quatj quatk mass\n";
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const Quaternion& q = sample.orientation[i];
    Row(text)
        .add(i + 1, sample.type[i] + 1)
        .add(sample.position[i])
        .add(sample.velocity[i])
        .add(sample.angular_velocity[i])
        .add(Vec3(2.0 * sample.semi_axes[i]))
        .add(q.w(), q.x(), q.y(), q.z(), mass_of(sample, i));
  }
  return text;
}

std::string extended_xyz(const Sample& sample) {
  std::string text = to_text(sample.size()) + "\nLattice=\"";
  for (Eigen::Index k = 0; k < 9; ++k) {
    if (k > 0) text += ' ';
    tables::append_text(text, sample.edges(k % 3, k / 3));
  }
  text += "\" pbc=\"";
  for (std::size_t k = 0; k < 3; ++k)
    text += std::string(k > 0 ? " " : "") + (sample.periodic[k] ? "T" : "F");
  text += std::string("\" Properties=type:I:1:pos:R:3:orientation:R:4:aspherical_shape:R:3:") +
          "velo:R:3:id:I:1:angular_velocity:R:3:mass:R:1 cycle=" + to_text(sample.cycle) +
          " Time=" + to_text(sample.time) + "\n";
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const Quaternion& q = sample.orientation[i];
    Row(text)
        .add(sample.type[i] + 1)
        .add(sample.position[i])
        .add(q.x(), q.y(), q.z(), q.w())
        .add(sample.semi_axes[i])
        .add(sample.velocity[i])
        .add(i + 1)
        .add(sample.angular_velocity[i])
        .add(mass_of(sample, i));
  }
  return text;
}

}  // namespace tangency::inline v0::dem
