// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/corpus/formats.hpp>

#include <array>
#include <cstddef>
#include <optional>

#include <tangency/verify/corpus/cells.hpp>
#include <tangency/verify/corpus/primitive_truth.hpp>
#include <tangency/verify/corpus/truth.hpp>

namespace tangency::inline v0::verify {
namespace {

// normals, nx, ny, nz, ax, ay, az.
std::string normal_cells(const TrueNormals& n) {
  using Set = TrueNormals::Set;
  const std::string set = n.set == Set::point    ? "point,"
                          : n.set == Set::circle ? "circle,"
                                                 : "all,";
  return set + (n.set == Set::all ? ",," : components(n.normal)) + ',' +
         (n.set == Set::circle ? components(n.axis) : ",,");
}

// `unit`: of the size.
TruthLines pair_lines(const std::optional<PairTruth>& truth, double unit) {
  if (!truth) return {};
  const std::string head = relation_cells(truth->relation) + ',' + rounded_hex(unit * truth->size) +
                           ',' + decimal(truth->gap) + ',';
  std::string tail = ",,,,,,";
  if (const auto& pw = truth->perram_wertheim) {
    const bool touch = truth->relation.relation == Relation::external_touch;
    const auto number = [&](const Real& v) { return touch ? "0" : decimal(v); };
    tail = ',' + number(pw->tangent_planes.gap) + ',' + components(pw->tangent_planes.normal) +
           ',' + (pw->midpoint ? number(pw->midpoint->gap) : "") + ',' + number(pw->centre_line);
  }
  TruthLines lines;
  for (const TrueNormals& n : truth->normals) lines.push_back(head + normal_cells(n) + tail);
  return lines;
}

}  // namespace

std::string relation_cells(const ExactRelation& exact) {
  std::string cells(name(exact.relation));
  cells += exact.inner == Inner::a ? ",a" : exact.inner == Inner::b ? ",b" : ",";
  return cells;
}

void append_body(std::string& line, const RawEllipsoid& body) {
  append_hex(line, body.centre);
  append_hex(line, body.semi_axes);
  append_hex(line, body.orientation);
}

std::string PairFormat::input(const EllipsoidPair& pair) {
  std::string line;
  append_body(line, pair.a);
  append_body(line, pair.b);
  return line;
}

TruthLines PairFormat::lines(const EllipsoidPair& pair) { return pair_lines(pair_truth(pair), 1); }

TruthLines FloatFormat::lines(const EllipsoidPair& pair) {
  return pair_lines(pair_truth(pair), 0x1p-24);
}

std::string MatrixFormat::input(const MatrixPair& pair) {
  std::string line;
  for (const RawShapeMatrix* body : {&pair.a, &pair.b})
    append_hex(line, body->centre), append_hex(line, body->entries);
  return line;
}

TruthLines MatrixFormat::lines(const MatrixPair& pair) { return pair_lines(pair_truth(pair), 1); }

std::string EllipseFormat::input(const EllipsePair& pair) {
  std::string line;
  for (const RawEllipse* e : {&pair.a, &pair.b})
    append_hex(line, e->centre), append_hex(line, e->semi_axes), append_hex(line, e->direction);
  return line;
}

TruthLines EllipseFormat::lines(const EllipsePair& pair) {
  const EllipsePairTruth truth = ellipse_truth(pair);
  const std::string head = relation_cells(truth.relation) + ',' +
                           (truth.crossings < 0 ? "" : std::to_string(truth.crossings)) + ',' +
                           rounded_hex(truth.size) + ',' + rounded_hex(truth.area) + ',' +
                           rounded_hex(truth.smaller_area) + ',' + decimal(truth.gap.gap);
  if (truth.gap.every_normal) return {head + ",all,,"};
  TruthLines lines;
  for (const auto& [x, y] : truth.gap.normals) {
    lines.push_back(head + ",point," + component(x) + ',' + component(y));
  }
  return lines;
}

std::string QuadricFormat::input(const RawQuadric& q) {
  std::string line;
  append_hex(line, std::array{q.A, q.B, q.C, q.D, q.E, q.F, q.G, q.H, q.J, q.K});
  return line;
}

TruthLines QuadricFormat::lines(const RawQuadric& q) {
  return {std::string(name(classify(q).type))};
}

std::string PointFormat::input(const BodyAndPoint& question) {
  std::string line;
  append_body(line, question.body);
  append_hex(line, question.point);
  return line;
}

TruthLines PointFormat::lines(const BodyAndPoint& question) {
  const PointTruth truth = point_truth(question);
  const std::string head = rounded_hex(truth.size) + ',' + decimal(truth.gap) + ',';
  TruthLines lines;
  for (const TrueNormals& n : truth.normals) lines.push_back(head + normal_cells(n));
  return lines;
}

std::string WallFormat::input(const BodyAndWall& question) {
  std::string line;
  append_body(line, question.body);
  append_hex(line, question.normal);
  append_hex(line, std::array{question.offset});
  return line;
}

TruthLines WallFormat::lines(const BodyAndWall& question) {
  const WallRowTruth truth = wall_truth(question);
  return {relation_cells(truth.relation) + ',' + rounded_hex(truth.size) + ',' +
          decimal(truth.gap) + ',' +
          normal_cells({TrueNormals::Set::point, truth.normal, truth.normal})};
}

std::string RayFormat::input(const BodyAndRay& question) {
  std::string line;
  append_body(line, question.body);
  append_hex(line, question.origin);
  append_hex(line, question.direction);
  return line;
}

TruthLines RayFormat::lines(const BodyAndRay& question) {
  const RayTruth truth = ray_truth(question);
  std::string line = rounded_hex(truth.size) + ',' + std::string(truth.result);
  for (std::size_t k = 0; k < 2; ++k)
    line += ',' + (k < truth.at.size() ? decimal(truth.at[k]) : "");
  return {line};
}

std::string TimeFormat::input(const MovingPair& question) {
  std::string line;
  for (const MovingBody* body : {&question.a, &question.b}) {
    append_body(line, body->body);
    append_hex(line, body->motion.velocity);
    append_hex(line, body->motion.angular_velocity);
  }
  append_hex(line, std::array{question.horizon, question.tolerance});
  return line;
}

TruthLines TimeFormat::lines(const MovingPair& question) {
  const auto truth = time_truth(question);
  if (!truth) return {};
  std::string line = hex(question.tolerance) + ',' + std::string(truth->status);
  for (std::size_t k = 0; k < 2; ++k)
    line += ',' + (truth->contact ? decimal((*truth->contact)[k]) : "");
  return {line};
}

}  // namespace tangency::inline v0::verify
