// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/import_scene.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <set>

#include <tangency/dem/particles.hpp>
#include <tangency/dem/scene/scene_error.hpp>
#include <tangency/dem/tool/csv_text.hpp>
#include <tangency/dem/tool/descending_axes.hpp>
#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::dem {
namespace {

using tables::to_text;

/// Chosen: laws of contacts stand in a table of types by types, some 60 bytes each.
constexpr std::size_t kMostKinds = 1000;

bool is_of_a_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/// Of letters, digits and _, and no number alone.
std::string scene_name(std::string name) {
  for (char& c : name)
    if (!is_of_a_name(c)) c = '_';
  return name.empty() || (name[0] >= '0' && name[0] <= '9') ? "type_" + name : name;
}

std::string three(const Vec3& v) {
  return "[" + to_text(v[0]) + ", " + to_text(v[1]) + ", " + to_text(v[2]) + "]";
}

/// Names that no two kinds share.
void name_kinds(BodyKinds& all, const Sample& sample, const std::vector<std::int32_t>& type_of) {
  std::map<std::int32_t, std::size_t> kinds_of_type;
  for (const std::int32_t type : type_of) ++kinds_of_type[type];
  std::map<std::int32_t, std::size_t> next;
  std::set<std::string> taken;
  for (std::size_t k = 0; k < all.kinds.size(); ++k) {
    const std::int32_t type = type_of[k];
    std::string name = scene_name(sample.type_names[static_cast<std::size_t>(type)]);
    if (kinds_of_type[type] > 1) name += "_" + to_text(++next[type]);
    while (!taken.insert(name).second) name += "_";
    all.kinds[k].name = name;
  }
}

std::string walls_of(const Sample& sample) {
  std::string walls;
  const char* axes = "xyz";
  for (std::size_t k = 0; k < 3; ++k)
    if (!sample.periodic[k]) walls += axes[k];
  return walls.empty() ? "" : "walls = \"" + walls + "\"\n";
}

/// As it stands within the quotes of a string of TOML. Of a comment it leaves one line.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      out += tables::formatted("\\u%04x", static_cast<unsigned>(c));
    else
      out += c;
  }
  return out;
}

}  // namespace

Sample with_descending_axes(Sample sample) {
  for (std::size_t i = 0; i < sample.size(); ++i)
    make_descend(sample.semi_axes[i], sample.orientation[i]);
  return sample;
}

BodyKinds kinds_of(const Sample& sample) {
  using Key = std::array<double, 5>;
  std::map<Key, std::int32_t> known;
  BodyKinds all;
  std::vector<std::int32_t> types;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const Vec3& axes = sample.semi_axes[i];
    const Key key{static_cast<double>(sample.type[i]), axes[0], axes[1], axes[2],
                  sample.density[i]};
    const auto [found, is_new] = known.emplace(key, static_cast<std::int32_t>(all.kinds.size()));
    all.of_body.push_back(found->second);
    if (is_new) {
      all.kinds.push_back({"", axes, sample.density[i], 0});
      types.push_back(sample.type[i]);
    }
    ++all.kinds[static_cast<std::size_t>(found->second)].count;
  }
  name_kinds(all, sample, types);
  return all;
}

std::string body_table(const Sample& sample, const BodyKinds& kinds) {
  CsvText text;
  for (const char* name : {"type", "x", "y", "z", "qw", "qx", "qy", "qz", "vx", "vy", "vz", "wx",
                           "wy", "wz", "r1", "r2", "r3", "density"})
    text.add(std::string_view(name));
  text.end_row();
  for (std::size_t i = 0; i < sample.size(); ++i) {
    text.add(std::string_view(kinds.kinds[static_cast<std::size_t>(kinds.of_body[i])].name));
    text.add(sample.position[i]);
    const Quaternion& q = sample.orientation[i];
    for (const double part : {q.w(), q.x(), q.y(), q.z()}) text.add(part);
    text.add(sample.velocity[i]);
    text.add(sample.angular_velocity[i]);
    text.add(sample.semi_axes[i]);
    text.add(sample.density[i]);
    text.end_row();
  }
  return std::string(text.view());
}

std::string scene_of(const Sample& sample, const BodyKinds& kinds, const std::string& source,
                     const std::string& table) {
  if (!sample.edges.isDiagonal(0.0))
    throw SceneError(source +
                     ": a tilted cell: a scene begins with edges along x, y and z; the "
                     "table alone can be written");
  if (kinds.kinds.size() > kMostKinds)
    throw SceneError(source + ": " + to_text(kinds.kinds.size()) +
                     " kinds of bodies, by type, semi-axes and density: a scene takes up to " +
                     to_text(kMostKinds) + "; round the sizes");
  std::string text = "# From " + escaped(source) +
                     ". What such files do not have is to be added: [contact] and the stages that "
                     "follow.\nschema = 1\n\n[cell]\nsize = " +
                     three(sample.edges.diagonal()) + "\n" + walls_of(sample);
  for (const BodyKinds::Kind& kind : kinds.kinds) {
    const Vec3& axes = kind.semi_axes;
    text += "\n[particles." + kind.name + "]\ncount = " + to_text(kind.count) +
            "\nmean_radius = " + to_text(mean_radius_of(axes)) +
            "\nelongation = " + to_text(axes[0] / axes[1]) +
            "\nflatness = " + to_text(axes[1] / axes[2]) + "\ndensity = " + to_text(kind.density) +
            "\n";
  }
  return text + "\n[[stage]]\nkind = \"place\"\narrangement = \"explicit\"\nfile = \"" +
         escaped(table) + "\"\n";
}

}  // namespace tangency::inline v0::dem
