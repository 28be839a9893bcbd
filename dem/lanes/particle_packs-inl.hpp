// SPDX-License-Identifier: MIT
/// @file
/// Particles, rotations and angles of many particles at once, one particle in each lane. Compiled
/// once for each instruction set. No operation is fused: particle_lanes.hpp (1).
#if defined(TANGENCY_PARTICLE_PACKS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TANGENCY_PARTICLE_PACKS_INL
#undef TANGENCY_PARTICLE_PACKS_INL
#else
#define TANGENCY_PARTICLE_PACKS_INL
#endif

#include <cstddef>

#include <tangency/dem/lanes/particle_lanes.hpp>

#define TANGENCY_PACK_REGISTERS 1
#include <tangency/geometry/batch/packs-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace tangency::inline v0::detail::HWY_NAMESPACE {
namespace {

HWY_INLINE Pack unfused_dot(const PackVec3& a, const PackVec3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
HWY_INLINE PackVec3 times(const PackVec3& a, const PackVec3& b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}

HWY_INLINE void store(const PackQuaternion& q, double* to) {
  hn::StoreInterleaved4(q.x.low, q.y.low, q.z.low, q.w.low, D(), to);
}
HWY_INLINE PackQuaternion chosen(const PackMask& yes, const PackQuaternion& p,
                                 const PackQuaternion& q) {
  return {chosen(yes, p.x, q.x), chosen(yes, p.y, q.y), chosen(yes, p.z, q.z),
          chosen(yes, p.w, q.w)};
}
HWY_INLINE PackQuaternion normalised(const PackQuaternion& q) {
  const Pack s = all(1.0) / root(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  return {q.x * s, q.y * s, q.z * s, q.w * s};
}

/// The rotation of a unit quaternion, body to space, by rows.
struct PackRotation {
  PackVec3 row[3];

  HWY_INLINE explicit PackRotation(const PackQuaternion& q) {
    const Pack one = all(1.0), tx = q.x + q.x, ty = q.y + q.y, tz = q.z + q.z;
    const Pack wx = tx * q.w, wy = ty * q.w, wz = tz * q.w;
    const Pack xx = tx * q.x, xy = ty * q.x, xz = tz * q.x;
    const Pack yy = ty * q.y, yz = tz * q.y, zz = tz * q.z;
    row[0] = {one - (yy + zz), xy - wz, xz + wy};
    row[1] = {xy + wz, one - (xx + zz), yz - wx};
    row[2] = {xz - wy, yz + wx, one - (xx + yy)};
  }
  HWY_INLINE PackVec3 to_space(const PackVec3& v) const {
    return {unfused_dot(row[0], v), unfused_dot(row[1], v), unfused_dot(row[2], v)};
  }
  HWY_INLINE PackVec3 to_body(const PackVec3& v) const {
    return row[0] * v.x + row[1] * v.y + row[2] * v.z;
  }
};

struct PackInertia {
  PackVec3 moments, inverse;
};

/// dem::principal_inertia().
HWY_INLINE PackInertia inertia_of(const Pack& mass, const PackVec3& axes, bool is_plane) {
  const PackVec3 squares = times(axes, axes);
  const PackVec3 parts =
      is_plane ? PackVec3{squares.y, squares.x, squares.x + squares.y}
               : PackVec3{squares.y + squares.z, squares.z + squares.x, squares.x + squares.y};
  const PackVec3 moments = parts * (mass * all(is_plane ? 0.25 : 0.2));
  const Pack one = all(1.0);
  return {moments, {one / moments.x, one / moments.y, one / moments.z}};
}

struct PackAngle {
  Pack cosine, sine;
};

/// Above it an angle is not small. Chosen: the half angles of a step are below it by tens to
/// thousands, and series of it are short.
constexpr double kSmall = 0.1;
/// Above it a turn is no number. Whole quarters below it times a part of pi/2 of 32 bits are exact.
constexpr double kLargestAngle = 0x1p20;

/// sin(t) / t - 1 for t^2 = z; the term left out is below 2^-58 where t is small.
HWY_INLINE Pack small_sinc_less_1(const Pack& z) {
  Pack sum = z * all(1.0 / 362880.0) - all(1.0 / 5040.0);
  sum = sum * z + all(1.0 / 120.0);
  sum = sum * z - all(1.0 / 6.0);
  return sum * z;
}
/// cos(t) for t^2 = z; the term left out is below 2^-68 where t is small.
HWY_INLINE Pack small_cosine(const Pack& z) {
  Pack sum = all(1.0 / 40320.0) - z * all(1.0 / 3628800.0);
  sum = sum * z - all(1.0 / 720.0);
  sum = sum * z + all(1.0 / 24.0);
  return all(1.0) - (all(0.5) * z - z * z * sum);
}

/// For |t| <= pi/4 and a little: terms left out are below 2^-60.
HWY_INLINE PackAngle reduced_angle(const Pack& t) {
  // 1/n! from n = 17 and 18 down
  constexpr double kSine[] = {
      -1.0 / 1307674368000.0, 1.0 / 6227020800.0, -1.0 / 39916800.0, 1.0 / 362880.0,
      -1.0 / 5040.0,          1.0 / 120.0,        -1.0 / 6.0};
  constexpr double kCosine[] = {
      1.0 / 20922789888000.0, -1.0 / 87178291200.0, 1.0 / 479001600.0, -1.0 / 3628800.0,
      1.0 / 40320.0,          -1.0 / 720.0,         1.0 / 24.0};
  const Pack z = t * t;
  Pack sine = all(1.0 / 355687428096000.0), cosine = all(-1.0 / 6402373705728000.0);
  for (const double term : kSine) sine = sine * z + all(term);
  for (const double term : kCosine) cosine = cosine * z + all(term);
  return {all(1.0) - (all(0.5) * z - z * z * cosine), t + t * (z * sine)};
}

/// Of any angle, by whole quarters of a turn; no number above kLargestAngle.
HWY_INLINE PackAngle large_angle(const Pack& t) {
  // pi/2 = the sum of these but for 2^-123.
  const Pack part[] = {all(0x1.921fb544p+0), all(0x1.0b4611a6p-34), all(0x1.3198a2e037073p-69)};
  const Pack k{hn::Round((t * all(0x1.45f306dc9c883p-1)).low)};
  const PackAngle r = reduced_angle(((t - k * part[0]) - k * part[1]) - k * part[2]);
  const Pack quarter = k - all(4.0) * Pack{hn::Floor((k * all(0.25)).low)};  // 0 to 3
  const Pack from_half = absolute(quarter - all(2.0));
  const PackMask odd = (from_half > all(0.5)) & (from_half < all(1.5));
  const Pack cosine = chosen(odd, r.sine, r.cosine), sine = chosen(odd, r.cosine, r.sine);
  const PackMask is_number = absolute(t) <= all(kLargestAngle);
  const Pack none_such = t - t + all(__builtin_nan(""));
  const PackMask left = absolute(quarter - all(1.5)) < all(1.0);
  return {chosen(is_number, chosen(left, -cosine, cosine), none_such),
          chosen(is_number, chosen(quarter > all(1.5), -sine, sine), none_such)};
}

HWY_INLINE PackAngle cosine_sine(const Pack& t) {
  const Pack z = t * t;
  PackAngle angle{small_cosine(z), t + t * small_sinc_less_1(z)};
  const PackMask large = absolute(t) > all(kSmall);
  if (!none(large)) {
    const PackAngle other = large_angle(t);
    angle = {chosen(large, other.cosine, angle.cosine), chosen(large, other.sine, angle.sine)};
  }
  return angle;
}

/// The turn by a rotation vector.
HWY_INLINE PackQuaternion turn_by(const PackVec3& v) {
  const Pack z = all(0.25) * unfused_dot(v, v);  // of the half angle
  Pack sinc = all(1.0) + small_sinc_less_1(z), cosine = small_cosine(z);
  const PackMask large = z > all(kSmall * kSmall);
  if (!none(large)) {
    const Pack half = root(z);
    const PackAngle angle = large_angle(half);
    sinc = chosen(large, angle.sine / half, sinc);
    cosine = chosen(large, angle.cosine, cosine);
  }
  const PackVec3 axis = v * (all(0.5) * sinc);
  return {axis.x, axis.y, axis.z, cosine};
}

/// p q
HWY_INLINE PackQuaternion operator*(const PackQuaternion& p, const PackQuaternion& q) {
  return {
      p.w * q.x + p.x * q.w + p.y * q.z - p.z * q.y, p.w * q.y + p.y * q.w + p.z * q.x - p.x * q.z,
      p.w * q.z + p.z * q.w + p.x * q.y - p.y * q.x, p.w * q.w - p.x * q.x - p.y * q.y - p.z * q.z};
}

/// Fewer particles than lanes, with others beside them that are at rest.
class PaddedParticles {
 public:
  PaddedParticles(const ParticleColumns& from, const MovedColumns& moved, std::size_t first,
                  std::size_t count)
      : first_(first), count_(count), moved_(moved) {
    for (std::size_t k = 0; k < kMostLanes; ++k) {
      mass_[k] = semi_axes_[3 * k] = semi_axes_[3 * k + 1] = semi_axes_[3 * k + 2] = 1.0;
      orientation_[4 * k + 3] = 1.0;
    }
    copy(from.velocity, 3, velocity_);
    copy(from.angular_velocity, 3, angular_velocity_);
    copy(from.orientation, 4, orientation_);
    copy(from.semi_axes, 3, semi_axes_);
    copy(from.mass, 1, mass_);
    copy(from.force, 3, force_);
    copy(from.moment, 3, moment_);
    copy(moved.position, 3, position_);
    columns = {velocity_, angular_velocity_, orientation_, semi_axes_, mass_,
               force_,    moment_,           from.is_plane};
    if (from.force == nullptr) columns.force = nullptr;
    if (from.moment == nullptr) columns.moment = nullptr;
    in_place = {position_, velocity_, angular_velocity_, orientation_};
  }
  /// Takes what has changed back to where it came from.
  void put_back() const {
    put(position_, 3, moved_.position);
    put(velocity_, 3, moved_.velocity);
    put(angular_velocity_, 3, moved_.angular_velocity);
    put(orientation_, 4, moved_.orientation);
  }

  ParticleColumns columns{};
  MovedColumns in_place{};

 private:
  void copy(const double* from, std::size_t width, double* to) const {
    if (from == nullptr) return;
    for (std::size_t k = 0; k < width * count_; ++k) to[k] = from[width * first_ + k];
  }
  void put(const double* from, std::size_t width, double* to) const {
    if (to == nullptr) return;
    for (std::size_t k = 0; k < width * count_; ++k) to[width * first_ + k] = from[k];
  }

  std::size_t first_, count_;
  MovedColumns moved_;
  double position_[3 * kMostLanes] = {}, velocity_[3 * kMostLanes] = {};
  double angular_velocity_[3 * kMostLanes] = {}, orientation_[4 * kMostLanes] = {};
  double semi_axes_[3 * kMostLanes], mass_[kMostLanes];
  double force_[3 * kMostLanes] = {}, moment_[3 * kMostLanes] = {};
};

/// work(columns, moved, at, k) for each pack, particles k on of the range at `at` of the columns.
template <class Work>
HWY_INLINE void for_each_pack(const ParticleColumns& columns, const MovedColumns& moved,
                              std::size_t first, std::size_t last, const Work& work) {
  std::size_t i = first;
  for (; i + pack_lanes() <= last; i += pack_lanes()) work(columns, moved, i, i - first);
  if (i == last) return;
  PaddedParticles padded(columns, moved, i, last - i);
  work(padded.columns, padded.in_place, std::size_t{0}, i - first);
  padded.put_back();
}

}  // namespace
}  // namespace tangency::inline v0::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
