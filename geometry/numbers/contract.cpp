// SPDX-License-Identifier: MIT
#include <tangency/geometry/numbers/contract.hpp>

#include <cstdio>
#include <cstdlib>

namespace tangency::inline v0::contract {

void wrong_length(const char* call, const char* what, std::size_t length,
                  std::size_t pairs) noexcept {
  std::fprintf(stderr, "tangency: %s: %s: %zu entries, and there are %zu pairs\n", call, what,
               length, pairs);
  std::abort();
}

void outside(const char* call, std::size_t pair, char entry, std::size_t index, std::size_t count,
             const char* what) noexcept {
  std::fprintf(stderr, "tangency: %s: pairs[%zu].%c = %zu, and there are %zu %s\n", call, pair,
               entry, index, count, what);
  std::abort();
}

void no_body(const char* call, std::size_t index, std::size_t bodies) noexcept {
  std::fprintf(stderr, "tangency: %s: body %zu, and there are %zu bodies\n", call, index, bodies);
  std::abort();
}

void wrong_range(const char* call, std::size_t first, std::size_t last) noexcept {
  std::fprintf(stderr, "tangency: %s: from body %zu to before body %zu\n", call, first, last);
  std::abort();
}

void wrong_column(const char* call, const char* what, std::size_t length,
                  std::size_t bodies) noexcept {
  std::fprintf(stderr, "tangency: %s: %s: %zu entries, and there are %zu bodies\n", call, what,
               length, bodies);
  std::abort();
}

void no_ellipsoid(const char* call, std::size_t index, const char* why) noexcept {
  std::fprintf(stderr, "tangency: %s: body %zu: %s\n", call, index, why);
  std::abort();
}

void no_floats(const char* call) noexcept {
  std::fprintf(stderr,
               "tangency: %s: accuracy: single precision or a cutoff, and the bodies are looked at "
               "in double alone\n",
               call);
  std::abort();
}

void not_finite(const char* call, const char* what, const Vec3& value) noexcept {
  std::fprintf(stderr, "tangency: %s: %s = (%g, %g, %g): must be finite\n", call, what, value[0],
               value[1], value[2]);
  std::abort();
}

}  // namespace tangency::inline v0::contract
