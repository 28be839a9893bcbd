// SPDX-License-Identifier: MIT
#include <tangency/dem/state_file.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include <tangency/dem/whole_file.hpp>

namespace tangency::dem {
namespace {

static_assert(std::endian::native == std::endian::little, "state files are little-endian");

constexpr std::string_view kMagic = "TANGSTAT";
constexpr std::uint32_t kFormatVersion = 5;

class Writer {
 public:
  template <class T>
  requires std::is_arithmetic_v<T>
  void operator()(const T& value) {
    const auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
    bytes_.append(raw.data(), raw.size());
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Bytes that are no state.
struct Damaged {
  const char* why;
};
constexpr Damaged kNotWhole{"it is not a whole state"};

class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}
  template <class T>
  requires std::is_arithmetic_v<T>
  void operator()(T& value) {
    if (bytes_.size() < sizeof(T)) throw kNotWhole;
    std::memcpy(&value, bytes_.data(), sizeof(T));
    if constexpr (std::is_floating_point_v<T>)
      if (!std::isfinite(value)) throw Damaged{"it holds a number that is not finite"};
    bytes_.remove_prefix(sizeof(T));
  }
  bool at_end() const { return bytes_.empty(); }
  std::size_t left() const { return bytes_.size(); }

 private:
  std::string_view bytes_;
};

// One description of the format for both ways: each function passes every number of its argument
// to the archive, a Writer or a ByteReader.

template <class Archive, class Vec>
requires std::is_same_v<std::remove_const_t<Vec>, Vec3>
void pass(Archive& archive, Vec& v) {
  for (int k = 0; k < 3; ++k) archive(v[k]);
}

template <class Archive, class Q>
requires std::is_same_v<std::remove_const_t<Q>, Quaternion>
void pass(Archive& archive, Q& q) {
  for (int k = 0; k < 4; ++k) archive(q.coeffs()[k]);
}

template <class Archive, class Number>
requires std::is_arithmetic_v<Number>
void pass(Archive& archive, Number& x) { archive(x); }

template <class Archive, class P>
requires std::is_same_v<std::remove_const_t<P>, Pair>
void pass(Archive& archive, P& pair) {
  archive(pair.a);
  archive(pair.b);
  for (auto& k : pair.image) archive(k);
}

template <class Archive, class M>
requires std::is_same_v<std::remove_const_t<M>, Mat3>
void pass(Archive& archive, M& m) {
  for (int k = 0; k < 9; ++k) archive(m.data()[k]);
}

void pass_material(Writer& archive, const std::optional<Material>& material) {
  archive(std::uint8_t{material.has_value()});
  if (!material) return;
  archive(material->young_modulus);
  archive(material->poisson_ratio);
}
void pass_material(ByteReader& archive, std::optional<Material>& material) {
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

template <class T>
void pass(Writer& archive, const std::vector<T>& items) {
  archive(std::uint64_t{items.size()});
  for (const T& item : items) pass(archive, item);
}

template <class T>
void pass(ByteReader& archive, std::vector<T>& items) {
  std::uint64_t size = 0;
  archive(size);
  if (size > archive.left()) throw kNotWhole;
  items.resize(size);
  for (T& item : items) pass(archive, item);
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

void pass_walls(Writer& archive, const std::array<bool, 3>& walled) {
  for (const bool one : walled) archive(std::uint8_t{one});
}
void pass_walls(ByteReader& archive, std::array<bool, 3>& walled) {
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

template <class Archive, class R>
void pass_reference(Archive& archive, R& reference) {
  pass(archive, reference.edges);
  archive(reference.skin_ratio);
  pass(archive, reference.reduced_position);
  pass(archive, reference.orientation);
  pass(archive, reference.semi_axes);
}

void pass_contacts(Writer& archive, const Contacts& contacts) {
  const std::size_t count = contacts.size();
  const auto pass_column = [&](const auto& column) {
    for (std::size_t k = 0; k < count; ++k) pass(archive, column[k]);
  };
  for (const auto column : ContactColumns::kVectors) pass_column(contacts.columns().*column);
  for (const auto column : ContactColumns::kNumbers) pass_column(contacts.columns().*column);
}

ContactColumns contacts_of(ByteReader& archive, std::size_t count) {
  ContactColumns columns;
  if (count > archive.left()) throw kNotWhole;
  columns.resize(count);
  const auto pass_column = [&](auto& column) {
    for (auto& entry : column) pass(archive, entry);
  };
  for (const auto column : ContactColumns::kVectors) pass_column(columns.*column);
  for (const auto column : ContactColumns::kNumbers) pass_column(columns.*column);
  return columns;
}

std::string bytes_of(const State& state) {
  Writer archive;
  pass_plain(archive, state);
  pass_reference(archive, state.list.reference());
  pass(archive, state.list.pairs());
  pass_contacts(archive, state.contacts);
  return archive.take();
}

/// Do all arrays belong together? A file with the right hash that fails is another program's.
bool is_whole(const State& state, const NeighbourList::Reference& reference,
              const std::vector<Pair>& pairs) {
  const Particles& p = state.particles;
  const std::size_t n = p.size();
  if (n == 0 || p.velocity.size() != n || p.angular_velocity.size() != n ||
      p.orientation.size() != n || p.semi_axes.size() != n || p.mass.size() != n ||
      p.type.size() != n || p.id.size() != n || reference.reduced_position.size() != n ||
      reference.orientation.size() != n || reference.semi_axes.size() != n)
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
    if (b >= n && (b >= n + 6 || !state.cell.walled[(b - n) / 2])) return false;
  }
  return true;
}

bool is_positive(const Vec3& v) { return v.minCoeff() > 0.0; }

bool lengths_are_positive(const State& state, const NeighbourList::Reference& reference) {
  const std::vector<Vec3>& axes = state.particles.semi_axes;
  const auto has_volume = [](const Mat3& edges) { return edges.determinant() > 0.0; };
  return has_volume(state.cell.edges) && has_volume(state.cell.reference_edges) &&
         has_volume(reference.edges) && reference.skin_ratio > 0.0 &&
         std::all_of(reference.semi_axes.begin(), reference.semi_axes.end(), is_positive) &&
         std::all_of(axes.begin(), axes.end(), is_positive);
}

State state_of(std::string_view bytes) {
  ByteReader archive(bytes);
  State state;
  NeighbourList::Reference reference;
  std::vector<Pair> pairs;
  pass_plain(archive, state);
  pass_reference(archive, reference);
  pass(archive, pairs);
  ContactColumns contacts = contacts_of(archive, pairs.size());
  if (!archive.at_end() || !is_whole(state, reference, pairs)) throw kNotWhole;
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
  return state;
}

/// 64-bit FNV-1a [Fowler, Noll, Vo; RFC 9923].
std::uint64_t fnv1a(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3u;
  return hash;
}

template <class T>
T number_at(std::string_view bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

}  // namespace

std::string state_hash(const State& state) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::uint64_t hash = fnv1a(bytes_of(state));
  std::string text(16, '0');
  for (auto at = text.rbegin(); at != text.rend(); ++at, hash >>= 4) *at = digits[hash & 15u];
  return text;
}

void save_state(const State& state, const std::filesystem::path& file) {
  const std::string body = bytes_of(state);
  Writer head, tail;
  head(kFormatVersion);
  tail(fnv1a(body));
  write_whole(file, std::string(kMagic) + head.take() + body + tail.take());
}

State load_state(const std::filesystem::path& file) {
  const auto fail = [&](const std::string& what) { throw StateError(file.string() + ": " + what); };
  std::string whole;
  try {
    whole = bytes_of_file(file);
  } catch (const ReadError& error) {
    throw StateError(error.what());
  }
  const std::string_view bytes = whole;
  constexpr std::size_t head = kMagic.size() + sizeof kFormatVersion;
  if (bytes.size() < head + sizeof(std::uint64_t) || !bytes.starts_with(kMagic))
    fail("no state of tangency-dem: final.state or checkpoint.state of a run");
  const auto found = number_at<std::uint32_t>(bytes, kMagic.size());
  if (found != kFormatVersion)
    fail("state of version " + std::to_string(found) + ": this program reads version " +
         std::to_string(kFormatVersion));
  const std::size_t end = bytes.size() - sizeof(std::uint64_t);
  const std::string_view body = bytes.substr(head, end - head);
  if (number_at<std::uint64_t>(bytes, end) != fnv1a(body)) fail("damaged: its hash is wrong");
  try {
    return state_of(body);
  } catch (const Damaged& damaged) {
    throw StateError(file.string() + ": damaged: " + damaged.why);
  }
}

}  // namespace tangency::dem
