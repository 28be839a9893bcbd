// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include <tangency/dem/particles.hpp>
#include <tangency/dem/tool/gsd_file.hpp>
#include <tangency/dem/tool/gsd_layout.hpp>
#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::dem {
namespace {

using namespace gsd;

/// Chunks of frame 0, one after the other.
class Chunks {
 public:
  template <class Number>
  void add(const char* name, std::uint32_t columns, std::span<const Number> values) {
    IndexEntry entry{};
    entry.rows = values.size() / columns;
    entry.location = static_cast<std::int64_t>(sizeof(Header) + data_.size());
    entry.columns = columns;
    entry.id = static_cast<std::uint16_t>(index_.size());
    entry.type = type_of<Number>();
    index_.push_back(entry);
    names_ += std::string(name) + '\0';
    for (const Number value : values) {
      const auto bytes = little_endian_bytes(value);
      data_.append(bytes.data(), bytes.size());
    }
  }
  template <class Number>
  void add(const char* name, std::uint32_t columns, const std::vector<Number>& values) {
    add(name, columns, std::span<const Number>(values));
  }
  template <class Number>
  void add(const char* name, Number value) {
    add(name, 1, std::span<const Number>(&value, 1));
  }
  /// Rows of one length, filled up by 0.
  void add(const char* name, const std::vector<std::string>& texts) {
    std::size_t longest = 1;
    for (const std::string& text : texts) longest = std::max(longest, text.size() + 1);
    std::vector<std::int8_t> rows;
    for (const std::string& text : texts) {
      rows.insert(rows.end(), text.begin(), text.end());
      rows.resize(rows.size() + longest - text.size(), 0);
    }
    add(name, static_cast<std::uint32_t>(longest), rows);
  }

  std::string file() {
    Header header{};
    header.magic = kMagic;
    header.schema_version = kSchemaVersion;
    header.version = kVersion;
    std::copy_n("tangency-dem", 12, header.application);
    std::copy_n(kSchema, 5, header.schema);
    names_.resize((names_.size() / kNameUnit + 1) * kNameUnit, '\0');
    header.names_location = sizeof(Header) + data_.size();
    header.names_units = names_.size() / kNameUnit;
    header.index_location = header.names_location + names_.size();
    header.index_entries = index_.size() + 1;  // a last one of zeros
    index_.push_back({});
    turn(header);
    for (IndexEntry& entry : index_) turn(entry);
    std::string bytes(reinterpret_cast<const char*>(&header), sizeof header);
    bytes += data_ + names_;
    bytes.append(reinterpret_cast<const char*>(index_.data()), index_.size() * sizeof(IndexEntry));
    return bytes;
  }

 private:
  std::vector<IndexEntry> index_;
  std::string names_, data_;
};

/// One type for each shape of each type.
struct Types {
  std::vector<std::string> names, shapes;
  std::vector<std::uint32_t> of_body;
};

std::string shape_text(const Vec3& radii) {
  return "{\"type\": \"Ellipsoid\", \"a\": " + tables::to_text(radii[0]) +
         ", \"b\": " + tables::to_text(radii[1]) + ", \"c\": " + tables::to_text(radii[2]) + "}";
}

Types types_of(const Sample& sample) {
  using Key = std::array<double, 4>;
  std::map<Key, std::uint32_t> known;
  std::vector<std::size_t> shapes_of(sample.type_names.size(), 0);
  Types types;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const Vec3& radii = sample.semi_axes[i];
    const auto type = static_cast<std::size_t>(sample.type[i]);
    const auto [found, is_new] =
        known.emplace(Key{static_cast<double>(type), radii[0], radii[1], radii[2]},
                      static_cast<std::uint32_t>(types.names.size()));
    types.of_body.push_back(found->second);
    if (!is_new) continue;
    const std::size_t others = shapes_of[type]++;
    types.names.push_back(sample.type_names[type] +
                          (others > 0 ? "_" + tables::to_text(others + 1) : ""));
    types.shapes.push_back(shape_text(radii));
  }
  return types;
}

void append(std::vector<float>& all, const Vec3& v) {
  for (const double x : v) all.push_back(static_cast<float>(x));
}
void append(std::vector<float>& all, const Quaternion& q) {
  for (const double x : {q.w(), q.x(), q.y(), q.z()}) all.push_back(static_cast<float>(x));
}

/// Twice the orientation times the angular momentum in body axes, as HOOMD has it.
Quaternion momentum_of(const Sample& sample, std::size_t i, const Vec3& inertia) {
  const Quaternion& q = sample.orientation[i];
  const Vec3 in_body = inertia.cwiseProduct(q.conjugate() * sample.angular_velocity[i]);
  Quaternion momentum = q * Quaternion(0.0, in_body[0], in_body[1], in_body[2]);
  momentum.coeffs() *= 2.0;
  return momentum;
}

void add_bodies(Chunks& chunks, const Sample& sample) {
  std::vector<float> position, orientation, velocity, momentum, mass, moment;
  std::vector<std::int32_t> image;
  const Vec3 centre = 0.5 * sample.edges.rowwise().sum();
  for (std::size_t i = 0; i < sample.size(); ++i) {
    std::array<std::int32_t, 3> edges{};
    append(position,
           Vec3(wrapped_into(sample.edges, sample.periodic, sample.position[i], edges) - centre));
    image.insert(image.end(), edges.begin(), edges.end());
    append(orientation, sample.orientation[i]);
    append(velocity, sample.velocity[i]);
    const double m = sample.density[i] * volume_of(sample.semi_axes[i]);
    const Vec3 inertia = principal_inertia(m, sample.semi_axes[i]);
    append(momentum, momentum_of(sample, i, inertia));
    append(moment, inertia);
    mass.push_back(static_cast<float>(m));
  }
  chunks.add("particles/mass", 1, mass);
  chunks.add("particles/moment_inertia", 3, moment);
  chunks.add("particles/position", 3, position);
  chunks.add("particles/orientation", 4, orientation);
  chunks.add("particles/velocity", 3, velocity);
  chunks.add("particles/angmom", 4, momentum);
  chunks.add("particles/image", 3, image);
}

}  // namespace

std::string gsd_file(const Sample& sample) {
  Chunks chunks;
  chunks.add("configuration/step", static_cast<std::uint64_t>(sample.cycle));
  chunks.add("configuration/dimensions", std::uint8_t{3});
  const Mat3& e = sample.edges;
  std::vector<float> box;
  for (const double x :
       {e(0, 0), e(1, 1), e(2, 2), e(0, 1) / e(1, 1), e(0, 2) / e(2, 2), e(1, 2) / e(2, 2)})
    box.push_back(static_cast<float>(x));
  chunks.add("configuration/box", 1, box);
  chunks.add("particles/N", static_cast<std::uint32_t>(sample.size()));
  const Types types = types_of(sample);
  chunks.add("particles/types", types.names);
  chunks.add("particles/type_shapes", types.shapes);
  chunks.add("particles/typeid", 1, types.of_body);
  add_bodies(chunks, sample);
  return chunks.file();
}

}  // namespace tangency::inline v0::dem
