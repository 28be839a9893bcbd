// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/body_table.hpp>

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <tangency/dem/particles.hpp>
#include <tangency/dem/samples/sample.hpp>
#include <tangency/dem/scene/scene_keys.hpp>
#include <tangency/dem/tool/descending_axes.hpp>
#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/tables/csv.hpp>
#include <tangency/geometry/tool/body_columns.hpp>

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

/// The key that columns stand for, whose values are theirs.
const Key& key_of(std::string_view section, std::string_view name) {
  return *std::find_if(scene_keys().begin(), scene_keys().end(),
                       [&](const Key& one) { return one.section == section && one.name == name; });
}
const Key& body_key(std::string_view name) { return key_of("body", name); }

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

/// Relative difference of semi-axes up to which a body is one of its type. Chosen: above what a
/// table of ten digits rounds by.
constexpr double kAsItsType = 1e-9;

/// The semi-axes of bodies, where the table has them.
class AxesColumns {
 public:
  AxesColumns(const tables::Header& header, int dimensions) : dimensions_(dimensions) {
    if (dimensions == 2)
      plane_ = group(header, {"r1", "r2"});
    else if (header.find("r1") || header.find("m.xx") || header.find("p.xx") || header.find("u1.x"))
      space_.emplace(header, "");
  }

  /// Sets the body's semi-axes, in descending order, and turns it so.
  void read(const tables::RowCursor& row, Body& body) const {
    if (space_) {
      const Ellipsoid solid = space_->read(row).ellipsoid();
      body.semi_axes = solid.semi_axes();
      body.orientation = solid.orientation();
    } else if (!plane_.empty()) {
      const Key& key = key_of("particles", "mean_radius");
      const Vec2 axes = numbers(row, plane_, key, Vec2(Vec2::Zero()));
      body.semi_axes = Vec3(axes[0], axes[1], 0.0);
    } else {
      return;
    }
    make_descend(body.semi_axes, body.orientation);
    if (dimensions_ == 2) body.semi_axes[2] = body.semi_axes[1];
  }

 private:
  int dimensions_;
  Columns plane_;
  std::optional<tool::BodyColumns> space_;
};

class BodyTable {
 public:
  BodyTable(const tables::Header& header, const Scene& scene)
      : scene_(scene),
        type_(header.require("type")),
        position_{header.require("x"), header.require("y"), header.require("z")},
        orientation_(group(header, {"qw", "qx", "qy", "qz"})),
        velocity_(group(header, {"vx", "vy", "vz"})),
        angular_velocity_(group(header, {"wx", "wy", "wz"})),
        axes_(header, scene.dimensions) {}

  Body read(const tables::RowCursor& row) const {
    const Vec3 none = Vec3::Zero();
    const Eigen::Vector4d q =
        numbers(row, orientation_, orientation_key_, Eigen::Vector4d(1.0, 0.0, 0.0, 0.0));
    if (q.isZero(0.0)) throw row.error(orientation_[0], "4 finite numbers, not all 0");
    Body body{type_of(row),
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
    axes_.read(row, body);
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
  AxesColumns axes_;
};

bool is_of_its_type(const Body& body, const Scene& scene) {
  const Vec3 axes = scene.particle_types[body.type].batch.shape.semi_axes(scene.dimensions);
  return (body.semi_axes - axes).cwiseAbs().maxCoeff() <= kAsItsType * axes.maxCoeff();
}

/// Shapes of the types whose bodies are not all as the scene says; bodies are made to have just
/// them, and those of other types none of their own.
BodyShapes own_shapes(std::vector<Body>& bodies, const Scene& scene) {
  std::vector<bool> own(scene.particle_types.size(), false);
  for (const Body& body : bodies)
    if (!body.semi_axes.isZero(0.0) && !is_of_its_type(body, scene)) own[body.type] = true;
  BodyShapes shapes(own.size());
  for (Body& body : bodies) {
    const Vec3 axes = body.semi_axes;
    body.semi_axes.setZero();
    if (!own[body.type]) continue;
    const Shape shape{mean_radius_of(axes, scene.dimensions), axes[0] / axes[1], axes[1] / axes[2]};
    shapes[body.type].push_back(shape);
    body.semi_axes = shape.semi_axes(scene.dimensions);
  }
  if (std::find(own.begin(), own.end(), true) == own.end()) shapes.clear();
  return shapes;
}

}  // namespace

void read_bodies(Scene& scene, const SceneFile& source, const std::filesystem::path& scene_file) {
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
  if (const BodyShapes shapes = own_shapes(bodies, scene); !shapes.empty())
    scene = source.scene(shapes);
  set_bodies(scene, std::move(bodies), file);
}

}  // namespace tangency::inline v0::dem
