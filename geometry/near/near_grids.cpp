// SPDX-License-Identifier: MIT
#include <tangency/geometry/near/near_grids.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include <tangency/geometry/power_of_two.hpp>
#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::detail {
namespace {

/// Width of a box in largest reaches of its level. Measured on 8001 equal spheres and on sizes from
/// 1 to 10: of 0.7, 1, 1.5 and 2 the last is the fastest, by a third of 1.
constexpr double kBoxWidth = 2.0;

/// Where a level has more boxes than this for each of its bodies, only those that hold a body are
/// kept, in a hash table. Chosen: empty boxes then take no more memory than the bodies.
constexpr double kBoxesPerBody = 8.0;

/// Most levels, of a factor 2 each; the last holds all that is smaller. Chosen: beyond a ratio of
/// 2^24 points and small bodies cost the same.
constexpr int kMostLevels = 24;

/// Most boxes along an axis, so that three of their numbers fit into 63 bits.
constexpr double kMostBoxes = 0x1p20;

/// Most edges that a centre may be away from the cell: an image is the difference of two such.
constexpr double kFarthest = 0x1p29;

/// Most images along an axis that one ball may hold.
constexpr double kMostImages = 0x1p20;

/// Scaled by a larger power of two than this a small number would not be exact. Chosen: what is
/// left of a range of 2^2098 is below the squares that are compared.
constexpr int kMostScaled = 1000;

[[noreturn]] void refuse(const std::string& what) { throw std::invalid_argument(what); }

std::string numbered(const char* name, std::size_t i) {
  return std::string(name) + "[" + std::to_string(i) + "]";
}

std::uint64_t scattered(std::uint64_t key) {
  key *= 0x9e3779b97f4a7c15u;  // 2^64 over the golden ratio: Fibonacci hashing
  return key ^ (key >> 32);
}

}  // namespace

/// One body that looks into one level.
struct NearGrids::Look {
  const Level& level;
  std::size_t at;
  bool own;     ///< is it the body's own level?
  Place place;  ///< own level: the box of the body
  Vec3 centre;
  double reach;
  std::vector<NearPair>& found;
  LatticeImage wraps;

  void meet(const NearGrids& grids, std::size_t first, std::size_t last, const std::uint64_t* box);
};

NearGrids::NearGrids(std::span<const Vec3> centres, std::span<const double> reaches,
                     const Lattice& lattice)
    : lattice_(lattice) {
  if (reaches.size() != centres.size())
    refuse("reaches: " + std::to_string(reaches.size()) + " entries, and there are " +
           std::to_string(centres.size()) + " centres");
  if (centres.size() > std::numeric_limits<std::uint32_t>::max())
    refuse("centres: " + std::to_string(centres.size()) + ": at most 2^32 - 1");
  choose_unit(centres, reaches);
  scale_edges();
  measure(centres, reaches);

  double largest = 0.0;
  for (const double reach : reaches) largest = std::max(largest, unit_ * reach);
  std::vector<std::uint8_t> level_of(centres.size());
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const double reach = unit_ * reaches[i];
    const double ratio = largest / reach;
    const int level = ratio < 0x1p23 ? std::ilogb(ratio) : kMostLevels - 1;  // 0/0 too
    level_of[i] = static_cast<std::uint8_t>(level);
    if (levels_.size() <= level_of[i]) levels_.resize(level_of[i] + std::size_t{1});
    Level& one = levels_[level_of[i]];
    one.reach = std::max(one.reach, reach);
    ++one.bodies;
  }
  require_few_images();
  shape_levels();
  sort(centres, reaches, level_of);
}

/// Checks the numbers, and makes the largest of them 1 to 2, by a power of two: a square then
/// neither overflows nor loses what margin_ does not hold.
void NearGrids::choose_unit(std::span<const Vec3> centres, std::span<const double> reaches) {
  double largest = 0.0;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    if (!centres[i].allFinite()) refuse(numbered("centres", i) + ": must be finite");
    if (!(reaches[i] >= 0.0) || !std::isfinite(reaches[i]))
      refuse(numbered("reaches", i) + ": must be finite and >= 0");
    largest = std::max({largest, centres[i].lpNorm<Eigen::Infinity>(), reaches[i]});
  }
  if (!lattice_.edges.allFinite()) refuse("edges: must be finite and linearly independent");
  for (int k = 0; k < 3; ++k)
    if (lattice_.periodic[static_cast<std::size_t>(k)])
      largest = std::max(largest, lattice_.edges.col(k).lpNorm<Eigen::Infinity>());
  unit_ = std::ldexp(1.0, -std::clamp(exponent_of(largest), -kMostScaled, kMostScaled));
}

/// Edges in the unit, open ones of length 1 to 2, and their inverse: by columns of one size, whose
/// determinant neither overflows nor underflows.
void NearGrids::scale_edges() {
  Mat3 shape;
  Vec3 size = Vec3::Ones();
  for (int k = 0; k < 3; ++k) {
    const Vec3 edge = lattice_.edges.col(k);
    const int exponent = exponent_of(edge);
    shape.col(k) = scaled_by_power(edge, -exponent);
    if (!lattice_.periodic[static_cast<std::size_t>(k)]) continue;
    const int in_unit = exponent + std::ilogb(unit_);
    if (in_unit < -kMostScaled && edge != Vec3::Zero())
      refuse("edges: edge " + std::to_string(k) + " is below 2^-1000 of the largest length");
    size[k] = std::ldexp(1.0, in_unit);
  }
  const Mat3 inverse = shape.inverse();
  const Vec3 norms = inverse.rowwise().norm();
  inverse_ = size.cwiseInverse().asDiagonal() * inverse;
  if (!norms.allFinite() || !inverse_.allFinite())
    refuse("edges: must be finite and linearly independent");
  lattice_.edges = shape * size.asDiagonal();
  heights_ = size.cwiseQuotient(norms);
}

/// Finds how far bodies spread along open axes, and bounds rounding: a centre
/// moved by whole edges, a distance and a reduced coordinate take less than 16 operations on
/// numbers below the sums here.
void NearGrids::measure(std::span<const Vec3> centres, std::span<const double> reaches) {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  Vec3 most = Vec3::Zero();  // |inverse| |centre|, at least a reduced coordinate
  const Mat3 magnitudes = inverse_.cwiseAbs();
  double size = 0.0, largest = 0.0;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const Vec3 centre = unit_ * centres[i];
    const Vec3 reduced = inverse_ * centre;
    for (int k = 0; k < 3; ++k)
      if (lattice_.periodic[static_cast<std::size_t>(k)] && !(std::abs(reduced[k]) <= kFarthest))
        refuse(numbered("centres", i) + ": " + tables::rounded_text(std::abs(reduced[k]), 6) +
               " edges away: at most 2^29");
    low = low.cwiseMin(reduced);
    high = high.cwiseMax(reduced);
    most = most.cwiseMax(magnitudes * centre.cwiseAbs());
    size = std::max(size, centre.lpNorm<1>());
    largest = std::max(largest, unit_ * reaches[i]);
  }
  Vec3 images = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    if (lattice_.periodic[static_cast<std::size_t>(k)]) {
      images[k] = most[k] + 2.0 * largest / heights_[k] + 2.0;
      size += images[k] * lattice_.edges.col(k).lpNorm<1>();
    } else if (!centres.empty()) {
      low_[k] = low[k];
      extent_[k] = high[k] - low[k];
    }
  }
  margin_ = 0x1p-48 * (size + largest);
  const Mat3 residual = (inverse_ * lattice_.edges - Mat3::Identity()).cwiseAbs();
  slack_ = 0x1p-48 * (Vec3::Ones() + most + images) + residual * images;
  for (int k = 0; k < 3; ++k)
    if (lattice_.periodic[static_cast<std::size_t>(k)] && slack_[k] > 1.0)
      refuse("centres: so far away that rounding moves them by a cell");
}

void NearGrids::require_few_images() const {
  if (levels_.empty()) return;
  for (int k = 0; k < 3; ++k)
    if (lattice_.periodic[static_cast<std::size_t>(k)] &&
        2.0 * levels_[0].reach / heights_[k] > kMostImages)
      refuse("edges: the cell is " + tables::rounded_text(heights_[k] / unit_, 6) +
             " high, and a ball " + tables::rounded_text(2.0 * levels_[0].reach / unit_, 6) +
             ": at most 2^20 images");
}

void NearGrids::shape_levels() {
  std::size_t buckets = 0;
  for (Level& level : levels_) {
    if (level.bodies == 0) continue;
    double boxes = 1.0;
    for (int k = 0; k < 3; ++k) {
      // Every look is wider by slack_: boxes of points too, so that it holds some few of them.
      const double width = std::max(kBoxWidth * level.reach / heights_[k], 2.0 * slack_[k]);
      const double wanted = extent_[k] > kMostBoxes * width ? kMostBoxes : extent_[k] / width;
      const double count = extent_[k] > 0.0 ? std::max(1.0, std::floor(wanted)) : 1.0;
      level.count[static_cast<std::size_t>(k)] = static_cast<std::int64_t>(count);
      level.scale[k] = extent_[k] > 0.0 ? count / extent_[k] : 0.0;
      boxes *= count;
    }
    const auto bodies = static_cast<double>(level.bodies);
    level.first_bucket = buckets;
    level.hashed = boxes > kBoxesPerBody * bodies + 64.0;
    const std::size_t size =
        level.hashed ? std::bit_ceil(2 * level.bodies) : static_cast<std::size_t>(boxes);
    level.mask = level.hashed ? size - 1 : 0;
    buckets += size;
  }
  starts_.assign(buckets + 1, 0);
}

void NearGrids::sort(std::span<const Vec3> centres, std::span<const double> reaches,
                     const std::vector<std::uint8_t>& level_of) {
  const std::size_t count = centres.size();
  std::vector<std::size_t> bucket(count);  // some 8 a body: more than 32 bits number
  std::vector<Seat> seats(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Level& level = levels_[level_of[i]];
    seats[i] = seat_of(static_cast<std::uint32_t>(i), unit_ * centres[i]);
    seats[i].box = box_of(level, place_of(level, seats[i].reduced));
    bucket[i] = bucket_of(level, seats[i].box);
    ++starts_[bucket[i] + 1];
  }
  for (std::size_t k = 1; k < starts_.size(); ++k) starts_[k] += starts_[k - 1];
  std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
  bodies_.resize(count);
  seats_.resize(count);
  level_at_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = next[bucket[i]]++;
    const LatticeImage& home = seats[i].home;
    bodies_[at] = {unit_ * centres[i] - lattice_.edges * Vec3(home[0], home[1], home[2]),
                   unit_ * reaches[i]};
    seats_[at] = seats[i];
    level_at_[at] = level_of[i];
  }
}

NearGrids::Seat NearGrids::seat_of(std::uint32_t id, const Vec3& centre) const {
  Seat seat{inverse_ * centre, {}, id, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    if (!lattice_.periodic[k]) continue;
    double& reduced = seat.reduced[static_cast<int>(k)];
    const double edges = std::floor(reduced);
    seat.home[k] = static_cast<std::int32_t>(edges);
    reduced -= edges;
  }
  return seat;
}

NearGrids::Place NearGrids::place_of(const Level& level, const Vec3& reduced) const {
  Place place;
  for (std::size_t k = 0; k < 3; ++k) {
    const int axis = static_cast<int>(k);
    const double box = (reduced[axis] - low_[axis]) * level.scale[axis];
    place[k] = std::clamp<std::int64_t>(static_cast<std::int64_t>(box), 0, level.count[k] - 1);
  }
  return place;
}

std::uint64_t NearGrids::box_of(const Level& level, const Place& place) const {
  return static_cast<std::uint64_t>((place[0] * level.count[1] + place[1]) * level.count[2] +
                                    place[2]);
}

std::size_t NearGrids::bucket_of(const Level& level, std::uint64_t box) const {
  return level.first_bucket +
         static_cast<std::size_t>(level.hashed ? scattered(box) & level.mask : box);
}

NearGrids::Range NearGrids::range_around(const Level& level, const Seat& seat, double reach) const {
  Range range;
  for (std::size_t k = 0; k < 3; ++k) {
    const int axis = static_cast<int>(k);
    const double half = reach / heights_[axis] * (1.0 + 0x1p-40) + slack_[axis];
    const double at = seat.reduced[axis] - low_[axis];
    const double first = std::floor((at - half) * level.scale[axis] - 0x1p-20);
    const double last = std::floor((at + half) * level.scale[axis] + 0x1p-20);
    if (lattice_.periodic[k]) {
      range.first[k] = static_cast<std::int64_t>(first);
      range.last[k] = static_cast<std::int64_t>(last);
    } else {
      const auto most = static_cast<double>(level.count[k] - 1);
      range.empty = range.empty || first > most || last < 0.0;
      range.first[k] = static_cast<std::int64_t>(std::clamp(first, 0.0, most));
      range.last[k] = static_cast<std::int64_t>(std::clamp(last, 0.0, most));
    }
  }
  return range;
}

double NearGrids::margin() const {
  return std::max(margin_ / unit_, std::numeric_limits<double>::min());
}

void NearGrids::find(std::size_t first, std::size_t last, std::vector<NearPair>& found) const {
  for (std::size_t at = first; at < last; ++at) {
    const std::size_t own = level_at_[at];
    for (std::size_t level = 0; level <= own; ++level)
      if (levels_[level].bodies > 0) look_around(at, levels_[level], level == own, found);
  }
}

/// In its own level a body looks only at boxes that come after its own, images included, and in its
/// own box at bodies that come after it: the other body of a pair sees this one before itself.
void NearGrids::look_around(std::size_t at, const Level& level, bool own,
                            std::vector<NearPair>& found) const {
  const Seat& seat = seats_[at];
  const Body& body = bodies_[at];
  const double reach = body.reach + margin_;
  const Range range = range_around(level, seat, body.reach + level.reach);
  if (range.empty) return;
  Look look{level,       at,    own,   own ? place_of(level, seat.reduced) : range.first,
            body.centre, reach, found, {}};
  const Place& from = look.place;
  Place place;
  for (place[0] = from[0]; place[0] <= range.last[0]; ++place[0]) {
    const bool first_sheet = own && place[0] == from[0];
    for (place[1] = first_sheet ? from[1] : range.first[1]; place[1] <= range.last[1]; ++place[1]) {
      const bool first_row = first_sheet && place[1] == from[1];
      place[2] = first_row ? from[2] : range.first[2];
      look_along_row(look, place, range.last[2]);
    }
  }
}

/// Boxes (place[0], place[1], place[2] to last).
void NearGrids::look_along_row(Look& look, Place place, std::int64_t last) const {
  const Level& level = look.level;
  const std::int64_t along = level.count[2];
  const auto wrap = [&](std::size_t k) {
    std::int64_t edges = 0;
    if (place[k] < 0 || place[k] >= level.count[k]) {  // mostly not: a division takes long
      edges = place[k] / level.count[k];
      if (place[k] < edges * level.count[k]) --edges;
    }
    look.wraps[k] = static_cast<std::int32_t>(edges);
    return place[k] - edges * level.count[k];
  };
  const bool with_own = look.own && place == look.place;
  const std::int64_t x = wrap(0), y = wrap(1);
  const Vec3 body = look.centre;
  bool own_box = with_own;
  while (place[2] <= last) {
    const std::int64_t z = wrap(2);
    // To the end of the cell, or of the range.
    const std::int64_t boxes = std::min(along - z, last - place[2] + 1);
    look.centre = body - lattice_.edges * Vec3(look.wraps[0], look.wraps[1], look.wraps[2]);
    const std::uint64_t box = box_of(level, {x, y, z});
    for (std::int64_t k = 0; k < boxes; k += level.hashed ? 1 : boxes) {
      const std::uint64_t here = box + static_cast<std::uint64_t>(k);
      const std::size_t bucket = bucket_of(level, here);
      const std::size_t end = bucket + (level.hashed ? 1 : static_cast<std::size_t>(boxes));
      const std::size_t first = own_box ? look.at + 1 : starts_[bucket];
      own_box = false;
      look.meet(*this, first, starts_[end], level.hashed ? &here : nullptr);
    }
    place[2] += boxes;
  }
  look.centre = body;
}

/// Meets bodies [first, last): those of one box if it is given.
void NearGrids::Look::meet(const NearGrids& grids, std::size_t first, std::size_t last,
                           const std::uint64_t* box) {
  for (std::size_t k = first; k < last; ++k) {
    const Body& other = grids.bodies_[k];
    const double sum = reach + other.reach;
    if ((other.centre - centre).squaredNorm() > sum * sum) continue;
    const Seat &from = grids.seats_[at], &to = grids.seats_[k];
    if (box && to.box != *box) continue;
    NearPair pair{from.id, to.id, {}};
    for (std::size_t axis = 0; axis < 3; ++axis)
      pair.image[axis] = wraps[axis] + from.home[axis] - to.home[axis];
    // An own image comes after its body and is positive as it is.
    if (pair.b < pair.a) {
      std::swap(pair.a, pair.b);
      for (std::int32_t& edges : pair.image) edges = -edges;
    }
    found.push_back(pair);
  }
}

}  // namespace tangency::inline v0::detail
