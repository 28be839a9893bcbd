// SPDX-License-Identifier: GPL-3.0-or-later
/// The interface in C: any numbers, any enumerators, any sizes of structs, with pointers to memory
/// that is as large as the header says and no larger.
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <tangency/geometry/bindings/c/tangency.h>
#include <tangency/tests/fuzz/mutate.hpp>
#include <tangency/tests/fuzz/target.hpp>

namespace tangency::testing::fuzz {
namespace {

/// Choices and numbers, from the bytes of an input and zeros behind them.
class Source {
 public:
  explicit Source(Bytes input) : rest_(input) {}

  std::uint8_t byte() {
    if (rest_.empty()) return 0;
    const std::uint8_t first = rest_[0];
    rest_ = rest_.subspan(1);
    return first;
  }
  std::size_t below(std::size_t limit) { return byte() % limit; }
  bool rarely() { return byte() > 240; }

  /// Most are tame: eighths from -16 to 16.
  double number() {
    const std::uint8_t first = byte();
    if (first < 250) return (first - 125) / 8.0;
    std::uint64_t bits = 0;
    for (int k = 0; k < 8; ++k) bits = bits << 8 | byte();
    return std::bit_cast<double>(bits);
  }
  /// An enumerator, or seldom none.
  int choice(int members) {
    return rarely() ? static_cast<int>(byte()) - 128
                    : static_cast<int>(below(static_cast<std::size_t>(members)));
  }
  std::vector<double> numbers(std::size_t count) {
    std::vector<double> list(count);
    for (double& x : list) x = number();
    return list;
  }

 private:
  Bytes rest_;
};

/// A struct of columns, each asked for or not, with memory for `count` rows and no more.
/// @tparam Struct  a size, and pointers behind it
template <class Struct>
class Columns {
 public:
  /// @param widths  a letter and a digit a column: d or i, and how many of them a row has; of more
  ///                than nine the letter D, of rows of 18, H, of 324, or E, of 6
  Columns(Source& source, std::size_t count, std::string_view widths) {
    static_assert(std::is_trivially_copyable_v<Struct>);
    const std::size_t fields = sizeof(Struct) / sizeof(void*) - 1;
    require(widths.size() == 2 * fields, "c", "widths of a struct");
    std::vector<void*> pointers(fields, nullptr);
    for (std::size_t k = 0; k < fields; ++k) {
      const std::size_t width = static_cast<std::size_t>(widths[2 * k + 1] - '0');
      const std::size_t bytes = widths[2 * k] == 'i'   ? sizeof(int) * width
                                : widths[2 * k] == 'D' ? sizeof(double) * 18
                                : widths[2 * k] == 'H' ? sizeof(double) * 324
                                                       : sizeof(double) * width;
      if (source.byte() % 4 == 0) continue;
      memory_.push_back(std::make_unique<std::byte[]>(count * bytes));
      pointers[k] = memory_.back().get();
    }
    // A version that knows fewer fields has a shorter struct, and seldom one of no version.
    std::size_t size = sizeof(Struct);
    if (source.rarely()) size = sizeof(std::size_t) * (1 + source.below(fields + 1));
    const std::size_t whole = std::max(size, sizeof(std::size_t));
    bytes_ = std::make_unique<std::byte[]>(whole);
    std::memcpy(bytes_.get(), &size, sizeof size);
    std::memcpy(bytes_.get() + sizeof size, pointers.data(), whole - sizeof size);
  }

  const Struct* get() const { return reinterpret_cast<const Struct*>(bytes_.get()); }

 private:
  std::vector<std::unique_ptr<std::byte[]>> memory_;
  std::unique_ptr<std::byte[]> bytes_;
};

/// What a call returned, and what it says of it.
void hold(int code) {
  require(code >= TANGENCY_OK && code <= TANGENCY_OUT_OF_MEMORY, "c",
          std::string("code ") + std::to_string(code) + ": " + tangency_error_message());
  if (code == TANGENCY_OK) return count("answered");
  const std::string message = tangency_error_message();
  require(!message.empty() && message.find('\n') == std::string::npos, "c", "message: " + message);
  require((tangency_error_row() == SIZE_MAX) == (code != TANGENCY_BAD_ROW), "c",
          "error_row: " + message);
  count("refused");
}

constexpr std::array<std::size_t, 5> kWidths{10, 9, 9, 12, 10}, kPlaneWidths{6, 5, 5, 5, 6};

/// Rows of numbers in either type, and from one to the next.
class Rows {
 public:
  Rows(Source& source, std::size_t width, std::size_t count) : number_(source.choice(2)) {
    const std::vector<double> numbers = source.numbers(width * count);
    doubles_ = std::make_unique<double[]>(numbers.size());
    std::ranges::copy(numbers, doubles_.get());
    floats_ = std::make_unique<float[]>(numbers.size());
    std::ranges::transform(numbers, floats_.get(), [](double x) { return static_cast<float>(x); });
    const std::size_t size = number_ == TANGENCY_NUMBER_FLOAT ? sizeof(float) : sizeof(double);
    stride_ = static_cast<std::ptrdiff_t>(width * size);
    if (count == 0 || source.below(4) != 0) return;
    // Backwards, from the last row.
    backwards_ = (count - 1) * width * size;
    stride_ = -stride_;
  }

  const void* get() const {
    const void* first =
        number_ == TANGENCY_NUMBER_FLOAT ? static_cast<const void*>(floats_.get()) : doubles_.get();
    return static_cast<const std::byte*>(first) + backwards_;
  }
  int number() const { return number_; }
  std::ptrdiff_t stride() const { return stride_; }

 private:
  int number_;
  std::unique_ptr<double[]> doubles_;
  std::unique_ptr<float[]> floats_;
  std::size_t backwards_ = 0;
  std::ptrdiff_t stride_ = 0;
};

std::size_t width_of(const std::array<std::size_t, 5>& widths, int form) {
  return form >= 0 && form < static_cast<int>(widths.size())
             ? widths[static_cast<std::size_t>(form)]
             : std::ranges::max(widths);
}

struct DestroyBodies {
  void operator()(tangency_bodies* bodies) const { tangency_bodies_destroy(bodies); }
};
struct DestroyEllipses {
  void operator()(tangency_ellipses* ellipses) const { tangency_ellipses_destroy(ellipses); }
};
struct DestroyNeighbours {
  void operator()(tangency_neighbours* list) const { tangency_neighbours_destroy(list); }
};

double level_of(Source& source) { return source.rarely() ? source.number() : 1.0; }

/// One session: bodies are made, and asked about.
class Session {
 public:
  explicit Session(Bytes input) : source_(input) {}

  void run() {
    if (source_.byte() % 4 == 3) return plane();
    make_bodies();
    if (!bodies_) return;
    for (int questions = 0; questions < 3; ++questions) ask(source_.below(15));
  }

 private:
  void make_bodies() {
    const int form = source_.choice(5);
    const std::size_t count = source_.below(5);
    const Rows rows(source_, width_of(kWidths, form), count);
    tangency_bodies* bodies = nullptr;
    hold(tangency_bodies_create(&bodies, form, rows.get(), rows.number(), count, rows.stride(),
                                level_of(source_)));
    bodies_.reset(bodies);
    if (!bodies_) return;
    require(tangency_bodies_count(bodies) == count, "c", "count");
    if (source_.below(4) != 0) return;
    const std::size_t more = source_.below(3), first = source_.below(4);
    const int other = source_.rarely() ? source_.choice(5) : form;
    const Rows added(source_, width_of(kWidths, other), more);
    hold(tangency_bodies_append(bodies, other, added.get(), added.number(), more, added.stride(),
                                level_of(source_)));
    const Rows set(source_, width_of(kWidths, form), more);
    hold(tangency_bodies_set(bodies, first, set.get(), set.number(), more, set.stride()));
  }

  /// Pairs of bodies that there are, seldom others; or none given: those of k and count + k.
  void draw_pairs(std::size_t things) {
    const std::size_t bodies = tangency_bodies_count(bodies_.get());
    count_ = source_.below(4);
    pairs_.clear();
    if (source_.below(5) == 0) return;
    for (std::size_t k = 0; k < count_; ++k) {
      for (const std::size_t most : {bodies, things}) {
        const std::size_t limit = source_.rarely() || most == 0 ? 256 : most;
        pairs_.push_back(static_cast<unsigned>(source_.below(limit)));
      }
    }
    pairs_.shrink_to_fit();
  }
  const unsigned* pairs() const { return pairs_.empty() ? nullptr : pairs_.data(); }

  /// Rows that may be left out.
  const double* maybe(std::vector<double>& kept, std::size_t width) {
    if (source_.byte() % 3 != 0) return nullptr;
    kept = source_.numbers(width * count_);
    kept.shrink_to_fit();
    return kept.data();
  }

  const tangency_accuracy* accuracy() {
    if (source_.below(3) == 0) return nullptr;
    accuracy_ = {sizeof accuracy_, 0, 0, source_.choice(2), source_.choice(2), 0};
    for (double* x : {&accuracy_.of_size, &accuracy_.length, &accuracy_.cutoff})
      *x = source_.rarely() ? source_.number() : source_.byte() / 1024.0;
    return &accuracy_;
  }

  int threads() { return source_.rarely() ? source_.choice(4) : 1; }

  void ask(std::size_t question) {
    const tangency_bodies* const all = bodies_.get();
    draw_pairs(tangency_bodies_count(all));
    std::vector<double> some, other;
    switch (question) {
      case 0: {
        const Columns<tangency_contact_columns> to(source_, count_, "d1d1d3d3d3i1i1d3d1d1d1");
        const double* apart = maybe(some, 3);
        const double* normals = maybe(other, 3);
        return hold(tangency_contacts(all, pairs(), count_, apart, normals, accuracy(), to.get(),
                                      threads()));
      }
      case 1: {
        const Columns<tangency_bounded_columns> to(source_, count_, "d1d1d3d3d3i1i1d3d1");
        const double* apart = maybe(some, 3);
        return hold(
            tangency_bounded_gaps(all, pairs(), count_, apart, accuracy(), to.get(), threads()));
      }
      case 2: {
        std::vector<unsigned char> to(count_);
        const double* apart = maybe(some, 3);
        const auto call = source_.below(2) == 0 ? tangency_overlaps : tangency_overlaps_by_filter;
        return hold(call(all, pairs(), count_, apart, to.data(), threads()));
      }
      case 3: {
        const Columns<tangency_relation_columns> to(source_, count_, "i1i1i1");
        const double* apart = maybe(some, 3);
        return hold(tangency_relations(all, pairs(), count_, apart, to.get(), threads()));
      }
      case 4: {
        const Columns<tangency_other_gap_columns> to(source_, count_, "d1d1d3d3d3i1");
        const double* apart = maybe(some, 3);
        return hold(tangency_other_gaps(all, pairs(), count_, apart, source_.choice(3), to.get(),
                                        threads()));
      }
      case 5: {
        const Columns<tangency_factor_columns> to(source_, count_, "d1d1d1d1i1");
        const double* apart = maybe(some, 3);
        return hold(
            tangency_perram_wertheim_factors(all, pairs(), count_, apart, to.get(), threads()));
      }
      case 6: {
        const Columns<tangency_derivative_columns> to(source_, count_, "D0H0d1i1");
        std::vector<int> statuses(count_);
        for (int& status : statuses) status = source_.choice(2);
        other = source_.numbers(3 * count_);
        const double* apart = maybe(some, 3);
        return hold(tangency_gap_derivatives(all, pairs(), count_, apart, other.data(),
                                             statuses.data(), to.get(), threads()));
      }
      case 7: {
        const Columns<tangency_curvature_columns> to(source_, count_, "d2d6d2d6d2d6");
        other = source_.numbers(3 * count_);
        return hold(
            tangency_contact_curvatures(all, pairs(), count_, other.data(), to.get(), threads()));
      }
      case 8: {
        const Columns<tangency_volume_columns> to(source_, count_, "d1d1d3d1i1");
        const double* apart = maybe(some, 3);
        const double tolerance = source_.rarely() ? source_.number() : 0x1p-8;
        // What is finer takes as long as it needs.
        if (tolerance > 0 && tolerance < 0x1p-20) return;
        return hold(
            tangency_common_volumes(all, pairs(), count_, apart, tolerance, to.get(), threads()));
      }
      case 9: {
        const Columns<tangency_containment_columns> to(source_, count_, "d1d1d3d3d3i1d1d1");
        const double* apart = maybe(some, 3);
        return hold(tangency_containments(all, pairs(), count_, apart, to.get(), threads()));
      }
      case 10: {
        const Columns<tangency_time_columns> to(source_, count_, "i1d1d1d1d3");
        other = source_.numbers(18 * count_);
        const double* apart = maybe(some, 3);
        const double horizon = source_.rarely() ? source_.number() : 1.0;
        const double tolerance = source_.rarely() ? source_.number() : 0x1p-10;
        return hold(tangency_times_of_contact(all, pairs(), count_, apart, other.data(), horizon,
                                              tolerance, to.get(), threads()));
      }
      case 14:
        return neighbours();
      default:
        return ask_of_others(question);
    }
  }

  /// Walls, points, balls and rays, which have numbers of their own.
  void ask_of_others(std::size_t question) {
    const tangency_bodies* const all = bodies_.get();
    const std::size_t things = source_.below(4);
    draw_pairs(things);
    const auto rows = [&](std::size_t width) {
      std::vector<double> numbers = source_.numbers(width * things);
      numbers.shrink_to_fit();
      return numbers;
    };
    if (question == 11) {
      const std::vector<double> walls = rows(4);
      const Columns<tangency_wall_columns> to(source_, count_, "d1d1d3d3d3i1i1i1");
      return hold(tangency_walls(all, walls.data(), things, source_.choice(2), pairs(), count_,
                                 to.get(), threads()));
    }
    if (question == 12) {
      const std::vector<double> rays = rows(8);
      const Columns<tangency_ray_columns> to(source_, count_, "i1i1d2d6d6");
      return hold(tangency_rays(all, rays.data(), things, pairs(), count_, to.get(), threads()));
    }
    if (source_.below(2) == 0) {
      const std::vector<double> points = rows(3);
      const Columns<tangency_point_columns> to(source_, count_, "d1d1d3d3i1");
      return hold(
          tangency_points(all, points.data(), things, pairs(), count_, to.get(), threads()));
    }
    const std::vector<double> balls = rows(4);
    const Columns<tangency_contact_columns> to(source_, count_, "d1d1d3d3d3i1i1d3d1d1d1");
    hold(tangency_balls(all, balls.data(), things, pairs(), count_, to.get(), threads()));
  }

  // In a cell of tame edges: in one that is thin against its bodies each has as many images as
  // there is memory for.
  void neighbours() {
    std::vector<double> edges(9, 0.0);
    std::vector<int> periodic(3);
    for (std::size_t k = 0; k < 3; ++k) {
      edges[4 * k] = 16.0 + source_.byte();
      edges[(4 * k + 1) % 9] = source_.byte() / 64.0;
      periodic[k] = source_.choice(2);
    }
    tangency_neighbour_question question{};
    question.size = sizeof question;
    question.reach = source_.rarely() ? source_.number() : source_.byte() / 256.0;
    question.edges = source_.below(2) == 0 ? edges.data() : nullptr;
    question.periodic = source_.below(2) == 0 ? periodic.data() : nullptr;
    question.answers = source_.choice(4);
    if (question.reach > 64) return;
    tangency_neighbours* list = nullptr;
    hold(tangency_neighbours_create(&list, bodies_.get(), &question, accuracy(), threads()));
    const std::unique_ptr<tangency_neighbours, DestroyNeighbours> owner(list);
    if (list == nullptr) return;
    tangency_neighbour_columns columns{};
    columns.size = sizeof columns;
    hold(tangency_neighbours_columns(list, &columns));
    for (std::size_t k = 0; k < 2 * tangency_neighbours_count(list); ++k)
      require(columns.pairs[k] < tangency_bodies_count(bodies_.get()), "c", "a neighbour");
  }

  void plane() {
    const int form = source_.choice(5);
    const std::size_t count = source_.below(5);
    const Rows rows(source_, width_of(kPlaneWidths, form), count);
    tangency_ellipses* made = nullptr;
    hold(tangency_ellipses_create(&made, form, rows.get(), rows.number(), count, rows.stride(),
                                  level_of(source_)));
    const std::unique_ptr<tangency_ellipses, DestroyEllipses> ellipses(made);
    if (!ellipses) return;
    count_ = source_.below(4);
    for (std::size_t k = 0; k < 2 * count_; ++k)
      pairs_.push_back(
          static_cast<unsigned>(source_.below(source_.rarely() || count == 0 ? 256 : count)));
    const Columns<tangency_plane_contact_columns> to(source_, count_,
                                                     "i1i1i1d1d1d2d2d2i1d1d8i4i1d1d2d2d1d1d1d1");
    hold(tangency_plane_contacts(made, pairs(), count_, to.get(), threads()));
    const std::size_t things = source_.below(4);
    const std::vector<double> points = source_.numbers(2 * things);
    const Columns<tangency_plane_point_columns> of_points(source_, count_, "d1d1d2d2i1");
    hold(tangency_plane_points(made, points.data(), things, pairs(), count_, of_points.get(),
                               threads()));
    const std::vector<double> coefficients = source_.numbers(10 * count_);
    const Columns<tangency_quadric_columns> types(source_, count_, "i1i1i1i1");
    hold(tangency_classify(coefficients.data(), count_, 80, types.get(), threads()));
  }

  Source source_;
  std::unique_ptr<tangency_bodies, DestroyBodies> bodies_;
  std::size_t count_ = 0;
  std::vector<unsigned> pairs_;
  tangency_accuracy accuracy_{};
};

std::vector<std::string> c_seeds() {
  std::vector<std::string> seeds;
  std::uint64_t state = 1;
  for (int k = 0; k < 32; ++k) {
    std::string& seed = seeds.emplace_back();
    for (int i = 0; i < 200; ++i) seed += static_cast<char>(next(state) % 240);
  }
  return seeds;
}

}  // namespace

std::vector<Target> c_targets() {
  constexpr std::size_t kMostBytes = 512;
  return {{"c", "the interface in C, with any arguments in valid memory", kMostBytes, c_seeds,
           [](Bytes input) { Session(input).run(); }, mutate_bytes}};
}

}  // namespace tangency::testing::fuzz
