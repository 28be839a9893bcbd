// SPDX-License-Identifier: MIT
#include <tangency/geometry/bodies/pencil_form.hpp>

#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

#include <tangency/geometry/bodies/exact_quadric_type.hpp>
#include <tangency/geometry/numbers/real_roots.hpp>

namespace tangency::inline v0::exact {
namespace {

using LinearForm = std::array<std::array<IntegerPolynomial, 4>, 4>;
using Indices = std::vector<std::size_t>;

/// A + f B
LinearForm linear_form(const IntegerForm<4>& a, const IntegerForm<4>& b) {
  LinearForm form;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) form[i][j] = IntegerPolynomial({a[i][j], b[i][j]});
  }
  return form;
}

Indices without(const Indices& indices, std::size_t position) {
  Indices rest = indices;
  rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(position));
  return rest;
}

/// Laplace's expansion by the first row.
IntegerPolynomial minor(const LinearForm& form, const Indices& rows, const Indices& columns) {
  if (rows.size() == 1) return form[rows[0]][columns[0]];
  IntegerPolynomial sum;
  for (std::size_t j = 0; j < columns.size(); ++j) {
    const IntegerPolynomial term =
        form[rows[0]][columns[j]] * minor(form, without(rows, 0), without(columns, j));
    if (j % 2 == 0) {
      sum += term;
    } else {
      sum -= term;
    }
  }
  return sum;
}

/// Sum of the principal minors of an order, of the leading block of a size.
IntegerPolynomial invariant(const LinearForm& form, std::size_t size, std::size_t order) {
  IntegerPolynomial sum;
  for (unsigned subset = 1; subset < 1u << size; ++subset) {
    Indices indices;
    for (std::size_t i = 0; i < size; ++i) {
      if ((subset >> i & 1u) != 0) indices.push_back(i);
    }
    if (indices.size() == order) sum += minor(form, indices, indices);
  }
  return sum;
}

/// A root of one invariant or of several.
struct Root {
  RealRoot value;
  std::array<bool, 7> vanishing;
};

/// The real roots of all invariants in one ascending order, equal ones once, their intervals
/// without common inner points.
class Roots {
 public:
  explicit Roots(const PencilInvariants& invariants) {
    sturm_.reserve(invariants.size());  // the roots refer to its elements
    for (std::size_t i = 0; i < invariants.size(); ++i) {
      if (invariants[i].degree() < 1) continue;
      const SturmSequence& sturm = sturm_.emplace_back(invariants[i]);
      for (RealRoot& root : isolate_real_roots(sturm)) insert(std::move(root), i);
    }
  }

  std::vector<Root>& sorted() noexcept { return sorted_; }

 private:
  void insert(RealRoot root, std::size_t invariant) {
    auto position = sorted_.begin();
    int order = 1;
    for (; position != sorted_.end(); ++position) {
      order = compare(root, position->value);
      if (order <= 0) break;
    }
    if (order != 0) {
      position = sorted_.insert(position, {std::move(root), {}});
    } else if (root.is_exact()) {
      position->value = std::move(root);
    }
    position->vanishing[invariant] = true;
  }

  std::vector<SturmSequence> sturm_;
  std::vector<Root> sorted_;
};

std::array<int, 7> signs_at(const PencilInvariants& invariants, const mpq_class& f) {
  std::array<int, 7> signs;
  for (std::size_t i = 0; i < signs.size(); ++i) signs[i] = invariants[i].sign_at(f);
  return signs;
}

/// An invariant that does not vanish at the root has no root inside its interval at all.
std::array<int, 7> signs_at(const PencilInvariants& invariants, const Root& root) {
  std::array<int, 7> signs =
      signs_at(invariants, mpq_class((root.value.low() + root.value.high()) / 2));
  for (std::size_t i = 0; i < signs.size(); ++i) {
    if (root.vanishing[i]) signs[i] = 0;
  }
  return signs;
}

Classification classification_of(const std::array<int, 7>& signs) {
  const std::array<int, 4> sub_discriminant{1, signs[0], signs[1], signs[2]};
  const std::array<int, 5> discriminant{1, signs[3], signs[4], signs[5], signs[6]};
  const Inertia s = inertia_from_signs(sub_discriminant);
  const Inertia q = inertia_from_signs(discriminant);
  return {type_of(q, s), q.rank(), s.rank(), Tier::exact};
}

/// One point strictly inside each of the intervals that the roots leave.
std::vector<mpq_class> samples(std::vector<Root>& roots) {
  if (roots.empty()) return {0};
  const mpq_class &first = roots.front().value.low(), &last = roots.back().value.high();
  std::vector<mpq_class> result{mpq_class(first - abs(first) - 1)};
  for (std::size_t i = 0; i + 1 < roots.size(); ++i) {
    result.push_back(sample_between(roots[i].value, roots[i + 1].value));
  }
  result.push_back(last + abs(last) + 1);
  return result;
}

}  // namespace

PencilInvariants pencil_invariants(const IntegerForm<4>& a, const IntegerForm<4>& b) {
  const LinearForm form = linear_form(a, b);
  return {invariant(form, 3, 1), invariant(form, 3, 2), invariant(form, 3, 3),
          invariant(form, 4, 1), invariant(form, 4, 2), invariant(form, 4, 3),
          invariant(form, 4, 4)};
}

IntegerPolynomial pencil_determinant(const IntegerForm<4>& a, const IntegerForm<4>& b,
                                     std::size_t size) {
  Indices all(size);
  std::iota(all.begin(), all.end(), std::size_t{0});
  return minor(linear_form(a, b), all, all);
}

std::vector<PencilMember> pencil_members(const IntegerForm<4>& a, const IntegerForm<4>& b) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  PencilInvariants invariants = pencil_invariants(a, b);
  // Their contents are many times as long as what is left, and tell nothing.
  for (IntegerPolynomial& invariant : invariants) invariant = invariant.primitive_part();
  Roots all_roots(invariants);
  std::vector<Root>& roots = all_roots.sorted();
  const std::vector<mpq_class> between = samples(roots);

  std::vector<PencilMember> members;
  for (std::size_t i = 0; i < between.size(); ++i) {
    const double low = i == 0 ? -infinity : roots[i - 1].value.below();
    const double high = i == roots.size() ? infinity : roots[i].value.above();
    const auto signs = signs_at(invariants, between[i]);
    members.push_back(
        {false, double_below(between[i]), low, high, signs, classification_of(signs)});
    if (i == roots.size()) break;
    const RealRoot& root = roots[i].value;
    const auto root_signs = signs_at(invariants, roots[i]);
    members.push_back(
        {true, root.nearest(), root.below(), high, root_signs, classification_of(root_signs)});
  }
  return members;
}

}  // namespace tangency::inline v0::exact
