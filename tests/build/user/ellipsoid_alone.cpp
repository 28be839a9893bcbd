// SPDX-License-Identifier: GPL-3.0-or-later
// What makes an Ellipsoid, in one unit: a small shared library, made as the whole one is.
#include <tangency/geometry/ellipsoid.cpp>
#include <tangency/geometry/numbers/double_double.cpp>
