// SPDX-License-Identifier: MIT
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <tangency/dem/particles.hpp>
#include <tangency/dem/tool/gsd_file.hpp>
#include <tangency/dem/tool/gsd_layout.hpp>
#include <tangency/geometry/tables/csv.hpp>
#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::dem {
namespace {

using namespace gsd;
using tables::to_text;

/// Names an item, counted from 0 as GSD's own programs do.
std::string item(const std::string& name, std::size_t k) { return name + "[" + to_text(k) + "]"; }

class GsdReader {
 public:
  GsdReader(std::string file, std::string_view bytes) : file_(std::move(file)), bytes_(bytes) {
    const auto header = at<Header>(0);
    if (header.magic != kMagic) fail("", "no GSD file");
    if (header.version >> 16 > 2)
      fail("version " + to_text(header.version >> 16), "1 or 2 of the file layer");
    if (std::string_view(header.schema, 6) != std::string_view("hoomd\0", 6))
      fail("schema", "hoomd");
    read_names(header);
    for (std::uint64_t k = 0; k < header.index_entries; ++k) {
      const auto entry = at<IndexEntry>(header.index_location + k * sizeof(IndexEntry));
      if (entry.location == 0) break;
      if (entry.id >= names_.size()) fail("index", "names that are in the list");
      chunks_[{entry.frame, names_[entry.id]}] = entry;
      last_ = std::max(last_, entry.frame);
    }
    if (chunks_.empty()) fail("index", "one frame or more");
  }

  std::uint64_t last() const { return last_; }
  void go_to(std::uint64_t frame) { frame_ = frame; }

  /// Of the frame, else of frame 0; nothing where neither has it.
  template <class Number>
  std::vector<Number> values(const std::string& name, std::size_t rows, std::size_t columns,
                             bool any_size = false) const {
    const IndexEntry* entry = find(name);
    if (!entry) return {};
    if (entry->type != type_of<Number>()) fail(name, "numbers of the schema's type");
    if (!any_size && (entry->rows != rows || entry->columns != columns))
      fail(name, to_text(rows) + " x " + to_text(columns) + " numbers");
    const std::uint64_t most = bytes_.size() / sizeof(Number);
    if (entry->columns == 0 || entry->rows > most / entry->columns) fail(name, "a whole chunk");
    std::vector<Number> numbers(entry->rows * entry->columns);
    copy(static_cast<std::uint64_t>(entry->location), numbers.data(),
         numbers.size() * sizeof(Number));
    from_little_endian(numbers.data(), numbers.size());
    if constexpr (std::is_floating_point_v<Number>)
      for (std::size_t k = 0; k < numbers.size(); ++k)
        if (!std::isfinite(numbers[k]))
          fail(item(name, k / entry->columns), to_text(numbers[k]), "finite numbers");
    return numbers;
  }
  std::vector<std::string> texts(const std::string& name) const {
    const auto letters = values<std::int8_t>(name, 0, 0, true);
    std::vector<std::string> texts;
    const IndexEntry* entry = find(name);
    for (std::size_t row = 0; entry && row < entry->rows; ++row) {
      const auto start = letters.begin() + static_cast<std::ptrdiff_t>(row * entry->columns);
      texts.emplace_back(start, std::find(start, start + entry->columns, std::int8_t{0}));
    }
    return texts;
  }

  [[noreturn]] void fail(const std::string& what, const std::string& allowed) const {
    throw tables::Error({.file = file_, .column = what, .rule = allowed});
  }
  [[noreturn]] void fail(const std::string& what, const std::string& value,
                         const std::string& allowed) const {
    throw tables::Error({.file = file_, .column = what, .value = value, .rule = allowed});
  }

 private:
  void copy(std::uint64_t location, void* to, std::size_t size) const {
    if (location > bytes_.size() || size > bytes_.size() - location)
      fail("", "a whole GSD file: this one is cut off");
    if (size > 0) std::memcpy(to, bytes_.data() + location, size);
  }
  template <class T>
  T at(std::uint64_t location) const {
    T value;
    copy(location, &value, sizeof value);
    turn(value);
    return value;
  }
  const IndexEntry* find(const std::string& name) const {
    for (const std::uint64_t frame : {frame_, std::uint64_t{0}})
      if (const auto found = chunks_.find({frame, name}); found != chunks_.end())
        return &found->second;
    return nullptr;
  }
  void read_names(const Header& header) {
    if (header.names_units > bytes_.size() / kNameUnit) fail("names", "a whole list");
    std::string list(header.names_units * kNameUnit, '\0');
    copy(header.names_location, list.data(), list.size());
    // Of version 1 each name has a unit of its own.
    const bool is_old = header.version >> 16 == 1;
    for (std::size_t start = 0; start < list.size() && list[start] != '\0';) {
      names_.emplace_back(list.c_str() + start);
      start += is_old ? kNameUnit : names_.back().size() + 1;
    }
  }

  std::string file_;
  std::string_view bytes_;
  std::vector<std::string> names_;
  std::map<std::pair<std::uint64_t, std::string>, IndexEntry> chunks_;
  std::uint64_t frame_ = 0, last_ = 0;
};

/// Length. Chosen: within them the volume, the moments of inertia and their quotients with numbers
/// of 32 bits are neither 0 nor infinite.
constexpr double kLeastRadius = 1e-30, kMostRadius = 1e30;

bool is_radius(double x) { return x >= kLeastRadius && x <= kMostRadius; }
std::string radius_rule() {
  return "from " + to_text(kLeastRadius) + " to " + to_text(kMostRadius);
}

/// Semi-axes of a type.
Vec3 radii_of(const GsdReader& in, const std::string& shape) {
  const auto json = nlohmann::json::parse(shape, nullptr, false);
  const bool has_type = json.is_object() && json.contains("type") && json["type"].is_string();
  const std::string kind = has_type ? json["type"].get<std::string>() : "";
  const auto number = [&](const char* key) {
    const double x = json.contains(key) && json[key].is_number() ? json[key].get<double>() : 0.0;
    if (!is_radius(x))
      in.fail("particles/type_shapes", shape, std::string(key) + " " + radius_rule());
    return x;
  };
  if (kind == "Ellipsoid") return {number("a"), number("b"), number("c")};
  if (kind == "Sphere") return Vec3::Constant(0.5 * number("diameter"));
  in.fail("particles/type_shapes", shape, "shapes of type Ellipsoid or Sphere");
}

std::vector<Vec3> vectors(const GsdReader& in, const std::string& name, std::size_t count) {
  const auto numbers = in.values<float>(name, count, 3);
  std::vector<Vec3> all;
  for (std::size_t k = 0; k + 2 < numbers.size(); k += 3)
    all.emplace_back(numbers[k], numbers[k + 1], numbers[k + 2]);
  return all;
}

std::vector<Quaternion> quaternions(const GsdReader& in, const std::string& name,
                                    std::size_t count) {
  const auto numbers = in.values<float>(name, count, 4);
  std::vector<Quaternion> all;
  for (std::size_t k = 0; k + 3 < numbers.size(); k += 4)
    all.emplace_back(numbers[k], numbers[k + 1], numbers[k + 2], numbers[k + 3]);
  return all;
}

Mat3 edges_of(const GsdReader& in) {
  const auto floats = in.values<float>("configuration/box", 6, 1);
  const std::vector<double> box(floats.begin(), floats.end());
  if (box.empty()) in.fail("configuration/box", "6 numbers");
  const double lx = box[0], ly = box[1], lz = box[2];
  if (!(lx > 0.0 && ly > 0.0 && lz > 0.0))
    in.fail("configuration/box", to_text(lx) + " " + to_text(ly) + " " + to_text(lz),
            "3 edges > 0");
  Mat3 edges;
  edges << lx, box[3] * ly, box[4] * lz, 0.0, ly, box[5] * lz, 0.0, 0.0, lz;
  return edges;
}

/// Centres from the cell's corner, in the image of the cell where they are.
std::vector<Vec3> centres(const GsdReader& in, std::size_t count, const Mat3& edges) {
  auto all = vectors(in, "particles/position", count);
  if (all.size() != count) in.fail("particles/position", to_text(count) + " x 3 numbers");
  const auto images = in.values<std::int32_t>("particles/image", count, 3);
  const Vec3 centre = 0.5 * edges.rowwise().sum();
  for (std::size_t i = 0; i < count; ++i) {
    all[i] += centre;
    if (!images.empty())
      all[i] += edges * Vec3(images[3 * i], images[3 * i + 1], images[3 * i + 2]);
  }
  return all;
}

/// Shapes by types; spheres by their diameters where no shapes are given.
void add_bodies(const GsdReader& in, std::size_t count, Sample& sample) {
  const auto places = centres(in, count, sample.edges);
  const auto types = in.values<std::uint32_t>("particles/typeid", count, 1);
  const auto shapes = in.texts("particles/type_shapes");
  const auto diameters = in.values<float>("particles/diameter", count, 1);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t type = types.empty() ? 0 : types[i];
    if (type >= sample.type_names.size())
      in.fail(item("particles/typeid", i), to_text(type),
              "below " + to_text(sample.type_names.size()) + ", the number of types");
    const Vec3 radii =
        type < shapes.size() && shapes[type] != "{}" && !shapes[type].empty()
            ? radii_of(in, shapes[type])
            : Vec3(Vec3::Constant(0.5 * (diameters.empty() ? 1.0 : double{diameters[i]})));
    if (!is_radius(radii[0]))
      in.fail(item("particles/diameter", i), to_text(2.0 * radii[0]),
              "twice a radius " + radius_rule());
    sample.add(static_cast<std::int32_t>(type), places[i], radii);
  }
}

void add_motion(const GsdReader& in, std::size_t count, Sample& sample) {
  if (auto all = quaternions(in, "particles/orientation", count); !all.empty())
    sample.orientation = std::move(all);
  if (auto all = vectors(in, "particles/velocity", count); !all.empty())
    sample.velocity = std::move(all);
  const auto mass = in.values<float>("particles/mass", count, 1);
  const auto moments = vectors(in, "particles/moment_inertia", count);
  const auto momenta = quaternions(in, "particles/angmom", count);
  for (std::size_t i = 0; i < count; ++i) {
    const Quaternion& q = sample.orientation[i];
    if (q.coeffs().isZero(0.0))
      in.fail(item("particles/orientation", i), "0 0 0 0", "4 numbers, not all 0");
    const double m = mass.empty() ? 1.0 : static_cast<double>(mass[i]);
    if (!(m > 0.0)) in.fail(item("particles/mass", i), to_text(m), "a number > 0");
    sample.density[i] = m / volume_of(sample.semi_axes[i]);
    if (momenta.empty()) continue;
    const Vec3 in_body = 0.5 * (q.conjugate() * momenta[i]).vec();
    const bool turns = !moments.empty() && (moments[i].array() > 0.0).all();
    const Vec3 inertia = turns ? moments[i] : principal_inertia(m, sample.semi_axes[i]);
    sample.angular_velocity[i] = q * in_body.cwiseQuotient(inertia);
  }
}

}  // namespace

bool is_gsd(std::string_view bytes) {
  std::array<char, sizeof kMagic> magic;
  if (bytes.size() < magic.size()) return false;
  std::copy_n(bytes.begin(), magic.size(), magic.begin());
  return of_little_endian_bytes<std::uint64_t>(magic) == kMagic;
}

Sample read_gsd(const std::string& file, std::string_view bytes, std::optional<int> frame) {
  GsdReader in(file, bytes);
  const std::uint64_t wanted = frame ? static_cast<std::uint64_t>(*frame) : in.last();
  if (wanted > in.last())
    in.fail("--frame = " + to_text(wanted), "from 0 to " + to_text(in.last()) + ", the last one");
  in.go_to(wanted);
  Sample sample;
  sample.edges = edges_of(in);
  const auto step = in.values<std::uint64_t>("configuration/step", 1, 1);
  if (!step.empty()) sample.cycle = static_cast<std::int64_t>(step[0]);
  const auto count = in.values<std::uint32_t>("particles/N", 1, 1);
  if (count.empty() || count[0] == 0) in.fail("particles/N", "1 particle or more");
  sample.type_names = in.texts("particles/types");
  if (sample.type_names.empty()) sample.type_names = {"A"};
  add_bodies(in, count[0], sample);
  add_motion(in, count[0], sample);
  return sample;
}

}  // namespace tangency::inline v0::dem
