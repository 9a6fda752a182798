// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_SOLVE_STATICS_BONDED_BODY_HPP
#define SOLIDEM_SOLVE_STATICS_BONDED_BODY_HPP

#include <Eigen/Core>
#include <vector>

#include "solve/statics/bond_tangent.hpp"
#include "solve/statics/static_equilibrium.hpp"

namespace solidem {

/// Where the elements of a body stand.
struct BodyPose {
  std::vector<Vector> displacement;             ///< m
  std::vector<Quaternion<double>> orientation;  ///< unit
  Matrix3 gradient{};                           ///< of a periodic body
};

/// A network with its rest state. Fields over the elements are vectors of six entries for each:
/// displacement and turn × length(), so that all are in m; or force and moment / length(), all in
/// N.
class BondedBody {
 public:
  explicit BondedBody(const BeamNetwork& network);

  const BeamNetwork& network() const { return *network_; }
  std::size_t elements() const { return network_->specimen->size(); }
  double length() const { return length_; }  ///< mean rest length, m
  /// The bonds at rest.
  const std::vector<BondState>& rest() const { return rest_; }

  BodyPose rest_pose() const;
  BodyPose pose_of(const Equilibrium& equilibrium) const;
  /// Displaces the elements and turns them, about fixed axes.
  void move(BodyPose& pose, const Eigen::VectorXd& change) const;
  std::vector<BondState> bonds_at(const BodyPose& pose) const;

  std::vector<BeamLoad<double>> loads(const std::vector<BondState>& bonds) const;
  /// Rates of the loads, from `bonds`, along a change of the elements and the periodic gradient.
  std::vector<BeamLoad<double>> load_rates(const std::vector<BondState>& bonds,
                                           const Eigen::VectorXd& change,
                                           const Matrix3& gradient) const;
  /// Sum of loads on each element.
  Eigen::VectorXd sum(const std::vector<BeamLoad<double>>& loads) const;
  /// Elastic energy of a small change from rest that makes these loads, J.
  double small_motion_energy(const Eigen::VectorXd& change, const Matrix3& gradient,
                             const std::vector<BeamLoad<double>>& loads) const;

 private:
  Vector image_shift(std::size_t bond, const Matrix3& gradient) const;
  BondMotion motion(std::size_t bond, const Eigen::VectorXd& change, const Matrix3& gradient) const;

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

/// How well forces are in balance, as shares of the bonds' loads on the elements.
struct Balance {
  double residual;   ///< force out of balance
  double round_off;  ///< what of it may be round-off
};
/// `extent`: of the lengths whose differences the bonds feel, m.
Balance balance(const BondedBody& body, const std::vector<BeamLoad<double>>& loads,
                const Eigen::VectorXd& out_of_balance, double extent);

/// The displacements and turns of an equilibrium as a field, and those of a field or pose into an
/// equilibrium.
Eigen::VectorXd field_of(const Equilibrium& equilibrium, double length);
void set_motion(const Eigen::VectorXd& field, double length, Equilibrium& equilibrium);
void set_motion(const BodyPose& pose, Equilibrium& equilibrium);

/// Reactions: what the bonds and loads leave on degrees of freedom that are held; forces and
/// strains of the bonds, which stand at `bonds`.
void set_loads(const BondedBody& body, const BoundaryConditions& conditions,
               const std::vector<BondState>& bonds, const std::vector<BeamLoad<double>>& loads,
               Equilibrium& equilibrium);

}  // namespace solidem

#endif
