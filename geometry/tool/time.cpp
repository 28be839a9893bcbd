// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tangency/geometry/time_of_contact.hpp>
#include <tangency/geometry/tool/body_columns.hpp>
#include <tangency/geometry/tool/columns.hpp>
#include <tangency/geometry/tool/command_line.hpp>

namespace tangency::inline v0::tool {
namespace {

constexpr std::array<std::string_view, 4> kOutputColumns{"row", "status", "time", "latest"};

constexpr const char* kHelp = R"(
of its motion, at constant velocities,
  a.vx a.vy a.vz   of its centre, length per time
  a.wx a.wy a.wz   of its rotation about its centre: in space, radians per time
the same columns with b. for body b, and of the row
  horizon          how far in time is looked, >= 0; or --horizon for all rows
  tolerance        how much earlier than the contact `time` may be, > 0; or --tolerance

Output columns, in this order:
  row              number of the data row, from 0
  status           see below
  time             the bodies are apart before it, and never meet earlier: proven, whatever
                   the status. The horizon where the status is none
  latest           of a contact, the bodies are in contact at some moment from time to
                   latest: proven, and latest is at most time + tolerance but for bodies by
                   matrices, whose rounding may make it later; else the same as time

Status of a row:
  none             apart from 0 to the horizon
  contact          the first contact lies between time and latest
  touching_at_start
                   the bodies have a common point at time 0: exact for the numbers as they
                   are read
  grazing          apart before time, when they are too close for rounding to tell
  not_converged    apart before time; the rest was not looked at
  not_applicable   a way or an angle within the horizon is beyond the range of a double;
                   numbers are empty
  invalid          the row was refused (only with --keep-going); numbers are empty

Exit status: 0 every row is answered; 1 some row is not_converged, not_applicable or
invalid; 2 refused command line or input, or a failed read or write.

Example, a sphere that flies at another, and past it:
  $ cat motions.csv
  a.x,a.y,a.z,a.r1,a.r2,a.r3,a.vx,a.vy,a.vz,a.wx,a.wy,a.wz,b.x,b.y,b.z,b.r1,b.r2,b.r3,b.vx,b.vy,b.vz,b.wx,b.wy,b.wz
  0,0,0,1,1,1,2,0,0,0,0,0,6,0,0,1,1,1,0,0,0,0,0,0
  0,0,0,1,1,1,2,0,0,0,0,0,6,3,0,1,1,1,0,0,0,0,0,0
  $ tangency time --horizon 10 --tolerance 0x1p-20 motions.csv
  row,status,time,latest
  0,contact,1.9999999999999574,2.0000009536742738
  1,none,10,10
)";

struct Options : QuadricOptions {
  std::string horizon, tolerance;
};

/// A number that is a column of the table or the same for all rows.
class TimeColumn {
 public:
  /// @param all_rows  a number that was checked, or nothing
  /// @throws tables::Error  neither is there, or both
  TimeColumn(const tables::Header& header, std::string_view name, const std::string& all_rows)
      : column_(header.find(name)) {
    const std::string rule = std::string(name) + " is a column or --" + std::string(name);
    if (!column_ && all_rows.empty()) throw lacking(header, "header", {std::string(name)}, rule);
    if (column_ && !all_rows.empty())
      throw tables::Error({.file = header.file(),
                           .line = header.line(),
                           .value = "header with " + std::string(name),
                           .rule = rule + ", not both"});
    if (!column_) tables::parse_number(all_rows, all_rows_);
  }

  double read(const tables::RowCursor& row) const {
    return column_ ? row.number(*column_) : all_rows_;
  }
  std::optional<tables::Column> column() const noexcept { return column_; }

 private:
  std::optional<tables::Column> column_;
  double all_rows_ = 0.0;
};

constexpr std::string_view kHorizonRule = "a horizon must be >= 0";
constexpr std::string_view kToleranceRule = "a tolerance must be > 0";

/// Of --horizon and --tolerance.
template <class Allowed>
tables::Check check_number(Allowed allowed, std::string_view rule) {
  return [=](const std::string& text) -> std::string {
    double value = 0.0;
    if (const auto broken = tables::parse_number(text, value))
      return text + ": " + std::string(*broken);
    return allowed(value) ? std::string() : text + ": " + std::string(rule);
  };
}

struct MovingBody {
  MatrixEllipsoid body;
  Motion motion;
};

class MovingBodyColumns {
 public:
  MovingBodyColumns(const tables::Header& header, const std::string& body, MixedTerms mixed_terms)
      : body_(header, body, mixed_terms),
        motion_(header, "body " + body, body + '.', {"vx", "vy", "vz", "wx", "wy", "wz"},
                "a body that moves has the columns vx, vy, vz, wx, wy and wz") {}

  MovingBody read(const tables::RowCursor& row) const {
    const std::array<double, 6> p = motion_.read(row);
    return {body_.read(row), {Vec3(p[0], p[1], p[2]), Vec3(p[3], p[4], p[5]), Vec3::Zero()}};
  }

 private:
  BodyColumns body_;
  NumberColumns<6> motion_;
};

/// Are ways and angles in the range of doubles?
bool is_representable(const Motion& motion, double horizon) {
  return (horizon * motion.velocity).allFinite() && (horizon * motion.angular_velocity).allFinite();
}

std::string_view to_string(ContactTimeStatus status) {
  switch (status) {
    case ContactTimeStatus::none:
      return "none";
    case ContactTimeStatus::contact:
      return "contact";
    case ContactTimeStatus::touching_at_start:
      return "touching_at_start";
    case ContactTimeStatus::grazing:
      return "grazing";
    case ContactTimeStatus::not_converged:
      break;
  }
  return "not_converged";
}

tables::RowOutcome write(const MovingBody& a, const MovingBody& b, double horizon, double tolerance,
                         tables::RowText& out) {
  if (!is_representable(a.motion, horizon) || !is_representable(b.motion, horizon)) {
    out.text("not_applicable");
    out.empty(2);
    return tables::RowOutcome::unanswered;
  }
  const TimeOfContact found =
      time_of_contact(a.body, a.motion, b.body, b.motion, horizon, tolerance);
  out.text(to_string(found.status));
  out.number(found.time);
  out.number(found.latest);
  return found.status == ContactTimeStatus::not_converged ? tables::RowOutcome::unanswered
                                                          : tables::RowOutcome::answered;
}

tables::RowFunction bind(const tables::Header& header, const Options& options) {
  const MixedTerms mixed_terms = mixed_terms_named(options.mixed_terms);
  return [a = MovingBodyColumns(header, "a", mixed_terms),
          b = MovingBodyColumns(header, "b", mixed_terms),
          horizon = TimeColumn(header, "horizon", options.horizon),
          tolerance = TimeColumn(header, "tolerance", options.tolerance)](
             const tables::RowCursor& row, tables::RowText& out) {
    const MovingBody body_a = a.read(row), body_b = b.read(row);
    const double until = horizon.read(row), within = tolerance.read(row);
    if (!(until >= 0.0)) throw row.error(*horizon.column(), kHorizonRule);
    if (!(within > 0.0)) throw row.error(*tolerance.column(), kToleranceRule);
    return write(body_a, body_b, until, within, out);
  };
}

}  // namespace

void add_time(tables::Program& program) {
  const auto describe = [](tables::Command& command, Options& own) {
    command.option("--horizon", own.horizon, "How far in time is looked, where no column says so")
        .check(check_number([](double x) { return x >= 0.0; }, kHorizonRule))
        .type_name("T");
    command
        .option("--tolerance", own.tolerance,
                "How much earlier than the contact `time` may be, where no column says so")
        .check(check_number([](double x) { return x > 0.0; }, kToleranceRule))
        .type_name("T");
  };
  add_row_command<Options>(
      program, {.name = "time",
                .description = "When pairs of moving ellipsoids first touch",
                .help = std::string(kBodyColumnsHelp) + kHelp,
                .describe = describe,
                .task = [](const Options& options) {
                  return row_task(kOutputColumns, "status",
                                  [options](const auto& header) { return bind(header, options); });
                }});
}

}  // namespace tangency::inline v0::tool
