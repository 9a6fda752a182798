// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_SOLVE_BONDED_BODY_HPP
#define SOLIDEM_SOLVE_BONDED_BODY_HPP

#include <Eigen/Core>
#include <vector>

#include "solve/bond_tangent.hpp"
#include "solve/static_equilibrium.hpp"

namespace solidem {

/// A network with its rest state. Fields over the elements are vectors of six entries for each:
/// displacement and turn × length(), so that all are in m; or force and moment / length(), all in
/// N.
class BondedBody {
 public:
  explicit BondedBody(const BeamNetwork& network);

  const BeamNetwork& network() const { return *network_; }
  std::size_t elements() const { return network_->specimen->size(); }
  double length() const { return length_; }  ///< mean rest length, m
  const std::vector<BondState>& rest() const { return rest_; }
  /// What the displacement gradient of a periodic body moves the far end of a bond by, m.
  Vector image_shift(std::size_t bond, const Matrix3& gradient) const;

  /// Sum of the bonds' loads on each element.
  Eigen::VectorXd sum(const std::vector<BeamLoad<double>>& loads) const;

  /// What small displacements and turns make of the bonds' loads.
  std::vector<BeamLoad<double>> small_motion_loads(const Eigen::VectorXd& field,
                                                   const Matrix3& gradient) const;
  /// Elastic energy of small displacements and turns that make these loads, J.
  double small_motion_energy(const Eigen::VectorXd& field, const Matrix3& gradient,
                             const std::vector<BeamLoad<double>>& loads) const;

 private:
  BondMotion motion(std::size_t bond, const Eigen::VectorXd& field, const Matrix3& gradient) const;

  const BeamNetwork* network_;
  double length_ = 0;
  std::vector<BondState> rest_;
};

/// What is held and what is loaded, as fields over the elements of a body.
struct BoundaryConditions {
  std::vector<char> held;  ///< six for each element
  Eigen::VectorXd value;   ///< where held
  Eigen::VectorXd load;
};

/// Throws InputError where an element or a degree does not exist, where one degree of freedom is
/// held at two values, and when the body is not held.
BoundaryConditions boundary_conditions(const BondedBody& body,
                                       const std::vector<Constraint>& constraints,
                                       const std::vector<ElementLoad>& loads);

/// Throws InputError when a load acts on an element along a direction that nothing resists.
void insist_on_resistance(const class StiffnessSolver& solver, const BondedBody& body,
                          const Eigen::VectorXd& load);

/// Force out of balance, as a share of the bonds' loads on the elements.
double residual_share(const BondedBody& body, const std::vector<BeamLoad<double>>& loads,
                      const Eigen::VectorXd& out_of_balance);

/// Displacements and turns of an equilibrium as a field, and back.
Eigen::VectorXd field_of(const Equilibrium& equilibrium, double length);
void set_field(const Eigen::VectorXd& field, double length, Equilibrium& equilibrium);

/// Reactions: what the bonds and loads leave on degrees of freedom that are held; bond forces.
void set_reactions(const BondedBody& body, const BoundaryConditions& conditions,
                   const std::vector<BeamLoad<double>>& loads, Equilibrium& equilibrium);

}  // namespace solidem

#endif
