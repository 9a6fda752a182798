// SPDX-License-Identifier: GPL-2.0-or-later
//
// Plasticity of a beam bond.
//
// Source: Terreros 2013, sections 3.2.1 and 3.2.2 (von Mises stress at mid-length, yield;
// with the printed M_i + M_j, which vanishes in pure bending, put right to M_i − M_j).
//
// Equivalent stress at the edge of the section at mid-length:
//   σ_e = sqrt(σ² + 3 τ²),   σ = |F_x| / S + ½ |M_i − M_j| r / I,   τ = M_x r / I_0.
// With the loads of laws/beam.hpp, ½ |M_i − M_j| = E I / l |a_j − a_i| and M_x = G I_0 / l φ, so
// that
//   ε_e = σ_e / E = sqrt((|e| + r |a_j − a_i|)² + 3 (G/E · r φ)²) / l,
// e the elastic extension and φ the elastic twist: everything below is written in this strain.
//
// Plastic deformation moves the shape in which the beam is free of load: the normals of its end
// sections in the elements' body axes, its length and its twist. The elastic law then holds as it
// stands, and rigid motion gives no load however much has flowed.
//
// Plastic work of a flow by Δq_p is ½ (Q_n + Q')·Δq_p, Q_n the load in the last pose and Q' the one
// that is left: the mean load, as it works on whatever moves the ends. With q_n, q and q' the
// elastic deformations in the last pose, before and after the flow, and W(a, b) their mutual
// energy, half of what the load of a does along b, so that W(q, q) = U(q),
//   ½ (Q_n + Q')·Δq_p = W(q_n, q) − W(q_n, q') + W(q, q') − U(q').
// A bond that did not stand on the yield surface in the last pose reached it at the share s of the
// way from there, s (ε − ε_n) = ε_y(κ) − ε_n: q_n is then q_n + s (q − q_n).
//
// A beam may be judged at its ends instead: there the larger of |M_i| and |M_j|, without torsion,
// stands for ½ |M_i − M_j|, which is never above it.
//
// The yield strain ε_y(κ) at a plastic strain κ is that of a yield law (yield_law.hpp). Three rules
// say when and how far a bond flows. Two leave the share p of the elastic deformation, in every
// mode alike, so that the stress returns to σ_y along the ray to the origin, which is not normal to
// the yield surface where modes are mixed:
//   radial return   when the strain since the last flow exceeds ε_y(κ):  p ε_e = ε_y(κ'),
//                   κ' = κ + (1 − p) ε_e the plastic strain;
//   scaled offset   (the thesis) when the strain ε since the bond was made exceeds its largest
//                   before, ε_y(κ) + κ: the stress is then that of the same monotonic curve,
//                   p ε = ε_y(κ'), κ' = (1 − p) ε; below it everything stays elastic, so reverse
//                   flow comes late and is a jump of the stress. The law is not bound to take
//                   energy: on paths that turn, a flow may give some back.
// The third is normal to it:
//   associated      Δq_p = Δλ ∂σ_e/∂Q of the resultants Q = (N, M, T) at mid-length and their
//                   elongation, bending and twist q, back onto the surface at once. With
//                   ε_N = |e|/l, ε_M = r |a_j − a_i|/l, γ = G/E · r φ/l, s = ε_N + ε_M and
//                   x = Δλ/(S l ε_e') this leaves
//                     s' = max(s/(1 + 5x), ε_N/(1 + x), ε_M/(1 + 4x)),   γ' = γ/(1 + 6x G/E),
//                     ε_N' = max(0, ε_N − x s'),   ε_M' = s' − ε_N',   κ' = κ + x ε_e',
//                   x from ε_e' = ε_y(κ'): κ is the strain that does the plastic work at σ_e.
#ifndef SOLIDEM_LAWS_BEAM_PLASTICITY_HPP
#define SOLIDEM_LAWS_BEAM_PLASTICITY_HPP

#include <utility>

#include "laws/beam.hpp"
#include "laws/bond_law.hpp"
#include "laws/yield_law.hpp"

namespace solidem {

/// What a beam remembers: the shape in which it is free of load, and how much it has flowed.
template <class Real>
struct BeamHistory {
  Vector3<Real> normal_i;  ///< of the end section, in body axes of i; at first the rest direction
  Vector3<Real> normal_j;  ///< the same in body axes of j
  Real extension;          ///< plastic part, m
  Real twist;              ///< plastic part, rad
  Real strain;             ///< κ: equivalent plastic strain, never decreasing
  BeamModes<Real> last;    ///< elastic deformation in the last pose
  Real last_strain;        ///< strain there by which flow is judged
};

/// The history of a beam that has not flowed.
template <class Real>
constexpr BeamHistory<Real> unyielded(const Vector3<Real>& rest_direction) {
  const Real none{0.0};
  return {rest_direction, rest_direction, none, none, none, {}, none};
}

/// Deformation of a beam since it last flowed.
template <class Real>
constexpr BeamDeformation<Real> elastic_deformation(const Real& rest_length,
                                                    const BeamPose<Real>& pose,
                                                    const BeamHistory<Real>& history) {
  BeamDeformation<Real> deformation = beam_deformation(rest_length, pose);
  deformation.extension = deformation.extension - history.extension;
  deformation.twist = deformation.twist - history.twist;
  return deformation;
}

/// σ_e / E. `shear_ratio`: G / E.
template <class Real>
constexpr Real equivalent_strain(const Real& radius, const Real& shear_ratio,
                                 const BeamPose<Real>& pose,
                                 const BeamDeformation<Real>& deformation) {
  using std::abs;
  using std::sqrt;
  const Vector3<Real> bend = pose.normal_j - pose.normal_i;
  const Real edge = abs(deformation.extension) + radius * sqrt(dot(bend, bend));
  const Real slip = shear_ratio * radius * deformation.twist;
  return sqrt(edge * edge + Real{3.0} * slip * slip) * deformation.inverse_rest_length;
}

/// A beam bond that may flow.
template <class Real>
struct YieldingBeam {
  BeamRigidity<Real> rigidity;
  Real rest_length;                                       ///< m
  Real radius;                                            ///< m
  Real shear_ratio;                                       ///< G / E
  JudgedSection yield_section = JudgedSection::middle;    ///< where it flows
  JudgedSection rupture_section = JudgedSection::middle;  ///< where it breaks
};

namespace detail {

/// Strain by bending at the edge of the section at the end whose normal is `here`, times l.
template <class Real>
constexpr Real end_bending(const YieldingBeam<Real>& beam, const Vector3<Real>& here,
                           const Vector3<Real>& there, const Vector3<Real>& direction) {
  using std::sqrt;
  const Real half{0.5}, one{1.0}, two{2.0}, three{3.0}, none{0.0};
  const BeamRigidity<Real>& rigidity = beam.rigidity;
  const Vector3<Real> moment =
      (three * rigidity.shear) * cross(here, direction) -
      (half * (three * rigidity.shear - rigidity.bending)) * cross(here, there);
  const Vector3<Real> across = moment - dot(moment, direction) * direction;
  const auto bends = greater(rigidity.bending, none);
  const Real per_moment = two * beam.radius / select(bends, rigidity.bending, one);  // r / E I
  return select(bends, per_moment * sqrt(dot(across, across)), none);
}

}  // namespace detail

/// Strain by bending at the edge of the judged section.
template <class Real>
constexpr Real bending_strain(JudgedSection section, const YieldingBeam<Real>& beam,
                              const BeamPose<Real>& pose,
                              const BeamDeformation<Real>& deformation) {
  using std::sqrt;
  const Vector3<Real> bend = pose.normal_j - pose.normal_i;
  const Real& per_length = deformation.inverse_rest_length;
  const Real middle = per_length * (beam.radius * sqrt(dot(bend, bend)));
  if (section == JudgedSection::middle) return middle;
  const Vector3<Real>& x = deformation.direction;
  const Real at_i = detail::end_bending(beam, pose.normal_i, pose.normal_j, x);
  const Real at_j = detail::end_bending(beam, pose.normal_j, pose.normal_i, x);
  const Real ends = per_length * select(greater(at_i, at_j), at_i, at_j);
  if (section == JudgedSection::ends) return ends;
  return select(greater(ends, middle), ends, middle);
}

/// σ_e / E in the judged section.
template <class Real>
constexpr Real equivalent_strain(JudgedSection section, const YieldingBeam<Real>& beam,
                                 const BeamPose<Real>& pose,
                                 const BeamDeformation<Real>& deformation) {
  using std::abs;
  using std::sqrt;
  if (section == JudgedSection::middle)
    return equivalent_strain(beam.radius, beam.shear_ratio, pose, deformation);
  const Real& per_length = deformation.inverse_rest_length;
  const Real edge =
      per_length * abs(deformation.extension) + bending_strain(section, beam, pose, deformation);
  const Real slip = per_length * (beam.shear_ratio * beam.radius * deformation.twist);
  return sqrt(edge * edge + Real{3.0} * slip * slip);
}

/// The strains by which a bond breaks that is deformed so and has flowed to the plastic strain κ.
/// `equivalent`: σ_e / E where it flows.
template <class Real>
constexpr BondStrain<Real> bond_strain(const YieldingBeam<Real>& beam, const BeamPose<Real>& pose,
                                       const BeamDeformation<Real>& deformation,
                                       const Real& equivalent, const Real& plastic_strain) {
  const Real& per_length = deformation.inverse_rest_length;
  const JudgedSection section = beam.rupture_section;
  return {section == beam.yield_section ? equivalent
                                        : equivalent_strain(section, beam, pose, deformation),
          plastic_strain, per_length * deformation.extension,
          bending_strain(section, beam, pose, deformation),
          per_length * (beam.shear_ratio * beam.radius * deformation.twist)};
}

/// Twice the largest that (ε_e l)² can be, without a root: below it a bond cannot have reached
/// its limit.
template <class Real>
constexpr Real bound_of_squared_extension(const Real& radius, const Real& shear_ratio,
                                          const BeamPose<Real>& pose,
                                          const BeamDeformation<Real>& deformation) {
  const Vector3<Real> bend = pose.normal_j - pose.normal_i;
  const Real slip = shear_ratio * radius * deformation.twist;
  return Real{2.0} *
             (deformation.extension * deformation.extension + radius * radius * dot(bend, bend)) +
         Real{3.0} * slip * slip;
}

/// How far a beam flows.
template <class Real>
struct PlasticFlow {
  Real fraction;        ///< p: what remains of the elastic deformation, 1 where nothing flows
  Real strain;          ///< κ afterwards
  Real elastic_strain;  ///< σ_e / E afterwards
};

/// Radial return: `strain` is ε_e since the last flow, `plastic_strain` κ before.
template <class Law, class Real>
constexpr PlasticFlow<Real> radial_return(const YieldCurve<Law, Real>& yield, const Real& strain,
                                          const Real& plastic_strain) {
  const Real one{1.0};
  const Real limit = yield.limit(plastic_strain);
  const Real after = returned_strain(yield, strain, plastic_strain);
  const auto flows = greater(strain, limit);
  return {select(flows, after / select(flows, strain, one), one),
          select(flows, plastic_strain + (strain - after), plastic_strain),
          select(flows, after, strain)};
}

/// Scaled offset: `strain` is ε since the bond was made, `plastic_strain` κ before.
template <class Law, class Real>
constexpr PlasticFlow<Real> scaled_offset(const YieldCurve<Law, Real>& yield, const Real& strain,
                                          const Real& plastic_strain) {
  const Real one{1.0};
  const Real largest = yield.total_limit(plastic_strain);
  const Real after = returned_strain(yield, strain, Real{0.0});
  const auto flows = greater(strain, largest);
  return {select(flows, after / select(flows, strain, one), one),
          select(flows, strain - after, plastic_strain), after};
}

/// Strains of the resultants at mid-length, each at the edge of the section.
template <class Real>
struct ResultantStrain {
  Real normal;   ///< ε_N, of |N|
  Real bending;  ///< ε_M, of |M|
  Real twist;    ///< γ, of T
};

/// How far a beam flows normal to its yield surface: what remains of each resultant.
template <class Real>
struct AssociatedFlow {
  Real normal, bending, twist;  ///< shares, 1 where nothing flows
  Real strain;                  ///< κ afterwards
  Real elastic_strain;          ///< σ_e / E afterwards
};

namespace detail {

template <class Number>
constexpr Number larger_of(const Number& a, const Number& b) {
  return select(greater(a, b), a, b);
}

/// σ_e / E after a flow by x, and s'.
template <class Number>
constexpr std::pair<Number, Number> strain_after(const ResultantStrain<Number>& strain,
                                                 const Number& shear_ratio, const Number& x) {
  using std::sqrt;
  const Number one{1.0};
  const Number edge =
      larger_of((strain.normal + strain.bending) / (one + Number{5.0} * x),
                larger_of(strain.normal / (one + x), strain.bending / (one + Number{4.0} * x)));
  const Number twist = strain.twist / (one + Number{6.0} * shear_ratio * x);
  return {sqrt(edge * edge + Number{3.0} * twist * twist), edge};
}

}  // namespace detail

/// Associated flow of a beam strained to ε_e. What is left beyond the surface falls with x and is
/// convex for laws that harden ever less, so that Newton's method comes to its end from one side.
template <class Law, class Real>
constexpr AssociatedFlow<Real> associated_flow(const YieldCurve<Law, Real>& yield,
                                               const ResultantStrain<Real>& strain,
                                               const Real& shear_ratio, const Real& equivalent,
                                               const Real& plastic_strain) {
  using std::abs;
  using Varied = DualNumber<Real>;
  constexpr int most_steps = 60;
  const Real none{0.0}, one{1.0};
  const ResultantStrain<Varied> fixed{Varied{strain.normal}, Varied{strain.bending},
                                      Varied{strain.twist}};
  const YieldState<Varied> state{Varied{yield.state.temperature}, Varied{yield.state.rate}};
  const auto flows = greater(equivalent, yield.limit(plastic_strain));
  Real x{0.0};
  for (int n = 0; n < most_steps; ++n) {
    const Varied at{x, one};
    const Varied left = detail::strain_after(fixed, Varied{shear_ratio}, at).first;
    const Varied excess = left - yield.law.limit(Varied{plastic_strain} + at * left, state);
    const auto falls = both(flows, greater(none, excess.derivative));
    const Real step = select(falls, -(excess.value / select(falls, excess.derivative, one)), none);
    x = detail::larger_of(x + step, none);
    if (!any(greater(abs(step), Real{4e-16} * (one + x)))) break;
  }
  const auto [left, edge] = detail::strain_after(strain, shear_ratio, x);
  const Real normal = detail::larger_of(strain.normal - x * edge, none);
  const auto share = [&](const Real& after, const Real& before) {
    const auto is_any = both(flows, greater(before, none));
    return select(is_any, after / select(is_any, before, one), one);
  };
  return {share(normal, strain.normal), share(edge - normal, strain.bending),
          one / (one + Real{6.0} * shear_ratio * x),
          select(flows, plastic_strain + x * left, plastic_strain),
          select(flows, left, equivalent)};
}

namespace detail {

/// A vector made a unit vector that is short of one by the square of an angle: Newton's steps for
/// 1 / length from 1.
template <class Real>
constexpr Vector3<Real> nearly_unit(Vector3<Real> v) {
  for (int n = 0; n < 2; ++n) v = (Real{1.5} - Real{0.5} * dot(v, v)) * v;
  return v;
}

}  // namespace detail

/// The pose of a beam of whose elastic deformation the share p remains: its section normals lean
/// towards the chord.
template <class Real>
constexpr BeamPose<Real> relaxed(const BeamPose<Real>& pose, const Vector3<Real>& direction,
                                 const Real& fraction) {
  const auto lean = [&](const Vector3<Real>& normal) {
    return detail::nearly_unit(direction + fraction * (normal - direction));
  };
  return {pose.chord, lean(pose.normal_i), lean(pose.normal_j), pose.relative_turn};
}

/// The pose of a beam of whose bending the share p remains; how much it is sheared does not change.
template <class Real>
constexpr BeamPose<Real> straightened(const BeamPose<Real>& pose, const Real& fraction) {
  const Vector3<Real> back = (Real{0.5} * (Real{1.0} - fraction)) * (pose.normal_j - pose.normal_i);
  return {pose.chord, detail::nearly_unit(pose.normal_i + back),
          detail::nearly_unit(pose.normal_j - back), pose.relative_turn};
}

/// What a bond does in a pose, and what it will remember if the pose is accepted.
template <class Real>
struct BeamResponse {
  BeamLoad<Real> load;
  BeamHistory<Real> history;  ///< to be kept when the time step is
  Real strain;                ///< σ_e / E after any flow
  Real energy;                ///< elastic, after any flow, J
  Real plastic_work;          ///< taken by this flow, J
  BondStrain<Real> strains;   ///< after any flow
};

namespace detail {

/// Flow from a pose and a deformation of the shape that the bond remembers to others.
/// `trial_strain`: by which it is judged, beyond `limit`; `strain`: κ afterwards.
template <class Real>
constexpr BeamResponse<Real> flowed(const YieldingBeam<Real>& beam,
                                    const BeamHistory<Real>& history, const BeamPose<Real>& from,
                                    const BeamDeformation<Real>& before, const BeamPose<Real>& pose,
                                    const BeamDeformation<Real>& left, const Real& trial_strain,
                                    const Real& limit, const Real& strain,
                                    const Real& elastic_strain,
                                    const Quaternion<Real>& orientation_i,
                                    const Quaternion<Real>& orientation_j) {
  const Real none{0.0}, one{1.0};
  const Real twist = dot(pose.relative_turn.v, pose.normal_i + pose.normal_j);
  const BeamModes<Real> modes = beam_modes(from, before, orientation_i);
  const BeamModes<Real> modes_left = beam_modes(pose, left, orientation_i);
  const auto mutual = [&](const BeamModes<Real>& a, const BeamModes<Real>& b) {
    return mutual_energy(beam.rigidity, beam.rest_length, a, b);
  };
  const auto comes_from_below =
      both(greater(limit, history.last_strain), greater(trial_strain, limit));
  const Real way = select(comes_from_below, trial_strain - history.last_strain, one);
  const Real share = select(comes_from_below, (limit - history.last_strain) / way, none);
  const Real crossed = mutual(modes, modes_left);
  const Real along_last = mutual(history.last, modes) - mutual(history.last, modes_left);
  const Real along_trial = mutual(modes, modes) - crossed;
  return {
      beam_load(beam.rigidity, pose, left),
      {rotate(conjugate(orientation_i), pose.normal_i),
       rotate(conjugate(orientation_j), pose.normal_j),
       history.extension + (before.extension - left.extension), twist - left.twist, strain,
       modes_left, elastic_strain},
      elastic_strain,
      beam_energy(beam.rigidity, pose, left),
      along_last + share * (along_trial - along_last) + crossed - mutual(modes_left, modes_left),
      bond_strain(beam, pose, left, elastic_strain, strain)};
}

/// A deformation of which shares remain.
template <class Real>
constexpr BeamDeformation<Real> remaining(const BeamDeformation<Real>& deformation,
                                          const Real& of_extension, const Real& of_twist) {
  BeamDeformation<Real> left = deformation;
  left.extension = of_extension * deformation.extension;
  left.twist = of_twist * deformation.twist;
  return left;
}

/// What a bond does that does not flow. `strain`: σ_e / E.
template <class Real>
constexpr BeamResponse<Real> unflowed(const YieldingBeam<Real>& beam,
                                      const BeamHistory<Real>& history, const BeamPose<Real>& pose,
                                      const BeamDeformation<Real>& deformation,
                                      const Real& strain) {
  return {beam_load(beam.rigidity, pose, deformation),
          history,
          strain,
          beam_energy(beam.rigidity, pose, deformation),
          Real{0.0},
          bond_strain(beam, pose, deformation, strain, history.strain)};
}

/// The same of one that may flow later. `judged`: the strain by which that is judged.
template <class Real>
constexpr BeamResponse<Real> unflowed(const YieldingBeam<Real>& beam, BeamHistory<Real> history,
                                      const BeamPose<Real>& pose,
                                      const BeamDeformation<Real>& deformation, const Real& strain,
                                      const Real& judged, const Quaternion<Real>& orientation_i) {
  history.last = beam_modes(pose, deformation, orientation_i);
  history.last_strain = judged;
  return unflowed(beam, history, pose, deformation, strain);
}

}  // namespace detail

/// A bond that keeps its shape, in a pose and with the deformation of it.
template <class Real>
constexpr BeamResponse<Real> elastic_response(const YieldingBeam<Real>& beam,
                                              const BeamHistory<Real>& history,
                                              const BeamPose<Real>& pose,
                                              const BeamDeformation<Real>& deformation) {
  return detail::unflowed(beam, history, pose, deformation,
                          equivalent_strain(beam.yield_section, beam, pose, deformation));
}

/// A bond under radial return, in a pose and with the deformation of it since the bond last flowed.
/// Nothing that is passed in changes: keep the history of the response to accept the pose.
template <class Law, class Real>
constexpr BeamResponse<Real> radial_return_response(const YieldCurve<Law, Real>& yield,
                                                    const YieldingBeam<Real>& beam,
                                                    const BeamHistory<Real>& history,
                                                    const BeamPose<Real>& pose,
                                                    const BeamDeformation<Real>& deformation,
                                                    const Quaternion<Real>& orientation_i,
                                                    const Quaternion<Real>& orientation_j) {
  const Real strain = equivalent_strain(beam.yield_section, beam, pose, deformation);
  const PlasticFlow<Real> flow = radial_return(yield, strain, history.strain);
  if (!any(greater(flow.strain, history.strain)))
    return detail::unflowed(beam, history, pose, deformation, strain, strain, orientation_i);
  return detail::flowed(
      beam, history, pose, deformation, relaxed(pose, deformation.direction, flow.fraction),
      detail::remaining(deformation, flow.fraction, flow.fraction), strain,
      yield.limit(history.strain), flow.strain, flow.elastic_strain, orientation_i, orientation_j);
}

/// A bond under associated flow; the section is that at mid-length. All else as above.
template <class Law, class Real>
constexpr BeamResponse<Real> associated_response(const YieldCurve<Law, Real>& yield,
                                                 const YieldingBeam<Real>& beam,
                                                 const BeamHistory<Real>& history,
                                                 const BeamPose<Real>& pose,
                                                 const BeamDeformation<Real>& deformation,
                                                 const Quaternion<Real>& orientation_i,
                                                 const Quaternion<Real>& orientation_j) {
  using std::abs;
  const Real strain = equivalent_strain(beam.radius, beam.shear_ratio, pose, deformation);
  if (!any(greater(strain, yield.limit(history.strain))))
    return detail::unflowed(beam, history, pose, deformation, strain, strain, orientation_i);
  const Real& per_length = deformation.inverse_rest_length;
  const ResultantStrain<Real> resultants{
      per_length * abs(deformation.extension),
      bending_strain(JudgedSection::middle, beam, pose, deformation),
      per_length * (beam.shear_ratio * beam.radius * deformation.twist)};
  const AssociatedFlow<Real> flow =
      associated_flow(yield, resultants, beam.shear_ratio, strain, history.strain);
  return detail::flowed(beam, history, pose, deformation, straightened(pose, flow.bending),
                        detail::remaining(deformation, flow.normal, flow.twist), strain,
                        yield.limit(history.strain), flow.strain, flow.elastic_strain,
                        orientation_i, orientation_j);
}

/// The same from where the ends stand.
template <class Law, class Real>
constexpr BeamResponse<Real> associated_response(const YieldCurve<Law, Real>& yield,
                                                 const YieldingBeam<Real>& beam,
                                                 const BeamHistory<Real>& history,
                                                 const Vector3<Real>& chord,
                                                 const Quaternion<Real>& orientation_i,
                                                 const Quaternion<Real>& orientation_j) {
  const BeamPose<Real> pose =
      beam_pose(chord, history.normal_i, history.normal_j, orientation_i, orientation_j);
  return associated_response(yield, beam, history, pose,
                             elastic_deformation(beam.rest_length, pose, history), orientation_i,
                             orientation_j);
}

/// The same from where the ends stand.
template <class Law, class Real>
constexpr BeamResponse<Real> radial_return_response(const YieldCurve<Law, Real>& yield,
                                                    const YieldingBeam<Real>& beam,
                                                    const BeamHistory<Real>& history,
                                                    const Vector3<Real>& chord,
                                                    const Quaternion<Real>& orientation_i,
                                                    const Quaternion<Real>& orientation_j) {
  const BeamPose<Real> pose =
      beam_pose(chord, history.normal_i, history.normal_j, orientation_i, orientation_j);
  return radial_return_response(yield, beam, history, pose,
                                elastic_deformation(beam.rest_length, pose, history), orientation_i,
                                orientation_j);
}

/// A bond under the scaled offset of the thesis. `whole`, `whole_deformation`: pose and deformation
/// since the bond was made; the others as above.
template <class Law, class Real>
constexpr BeamResponse<Real> scaled_offset_response(
    const YieldCurve<Law, Real>& yield, const YieldingBeam<Real>& beam,
    const BeamHistory<Real>& history, const BeamPose<Real>& pose,
    const BeamDeformation<Real>& deformation, const BeamPose<Real>& whole,
    const BeamDeformation<Real>& whole_deformation, const Quaternion<Real>& orientation_i,
    const Quaternion<Real>& orientation_j) {
  const JudgedSection section = beam.yield_section;
  const Real strain = equivalent_strain(section, beam, whole, whole_deformation);
  const PlasticFlow<Real> flow = scaled_offset(yield, strain, history.strain);
  if (!any(greater(flow.strain, history.strain)))
    return detail::unflowed(beam, history, pose, deformation,
                            equivalent_strain(section, beam, pose, deformation), strain,
                            orientation_i);
  BeamResponse<Real> response = detail::flowed(
      beam, history, pose, deformation, relaxed(whole, whole_deformation.direction, flow.fraction),
      detail::remaining(whole_deformation, flow.fraction, flow.fraction), strain,
      yield.total_limit(history.strain), flow.strain, flow.elastic_strain, orientation_i,
      orientation_j);
  response.history.last_strain = strain;
  return response;
}

/// The same from where the ends stand. `rest_direction`: of the bond when it was made, in body
/// axes.
template <class Law, class Real>
constexpr BeamResponse<Real> scaled_offset_response(const YieldCurve<Law, Real>& yield,
                                                    const YieldingBeam<Real>& beam,
                                                    const BeamHistory<Real>& history,
                                                    const Vector3<Real>& rest_direction,
                                                    const Vector3<Real>& chord,
                                                    const Quaternion<Real>& orientation_i,
                                                    const Quaternion<Real>& orientation_j) {
  const BeamPose<Real> pose =
      beam_pose(chord, history.normal_i, history.normal_j, orientation_i, orientation_j);
  const BeamPose<Real> whole = beam_pose(chord, rest_direction, orientation_i, orientation_j);
  return scaled_offset_response(
      yield, beam, history, pose, elastic_deformation(beam.rest_length, pose, history), whole,
      beam_deformation(beam.rest_length, whole), orientation_i, orientation_j);
}

}  // namespace solidem

#endif
