// SPDX-License-Identifier: GPL-2.0-or-later
#include "solve/calibration/orthotropic_constants.hpp"

#include <algorithm>
#include <cmath>
#include <Eigen/Dense>

#include "model/error.hpp"
#include "solve/statics/bond_tangent.hpp"

namespace solidem {

namespace {

using EigenMatrix6 = Eigen::Matrix<double, 6, 6>;

EigenMatrix6 as_eigen(const Matrix6& matrix) {
  EigenMatrix6 result;
  for (int a = 0; a < 6; ++a)
    for (int b = 0; b < 6; ++b)
      result(a, b) = matrix[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)];
  return result;
}

Matrix6 from_eigen(const EigenMatrix6& matrix) {
  Matrix6 result{};
  for (int a = 0; a < 6; ++a)
    for (int b = 0; b < 6; ++b)
      result[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)] = matrix(a, b);
  return result;
}

/// The two axes of a component in Voigt's order.
constexpr std::array<std::array<int, 2>, 6> voigt{
    {{{0, 0}}, {{1, 1}}, {{2, 2}}, {{1, 2}}, {{0, 2}}, {{0, 1}}}};

std::array<Vector, 3> triad(const GrainAxes<double>& axes) {
  return {axes.longitudinal, axes.radial, axes.tangential()};
}

/// The symmetric displacement gradient of a unit strain: half of it each way for shears.
Matrix3 unit_strain(const std::array<Vector, 3>& axes, std::size_t component_index) {
  const auto [a, b] = voigt[component_index];
  const Vector& m = axes[static_cast<std::size_t>(a)];
  const Vector& n = axes[static_cast<std::size_t>(b)];
  Matrix3 gradient{};
  for (int row = 0; row < 3; ++row)
    gradient[static_cast<std::size_t>(row)] =
        (0.5 * component(m, row)) * n + (0.5 * component(n, row)) * m;
  return gradient;
}

Vector times(const Matrix3& matrix, const Vector& v) {
  return {dot(matrix[0], v), dot(matrix[1], v), dot(matrix[2], v)};
}

void insist_on_periodicity(const Domain& domain) {
  if (domain.periodic[0] && domain.periodic[1] && domain.periodic[2]) return;
  throw InputError(
      "[specimen] periodic: elastic constants are those of a periodic cell; expected [true, true, "
      "true]");
}

}  // namespace

Matrix6 inverse(const Matrix6& matrix) {
  const Eigen::LLT<EigenMatrix6> factor(as_eigen(matrix));
  if (factor.info() != Eigen::Success)
    throw RunError("a stiffness is not positive definite: the body resists some strain not at all");
  return from_eigen(factor.solve(EigenMatrix6::Identity()));
}

EffectiveStiffness effective_stiffness(const BeamNetwork& network, const GrainAxes<double>& axes,
                                       const EffectiveStiffness* guess) {
  insist_on_periodicity(network.specimen->domain);
  if (network.bonds.empty())
    throw InputError("[bonds] tolerance: the body has no bonds; expected a larger one");
  EffectiveStiffness result{};
  result.axes = axes;
  const std::array<Vector, 3> frame = triad(axes);
  const std::int32_t anchor = network.bonds.front().i;
  const std::vector<Constraint> held{{anchor, 0, 0}, {anchor, 1, 0}, {anchor, 2, 0}};
  EigenMatrix6 stiffness;
  for (std::size_t b = 0; b < 6; ++b) {
    EquilibriumOptions options;
    options.periodic_gradient = unit_strain(frame, b);
    if (guess != nullptr) options.guess = &guess->strained[b];
    result.strained[b] = small_equilibrium(network, held, {}, options);
    const Matrix3 stress = mean_stress(network, result.strained[b]);
    for (std::size_t a = 0; a < 6; ++a) {
      const auto [m, n] = voigt[a];
      stiffness(static_cast<int>(a), static_cast<int>(b)) = dot(
          frame[static_cast<std::size_t>(m)], times(stress, frame[static_cast<std::size_t>(n)]));
    }
  }
  const EigenMatrix6 transposed = stiffness.transpose();
  result.asymmetry =
      (stiffness - transposed).cwiseAbs().maxCoeff() / stiffness.cwiseAbs().maxCoeff();
  result.stiffness = from_eigen(0.5 * (stiffness + transposed));
  return result;
}

Matrix6 stiffness_rate(const BeamNetwork& network, const EffectiveStiffness& measured,
                       const std::vector<BeamRigidity<double>>& rigidity_rate) {
  const Specimen& specimen = *network.specimen;
  const std::array<Vector, 3> frame = triad(measured.axes);
  std::array<Matrix3, 6> strain;
  for (std::size_t a = 0; a < 6; ++a) strain[a] = unit_strain(frame, a);
  EigenMatrix6 rate = EigenMatrix6::Zero();
  for (std::size_t k = 0; k < network.bonds.size(); ++k) {
    const auto i = static_cast<std::size_t>(network.bonds[k].i);
    const auto j = static_cast<std::size_t>(network.bonds[k].j);
    const Vector chord = rest_chord(specimen, network.bonds[k]);
    const double length = norm(chord);
    const Vector shift = chord - (specimen.position[j] - specimen.position[i]);
    // How the ends move in each state, seen from the centre of i.
    Eigen::Matrix<double, 12, 6> motion = Eigen::Matrix<double, 12, 6>::Zero();
    for (std::size_t a = 0; a < 6; ++a) {
      const Equilibrium& state = measured.strained[a];
      const Vector opened = state.displacement[j] - state.displacement[i] + times(strain[a], shift);
      const Vector parts[] = {state.rotation[i], opened, state.rotation[j]};
      for (int part = 0; part < 3; ++part)
        for (int axis = 0; axis < 3; ++axis)
          motion(3 + 3 * part + axis, static_cast<int>(a)) = component(parts[part], axis);
    }
    const BondState state{rigidity_rate[k], length, (1 / length) * chord, chord, {}, {}};
    rate += motion.transpose() * tangent(state) * motion;
  }
  return from_eigen(rate / specimen.domain.volume);
}

OrthotropicConstants orthotropic_constants(const Matrix6& stiffness) {
  const Matrix6 s = inverse(stiffness);
  OrthotropicConstants constants{};
  constants.young_modulus = {1 / s[0][0], 1 / s[1][1], 1 / s[2][2]};
  constants.shear_modulus = {1 / s[5][5], 1 / s[4][4], 1 / s[3][3]};
  constants.poisson_ratio = {-s[1][0] / s[0][0], -s[2][0] / s[0][0], -s[2][1] / s[1][1]};
  for (std::size_t a = 0; a < 6; ++a)
    for (std::size_t b = std::max<std::size_t>(a + 1, 3); b < 6; ++b)
      constants.coupling =
          std::max(constants.coupling, std::abs(s[a][b]) / std::sqrt(s[a][a] * s[b][b]));
  return constants;
}

double young_modulus_along(const Vector& direction, const Matrix6& compliance) {
  const Vector& n = direction;
  const double v[] = {n.x * n.x, n.y * n.y, n.z * n.z, n.y * n.z, n.x * n.z, n.x * n.y};
  double along = 0;
  for (std::size_t a = 0; a < 6; ++a)
    for (std::size_t b = 0; b < 6; ++b) along += v[a] * compliance[a][b] * v[b];
  return 1 / along;
}

}  // namespace solidem
