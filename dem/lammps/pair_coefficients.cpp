// SPDX-License-Identifier: GPL-2.0-or-later
#include <tangency/dem/lammps/pair_coefficients.hpp>

#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <system_error>

namespace tangency::inline v0::lammps {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

/// The words, one after the other.
class Words {
 public:
  explicit Words(std::span<const char* const> words) : words_(words) {}

  bool done() const { return at_ == words_.size(); }
  /// @param what  that the message calls it
  std::string_view next(const char* what) {
    if (done()) throw InvalidCoefficients("a word is missing at the end: " + std::string(what));
    return words_[at_++];
  }
  /// A number in [least, most]; `allowed` says that range.
  double number(const char* what, const char* allowed, double least, double most) {
    const std::string_view word = next(what);
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    const bool is_number = error == std::errc{} && end == word.data() + word.size();
    if (!is_number || !std::isfinite(value) || !(value >= least && value <= most))
      throw InvalidCoefficients(std::string(what) + " = " + std::string(word) + ": " + allowed);
    return value;
  }
  double positive(const char* what) {
    return number(what, "a number > 0 is allowed", std::numeric_limits<double>::min(), kNoLimit);
  }
  double not_negative(const char* what) {
    return number(what, "a number >= 0 is allowed", 0.0, kNoLimit);
  }

 private:
  std::span<const char* const> words_;
  std::size_t at_ = 0;
};

void read_tangential(Words& words, dem::ContactLaw& law) {
  const std::string_view kind = words.next("the kind of tangential: linear or mindlin");
  const char* const own = law.hertz ? "mindlin" : "linear";
  if (kind != own)
    throw InvalidCoefficients("tangential " + std::string(kind) + ": with " +
                              (law.hertz ? "hertz/material" : "hooke") + " tangential " + own +
                              " is allowed");
  // Of Mindlin's the stiffness goes with the contact: here it only says that there is one.
  law.shear_stiffness = law.hertz ? law.normal_stiffness : words.not_negative("kt");
  law.friction_coefficient = words.not_negative("mu");
}

}  // namespace

dem::ContactLaw law_of(std::span<const char* const> text) {
  Words words(text);
  dem::ContactLaw law{};
  const std::string_view normal = words.next("hooke or hertz/material");
  if (normal == "hooke") {
    law.normal_stiffness = words.positive("kn");
  } else if (normal == "hertz/material") {
    const double young = words.positive("E");
    law.hertz = dem::Material{young, words.number("nu", "0 to 0.5 is allowed", 0.0, 0.5)};
    law.normal_stiffness = young;
  } else {
    throw InvalidCoefficients("law = " + std::string(normal) +
                              ": hooke or hertz/material is allowed");
  }
  while (!words.done()) {
    const std::string_view key = words.next("");
    if (key == "tangential") {
      read_tangential(words, law);
    } else if (key == "cohesion") {
      law.cohesion = words.not_negative("cohesion");
    } else if (key == "restitution") {
      law.damping_ratio = dem::damping_ratio_of(
          words.number("restitution", "0.05 to 1 is allowed", dem::kLeastRestitution, 1.0));
    } else {
      throw InvalidCoefficients("word = " + std::string(key) +
                                ": tangential, cohesion or restitution is allowed");
    }
  }
  return law;
}

StoredLaw stored(const dem::ContactLaw& law) {
  const dem::Material material = law.hertz.value_or(dem::Material{0.0, 0.0});
  return {law.normal_stiffness,   law.shear_stiffness,   law.friction_coefficient,
          law.cohesion,           law.damping_ratio,     law.hertz ? 1.0 : 0.0,
          material.young_modulus, material.poisson_ratio};
}

dem::ContactLaw restored(const StoredLaw& n) {
  dem::ContactLaw law{n[0], n[1], n[2], n[3], {}, n[4]};
  if (n[5] != 0.0) law.hertz = dem::Material{n[6], n[7]};
  return law;
}

}  // namespace tangency::inline v0::lammps
