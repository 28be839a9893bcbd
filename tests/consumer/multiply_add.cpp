// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/geometry/gap.hpp>

double multiply_add(double a, double b, double c) { return a * b + c; }
