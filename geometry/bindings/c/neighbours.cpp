// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <tangency/geometry/bindings/c/ask.hpp>
#include <tangency/geometry/neighbours.hpp>
#include <tangency/geometry/tables/number_text.hpp>

struct tangency_neighbours {
  tangency::Neighbours list;
  std::vector<unsigned> pairs;
  std::vector<int> images;
};

namespace tangency::inline v0::c {
namespace {

constexpr std::array<const char*, 3> kEdge{"x", "y", "z"};

Lattice lattice_of(const tangency_neighbour_question& question) {
  if (question.edges == nullptr) return Lattice::open();
  require_finite_rows("question.edges", question.edges, 3, 3, kEdge.data());
  Lattice lattice;
  for (int i = 0; i < 3; ++i) {
    lattice.edges.col(i) = vectors(question.edges)[i];
    const auto axis = static_cast<std::size_t>(i);
    lattice.periodic[axis] = question.periodic == nullptr || question.periodic[axis] != 0;
  }
  return lattice;
}

/// The list; where the kernel refuses edges their numbers are told.
Neighbours neighbours_of(const tangency_bodies& bodies, const NeighbourQuestion& asked) {
  try {
    return bodies.by_matrices() ? neighbours(bodies.matrices(), asked)
                                : neighbours(bodies.moving(), asked);
  } catch (const std::invalid_argument& refused) {
    constexpr std::string_view kEdges = "edges: ";
    const std::string_view text = refused.what();
    if (!text.starts_with(kEdges)) throw;
    std::string edges = "question.edges =";
    for (const double x : asked.lattice.edges.reshaped()) edges += " " + tables::to_text(x);
    refuse(edges, text.substr(kEdges.size()));
  }
}

NeighbourQuestion question_of(const tangency_neighbour_question* given,
                              const tangency_accuracy* accuracy, int threads) {
  const tangency_neighbour_question question = known(given, "question");
  if (question.answers < TANGENCY_NEIGHBOUR_ANSWERS_PAIRS ||
      question.answers > TANGENCY_NEIGHBOUR_ANSWERS_CONTACTS) {
    refuse_value("question.answers", question.answers, "must be a tangency_neighbour_answers");
  }
  if (question.reserved != 0) refuse_value("question.reserved", question.reserved, "must be 0");
  return {question.reach, lattice_of(question), static_cast<NeighbourAnswers>(question.answers),
          accuracy_of(accuracy), threads};
}

/// The first number of a column, or null where it is empty.
template <class Number, class Element>
const Number* first_of(const std::vector<Element>& column) {
  return column.empty() ? nullptr : reinterpret_cast<const Number*>(column.data());
}

tangency_neighbour_columns columns_of(const tangency_neighbours& from) {
  return {.size = sizeof(tangency_neighbour_columns),
          .pairs = first_of<unsigned>(from.pairs),
          .images = first_of<int>(from.images),
          .overlaps = first_of<unsigned char>(from.list.overlaps),
          .gap = first_of<double>(from.list.gap),
          .gap_error = first_of<double>(from.list.gap_error),
          .status = first_of<int>(from.list.status),
          .normal = first_of<double>(from.list.normal),
          .arm_a = first_of<double>(from.list.arm_a),
          .arm_b = first_of<double>(from.list.arm_b),
          .separation = first_of<double>(from.list.separation)};
}

}  // namespace
}  // namespace tangency::inline v0::c

using namespace tangency;     // NOLINT(google-build-using-namespace): this file is the border
using namespace tangency::c;  // NOLINT(google-build-using-namespace)

extern "C" {

int tangency_neighbours_create(tangency_neighbours** neighbours, const tangency_bodies* bodies,
                               const tangency_neighbour_question* question,
                               const tangency_accuracy* accuracy, int threads) {
  return guarded([&] {
    if (neighbours == nullptr) refuse("neighbours", "must not be NULL");
    *neighbours = nullptr;
    const NeighbourQuestion asked = question_of(question, accuracy, threads);
    auto made = std::make_unique<tangency_neighbours>();
    if (required(bodies).size() > 0) made->list = neighbours_of(*bodies, asked);
    made->pairs.reserve(2 * made->list.size());
    made->images.reserve(3 * made->list.size());
    for (const NearPair& pair : made->list.pairs) {
      made->pairs.insert(made->pairs.end(), {pair.a, pair.b});
      made->images.insert(made->images.end(), pair.image.begin(), pair.image.end());
    }
    *neighbours = made.release();
  });
}

size_t tangency_neighbours_count(const tangency_neighbours* neighbours) {
  return neighbours == nullptr ? 0 : neighbours->list.size();
}

int tangency_neighbours_columns(const tangency_neighbours* neighbours,
                                tangency_neighbour_columns* columns) {
  return guarded([&] {
    if (neighbours == nullptr) refuse("neighbours", "must not be NULL");
    if (columns == nullptr) refuse("columns", "must not be NULL");
    const std::size_t size = columns->size;
    require_size("columns", size);
    tangency_neighbour_columns all = columns_of(*neighbours);
    all.size = size;
    // What a longer struct of a later version has behind these is not answered.
    std::memset(columns, 0, size);
    std::memcpy(columns, &all, std::min(size, sizeof all));
  });
}

void tangency_neighbours_destroy(tangency_neighbours* neighbours) { delete neighbours; }

}  // extern "C"
