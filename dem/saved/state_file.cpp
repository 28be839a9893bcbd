// SPDX-License-Identifier: MIT
#include <tangency/dem/saved/state_file.hpp>

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <tangency/dem/saved/little_endian.hpp>
#include <tangency/dem/saved/state_stream.hpp>
#include <tangency/dem/whole_file.hpp>

namespace tangency::inline v0::dem {
namespace {

constexpr std::string_view kMagic = "TANGSTAT";
/// Of a state on a ramp, of one with all else that a scene may ask for (pass_latest()), and of one
/// that has none of this: scenes that do not use it have files and hashes as before.
constexpr std::uint32_t kRampVersion = 8, kLatestVersion = 7, kPlainVersion = 5;

// One description of the format for both ways: each function passes every number of its argument
// to the archive, a StateWriter or a StateReader.

/// The numbers that a T consists of, and nothing else: a column of them is one block of bytes.
template <class T>
struct PartsOf {
  using Part = void;
};
template <std::same_as<double> T>
struct PartsOf<T> {
  using Part = double;
};
template <std::same_as<std::int32_t> T>
struct PartsOf<T> {
  using Part = std::int32_t;
};
template <>
struct PartsOf<Vec3> {
  using Part = double;
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
};
template <>
struct PartsOf<Quaternion> {
  using Part = double;
  static_assert(sizeof(Quaternion) == 4 * sizeof(double));
};
template <>
struct PartsOf<Pair> {
  using Part = std::int32_t;
  static_assert(sizeof(Pair) == 5 * sizeof(std::int32_t));
};
template <class T>
concept Row = !std::is_void_v<typename PartsOf<T>::Part>;

template <class Archive, class M>
requires std::is_same_v<std::remove_const_t<M>, Mat3>
void pass(Archive& archive, M& m) {
  for (int k = 0; k < 9; ++k) archive(m.data()[k]);
}

void pass_material(StateWriter& archive, const std::optional<Material>& material) {
  archive(std::uint8_t{material.has_value()});
  if (!material) return;
  archive(material->young_modulus);
  archive(material->poisson_ratio);
}
void pass_material(StateReader& archive, std::optional<Material>& material) {
  std::uint8_t byte = 0;
  archive(byte);
  if (byte > 1) throw kNotWhole;
  if (byte == 0) return;
  Material& read = material.emplace();
  archive(read.young_modulus);
  archive(read.poisson_ratio);
}

template <class Archive, class S>
requires std::is_same_v<std::remove_const_t<S>, ServoMemory>
void pass(Archive& archive, S& servo) {
  archive(servo.integral);
  archive(servo.rate);
  archive(servo.watched);
  archive(servo.missed);
  archive(servo.worst);
}

template <class Archive, class L>
requires std::is_same_v<std::remove_const_t<L>, ContactLaw>
void pass(Archive& archive, L& law) {
  for (auto* x :
       {&law.normal_stiffness, &law.shear_stiffness, &law.friction_coefficient, &law.cohesion})
    archive(*x);
  pass_material(archive, law.hertz);
}

/// A wall that holds no stress has one of 0. What a run goes on with is the scene's.
template <class Archive, class W>
requires std::is_same_v<std::remove_const_t<W>, PlaneWall>
void pass(Archive& archive, W& wall) {
  for (int k = 0; k < 3; ++k) archive(wall.normal[k]);
  archive(wall.offset);
  for (int k = 0; k < 3; ++k) archive(wall.velocity[k]);
  PlaneWall::Held held = wall.held.value_or(PlaneWall::Held{0.0, 0.0});
  archive(held.stress);
  archive(held.max_speed);
  if constexpr (!std::is_const_v<W>)
    if (held.stress > 0.0) wall.held = held;
}

/// The first `count` items.
template <Row T>
void pass_rows(StateWriter& archive, const std::vector<T>& items, std::size_t count) {
  using Part = typename PartsOf<T>::Part;
  archive.block(reinterpret_cast<const Part*>(items.data()), count * (sizeof(T) / sizeof(Part)));
}

template <class T>
void pass(StateWriter& archive, const std::vector<T>& items) {
  archive(std::uint64_t{items.size()});
  if constexpr (Row<T>)
    pass_rows(archive, items, items.size());
  else
    for (const T& item : items) pass(archive, item);
}

/// Items that are read at a time where it is not known that the file has as many as it says.
/// Chosen: some 10 MB.
constexpr std::uint64_t kPiece = 1 << 19;

template <Row T>
void pass_rows(StateReader& archive, std::vector<T>& items, std::uint64_t size) {
  using Part = typename PartsOf<T>::Part;
  if (size > archive.most_left() / sizeof(T)) throw kNotWhole;
  if (!archive.is_pipe()) items.reserve(size);
  while (items.size() < size) {
    const std::size_t first = items.size();
    items.resize(first + std::min(size - first, kPiece));
    archive.block(reinterpret_cast<Part*>(items.data() + first),
                  (items.size() - first) * (sizeof(T) / sizeof(Part)));
  }
}

template <class T>
void pass(StateReader& archive, std::vector<T>& items) {
  std::uint64_t size = 0;
  archive(size);
  if constexpr (Row<T>)
    pass_rows(archive, items, size);
  else
    while (items.size() < size) pass(archive, items.emplace_back());
}

template <class Archive, class P>
void pass_particles(Archive& archive, P& particles) {
  pass(archive, particles.position);
  pass(archive, particles.velocity);
  pass(archive, particles.angular_velocity);
  pass(archive, particles.orientation);
  pass(archive, particles.semi_axes);
  pass(archive, particles.mass);
  pass(archive, particles.type);
  pass(archive, particles.id);
}

void pass_walls(StateWriter& archive, const std::array<bool, 3>& walled) {
  for (const bool one : walled) archive(std::uint8_t{one});
}
void pass_walls(StateReader& archive, std::array<bool, 3>& walled) {
  for (bool& one : walled) {
    std::uint8_t byte = 0;
    archive(byte);
    if (byte > 1) throw kNotWhole;
    one = byte == 1;
  }
}

/// Everything but the list and the contacts, which are classes that restore() themselves.
template <class Archive, class S>
void pass_plain(Archive& archive, S& state) {
  pass_particles(archive, state.particles);
  for (auto* m : {&state.cell.edges, &state.cell.rate, &state.cell.reference_edges})
    pass(archive, *m);
  archive(state.cell.dimensions);
  pass_walls(archive, state.cell.walled);
  archive(state.cycle);
  archive(state.time);
  archive(state.stage);
  archive(state.stage_cycle);
  pass(archive, state.servos);
  archive(state.fire.mixing);
  archive(state.fire.downhill);
  archive(state.increments);
  archive(state.laws.types);
  pass(archive, state.laws.law);
  auto& energy = state.energy;
  for (auto* x : {&energy.start, &energy.boundary, &energy.gravity, &energy.growth, &energy.branch,
                  &energy.sliding, &energy.damping})
    archive(*x);
}

/// Does a state have anything of pass_latest()?
bool has_latest(const State& state) {
  return state.laws.dissipate() || state.energy.viscous != 0.0 || !state.cell.planes.empty() ||
         !state.description.is_none();
}

std::uint32_t version_of(const State& state) {
  if (!state.ramp_start.empty()) return kRampVersion;
  return has_latest(state) ? kLatestVersion : kPlainVersion;
}

/// What the format of kLatestVersion has behind that of kPlainVersion.
template <class Archive, class S, class R>
void pass_latest(Archive& archive, S& state, R& reference) {
  for (auto& law : state.laws.law) archive(law.damping_ratio);
  archive(state.energy.viscous);
  pass(archive, reference.planes);
  pass(archive, state.cell.planes);
  for (auto* x : {&state.description.xy, &state.description.yz, &state.description.xz}) archive(*x);
}

template <class Archive, class R>
void pass_reference(Archive& archive, R& reference) {
  pass(archive, reference.edges);
  pass(archive, reference.skin);
  pass(archive, reference.reduced_position);
  pass(archive, reference.orientation);
  pass(archive, reference.semi_axes);
}

/// Each column without what it is filled up with.
void pass_contacts(StateWriter& archive, const Contacts& contacts) {
  for (const auto column : ContactColumns::kVectors)
    pass_rows(archive, contacts.columns().*column, contacts.size());
  for (const auto column : ContactColumns::kNumbers)
    pass_rows(archive, contacts.columns().*column, contacts.size());
}

void write(StateWriter& archive, const State& state) {
  pass_plain(archive, state);
  pass_reference(archive, state.list.reference());
  pass(archive, state.list.pairs());
  pass_contacts(archive, state.contacts);
  const std::uint32_t version = version_of(state);
  if (version >= kLatestVersion) pass_latest(archive, state, state.list.reference());
  if (version >= kRampVersion) pass(archive, state.ramp_start);
}

void pass_contacts(StateReader& archive, ContactColumns& columns, std::size_t pairs) {
  for (const auto column : ContactColumns::kVectors) pass_rows(archive, columns.*column, pairs);
  for (const auto column : ContactColumns::kNumbers) pass_rows(archive, columns.*column, pairs);
}

/// What a file holds, before it is known to be a state.
struct Read {
  State state;
  NeighbourList::Reference reference;
  std::vector<Pair> pairs;
  ContactColumns contacts;
};

void read(StateReader& archive, Read& found, std::uint32_t version) {
  pass_plain(archive, found.state);
  pass_reference(archive, found.reference);
  pass(archive, found.pairs);
  pass_contacts(archive, found.contacts, found.pairs.size());
  if (version >= kLatestVersion) pass_latest(archive, found.state, found.reference);
  if (version >= kRampVersion) pass(archive, found.state.ramp_start);
}

/// Do all arrays belong together? A file with the right hash that fails is another program's.
bool is_whole(const State& state, const NeighbourList::Reference& reference,
              const std::vector<Pair>& pairs) {
  const Particles& p = state.particles;
  const std::size_t n = p.size();
  if (n == 0 || p.velocity.size() != n || p.angular_velocity.size() != n ||
      p.orientation.size() != n || p.semi_axes.size() != n || p.mass.size() != n ||
      p.type.size() != n || p.id.size() != n || reference.reduced_position.size() != n ||
      reference.orientation.size() != n || reference.semi_axes.size() != n ||
      reference.skin.size() != n || reference.planes.size() != state.cell.planes.size())
    return false;
  std::vector<bool> seen(n);
  for (const std::int32_t id : p.id) {
    if (id < 0 || static_cast<std::size_t>(id) >= n || seen[static_cast<std::size_t>(id)])
      return false;
    seen[static_cast<std::size_t>(id)] = true;
  }
  for (const Pair& pair : pairs) {
    if (pair.a < 0 || pair.b < pair.a || static_cast<std::size_t>(pair.a) >= n) return false;
    const auto b = static_cast<std::size_t>(pair.b);
    if (b >= n + kCellFaces + state.cell.planes.size()) return false;
    if (b >= n && b < n + kCellFaces && !state.cell.walled[(b - n) / 2]) return false;
  }
  return true;
}

bool is_positive(const Vec3& v) { return v.minCoeff() > 0.0; }

bool lengths_are_positive(const State& state, const NeighbourList::Reference& reference) {
  const std::vector<Vec3>& axes = state.particles.semi_axes;
  const auto has_volume = [](const Mat3& edges) { return edges.determinant() > 0.0; };
  return has_volume(state.cell.edges) && has_volume(state.cell.reference_edges) &&
         has_volume(reference.edges) &&
         std::all_of(reference.skin.begin(), reference.skin.end(),
                     [](double s) { return s > 0.0; }) &&
         std::all_of(axes.begin(), axes.end(), is_positive);
}

/// @throws Damaged
State state_of(Read found) {
  auto& [state, reference, pairs, contacts] = found;
  if (!is_whole(state, reference, pairs)) throw kNotWhole;
  if (!lengths_are_positive(state, reference)) throw Damaged{"it holds a length that is not > 0"};
  const std::vector<double>& mass = state.particles.mass;
  if (std::any_of(mass.begin(), mass.end(), [](double m) { return !(m > 0.0); }))
    throw Damaged{"it holds a mass that is not > 0"};
  if (state.laws.types == 0 || state.laws.types > state.laws.law.size() ||
      state.laws.law.size() != state.laws.types * state.laws.types)
    throw kNotWhole;
  if (state.cell.dimensions != 2 && state.cell.dimensions != 3)
    throw Damaged{"its dimensions are neither 2 nor 3"};
  state.particles.dimensions = state.cell.dimensions;
  if (state.stage == 0) throw Damaged{"its stage is 0, and a run's are counted from 1"};
  state.list.restore(std::move(reference), std::move(pairs));
  state.contacts.restore(std::move(contacts), state.particles, state.list);
  return std::move(state);
}

/// @throws Damaged
State state_in(StateReader& file, std::uint32_t version) {
  Read found;
  const char* damage = nullptr;
  try {
    read(file, found, version);
  } catch (const Damaged& damaged) {
    damage = damaged.why;
  }
  const StateReader::Ending ending = file.finish();
  if (!ending.hash_is_right) throw Damaged{"its hash is wrong"};
  if (damage != nullptr) throw Damaged{damage};
  if (!ending.is_at_once) throw kNotWhole;
  return state_of(std::move(found));
}

/// Of the format, from the head of a file; nothing where it is no state.
std::optional<std::uint32_t> version_in(StateReader& file) {
  std::array<char, kMagic.size() + sizeof kRampVersion> head;
  const std::size_t size = file.head(head.data(), head.size());
  if (size < head.size() || !std::string_view(head.data(), size).starts_with(kMagic))
    return std::nullopt;
  std::array<char, sizeof kRampVersion> version;
  std::copy_n(head.data() + kMagic.size(), version.size(), version.begin());
  return of_little_endian_bytes<std::uint32_t>(version);
}

bool is_readable(std::uint32_t version) {
  return version == kPlainVersion || version == kLatestVersion || version == kRampVersion;
}

void write(WholeFile& out, Number auto number) {
  const auto bytes = little_endian_bytes(number);
  out.write(std::string_view(bytes.data(), bytes.size()));
}

}  // namespace

std::string state_hash(const State& state) {
  constexpr std::string_view digits = "0123456789abcdef";
  StateWriter archive(nullptr);
  write(archive, state);
  std::uint64_t hash = archive.finish();
  std::string text(16, '0');
  for (auto at = text.rbegin(); at != text.rend(); ++at, hash >>= 4) *at = digits[hash & 15u];
  return text;
}

void save_state(const State& state, const std::filesystem::path& file) {
  WholeFile out(file);
  out.write(kMagic);
  write(out, version_of(state));
  StateWriter archive(&out);
  write(archive, state);
  write(out, archive.finish());
  out.publish();
}

std::optional<std::int64_t> cycle_of_state(const std::filesystem::path& file) {
  try {
    StateReader in(file);
    if (const auto version = version_in(in); !version || !is_readable(*version))
      return std::nullopt;
    State state;
    pass_plain(in, state);
    return state.cycle;
  } catch (const ReadError&) {
  } catch (const Damaged&) {
  }
  return std::nullopt;
}

State load_state(const std::filesystem::path& file) {
  const auto fail = [&](const std::string& what) { throw StateError(file.string() + ": " + what); };
  try {
    StateReader in(file);
    const auto version = version_in(in);
    if (!version) fail("no state of tangency-dem: final.state or checkpoint.state of a run");
    if (!is_readable(*version))
      fail("state of version " + std::to_string(*version) + ": this program reads version " +
           std::to_string(kPlainVersion) + ", " + std::to_string(kLatestVersion) + " or " +
           std::to_string(kRampVersion));
    return state_in(in, *version);
  } catch (const ReadError& error) {
    throw StateError(error.what());
  } catch (const Damaged& damaged) {
    throw StateError(file.string() + ": damaged: " + damaged.why);
  }
}

}  // namespace tangency::inline v0::dem
