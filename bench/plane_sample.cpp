// SPDX-License-Identifier: GPL-3.0-or-later
// Depths of the contacts of dense plane samples by three definitions, beside the comparison that
// was published for one such sample [Ouadfel1998, section 4.4.2]:
//     plane_sample tests/data/plane_samples
//   chord   the plane scheme: a quartic, the chord of the two crossings (ellipse_crossings.hpp);
//   trace   the scheme of curves (trace_contact.hpp) on prolate spheroids with the same sections,
//           of the two bodies that of the lower row as A; in double, and as the thesis seems to
//           have run it: in single precision, with the frame as stored;
//   gap     the common normal: the signed gap of the ellipses;
//   first order   what the chord should give to first order: docs/derivations/plane-chord.md.
// Differences are relative to the second named, |x - y| / y; their mean is the published measure
// (eq. 4.10), there below 0.41 % for trace against chord over 2794 contacts.
// Exit status 2: a sample that cannot be read, or that has not the contacts its index row says.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include <tangency/geometry/ellipse_crossings.hpp>
#include <tangency/geometry/ellipse_gap.hpp>
#include <tangency/geometry/tables/command_line.hpp>
#include <tangency/geometry/tables/csv.hpp>
#include <tangency/geometry/trace/scheme.hpp>
#include <tangency/geometry/trace_contact.hpp>

namespace {

using namespace tangency;

struct Sample {
  std::string name;
  Vec2 cell;
  std::size_t contacts;  ///< as its index row says
  double mean_depth;     ///< alike, over the mean radius
  std::vector<Ellipse> bodies;

  double radius() const { return std::sqrt(bodies.front().semi_axes().prod()); }
};

std::vector<Ellipse> read_bodies(const std::string& file) {
  tables::Reader reader(file);
  const tables::Header& header = reader.header();
  std::vector<tables::Column> columns;
  for (const char* name : {"x", "y", "a", "b", "ux", "uy"}) columns.push_back(header.require(name));
  std::vector<Ellipse> bodies;
  tables::for_each_row(reader, [&](const tables::RowCursor& row) {
    const auto pair = [&](std::size_t k) {
      return Vec2(row.number(columns[k]), row.number(columns[k + 1]));
    };
    bodies.emplace_back(pair(0), pair(2), pair(4));
  });
  return bodies;
}

std::vector<Sample> read_samples(const std::string& directory) {
  tables::Reader reader(directory + "/samples.csv");
  const tables::Header& header = reader.header();
  const auto name = header.require("sample"), x = header.require("cell_x"),
             y = header.require("cell_y"), contacts = header.require("contacts"),
             depth = header.require("mean_depth");
  std::vector<Sample> samples;
  tables::for_each_row(reader, [&](const tables::RowCursor& row) {
    const std::string stem(row.text(name));
    samples.push_back({stem, Vec2(row.number(x), row.number(y)),
                       static_cast<std::size_t>(row.number(contacts)), row.number(depth),
                       read_bodies(directory + "/" + stem + ".csv")});
  });
  return samples;
}

/// A depth that a scheme did not give is nan.
struct Contact {
  std::size_t a, b;
  double gap, chord, trace, trace_single;
  double first_order;  ///< what the chord gives to first order in depth over radius
};

/// A prolate spheroid with the ellipse as its section z = 0; the centre is not used.
Ellipsoid spheroid_of(const Ellipse& e) {
  const double half = 0.5 * std::atan2(e.direction()[1], e.direction()[0]);
  const Vec3 axes(e.semi_axes()[0], e.semi_axes()[1], e.semi_axes()[1]);
  return Ellipsoid(Vec3::Zero(), axes,
                   Eigen::Quaterniond(std::cos(half), 0.0, 0.0, std::sin(half)));
}

double chord_depth(const Ellipse& a, const Ellipse& b, const Vec2& d) {
  const ChordContact chord = chord_contact(a, b, d);
  return chord.status == ChordStatus::ok ? chord.depth : std::nan("");
}

double trace_depth(const Ellipse& a, const Ellipse& b, const Vec2& d) {
  const TraceContact trace = trace_contact(spheroid_of(a), spheroid_of(b), {d[0], d[1], 0.0});
  return trace.status == TraceStatus::ok ? -trace.gap : std::nan("");
}

double single_trace_depth(const Ellipse& a, const Ellipse& b, const Vec2& d) {
  const auto trace = detail::trace_scheme<float>(
      detail::trace_body<float>(spheroid_of(a)), detail::trace_body<float>(spheroid_of(b)),
      Vec3(d[0], d[1], 0.0).cast<float>(), {.turned_to_the_pair = false});
  return trace.status == TraceStatus::ok ? -static_cast<double>(trace.gap) : std::nan("");
}

/// Curvature of an ellipse where its outer normal is n, and its rate of change along the boundary,
/// counterclockwise: kappa = h^3 / (a b)^2, dphi/ds = kappa.
struct Bend {
  double curvature, change;
};
Bend bend_at(const Ellipse& e, const Vec2& n) {
  const Vec2 u = e.direction().normalized(), axes = e.semi_axes();
  const double along = u.dot(n), across = u[0] * n[1] - u[1] * n[0];
  const double h = std::hypot(axes[0] * along, axes[1] * across);
  const double square = axes[0] * axes[0] * axes[1] * axes[1];
  const double slope = (axes[1] * axes[1] - axes[0] * axes[0]) * along * across / h;  // dh/dphi
  const double curvature = h * h * h / square;
  return {curvature, 3.0 * h * h * slope / square * curvature};
}

/// docs/derivations/plane-chord.md
double first_order_chord(const Ellipse& a, const Ellipse& b, const PlaneGap& gap) {
  const Bend of_a = bend_at(a, gap.normal), of_b = bend_at(b, -gap.normal);
  const double k = of_a.curvature + of_b.curvature, skew = of_a.change - of_b.change;
  return -gap.gap * (1.0 + skew * skew * gap.gap / (18.0 * k * k * k));
}

/// Every pair of images that overlaps, by brute force. Cells are wider than two particles, so that
/// of a pair one image at most does.
std::vector<Contact> contacts_of(const Sample& sample) {
  std::vector<Contact> contacts;
  for (std::size_t i = 0; i < sample.bodies.size(); ++i)
    for (std::size_t j = i + 1; j < sample.bodies.size(); ++j) {
      const Ellipse &a = sample.bodies[i], &b = sample.bodies[j];
      Vec2 d = b.centre() - a.centre();
      d.array() -= sample.cell.array() * (d.array() / sample.cell.array()).round();
      if (d.norm() >= a.largest_semi_axis() + b.largest_semi_axis()) continue;
      const PlaneGap gap = signed_gap(a, b, d);
      if (gap.gap >= 0.0) continue;
      contacts.push_back({i, j, -gap.gap, chord_depth(a, b, d), trace_depth(a, b, d),
                          single_trace_depth(a, b, d), first_order_chord(a, b, gap)});
    }
  return contacts;
}

/// One comparison: which depth against which.
struct Difference {
  const char* name;
  double Contact::*of;
  double Contact::*against;

  double operator()(const Contact& c) const { return std::abs(c.*of / (c.*against) - 1.0); }
};
constexpr Difference kDifferences[] = {
    {"trace, chord", &Contact::trace, &Contact::chord},
    {"single trace, chord", &Contact::trace_single, &Contact::chord},
    {"chord, gap", &Contact::chord, &Contact::gap},
    {"trace, gap", &Contact::trace, &Contact::gap},
    {"first order, gap", &Contact::first_order, &Contact::gap},
    {"chord, first order", &Contact::chord, &Contact::first_order},
};

/// Over the contacts where both have an answer, ascending.
std::vector<double> values_of(const std::vector<Contact>& contacts, const Difference& difference) {
  std::vector<double> values;
  for (const Contact& c : contacts)
    if (const double value = difference(c); !std::isnan(value)) values.push_back(value);
  std::sort(values.begin(), values.end());
  return values;
}

double quantile(const std::vector<double>& ascending, double part) {
  if (ascending.empty()) return std::nan("");
  return ascending[static_cast<std::size_t>(part * static_cast<double>(ascending.size() - 1))];
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// Slope of log y over log x by least squares; pairs with a 0 are left out.
double exponent(const std::vector<double>& x, const std::vector<double>& y) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!(x[i] > 0.0 && y[i] > 0.0)) continue;
    const double p = std::log(x[i]), q = std::log(y[i]);
    n += 1, sx += p, sy += q, sxx += p * p, sxy += p * q;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

double mean_gap(const std::vector<Contact>& contacts) {
  double sum = 0.0;
  for (const Contact& c : contacts) sum += c.gap;
  return sum / static_cast<double>(contacts.size());
}

/// Does the sample hold what its index row says? The simulator's own sums go over the list's order.
void check(const Sample& sample, const std::vector<Contact>& contacts) {
  const double depth = mean_gap(contacts) / sample.radius();
  if (contacts.size() == sample.contacts && std::abs(depth / sample.mean_depth - 1.0) < 1e-9)
    return;
  throw std::runtime_error(sample.name + ": " + std::to_string(contacts.size()) +
                           " contacts of mean depth " + std::to_string(depth) + ", not the " +
                           std::to_string(sample.contacts) + " of " +
                           std::to_string(sample.mean_depth) + " in samples.csv");
}

void print_sample(const Sample& sample, const std::vector<Contact>& contacts) {
  const double n = static_cast<double>(contacts.size());
  std::printf(
      "\n%s: %zu ellipses, %zu contacts, %.3f a particle, mean depth %.4f %% of the mean "
      "radius\n",
      sample.name.c_str(), sample.bodies.size(), contacts.size(),
      n / static_cast<double>(sample.bodies.size()), 100.0 * mean_gap(contacts) / sample.radius());
  std::printf("  %-20s %8s %8s %10s %10s %10s %10s %10s\n", "relative difference", "rows",
              "no ans.", "mean", "median", "90 %", "99 %", "largest");
  for (const Difference& difference : kDifferences) {
    const std::vector<double> values = values_of(contacts, difference);
    std::printf("  %-20s %8zu %7.2f%% %10.2e %10.2e %10.2e %10.2e %10.2e\n", difference.name,
                values.size(), 100.0 * (1.0 - static_cast<double>(values.size()) / n), mean(values),
                quantile(values, 0.5), quantile(values, 0.9), quantile(values, 0.99),
                quantile(values, 1.0));
  }
}

void print_rows(const std::vector<Contact>& contacts) {
  std::printf("  %6s %6s %18s %18s %18s %18s\n", "body", "body", "chord", "trace", "single trace",
              "gap");
  for (const Contact& c : contacts)
    std::printf("  %6zu %6zu %18.10e %18.10e %18.10e %18.10e\n", c.a, c.b, c.chord, c.trace,
                c.trace_single, c.gap);
}

void print_worst(std::vector<Contact> contacts) {
  const Difference& difference = kDifferences[0];
  std::erase_if(contacts, [&](const Contact& c) { return std::isnan(difference(c)); });
  std::sort(contacts.begin(), contacts.end(),
            [&](const Contact& p, const Contact& q) { return difference(p) > difference(q); });
  contacts.resize(std::min<std::size_t>(contacts.size(), 5));
  std::printf("  worst by %s:\n", difference.name);
  print_rows(contacts);
}

/// The contacts among a particle and those that it touches.
std::vector<Contact> cluster_around(std::size_t centre, const std::vector<Contact>& contacts) {
  std::vector<std::size_t> members{centre};
  for (const Contact& c : contacts)
    if (c.a == centre || c.b == centre) members.push_back(c.a == centre ? c.b : c.a);
  const auto is_member = [&](std::size_t i) {
    return std::find(members.begin(), members.end(), i) != members.end();
  };
  std::vector<Contact> cluster;
  for (const Contact& c : contacts)
    if (is_member(c.a) && is_member(c.b)) cluster.push_back(c);
  return cluster;
}

/// The first cluster of as many contacts as the published table has.
void print_cluster(const Sample& sample, const std::vector<Contact>& contacts) {
  constexpr std::size_t published_rows = 14;
  for (std::size_t centre = 0; centre < sample.bodies.size(); ++centre) {
    const std::vector<Contact> cluster = cluster_around(centre, contacts);
    if (cluster.size() != published_rows) continue;
    std::printf("  contacts among particle %zu and those that it touches:\n", centre);
    print_rows(cluster);
    return;
  }
}

/// Over all samples: each contact's difference against its depth over the mean radius.
void print_exponents(const std::vector<Sample>& samples,
                     const std::vector<std::vector<Contact>>& contacts) {
  std::printf("\nexponent of the relative difference in depth / mean radius\n  %-20s %12s %12s\n",
              "", "of medians", "all contacts");
  for (const Difference& difference : kDifferences) {
    std::vector<double> x, y, depth, median;
    for (std::size_t k = 0; k < samples.size(); ++k) {
      for (const Contact& c : contacts[k]) {
        if (std::isnan(difference(c))) continue;
        x.push_back(c.gap / samples[k].radius());
        y.push_back(difference(c));
      }
      depth.push_back(mean_gap(contacts[k]) / samples[k].radius());
      median.push_back(quantile(values_of(contacts[k], difference), 0.5));
    }
    std::printf("  %-20s %12.3f %12.3f\n", difference.name, exponent(depth, median),
                exponent(x, y));
  }
}

void print_all(const std::string& directory) {
  const std::vector<Sample> samples = read_samples(directory);
  std::vector<std::vector<Contact>> contacts;
  for (const Sample& sample : samples) {
    contacts.push_back(contacts_of(sample));
    check(sample, contacts.back());
    print_sample(sample, contacts.back());
    print_worst(contacts.back());
    print_cluster(sample, contacts.back());
  }
  print_exponents(samples, contacts);
}

}  // namespace

int main(int argc, char** argv) {
  tangency::tables::Program program("plane_sample", "Overlaps of a plane sample by definition");
  std::string directory;
  program.option("DIR", directory, "Directory with samples.csv in it").required();
  program.runs([&] {
    print_all(directory);
    return 0;
  });
  return program.run(argc, argv);
}
