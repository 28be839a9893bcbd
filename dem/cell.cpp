// SPDX-License-Identifier: MIT
#include <cmath>
#include <tangency/dem/cell.hpp>

namespace tangency::dem {

Image Cell::image_of(const Vec3& x) const {
  Image image;
  for (int k = 0; k < 3; ++k)
    image[static_cast<std::size_t>(k)] = static_cast<std::int32_t>(std::floor(x[k] / length[k]));
  return image;
}

Vec3 Cell::logarithmic_strain() const { return (length.array() / reference_length.array()).log(); }

}  // namespace tangency::dem
