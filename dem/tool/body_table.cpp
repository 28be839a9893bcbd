// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/body_table.hpp>

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <tangency/dem/sample.hpp>
#include <tangency/dem/scene_keys.hpp>
#include <tangency/geometry/tables/csv.hpp>

namespace tangency::inline v0::dem {
namespace {

using Columns = std::vector<tables::Column>;

/// Columns of which a table has all or none; empty where it has none.
Columns group(const tables::Header& header, const std::vector<std::string>& names) {
  Columns columns;
  for (const std::string& name : names)
    if (const auto column = header.find(name)) columns.push_back(*column);
  if (columns.empty() || columns.size() == names.size()) return columns;
  for (const std::string& name : names) header.require(name);  // names the one that is missing
  return columns;
}

/// The key of [[body]] that columns stand for, whose values are theirs.
const Key& body_key(std::string_view name) {
  return *std::find_if(scene_keys().begin(), scene_keys().end(),
                       [&](const Key& one) { return one.section == "body" && one.name == name; });
}

template <class Vector>
Vector numbers(const tables::RowCursor& row, const Columns& columns, const Key& key,
               const Vector& otherwise) {
  if (columns.empty()) return otherwise;
  Vector v = otherwise;
  for (Eigen::Index k = 0; k < v.size(); ++k) {
    const tables::Column column = columns[static_cast<std::size_t>(k)];
    v[k] = row.number(column);
    if (!key.range.holds(v[k])) throw row.error(column, "one of " + allowed_values(key));
  }
  return v;
}

class BodyTable {
 public:
  BodyTable(const tables::Header& header, const Scene& scene)
      : scene_(scene),
        type_(header.require("type")),
        position_{header.require("x"), header.require("y"), header.require("z")},
        orientation_(group(header, {"qw", "qx", "qy", "qz"})),
        velocity_(group(header, {"vx", "vy", "vz"})),
        angular_velocity_(group(header, {"wx", "wy", "wz"})) {}

  Body read(const tables::RowCursor& row) const {
    const Vec3 none = Vec3::Zero();
    const Eigen::Vector4d q =
        numbers(row, orientation_, orientation_key_, Eigen::Vector4d(1.0, 0.0, 0.0, 0.0));
    if (q.isZero(0.0)) throw row.error(orientation_[0], "4 finite numbers, not all 0");
    const Body body{type_of(row),
                    numbers(row, position_, position_key_, none),
                    {q[0], q[1], q[2], q[3]},
                    numbers(row, velocity_, velocity_key_, none),
                    numbers(row, angular_velocity_, angular_velocity_key_, none)};
    for (int k = 0; k < 3 && scene_.cell_size; ++k)
      if (!is_near_cell(body.position[k], (*scene_.cell_size)[k]))
        throw row.error(position_[static_cast<std::size_t>(k)], kNearTheCell);
    if (scene_.dimensions == 2) {
      require_zero(row, position_, {2});
      require_zero(row, orientation_, {1, 2});
      require_zero(row, velocity_, {2});
      require_zero(row, angular_velocity_, {0, 1});
    }
    return body;
  }

 private:
  static void require_zero(const tables::RowCursor& row, const Columns& columns,
                           std::initializer_list<std::size_t> which) {
    if (columns.empty()) return;
    for (const std::size_t k : which)
      if (row.number(columns[k]) != 0.0)
        throw row.error(columns[k], "0: with dimensions = 2 a body lies, moves and turns in z = 0");
  }

  std::size_t type_of(const tables::RowCursor& row) const {
    const auto& types = scene_.particle_types;
    for (std::size_t k = 0; k < types.size(); ++k)
      if (types[k].name == row.text(type_)) return k;
    throw row.error(type_, "a name of one of the scene's particle types");
  }

  const Scene& scene_;
  const Key& position_key_ = body_key("position");
  const Key& orientation_key_ = body_key("orientation");
  const Key& velocity_key_ = body_key("velocity");
  const Key& angular_velocity_key_ = body_key("angular_velocity");
  tables::Column type_;
  Columns position_, orientation_, velocity_, angular_velocity_;
};

}  // namespace

void read_bodies(Scene& scene, const std::filesystem::path& scene_file) {
  const std::string& name = scene.stages.front().place->file;
  if (name.empty()) return;
  const std::string file = (scene_file.parent_path() / name).string();
  std::vector<Body> bodies;
  try {
    tables::Reader reader(file);
    const BodyTable table(reader.header(), scene);
    tables::for_each_row(reader,
                         [&](const tables::RowCursor& row) { bodies.push_back(table.read(row)); });
  } catch (const tables::Error& error) {
    throw SceneError(error.what());
  }
  set_bodies(scene, std::move(bodies), file);
}

}  // namespace tangency::inline v0::dem
