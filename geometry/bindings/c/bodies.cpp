// SPDX-License-Identifier: MIT
#include <tangency/geometry/bindings/c/bodies.hpp>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <string>
#include <utility>

#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::c {
namespace {

Vec3 vector_at(const double* p) { return {p[0], p[1], p[2]}; }

/// Of xx yy zz xy yz zx.
Mat3 symmetric_at(const double* p) {
  return Symmetric3{p[0], p[1], p[2], p[4], p[5], p[3]}.matrix();
}

void require_level(double level) {
  if (!(level > 0.0 && level <= std::numeric_limits<double>::max())) {
    refuse_value("level", level, "must be finite and > 0");
  }
}

/// made(numbers) of every row, and a refusal that names the row where it throws.
template <std::size_t N, class Body, class Make>
std::vector<Body> made_of(const Rows& rows, const Make& make) {
  const NumberColumn<N> column = rows.column<NumberColumn<N>>();
  std::vector<Body> bodies;
  bodies.reserve(rows.count);
  const auto refused = [&](const auto& fault) {
    refuse_row(rows.argument, bodies.size(), fault.field, fault.value, fault.rule);
  };
  std::array<double, N> p;
  while (bodies.size() < rows.count) {
    column.read(bodies.size(), p.data());
    try {
      bodies.push_back(make(p.data()));
    } catch (const InvalidEllipsoid& invalid) {
      refused(invalid.fault());
    } catch (const InvalidEllipse& invalid) {
      refused(invalid.fault());
    } catch (const InvalidQuadric& invalid) {
      refused(invalid.fault());
    }
  }
  return bodies;
}

std::vector<MatrixEllipsoid> matrices_of(int form, const Rows& rows, double level) {
  switch (form) {
    case TANGENCY_FORM_SHAPE:
      return made_of<9, MatrixEllipsoid>(rows, [&](const double* p) {
        return MatrixEllipsoid::from_shape(vector_at(p), symmetric_at(p + 3), level);
      });
    case TANGENCY_FORM_PRECISION:
      return made_of<9, MatrixEllipsoid>(rows, [&](const double* p) {
        return MatrixEllipsoid::from_precision(vector_at(p), symmetric_at(p + 3), level);
      });
    case TANGENCY_FORM_VECTORS:
      return made_of<12, MatrixEllipsoid>(rows, [](const double* p) {
        Mat3 axes;
        axes << vector_at(p + 3), vector_at(p + 6), vector_at(p + 9);
        return MatrixEllipsoid::from_axes(vector_at(p), axes);
      });
    case TANGENCY_FORM_QUADRIC:
      return made_of<10, MatrixEllipsoid>(rows, [](const double* p) {
        Quadric::Coefficients c{};
        std::copy(p, p + 10, c.begin());
        return MatrixEllipsoid::from_quadric(Quadric(c));
      });
    default:
      refuse_value("form", form, "must be a tangency_form");
  }
}

std::vector<MatrixEllipse> ellipses_of(int form, const Rows& rows, double level) {
  switch (form) {
    case TANGENCY_PLANE_FORM_DIRECTION:
      return made_of<6, MatrixEllipse>(rows, [](const double* p) {
        return Ellipse({p[0], p[1]}, {p[2], p[3]}, {p[4], p[5]});
      });
    case TANGENCY_PLANE_FORM_ANGLE:
      return made_of<5, MatrixEllipse>(rows, [](const double* p) {
        return Ellipse::at_angle({p[0], p[1]}, {p[2], p[3]}, p[4]);
      });
    case TANGENCY_PLANE_FORM_SHAPE:
      return made_of<5, MatrixEllipse>(rows, [&](const double* p) {
        return MatrixEllipse::from_shape({p[0], p[1]}, {p[2], p[3], p[4]}, level);
      });
    case TANGENCY_PLANE_FORM_PRECISION:
      return made_of<5, MatrixEllipse>(rows, [&](const double* p) {
        return MatrixEllipse::from_precision({p[0], p[1]}, {p[2], p[3], p[4]}, level);
      });
    case TANGENCY_PLANE_FORM_CONIC:
      return made_of<6, MatrixEllipse>(rows, [](const double* p) {
        std::array<double, 6> c{};
        std::copy(p, p + 6, c.begin());
        return MatrixEllipse::from_conic(c);
      });
    default:
      refuse_value("form", form, "must be a tangency_plane_form");
  }
}

PoseColumns poses_of(const Rows& rows) {
  return {QuaternionColumn(rows.column<NumberColumn<4>>(6), QuaternionOrder::wxyz),
          rows.column<VectorColumn>()};
}

/// What a call says of a null pointer to bodies.
template <class Bodies>
Bodies& required(Bodies* bodies, const char* argument) {
  if (bodies == nullptr) refuse(argument, "must not be NULL");
  return *bodies;
}

}  // namespace

void require_axes(const Rows& rows) {
  const NumberColumn<10> column = rows.column<NumberColumn<10>>();
  std::array<double, 10> p;
  for (std::size_t i = 0; i < rows.count; ++i) {
    column.read(i, p.data());
    if (const auto fault = Ellipsoid::find_fault(vector_at(p.data()), vector_at(&p[3]),
                                                 Quaternion(p[6], p[7], p[8], p[9]))) {
      refuse_row(rows.argument, i, fault->field, fault->value, fault->rule);
    }
  }
}

}  // namespace tangency::inline v0::c

using tangency::c::guarded;
using tangency::c::refuse;
using tangency::c::required;
using tangency::c::Rows;
using tangency::tables::to_text;

const tangency::c::Prepared& tangency_bodies::prepared() const {
  const std::scoped_lock lock(preparing_);
  if (!prepared_) {
    std::vector<tangency::Ellipsoid> ellipsoids;
    ellipsoids.reserve(size());
    for (std::size_t i = 0; i < size(); ++i) {
      ellipsoids.push_back(by_matrices() ? matrices_[i].ellipsoid() : moving_[i]);
    }
    prepared_ = std::make_unique<tangency::c::Prepared>(std::move(ellipsoids));
  }
  return *prepared_;
}

void tangency_bodies::append(int form, const Rows& rows, double level) {
  tangency::c::require_level(level);
  if (form == TANGENCY_FORM_AXES && !by_matrices()) {
    append_axes(rows);
  } else {
    append_matrices(form, rows, level);
  }
  prepared_.reset();
}

void tangency_bodies::append_axes(const Rows& rows) {
  require_axes(rows);
  if (rows.count == 0) return;
  const std::size_t before = size();
  if (before == 0) {
    moving_.assign(rows.column<tangency::VectorColumn>(3), tangency::c::poses_of(rows));
    return;
  }
  moving_.resize(before + rows.count);
  moving_.set_semi_axes(before, rows.column<tangency::VectorColumn>(3));
  moving_.set_poses(before, tangency::c::poses_of(rows));
}

void tangency_bodies::append_matrices(int form, const Rows& rows, double level) {
  std::vector<tangency::MatrixEllipsoid> more;
  if (form == TANGENCY_FORM_AXES) {
    tangency_bodies by_axes;
    by_axes.append_axes(rows);
    for (std::size_t i = 0; i < rows.count; ++i) more.emplace_back(by_axes.moving_[i]);
  } else {
    more = tangency::c::matrices_of(form, rows, level);
  }
  if (more.empty()) return;  // bodies by axes stay so
  std::vector<tangency::MatrixEllipsoid> all;
  all.reserve(size() + more.size());
  for (std::size_t i = 0; i < size(); ++i) {
    all.push_back(by_matrices() ? matrices_[i] : tangency::MatrixEllipsoid(moving_[i]));
  }
  std::ranges::move(more, std::back_inserter(all));
  tangency::MovingBodies moving = moving_;
  for (std::size_t i = size(); i < all.size(); ++i) {
    const tangency::Ellipsoid& body = all[i].ellipsoid();
    moving.add(body.semi_axes(), body.orientation(), body.centre());
  }
  moving_ = std::move(moving);
  matrices_ = std::move(all);
}

void tangency_bodies::set(std::size_t first, const Rows& rows) {
  if (rows.count > size()) {
    tangency::c::refuse_value("count", static_cast<double>(rows.count),
                              "must be at most " + to_text(size()) + ", the number of bodies");
  }
  if (first > size() - rows.count) {
    tangency::c::refuse_value("first", static_cast<double>(first),
                              "must be at most " + to_text(size() - rows.count) + ", of " +
                                  to_text(size()) + " bodies for " + to_text(rows.count) + " rows");
  }
  require_axes(rows);
  moving_.set_semi_axes(first, rows.column<tangency::VectorColumn>(3));
  moving_.set_poses(first, tangency::c::poses_of(rows));
  for (std::size_t i = first; by_matrices() && i < first + rows.count; ++i) {
    matrices_[i] = moving_[i];
  }
  prepared_.reset();
}

extern "C" {

int tangency_bodies_create(tangency_bodies** bodies, int form, const void* rows, int number,
                           size_t count, ptrdiff_t stride, double level) {
  return guarded([&] {
    required(bodies, "bodies") = nullptr;
    auto made = std::make_unique<tangency_bodies>();
    made->append(form, {"rows", rows, number, count, stride}, level);
    *bodies = made.release();
  });
}

int tangency_bodies_append(tangency_bodies* bodies, int form, const void* rows, int number,
                           size_t count, ptrdiff_t stride, double level) {
  return guarded([&] {
    required(bodies, "bodies").append(form, {"rows", rows, number, count, stride}, level);
  });
}

int tangency_bodies_set(tangency_bodies* bodies, size_t first, const void* rows, int number,
                        size_t count, ptrdiff_t stride) {
  return guarded([&] {
    required(bodies, "bodies").set(first, {"rows", rows, number, count, stride});
  });
}

size_t tangency_bodies_count(const tangency_bodies* bodies) {
  return bodies == nullptr ? 0 : bodies->size();
}

void tangency_bodies_destroy(tangency_bodies* bodies) { delete bodies; }

int tangency_ellipses_create(tangency_ellipses** ellipses, int form, const void* rows, int number,
                             size_t count, ptrdiff_t stride, double level) {
  return guarded([&] {
    required(ellipses, "ellipses") = nullptr;
    auto made = std::make_unique<tangency_ellipses>();
    tangency::c::require_level(level);
    made->all = tangency::c::ellipses_of(form, {"rows", rows, number, count, stride}, level);
    *ellipses = made.release();
  });
}

int tangency_ellipses_append(tangency_ellipses* ellipses, int form, const void* rows, int number,
                             size_t count, ptrdiff_t stride, double level) {
  return guarded([&] {
    tangency_ellipses& to = required(ellipses, "ellipses");
    tangency::c::require_level(level);
    const auto more = tangency::c::ellipses_of(form, {"rows", rows, number, count, stride}, level);
    to.all.insert(to.all.end(), more.begin(), more.end());
  });
}

size_t tangency_ellipses_count(const tangency_ellipses* ellipses) {
  return ellipses == nullptr ? 0 : ellipses->all.size();
}

void tangency_ellipses_destroy(tangency_ellipses* ellipses) { delete ellipses; }

}  // extern "C"
