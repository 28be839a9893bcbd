// SPDX-License-Identifier: MIT
/// @file
/// Averages of products of components of unit vectors, over the sphere and over the circle, to any
/// even order [Ouadfel1998, appendix C]. What closed forms of micromechanics are made of.
///
/// <g> is the mean over all directions: (1/4 pi) times the integral over the sphere, or (1/2 pi)
/// times that over the circle. All values are pure numbers. No function here keeps state: any
/// number of threads may call them. Formulas: docs/derivations/micromechanics.md.
#pragma once

#include <span>

#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::micromechanics {

/// The tensor B of order 2m at the given indices: the sum over all (2m - 1)!! pairings of the
/// indices of the product of Kronecker deltas. It has an order, not a number of dimensions: indices
/// are any integers, and indices that occur p, q, ... times give (p - 1)!! (q - 1)!! ..., or 0
/// where one occurs an odd number of times.
/// @return 1 for no index; exact below 2^53
///
/// (1) B_(i1 ... i2m) is the sum over k >= 2 of delta(i1, ik) times B of the other indices
double pairing_sum(std::span<const int> indices);

/// <n_x^p n_y^q n_z^r> over the sphere: (p-1)!! (q-1)!! (r-1)!! / (p+q+r+1)!!, 0 if any is odd.
/// @param p,q,r  exponents, >= 0, else std::invalid_argument
///
/// (2) the averages with p + 2, q + 2 and r + 2 add up to that with p, q, r
double sphere_average(int p, int q, int r);

/// <n_x^p n_y^q> over the circle: (p-1)!! (q-1)!! / (p+q)!!, 0 if any is odd.
/// @param p,q  exponents, >= 0, else std::invalid_argument
double circle_average(int p, int q);

/// <(nAn) nn> over the sphere, of a symmetric, traceless A: (2/15) A.
Mat3 average_with(const Mat3& a);
/// <(nAn)(nBn) nn>, A and B symmetric and traceless: (1/105)(2 (A:B) I + 4 (AB + BA)).
Mat3 average_with(const Mat3& a, const Mat3& b);
/// <(nAn)(nBn)(nCn) nn>, all three symmetric and traceless: (1/945)(8 tr(ABC) I
/// + 4 ((B:C) A + (A:C) B + (A:B) C) + 8 times the sum of the six products of A, B and C).
Mat3 average_with(const Mat3& a, const Mat3& b, const Mat3& c);

/// The sum of the six products of three matrices, one for each order of them.
Mat3 sum_of_products(const Mat3& a, const Mat3& b, const Mat3& c);

/// A:B, the sum of products of components.
double contracted(const Mat3& a, const Mat3& b);

}  // namespace tangency::inline v0::micromechanics
