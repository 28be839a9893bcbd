// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/histogram.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <tangency/dem/micromechanics/distributions.hpp>
#include <tangency/dem/micromechanics/harmonics.hpp>
#include <tangency/dem/tool/csv_text.hpp>

namespace tangency::inline v0::dem {
namespace {

namespace mm = micromechanics;

constexpr const char* kColumns =
    "class,dx,dy,dz,area,sides,E,fn,ftx,fty,ftz,zn,ztx,zty,ztz,length,"
    "fl_xx,fl_xy,fl_xz,fl_yx,fl_yy,fl_yz,fl_zx,fl_zy,fl_zz,"
    "E2,E4,fn2,fn4,ft2x,ft2y,ft2z,ft4x,ft4y,ft4z,"
    "zn2,zn4,zt2x,zt2y,zt2z,zt4x,zt4y,zt4z\n";

/// Class means, NaN of empty classes.
class Means {
 public:
  Means(const mm::DirectionGroups& groups, const Packing& packing)
      : groups_(groups),
        force_normal_(groups.means(normal(packing.contacts.force))),
        branch_normal_(groups.means(normal(packing.contacts.branch))),
        length_(groups.means(mm::lengths(packing.contacts.branch))),
        force_tangential_(groups.means(tangential(packing.contacts.force))),
        branch_tangential_(groups.means(tangential(packing.contacts.branch))),
        products_(mm::group_sums(groups, packing.arrays()).products) {}

  void add_to(CsvText& row, std::size_t g) const {
    const auto sides = static_cast<double>(groups_.sides(g));
    const double defined = sides > 0.0 ? 1.0 : kNotDefined;
    row.add(defined * force_normal_[g]);
    row.add(Vec3(defined * force_tangential_[g]));
    row.add(defined * branch_normal_[g]);
    row.add(Vec3(defined * branch_tangential_[g]));
    row.add(defined * length_[g]);
    for (int i = 0; i < 3; ++i) row.add(Vec3(products_[g].row(i).transpose() / sides));
  }

 private:
  std::vector<double> normal(const std::vector<Vec3>& v) const {
    return mm::normal_components(groups_.normals(), v);
  }
  std::vector<Vec3> tangential(const std::vector<Vec3>& v) const {
    return mm::tangential_components(groups_.normals(), v);
  }

  const mm::DirectionGroups& groups_;
  std::vector<double> force_normal_, branch_normal_, length_;
  std::vector<Vec3> force_tangential_, branch_tangential_;
  std::vector<Mat3> products_;  ///< of force and contact vector, summed over sides
};

/// Values of a model of order 2, and of both.
template <class Model, class Value>
void add_models(CsvText& row, const mm::Averages::Tensor& tensor, const Vec3& n,
                const Value& none) {
  if (!tensor) {
    row.add(none);
    row.add(none);
    return;
  }
  row.add(Value(Model{tensor->mean, tensor->second, {}}.value(n)));
  row.add(Value(Model{tensor->mean, tensor->second, *tensor->fourth}.value(n)));
}

}  // namespace

std::string histogram_csv(const Packing& packing, const MicroSummary& summary) {
  const mm::DirectionGroups groups(summary.classes.partition(), packing.contacts.normal);
  const Means means(groups, packing);
  const mm::Averages& averages = summary.averages;
  const Vec3 no_vector = Vec3::Constant(kNotDefined);
  CsvText row;
  for (std::size_t g = 0; g < groups.partition().size(); ++g) {
    const Vec3& n = groups.partition().direction(g);
    row.add(static_cast<std::int64_t>(g));
    row.add(n);
    row.add(groups.partition().area(g));
    row.add(groups.sides(g));
    row.add(groups.density(g));
    means.add_to(row, g);
    add_models<mm::ScalarHarmonics>(row, averages.normals, n, kNotDefined);
    add_models<mm::ScalarHarmonics>(row, averages.force_normal, n, kNotDefined);
    add_models<mm::TangentialHarmonics>(row, averages.force_tangential, n, no_vector);
    add_models<mm::ScalarHarmonics>(row, averages.branch_normal, n, kNotDefined);
    add_models<mm::TangentialHarmonics>(row, averages.branch_tangential, n, no_vector);
    row.end_row();
  }
  return kColumns + std::string(row.view());
}

}  // namespace tangency::inline v0::dem
