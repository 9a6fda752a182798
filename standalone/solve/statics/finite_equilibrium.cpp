// SPDX-License-Identifier: GPL-2.0-or-later
#include "solve/statics/finite_equilibrium.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "model/error.hpp"
#include "solve/statics/bonded_body.hpp"
#include "solve/statics/stiffness_solver.hpp"

namespace solidem {

namespace {

using Index = Eigen::Index;

/// The search for an equilibrium: where the body stands, and the share of what acts on it.
class Search {
 public:
  Search(const BondedBody& body, const BoundaryConditions& conditions, const FiniteOptions& options)
      : body_(body),
        conditions_(conditions),
        options_(options),
        solver_(*body.network().specimen, body.network().bonds, conditions.held, body.length(),
                options.method) {
    pose_ = body.rest_pose();
  }

  /// From the present share to the next, or back to where it was. True when in balance.
  bool step_to(double fraction) {
    const BodyPose start = pose_;
    const double start_fraction = fraction_;
    // Whole corrections settle soonest: thin beams bend only after they were stretched. Where they
    // do not settle, each is held to lower the energy.
    for (const bool guarded : {false, true}) {
      pose_ = start;
      fraction_ = fraction;
      predict(start_fraction);
      for (int correction = 0; correction < options_.most_corrections; ++correction) {
        if (in_balance()) return true;
        if (!correct(guarded)) break;
      }
      if (in_balance()) return true;
    }
    pose_ = start;
    fraction_ = start_fraction;
    return false;
  }

  Equilibrium result() {
    Equilibrium equilibrium;
    const auto bonds = body_.bonds_at(pose_);
    set_motion(pose_, equilibrium);
    set_loads(body_, scaled_conditions(), bonds, body_.loads(bonds), equilibrium);
    equilibrium.periodic_gradient = pose_.gradient;
    equilibrium.iterations = iterations_;
    equilibrium.corrections = corrections_;
    equilibrium.residual = balance_.residual;
    equilibrium.energy = energy(pose_);
    // A force of every kind shows whether the body resists all of them.
    assemble(pose_, 0);
    Eigen::VectorXd change = Eigen::VectorXd::Zero(conditions_.load.size());
    const Eigen::VectorXd all = Eigen::VectorXd::LinSpaced(change.size(), -1, 1).array().cube();
    equilibrium.unstable = !solver_.solve(all, change, 1e-3).positive;
    return equilibrium;
  }

  double residual() const { return balance_.residual; }
  double lowest_residual() const { return lowest_; }
  int corrections() const { return corrections_; }

 private:
  BoundaryConditions scaled_conditions() const {
    BoundaryConditions now = conditions_;
    now.load *= fraction_;
    return now;
  }

  double energy(const BodyPose& pose) const {
    double sum = 0;
    for (const BondState& bond : body_.bonds_at(pose)) sum += bond.energy();
    return sum;
  }

  bool in_balance() const { return balance_.residual <= options_.tolerance + balance_.round_off; }

  /// Forces on what is free.
  Eigen::VectorXd out_of_balance(const BodyPose& pose, Balance& how) const {
    const auto loads = body_.loads(body_.bonds_at(pose));
    Eigen::VectorXd force = body_.sum(loads) + fraction_ * conditions_.load;
    for (Index k = 0; k < force.size(); ++k)
      if (!solver_.is_free(static_cast<std::size_t>(k))) force[k] = 0;
    double reach = 4 * body_.length();
    for (const Vector& u : pose.displacement) reach = std::max(reach, 4 * body_.length() + norm(u));
    how = balance(body_, loads, force, reach);
    return force;
  }

  void assemble(const BodyPose& pose, double shift) {
    const auto bonds = body_.bonds_at(pose);
    solver_.assemble([&](std::size_t b) { return tangent(bonds[b]); }, shift);
  }

  /// Moves what is held, and the rest by the tangent.
  void predict(double from_fraction) {
    const double part = fraction_ - from_fraction;
    Eigen::VectorXd held = part * conditions_.value;
    assemble(pose_, 0);
    const auto bonds = body_.bonds_at(pose_);
    Matrix3 gradient = options_.periodic_gradient;
    for (Vector& row : gradient) row = part * row;
    Eigen::VectorXd force = body_.sum(body_.load_rates(bonds, held, gradient));
    force += part * conditions_.load;
    insist_on_resistance(solver_, body_, conditions_.load);
    Eigen::VectorXd change = Eigen::VectorXd::Zero(force.size());
    iterations_ += solver_.solve(force, change, 1e-6).iterations;
    pose_.gradient = options_.periodic_gradient;
    for (Vector& row : pose_.gradient) row = fraction_ * row;
    body_.move(pose_, held + change);
    force_ = out_of_balance(pose_, balance_);
    lowest_ = balance_.residual;
  }

  /// One correction of Newton's, shortened until the energy falls if it is guarded. False: none was
  /// found.
  bool correct(bool guarded) {
    ++corrections_;
    Eigen::VectorXd change = Eigen::VectorXd::Zero(force_.size());
    // Far from balance the linear equations need not be solved exactly.
    const double goal =
        std::max(std::min(0.01, balance_.residual), 0.1 * options_.tolerance / balance_.residual);
    double shift = 0;
    for (int attempt = 0;; ++attempt) {
      assemble(pose_, shift);
      change.setZero();
      const auto solved = solver_.solve(force_, change, std::min(goal, 0.1));
      iterations_ += solved.iterations;
      if (solved.positive || !solver_.is_factorised() || !guarded) break;
      // Not a minimum here: stiffen all until it is one.
      shift = shift == 0 ? 1e-6 * solver_.largest_stiffness() : 10 * shift;
      if (attempt == 12) return false;
    }
    if (!guarded) {
      body_.move(pose_, change);
      force_ = out_of_balance(pose_, balance_);
      lowest_ = std::min(lowest_, balance_.residual);
      return std::isfinite(balance_.residual);
    }
    const double slope = -force_.dot(change);  // of the potential energy along the change
    if (!(slope < 0)) return false;
    const double before = energy(pose_);
    // Far larger than the round-off of a sum of so many energies.
    const double noise = 1e-12 * std::abs(before);
    double length = 1;
    for (int halving = 0; halving < 30; ++halving, length *= 0.5) {
      BodyPose next = pose_;
      body_.move(next, length * change);
      Balance how{};
      const Eigen::VectorXd force = out_of_balance(next, how);
      const double rise = energy(next) - before - length * fraction_ * conditions_.load.dot(change);
      const bool falls = rise <= 1e-4 * length * slope;
      const bool settles =
          std::abs(length * slope) < 1e3 * noise && how.residual < balance_.residual;
      if (!falls && !settles) continue;
      pose_ = std::move(next);
      force_ = force;
      balance_ = how;
      lowest_ = std::min(lowest_, how.residual);
      return true;
    }
    return false;
  }

  const BondedBody& body_;
  const BoundaryConditions& conditions_;
  const FiniteOptions& options_;
  StiffnessSolver solver_;
  BodyPose pose_;
  Eigen::VectorXd force_;  // out of balance
  Balance balance_{};
  double fraction_ = 0, lowest_ = 0;
  int iterations_ = 0, corrections_ = 0;
};

}  // namespace

Equilibrium finite_equilibrium(const BeamNetwork& network,
                               const std::vector<Constraint>& constraints,
                               const std::vector<ElementLoad>& loads,
                               const FiniteOptions& options) {
  const BondedBody body(network);
  const BoundaryConditions conditions = boundary_conditions(body, constraints, loads);
  Search search(body, conditions, options);
  double fraction = 0, step = options.first_step;
  int steps = 0;
  while (fraction < 1) {
    const int before = search.corrections();
    const double next = fraction + step > 1 - 1e-9 ? 1.0 : fraction + step;
    if (search.step_to(next)) {
      fraction = next;
      ++steps;
      if (options.report) options.report(fraction, search.corrections(), search.residual());
      if (search.corrections() - before <= 6) step *= 2;
      continue;
    }
    step = 0.5 * (next - fraction);
    if (step < options.least_step) {
      char text[256];
      std::snprintf(text, sizeof text,
                    "no static equilibrium beyond %.4g of the loads and displacements: in the next "
                    "%.2g forces out of balance remain at %.2g of the bonds' forces; the body may "
                    "buckle or fold there, which a dynamic run can follow",
                    fraction, 2 * step, search.lowest_residual());
      throw RunError(text);
    }
  }
  Equilibrium equilibrium = search.result();
  equilibrium.load_steps = steps;
  return equilibrium;
}

}  // namespace solidem
