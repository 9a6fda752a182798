// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_CONTACT_LAW_HPP
#define SOLIDEM_EFFECTS_CONTACT_LAW_HPP

#include <optional>

namespace solidem {

/// What a scene says of contacts besides how they stand to bonds (ContactParameters):
/// laws/linear_contact.hpp.
struct ContactLaw {
  /// Of elements of different bodies that overlap at the start.
  enum class InitialOverlap {
    refused,
    kept  ///< they touch where they stand
  };
  std::optional<double> normal_stiffness;   ///< k_n of every contact, N/m
  std::optional<double> young_modulus;      ///< E of k_n = 2 E R_i R_j / (R_i + R_j), Pa
  double tangential_stiffness_ratio = 0.8;  ///< k_t / k_n
  double friction = 0;                      ///< μ
  double restitution = 1;                   ///< e
  InitialOverlap initial_overlap = InitialOverlap::refused;

  /// k_n, N/m, of two elements, where it does not hang on bonds.
  double stiffness(double radius_i, double radius_j) const {
    return normal_stiffness ? *normal_stiffness
                            : 2 * *young_modulus * radius_i * radius_j / (radius_i + radius_j);
  }

  /// Whether contacts are as stiff as the bonds in whose places they are.
  bool is_stiff_as_bonds() const { return !normal_stiffness && !young_modulus; }
};

}  // namespace solidem

#endif
