// SPDX-License-Identifier: MIT
// The polygons between the contacts of a plane packing.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numeric>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <tangency/dem/micromechanics/strain_mesh.hpp>

#include "require_length.hpp"

namespace tangency::inline v0::micromechanics {
namespace {

/// How far areas of polygons may be off that of the cell, relatively: rounding of a million. Where
/// edges wind around the cell twice they are off by the whole of it.
constexpr double kSameArea = 1e-9;

/// How near the ends of a way there and back have to be to be one place, in lengths of a cell.
/// Chosen: other images are a cell away, and rounding is far below it.
constexpr double kOnePlace = 1e-6;

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

/// Contacts as darts: 2c leaves the first body of contact c, 2c + 1 the second.
class ContactNet {
 public:
  ContactNet(const PeriodicCentres& centres, const PeriodicPairs& contacts,
             std::span<const Vec3> arm);

  /// Drops all contacts but those of the part that spans the cell.
  /// @throws NoMesh where none does
  void keep_what_spans();
  /// Walks around the polygon on the left of each dart. Needs keep_what_spans().
  /// @throws NoMesh where these are not the polygons of a net
  void find_polygons();
  /// Drops contacts with one polygon on both sides: without them something falls off. Was there
  /// any? Needs find_polygons().
  bool drop_bridges();
  StrainMesh mesh() const;

 private:
  struct Polygon {
    double area = 0.0;
    Vec3 centre = Vec3::Zero();  ///< from the centre of the body that the walk began at
  };

  std::size_t tail(std::size_t dart) const {
    return static_cast<std::size_t>(contacts_.bodies[dart / 2][dart % 2]);
  }
  Vec3 along(std::size_t dart) const {
    const Vec3 branch = centres_.branch(contacts_.bodies[dart / 2], contacts_.image[dart / 2]);
    return dart % 2 == 0 ? branch : Vec3(-branch);
  }
  PeriodicImage image(std::size_t dart) const {
    const PeriodicImage& i = contacts_.image[dart / 2];
    return dart % 2 == 0 ? i : PeriodicImage{-i[0], -i[1], -i[2]};
  }
  bool is_used(std::size_t dart) const { return is_used_[dart / 2]; }
  std::vector<std::vector<std::size_t>> darts_by_angle() const;
  bool spans(std::size_t root, std::vector<PeriodicImage>& place, std::vector<bool>& seen) const;
  void turn_into_order();
  void walk_around(std::size_t first);
  std::size_t used_contacts() const {
    return static_cast<std::size_t>(std::count(is_used_.begin(), is_used_.end(), true));
  }
  std::size_t used_bodies() const;

  const PeriodicCentres& centres_;
  const PeriodicPairs& contacts_;
  std::vector<double> angle_;                      ///< of each dart, where it leaves its body
  std::vector<bool> is_used_;                      ///< of each contact
  std::vector<std::vector<std::size_t>> leaving_;  ///< darts that are used, of each body
  std::vector<std::size_t> next_;                  ///< dart around the polygon on the left
  std::vector<std::size_t> polygon_of_;            ///< on the left of each dart
  std::vector<Vec3> from_centre_;                  ///< of that polygon to the tail of the dart
  std::vector<Polygon> polygons_;
};

ContactNet::ContactNet(const PeriodicCentres& centres, const PeriodicPairs& contacts,
                       std::span<const Vec3> arm)
    : centres_(centres), contacts_(contacts), is_used_(contacts.size(), true) {
  angle_.reserve(2 * contacts.size());
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const Vec3 branch = along(2 * c);
    const Vec3 of_a = arm.empty() ? branch : arm[c];
    const Vec3 of_b = arm.empty() ? Vec3(-branch) : Vec3(arm[c] - branch);
    angle_.push_back(std::atan2(of_a[1], of_a[0]));
    angle_.push_back(std::atan2(of_b[1], of_b[0]));
  }
}

std::size_t ContactNet::used_bodies() const {
  return leaving_.size() -
         static_cast<std::size_t>(std::count_if(leaving_.begin(), leaving_.end(),
                                                [](const auto& darts) { return darts.empty(); }));
}

/// Counter-clockwise.
std::vector<std::vector<std::size_t>> ContactNet::darts_by_angle() const {
  std::vector<std::vector<std::size_t>> leaving(centres_.position.size());
  for (std::size_t dart = 0; dart < angle_.size(); ++dart)
    if (is_used(dart)) leaving[tail(dart)].push_back(dart);
  for (auto& darts : leaving)
    std::sort(darts.begin(), darts.end(), [&](std::size_t a, std::size_t b) {
      return angle_[a] != angle_[b] ? angle_[a] < angle_[b] : a < b;
    });
  return leaving;
}

/// Visits what hangs together with a body. Do ways around it lead along both axes of the cell?
bool ContactNet::spans(std::size_t root, std::vector<PeriodicImage>& place,
                       std::vector<bool>& seen) const {
  std::vector<std::size_t> open{root};
  seen[root] = true;
  PeriodicImage first{};
  bool both = false;
  while (!open.empty()) {
    const std::size_t at = open.back();
    open.pop_back();
    for (const std::size_t dart : leaving_[at]) {
      const std::size_t to = tail(dart ^ 1);
      PeriodicImage there = image(dart);
      for (std::size_t k = 0; k < 3; ++k) there[k] += place[at][k];
      if (!seen[to]) {
        seen[to] = true;
        place[to] = there;
        open.push_back(to);
        continue;
      }
      for (std::size_t k = 0; k < 3; ++k) there[k] -= place[to][k];
      if (first == PeriodicImage{}) first = there;
      both = both || std::int64_t{first[0]} * there[1] != std::int64_t{first[1]} * there[0];
    }
  }
  return both;
}

void ContactNet::keep_what_spans() {
  leaving_ = darts_by_angle();
  const std::size_t bodies = leaving_.size();
  std::vector<PeriodicImage> place(bodies, PeriodicImage{});
  std::vector<bool> seen(bodies, false);
  std::size_t parts = 0;
  for (std::size_t root = 0; root < bodies; ++root) {
    if (seen[root] || leaving_[root].empty()) continue;
    std::vector<bool> part = seen;
    if (spans(root, place, part)) {
      ++parts;
      for (std::size_t c = 0; c < contacts_.size(); ++c) {
        const std::size_t body = tail(2 * c);
        is_used_[c] = is_used_[c] && part[body] && !seen[body];
      }
    }
    seen = std::move(part);
  }
  if (parts == 0) throw NoMesh("contacts do not span the cell along both axes: it has no polygons");
  if (parts > 1) throw NoMesh("edges cross: two parts without a contact each span the cell");
  leaving_ = darts_by_angle();
}

/// At the end of a dart the polygon on its left goes on along the next dart clockwise from the way
/// back.
void ContactNet::turn_into_order() {
  next_.assign(angle_.size(), kNone);
  for (const auto& darts : leaving_)
    for (std::size_t k = 0; k < darts.size(); ++k)
      next_[darts[k] ^ 1] = darts[(k + darts.size() - 1) % darts.size()];
}

void ContactNet::walk_around(std::size_t first) {
  std::vector<std::size_t> walk;
  Vec3 place = Vec3::Zero(), sum = Vec3::Zero();
  PeriodicImage around{};
  Polygon polygon;
  for (std::size_t dart = first; polygon_of_[dart] == kNone; dart = next_[dart]) {
    polygon_of_[dart] = polygons_.size();
    from_centre_[dart] = place;
    walk.push_back(dart);
    sum += place;
    const Vec3 side = along(dart);
    polygon.area += 0.5 * (place[0] * side[1] - place[1] * side[0]);
    place += side;
    for (std::size_t k = 0; k < 2; ++k) around[k] += image(dart)[k];
  }
  if (around != PeriodicImage{})
    throw NoMesh("edges cross: a polygon of " + std::to_string(walk.size()) +
                 " contacts does not close");
  polygon.centre = sum / static_cast<double>(walk.size());
  for (const std::size_t dart : walk) from_centre_[dart] -= polygon.centre;
  polygons_.push_back(polygon);
}

void ContactNet::find_polygons() {
  turn_into_order();
  polygons_.clear();
  polygon_of_.assign(angle_.size(), kNone);
  from_centre_.assign(angle_.size(), Vec3::Zero());
  for (std::size_t dart = 0; dart < angle_.size(); ++dart)
    if (is_used(dart) && polygon_of_[dart] == kNone) walk_around(dart);
  const std::size_t polygons = polygons_.size(), bodies = used_bodies(), contacts = used_contacts();
  if (polygons + bodies != contacts)
    throw NoMesh("edges cross: " + std::to_string(polygons) + " polygons and " +
                 std::to_string(bodies) + " particles have " + std::to_string(contacts) +
                 " contacts, which must be as many as both together");
  const double area =
      std::accumulate(polygons_.begin(), polygons_.end(), 0.0,
                      [](double sum, const Polygon& polygon) { return sum + polygon.area; });
  if (!(std::abs(area - centres_.volume()) <= kSameArea * centres_.volume()))
    throw NoMesh("edges cross: polygons have the area " + std::to_string(area) +
                 ", and the cell has " + std::to_string(centres_.volume()));
}

bool ContactNet::drop_bridges() {
  bool any = false;
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    if (!is_used_[c] || polygon_of_[2 * c] != polygon_of_[2 * c + 1]) continue;
    // Of one image of the polygon, not of two: the way there and back begins and ends in one place.
    const Vec3 apart = from_centre_[2 * c] + along(2 * c) - from_centre_[2 * c + 1];
    if (apart.norm() > kOnePlace * std::sqrt(centres_.volume())) continue;
    is_used_[c] = false;
    any = true;
  }
  return any;
}

StrainMesh ContactNet::mesh() const {
  StrainMesh mesh{2, centres_.volume(), {}, polygons_.size(), used_bodies()};
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    if (!is_used_[c]) continue;
    const Vec3 branch = along(2 * c);
    // Centre on the left less centre on the right.
    const Vec3 across = from_centre_[2 * c + 1] - branch - from_centre_[2 * c];
    mesh.edges.push_back(
        {contacts_.bodies[c], contacts_.image[c], branch, Vec3(across[1], -across[0], 0.0)});
  }
  return mesh;
}

}  // namespace

StrainMesh polygon_mesh(const PeriodicCentres& centres, const PeriodicPairs& contacts,
                        std::span<const Vec3> arm) {
  require_sound(contacts, centres);
  if (centres.dimensions != 2)
    throw std::invalid_argument("dimensions = " + std::to_string(centres.dimensions) +
                                ": polygons are of the plane");
  if (!arm.empty()) require_length("arm", arm.size(), contacts.size(), "pairs");
  ContactNet net(centres, contacts, arm);
  do {
    net.keep_what_spans();
    net.find_polygons();
  } while (net.drop_bridges());
  return net.mesh();
}

}  // namespace tangency::inline v0::micromechanics
