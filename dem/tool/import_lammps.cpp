// SPDX-License-Identifier: MIT
#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <tangency/dem/particles.hpp>
#include <tangency/dem/tool/import_text.hpp>
#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::dem {
namespace {

using tables::to_text;

Vec3 vector_at(const LineReader& in, std::size_t word, std::string_view name) {
  return {in.number(word, name), in.number(word + 1, name), in.number(word + 2, name)};
}

Quaternion unit(const LineReader& in, double w, double x, double y, double z) {
  const Quaternion q(w, x, y, z);
  if (q.coeffs().isZero(0.0)) in.fail("quaternion", in.line(), "4 numbers, not all 0");
  return q;  // as it stands: bodies take any length
}

/// Chosen: as many as particles.
constexpr std::int64_t kMostTypes = 1'000'000;

std::int32_t type_at(const LineReader& in, std::size_t word) {
  const std::int64_t type = in.integer(word, "type");
  if (type < 1 || type > kMostTypes)
    in.fail("type", in.words()[word], "an integer from 1 to " + to_text(kMostTypes));
  return static_cast<std::int32_t>(type);
}

/// Types are called by their numbers.
void add_names_to(std::vector<std::string>& names, std::int32_t type) {
  while (names.size() < static_cast<std::size_t>(type)) names.push_back(to_text(names.size() + 1));
}

/// One atom as the sections of a data file tell of it.
struct Atom {
  std::int32_t type = 0;
  Vec3 position = Vec3::Zero(), velocity = Vec3::Zero(), semi_axes = Vec3::Zero();
  Vec3 spin = Vec3::Zero();  ///< angular momentum; of spheres angular velocity
  Quaternion orientation = Quaternion::Identity();
  double density = 0.0;
  bool has_ellipsoid = false;
};

/// Sections that a data file may have after its header; those not read here are passed over.
bool is_section(std::string_view word) {
  static const std::set<std::string_view> sections{
      "Atoms",     "Velocities", "Ellipsoids", "Masses",    "Bonds",
      "Angles",    "Dihedrals",  "Bodies",     "Impropers", "Lines",
      "Triangles", "Pair",       "PairIJ",     "Bond",      "Angle",
      "Dihedral",  "Improper",   "Atom",       "Ellipsoid", "MiddleBondTorsion"};
  return sections.contains(word);
}

class DataFile {
 public:
  DataFile(const std::string& file, std::string_view text) : in_(file, text) {}

  Sample read() {
    in_.next();  // a title
    while (in_.next()) {
      std::vector<std::string_view> words = in_.words();
      const auto comment = std::find_if(words.begin(), words.end(),
                                        [](std::string_view word) { return word[0] == '#'; });
      const std::string_view style = comment != words.end() && comment + 1 != words.end()
                                         ? *(comment + 1)
                                         : std::string_view();
      words.erase(comment, words.end());
      if (words.empty()) continue;
      if (is_section(words[0]))
        begin_section(words[0], style);
      else if (section_.empty())
        read_header(words);
      else
        read_row();
    }
    return sample();
  }

 private:
  void read_header(const std::vector<std::string_view>& words) {
    const std::string_view last = words.back();
    const std::string_view ends = "xhi yhi zhi";
    if (words.size() == 4 && last.size() == 3 && ends.find(last) != ends.npos) {
      const auto axis = static_cast<Eigen::Index>(last[0] - 'x');
      low_[axis] = in_.number(0, words[2]);
      edges_(axis, axis) = in_.number(1, last) - low_[axis];
      if (!(edges_(axis, axis) > 0.0)) in_.fail(last, words[1], "above " + std::string(words[2]));
    } else if (words.size() == 6 && last == "yz") {
      edges_(0, 1) = in_.number(0, "xy");
      edges_(0, 2) = in_.number(1, "xz");
      edges_(1, 2) = in_.number(2, "yz");
    } else if (last == "atoms") {
      count_ = in_.integer(0, "atoms");
    }
  }

  void begin_section(std::string_view name, std::string_view style) {
    section_ = name;
    if (name != "Atoms") return;
    is_sphere_ = style == "sphere";
    if (!style.empty() && style != "ellipsoid" && !is_sphere_)
      in_.fail("Atoms #", style, "atom_style ellipsoid or sphere");
  }

  void read_row() {
    if (section_ == "Atoms") return is_sphere_ ? read_sphere() : read_atom();
    if (section_ == "Velocities") {
      Atom& atom = known();
      atom.velocity = vector_at(in_, 1, "velocity");
      if (in_.words().size() >= 7)
        atom.spin = vector_at(in_, 4, is_sphere_ ? "angular velocity" : "angular momentum");
    } else if (section_ == "Ellipsoids") {
      Atom& atom = known();
      in_.require_words(8, "Ellipsoids");
      for (std::size_t k = 0; k < 3; ++k)
        atom.semi_axes[static_cast<Eigen::Index>(k)] = 0.5 * in_.positive(1 + k, "diameter");
      atom.orientation = unit(in_, in_.number(4, "quatw"), in_.number(5, "quati"),
                              in_.number(6, "quatj"), in_.number(7, "quatk"));
      atom.has_ellipsoid = true;
    }
  }

  Atom& added() {
    const std::int64_t id = in_.integer(0, "id");
    if (!atoms_.emplace(id, Atom{}).second) in_.fail("id", in_.words()[0], "each id once");
    Atom& atom = atoms_[id];
    atom.type = type_at(in_, 1);
    return atom;
  }
  void read_atom() {
    in_.require_words(7, "Atoms");
    Atom& atom = added();
    if (in_.integer(2, "ellipsoidflag") != 1)
      in_.fail("ellipsoidflag", in_.words()[2], "1: every atom is an ellipsoid");
    atom.density = in_.positive(3, "density");
    atom.position = vector_at(in_, 4, "position");
  }
  void read_sphere() {
    in_.require_words(7, "Atoms");
    Atom& atom = added();
    atom.semi_axes.setConstant(0.5 * in_.positive(2, "diameter"));
    atom.density = in_.positive(3, "density");
    atom.position = vector_at(in_, 4, "position");
    atom.has_ellipsoid = true;
  }
  Atom& known() {
    const auto found = atoms_.find(in_.integer(0, "id"));
    if (found == atoms_.end()) in_.fail("id", in_.words()[0], "the id of an atom above");
    return found->second;
  }

  Sample sample() const {
    if (atoms_.empty()) in_.fail("Atoms", "", "a section Atoms of style ellipsoid or sphere");
    if (count_ != static_cast<std::int64_t>(atoms_.size()))
      in_.fail("atoms", to_text(count_),
               "as many as in the section Atoms, " + to_text(atoms_.size()));
    if (!(edges_.diagonal().array() > 0.0).all())
      in_.fail("xlo xhi", "", "the bounds of the box along x, y and z");
    Sample sample;
    sample.edges = edges_;
    for (const auto& [id, atom] : atoms_) {
      if (!atom.has_ellipsoid)
        in_.fail("Ellipsoids", "", "a row of the section Ellipsoids for atom " + to_text(id));
      add_names_to(sample.type_names, atom.type);
      sample.add(atom.type - 1, atom.position - low_, atom.semi_axes);
      sample.velocity.back() = atom.velocity;
      sample.orientation.back() = atom.orientation;
      sample.density.back() = atom.density;
      sample.angular_velocity.back() = is_sphere_ ? atom.spin : velocity_of(atom);
    }
    return sample;
  }
  static Vec3 velocity_of(const Atom& atom) {
    const Mat3 rotation = atom.orientation.normalized().toRotationMatrix();
    const Vec3 inertia =
        principal_inertia(atom.density * volume_of(atom.semi_axes), atom.semi_axes);
    return rotation * (rotation.transpose() * atom.spin).cwiseQuotient(inertia);
  }

  LineReader in_;
  std::string section_;
  bool is_sphere_ = false;
  std::int64_t count_ = 0;
  Vec3 low_ = Vec3::Zero();
  Mat3 edges_ = Mat3::Zero();
  std::map<std::int64_t, Atom> atoms_;
};

class Dump {
 public:
  Dump(const std::string& file, std::string_view text) : in_(file, text) {}

  Sample read(std::optional<int> wanted) {
    Sample last;
    int frame = -1;
    while (in_.next()) {
      if (in_.words().empty()) continue;
      if (in_.line().substr(0, 14) != "ITEM: TIMESTEP")
        in_.fail("ITEM", in_.line(), "ITEM: TIMESTEP");
      last = read_frame();
      if (++frame == wanted) return last;
    }
    if (wanted)
      in_.fail("--frame", to_text(*wanted), "from 0 to " + to_text(frame) + ", the last one");
    return last;
  }

 private:
  void expect(std::string_view item) {
    if (!in_.next() || in_.line().substr(0, item.size()) != item)
      in_.fail("ITEM", in_.line(), std::string(item));
  }

  Sample read_frame() {
    Sample sample;
    in_.next();
    sample.cycle = in_.integer(0, "TIMESTEP");
    while (in_.next() && in_.line().substr(0, 21) != "ITEM: NUMBER OF ATOMS")
      ;  // units and time, where they are asked for
    in_.next();
    const std::int64_t count = in_.integer(0, "NUMBER OF ATOMS");
    expect("ITEM: BOX BOUNDS");
    const Vec3 low = read_box(sample);
    expect("ITEM: ATOMS");
    bind();
    std::map<std::int64_t, std::size_t> order;
    Sample rows = sample;
    for (std::int64_t k = 0; k < count; ++k) {
      if (!in_.next() || in_.words().empty())
        in_.fail("ATOMS", to_text(k), to_text(count) + " rows");
      if (!order.emplace(in_.integer(column_.at("id"), "id"), rows.size()).second)
        in_.fail("id", in_.words()[column_.at("id")], "each id once");
      read_row(rows, low);
    }
    for (const auto& [id, k] : order) copy(rows, k, sample);
    sample.type_names = rows.type_names;
    return sample;
  }

  Vec3 read_box(Sample& sample) {
    const std::vector<std::string_view> words = in_.words();
    const bool tilted = words.size() > 3 && words[3] == "xy";
    if (words.size() > 3 && words[3] == "abc")
      in_.fail("BOX BOUNDS", in_.line(), "a restricted triclinic or an orthogonal box");
    const std::size_t flags = tilted ? 6 : 3;
    Vec3 low, high;
    Mat3& edges = sample.edges = Mat3::Zero();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<Eigen::Index>(axis);
      if (words.size() > flags + axis) sample.periodic[axis] = words[flags + axis][0] == 'p';
      in_.next();
      low[k] = in_.number(0, "low bound");
      high[k] = in_.number(1, "high bound");
      if (tilted)
        (axis == 0 ? edges(0, 1) : axis == 1 ? edges(0, 2) : edges(1, 2)) = in_.number(2, "tilt");
    }
    const double xy = edges(0, 1), xz = edges(0, 2), yz = edges(1, 2);
    low[0] -= std::min({0.0, xy, xz, xy + xz});
    high[0] -= std::max({0.0, xy, xz, xy + xz});
    low[1] -= std::min(0.0, yz);
    high[1] -= std::max(0.0, yz);
    edges.diagonal() = high - low;
    if (!(edges.diagonal().array() > 0.0).all())
      in_.fail("BOX BOUNDS", in_.line(), "high bounds above the low ones");
    return low;
  }

  bool has(const std::string& name) const { return column_.contains(name); }
  void bind() {
    column_.clear();
    for (std::size_t k = 2; k < in_.words().size(); ++k)
      column_[std::string(in_.words()[k])] = k - 2;
    const auto one_of = [&](std::initializer_list<const char*> names) {
      for (const char* name : names)
        if (has(name)) return std::string(name);
      return std::string();
    };
    place_ = one_of({"xu", "x", "xsu", "xs"});
    size_ = one_of({"shapex", "diameter", "radius"});
    const auto require = [&](std::initializer_list<std::string> names) {
      for (const std::string& name : names)
        if (!has(name)) in_.fail("ITEM: ATOMS", in_.line(), "with a column " + name);
    };
    require({"id"});
    if (place_.empty()) in_.fail("ITEM: ATOMS", in_.line(), "with columns xu yu zu or x y z");
    if (size_.empty())
      in_.fail("ITEM: ATOMS", in_.line(),
               "with columns shapex shapey shapez (diameters), diameter or radius; "
               "dump_modify colname, or an editor, gives them these names");
    const std::string rest = place_.substr(1);
    require({"y" + rest, "z" + rest});
    if (size_ == "shapex") require({"shapey", "shapez"});
    if (has("quatw")) require({"quati", "quatj", "quatk"});
    if (has("vx")) require({"vy", "vz"});
    if (has("omegax")) require({"omegay", "omegaz"});
  }

  double number(const std::string& name) const { return in_.number(column_.at(name), name); }
  Vec3 vector(const std::string& x, const std::string& y, const std::string& z) const {
    return {number(x), number(y), number(z)};
  }
  Vec3 place(const Sample& rows, const Vec3& low) const {
    const std::string rest = place_.substr(1);
    const Vec3 x = vector(place_, "y" + rest, "z" + rest);
    return rest.find('s') == rest.npos ? Vec3(x - low) : Vec3(rows.edges * x);
  }
  Vec3 radii() const {
    if (size_ == "shapex") {
      Vec3 radii = 0.5 * vector("shapex", "shapey", "shapez");
      if (!(radii.array() > 0.0).all())
        in_.fail("shapex", in_.words()[column_.at("shapex")], "3 diameters > 0");
      return radii;
    }
    return Vec3::Constant((size_ == "diameter" ? 0.5 : 1.0) *
                          in_.positive(column_.at(size_), size_));
  }

  void read_row(Sample& rows, const Vec3& low) const {
    const std::int32_t type = has("type") ? type_at(in_, column_.at("type")) : 1;
    add_names_to(rows.type_names, type);
    rows.add(type - 1, place(rows, low), radii());
    if (has("vx")) rows.velocity.back() = vector("vx", "vy", "vz");
    if (has("omegax")) rows.angular_velocity.back() = vector("omegax", "omegay", "omegaz");
    if (has("quatw"))
      rows.orientation.back() =
          unit(in_, number("quatw"), number("quati"), number("quatj"), number("quatk"));
    if (has("mass"))
      rows.density.back() =
          in_.positive(column_.at("mass"), "mass") / volume_of(rows.semi_axes.back());
  }

  static void copy(const Sample& from, std::size_t k, Sample& to) {
    to.add(from.type[k], from.position[k], from.semi_axes[k]);
    to.velocity.back() = from.velocity[k];
    to.angular_velocity.back() = from.angular_velocity[k];
    to.orientation.back() = from.orientation[k];
    to.density.back() = from.density[k];
  }

  LineReader in_;
  std::map<std::string, std::size_t> column_;
  std::string place_, size_;
};

}  // namespace

Sample read_lammps_data(const std::string& file, std::string_view text) {
  return DataFile(file, text).read();
}

Sample read_lammps_dump(const std::string& file, std::string_view text, std::optional<int> frame) {
  return Dump(file, text).read(frame);
}

}  // namespace tangency::inline v0::dem
