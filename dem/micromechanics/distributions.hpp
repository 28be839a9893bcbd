// SPDX-License-Identifier: MIT
/// @file
/// Contacts sorted into the classes of a partition by their normals: histograms, the two kinds of
/// average, sums of groups, and what a model leaves unexplained [Ouadfel1998, chapter 2].
///
/// A contact has two sides: (n, v) of a and (-n, -v) of b, v any of its vectors. Both are counted:
/// M, the number of sides, is twice that of contacts, and the side of b is in the opposite class of
/// that of a. Scalars (normal components, lengths) are the same from both sides.
///
/// Over contacts: (1/M) times the sum over sides. Over orientations: the sum over classes of the
/// class mean times w_g, the class's share of the area of all classes that are not empty. The two
/// differ where contacts are anisotropic; f0 and z0 of the theory are of the second kind.
///
/// Errors: arrays whose length is not the number of contacts are std::invalid_argument. Nothing
/// changes once made: any number of threads may read it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <tangency/dem/micromechanics/contact_arrays.hpp>
#include <tangency/dem/micromechanics/harmonics.hpp>
#include <tangency/dem/micromechanics/sphere_partition.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::micromechanics {

/// A side more in a class is a side more in its opposite: sides and densities of opposite classes
/// are equal, and means of vectors are opposite.
///
/// (1) the sum of density times area over all classes is 1, with any contact
/// (2) exchanging a and b of a contact, or the order of contacts, changes nothing but rounding
class DirectionGroups {
 public:
  /// @param partition  the classes of directions
  /// @param normals  unit, out of a; one a contact. Need not outlive the call
  DirectionGroups(SpherePartition partition, std::span<const Vec3> normals);

  /// The partition that was given.
  const SpherePartition& partition() const { return partition_; }
  /// The number of contacts.
  std::size_t contacts() const { return group_.size(); }
  /// As given, one a contact.
  const std::vector<Vec3>& normals() const { return normals_; }
  /// The class of the side of a.
  std::size_t group(std::size_t contact) const { return group_[contact]; }
  /// Sides in a class, M_g; together M = 2 contacts().
  std::int64_t sides(std::size_t g) const { return sides_[g]; }
  /// Classes without a contact: where the histogram says nothing.
  std::size_t empty_classes() const { return empty_; }
  /// E_g = M_g / (M area), the density of contact normals per solid angle; 0 without contacts.
  double density(std::size_t g) const;
  /// w_g, the share of an average over orientations; 0 of an empty class.
  double weight(std::size_t g) const;
  /// What both sides of a contact weigh in an average over orientations: 2 w_g / M_g. Together 1.
  double contact_weight(std::size_t contact) const;

  /// Class means, 0 of empty classes.
  std::vector<double> means(std::span<const double> scalars) const;
  /// @overload
  std::vector<Vec3> means(std::span<const Vec3> vectors) const;

  /// Averages of a scalar; 0 without contacts.
  double over_contacts(std::span<const double> scalars) const;
  /// Mean over all directions of the means of classes, weighted by area.
  double over_orientations(std::span<const double> scalars) const;

 private:
  SpherePartition partition_;
  std::vector<Vec3> normals_;
  std::vector<std::size_t> group_;
  std::vector<std::int64_t> sides_;
  double filled_ = 0.0;  ///< area of the classes that are not empty
  std::size_t empty_ = 0;
};

/// Variances below this share of a mean square are rounding. Chosen: the square of 50 units of it.
inline constexpr double kRoundedVariance = 1e-28;

/// v . n, and v less that along n, of each contact.
std::vector<double> normal_components(std::span<const Vec3> normals, std::span<const Vec3> v);
/// v less its part along the normal, one a contact.
std::vector<Vec3> tangential_components(std::span<const Vec3> normals, std::span<const Vec3> v);
/// |v| of each vector.
std::vector<double> lengths(std::span<const Vec3> v);

/// The stress by groups of contacts of one direction [Ouadfel1998, eq. 2.80-2.86].
struct GroupSums {
  /// The sum over groups of M_g times the mean of f (x) l: the stress itself, stress_of.
  Mat3 exact = Mat3::Zero();
  /// With the means of f and of l of each group multiplied in place: the stress if forces did not
  /// depend on the vectors within groups. How near it is to the other tests that.
  Mat3 independent = Mat3::Zero();
  /// The sum of f (x) l over the sides of each class, l from the centre of the side's body: M_g
  /// times its mean. Together volume times `exact`.
  std::vector<Mat3> products;
};
/// @param contacts  the contacts
/// @param groups  of the normals of `contacts`
/// With half the branch on both sides where `arm` is empty, else with the contact vectors of each
/// side; the exact sum is the same.
GroupSums group_sums(const DirectionGroups& groups, const ContactArrays& contacts);

/// The share of the variance of class means that a model leaves, weighted as over orientations: 0
/// is a perfect model, 1 that of a constant. NaN where class means do not vary. Sampling scatter of
/// the class means is in it: a true model of few contacts leaves more than 0.
/// @param groups  the contacts, sorted by direction
/// @param scalars  one a contact
/// @param model  of scalars; of a tangential vector, whose mean is 0; of the density of normals
double unexplained_variance(const DirectionGroups& groups, std::span<const double> scalars,
                            const ScalarHarmonics& model);
/// @overload
double unexplained_variance(const DirectionGroups& groups, std::span<const Vec3> tangential,
                            const TangentialHarmonics& model);
/// @overload
double unexplained_variance(const DirectionGroups& groups, const ScalarHarmonics& density);

/// The contacts whose normals have their largest component, by size, along one axis: those that
/// mainly bear the stress along it [Ouadfel1998, section 5.4.7].
struct AxisGroup {
  std::int64_t contacts = 0;       ///< how many were counted
  double fraction = 0.0;           ///< of all contacts; NaN without any
  double mean_normal_force = 0.0;  ///< over the group's contacts; NaN without any
};
/// Of the axes x, y, z. Of equally large components the first counts.
///
/// (3) contacts of the three add up to all
std::array<AxisGroup, 3> axis_groups(std::span<const Vec3> normals, std::span<const Vec3> forces);

/// The mean of a tangential vector's component away from the axis in each ring of a polar
/// partition, with n = axis cos(beta) + r sin(beta) [Ouadfel1998, eq. 2.74]. As the model has it in
/// TangentialHarmonics::radial.
struct RadialRing {
  double beta = 0.0;               ///< angle of the ring's middle to the axis, radian
  double value = 0.0;              ///< over the sectors that are not empty; 0 where all are
  std::size_t filled_sectors = 0;  ///< sectors that hold at least one contact
};
/// @throws std::invalid_argument if the partition is not polar
std::vector<RadialRing> radial_means(const DirectionGroups& groups,
                                     std::span<const Vec3> tangential);

}  // namespace tangency::inline v0::micromechanics
