// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_ENGINE_ENERGY_GUARD_HPP
#define SOLIDEM_ENGINE_ENERGY_GUARD_HPP

#include <functional>
#include <optional>

namespace solidem {

/// Energies of a body in motion, J.
struct EnergyInMotion {
  double kinetic;  ///< with velocities half a step behind
  double spent;    ///< that does not come back
  double put_in;   ///< at the start and from outside since
};

/// Tells a run that diverges: all that moves was paid for, by the start, from outside or by what
/// was stored.
class EnergyGuard {
 public:
  /// Notes what is stored in the body at the start, J, of what `put_in` counts.
  void start(double stored) { initially_stored_ = stored; }
  /// Energy of no account, J.
  void ignore(double round_off) { round_off_ = round_off; }

  /// None where all that moves was paid for, else what was, J. `stored`: looks how much is stored
  /// now, which may come out; null: nothing that was stored at the start may.
  std::optional<double> paid_too_little(const EnergyInMotion& motion,
                                        const std::function<double()>& stored) const;
  /// Notes that so much, J, was put in: what is taken out again may still move elsewhere.
  void note(double put_in);

  double round_off() const { return round_off_; }
  double largest() const { return largest_; }
  void restore(double largest) { largest_ = largest; }

 private:
  double initially_stored_ = 0, largest_ = 0, round_off_ = 0;
  mutable double vouched_ = 0;  ///< of motion, for which what was released was found to suffice
};

}  // namespace solidem

#endif
