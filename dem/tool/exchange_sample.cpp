// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/exchange_sample.hpp>

#include <Eigen/QR>

#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>

#include <tangency/dem/saved/state_file.hpp>
#include <tangency/geometry/tables/csv.hpp>
#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::dem {
namespace {

/// kg/m^3: that of scenes which give none.
constexpr double kUsualDensity = 1000.0;

bool is_triangular(const Mat3& edges) {
  return edges.isUpperTriangular(0.0) && (edges.diagonal().array() > 0.0).all();
}

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

}  // namespace

void Sample::add(std::int32_t of_type, const Vec3& centre, const Vec3& radii) {
  type.push_back(of_type);
  position.push_back(centre);
  semi_axes.push_back(radii);
  velocity.push_back(Vec3::Zero());
  angular_velocity.push_back(Vec3::Zero());
  orientation.push_back(Quaternion::Identity());
  density.push_back(kUsualDensity);
}

Sample sample_of(const State& state, const std::vector<std::string>& type_names) {
  const Particles& from = state.particles;
  if (from.dimensions != 3)
    throw StateError(
        "a plane state: only states in space are exported; its tables are written by "
        "tangency-dem particles");
  Sample sample;
  sample.edges = state.cell.edges;
  for (std::size_t axis = 0; axis < 3; ++axis) sample.periodic[axis] = !state.cell.walled[axis];
  sample.cycle = state.cycle;
  sample.time = state.time;
  sample.type_names = type_names;
  for (const std::uint32_t i : from.index_of_id()) {
    sample.add(from.type[i], from.position[i], from.semi_axes[i]);
    sample.velocity.back() = from.velocity[i];
    sample.angular_velocity.back() = from.angular_velocity[i];
    sample.orientation.back() = from.orientation[i];
    sample.density.back() = from.mass[i] / volume_of(from.semi_axes[i]);
    while (sample.type_names.size() <= static_cast<std::size_t>(from.type[i]))
      sample.type_names.push_back(tables::to_text(sample.type_names.size() + 1));
  }
  return sample;
}

Sample with_triangular_cell(Sample sample) {
  if (is_triangular(sample.edges)) return sample;
  const Eigen::HouseholderQR<Mat3> factors(sample.edges);
  Mat3 turn = factors.householderQ();
  Mat3 edges = factors.matrixQR().triangularView<Eigen::Upper>();
  for (Eigen::Index k = 0; k < 3; ++k)
    if (edges(k, k) < 0.0) {
      edges.row(k) = -edges.row(k).eval();
      turn.col(k) = -turn.col(k).eval();
    }
  sample.edges = edges;
  const Mat3 back = turn.transpose();
  const Quaternion quaternion(back);
  for (std::size_t i = 0; i < sample.size(); ++i) {
    for (Vec3* v : {&sample.position[i], &sample.velocity[i], &sample.angular_velocity[i]})
      *v = (back * *v).eval();
    sample.orientation[i] = (quaternion * sample.orientation[i]).normalized();
  }
  return sample;
}

Vec3 wrapped_into(const Mat3& edges, const std::array<bool, 3>& periodic, const Vec3& x,
                  std::array<std::int32_t, 3>& image) {
  const Vec3 reduced = edges.triangularView<Eigen::Upper>().solve(x);
  Vec3 inside = x;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<Eigen::Index>(axis);
    image[axis] = periodic[axis] ? static_cast<std::int32_t>(std::floor(reduced[k])) : 0;
    inside -= image[axis] * edges.col(k);
  }
  return inside;
}

bool LineReader::next() {
  if (rest_.empty()) return false;
  const std::size_t end = rest_.find('\n');
  line_ = rest_.substr(0, end);
  rest_ = end == rest_.npos ? std::string_view() : rest_.substr(end + 1);
  ++number_;
  words_.clear();
  for (std::size_t at = 0; at < line_.size();) {
    while (at < line_.size() && is_blank(line_[at])) ++at;
    const std::size_t start = at;
    while (at < line_.size() && !is_blank(line_[at])) ++at;
    if (at > start) words_.push_back(line_.substr(start, at - start));
  }
  return true;
}

void LineReader::fail(std::string_view name, std::string_view value, std::string rule) const {
  throw tables::Error({.file = file_,
                       .line = number_,
                       .column = std::string(name),
                       .value = std::string(value),
                       .rule = std::move(rule)});
}

void LineReader::require_words(std::size_t count, std::string_view what) const {
  if (words_.size() < count)
    fail(what, line_,
         "at least " + tables::to_text(count) + " values, and here are " +
             tables::to_text(words_.size()));
}

double LineReader::number(std::size_t word, std::string_view name) const {
  require_words(word + 1, name);
  double value = 0.0;
  if (const auto rule = tables::parse_number(words_[word], value))
    fail(name, words_[word], std::string(*rule));
  return value;
}

double LineReader::positive(std::size_t word, std::string_view name) const {
  const double value = number(word, name);
  if (!(value > 0.0)) fail(name, words_[word], "a number > 0");
  return value;
}

std::int64_t LineReader::integer(std::size_t word, std::string_view name) const {
  require_words(word + 1, name);
  const std::string_view text = words_[word];
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) fail(name, text, "an integer");
  return value;
}

}  // namespace tangency::inline v0::dem
