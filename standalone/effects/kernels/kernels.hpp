// SPDX-License-Identifier: GPL-2.0-or-later
//
// The hot loops, compiled once for each instruction set and chosen at run time.
#ifndef SOLIDEM_EFFECTS_KERNELS_KERNELS_HPP
#define SOLIDEM_EFFECTS_KERNELS_KERNELS_HPP

#include <cstddef>
#include <cstdint>
#include <vector>

#include "laws/beam.hpp"
#include "laws/beam_flow.hpp"
#include "laws/bond_limit.hpp"
#include "laws/central_laws.hpp"
#include "neighbours/neighbourhood.hpp"
#include "specimen/soft_sphere_kernels.hpp"

namespace solidem {

/// What the hot loop of beams looks out for.
enum class Watch {
  elastic,     ///< nothing: bonds neither flow nor break
  watched,     ///< a strain at which bonds may break
  remembering  ///< the same of each bond, which keeps a history
};

/// Columns of bonded elements in motion, as the kernels read and write them.
struct BeamMotion {
  Watch watch;
  bool has_rotation;  ///< false: bonds are springs, elements have no orientation
  const std::uint32_t* first_row;
  const std::int32_t* neighbour;
  const double* pose;
  double* next_pose;
  double* velocity;
  double* angular_velocity;
  const double* inverse_mass;
  const double* inverse_inertia;
  const double* rest_direction;
  const double* rest_length;
  const double* bond_rigidity;    ///< null: `rigidity` holds for every bond
  const double* image_shift;      ///< null: no periodic direction
  BeamRigidity<double> rigidity;  ///< of every bond
  double kick;                    ///< s, by which the velocities move on
  double drift;                   ///< s, by which the poses move on

  // Where bonds flow or break.
  double* section_normal;
  double* far_section_normal;
  double* plastic_extension;
  double* plastic_twist;
  double* plastic_strain;
  const double* last_pose;  ///< null: no bond flows
  double* limit_strain;
  double* plastic_work;
  const double* bond_radius;  ///< null: `radius` holds for every bond
  const double* bond_limits;  ///< null: the laws hold for every bond as they stand
  const double* temperature;  ///< of the elements; null: it does not count
  double* flow_rate;          ///< null: the rate does not count
  double* flow_time;
  double time;           ///< s, of the pose
  double rate_time;      ///< s, over which rates are averaged
  double rate_per_flow;  ///< 1/s, what a flow in this step adds to the rate
  double radius;
  double shear_ratio;          ///< G / E, where the bonds are all alike
  double common_limit_strain;  ///< of bonds that are watched
  const YieldLaw* yield;       ///< null: no bond flows
  FlowRule flow_rule;
  JudgedSection yield_section, rupture_section;
  bool look_at_all;                      ///< bonds are judged elsewhere than the hot loop can tell
  const RuptureLaw* rupture;             ///< null: no bond breaks
  std::vector<std::uint32_t>* breaking;  ///< slots that break in this step are added here
};

/// What bonds do to elements, and energies that they store, as observers see them.
struct BeamEfforts {
  // Of each element, of whole blocks; all of them null: not asked for.
  double* force;   ///< N, in lanes of vectors
  double* moment;  ///< N·m, likewise
  double* energy;  ///< J, half of that of its bonds
  double*
      slot_load;  ///< force and moment of each slot from the first block on; null: not asked for
  /// Slots that have a shape of their own or may flow are left out, and added here.
  std::vector<std::uint32_t>* left;
};

/// Columns of elements in motion under central forces.
struct CentralMotion {
  CentralLaw law;
  const std::uint32_t* first_row;
  const std::int32_t* neighbour;
  const double*
      position;  ///< x y z, α R; where motion is dissipated also the velocity, and a spare
  double* next_position;
  double* velocity;
  const double* inverse_mass;
  const double* rest_length;  ///< null: radii touch at the equilibrium
  const double* image_shift;  ///< null: no periodic direction
  double range;               ///< α
  double interpenetration;    ///< a
  double kick;                ///< s, by which the velocities move on
  double drift;               ///< s, by which the positions move on

  // Where motion is dissipated.
  double dissipation;         ///< c, N·s/m; zero: none now
  double* dissipated_energy;  ///< null: nowhere

  // Where cracks are told.
  double* barycentre;                 ///< null: none
  double crack_threshold;             ///< C
  const double* neighbours_at_start;  ///< null: free faces are crack faces

  // Where neighbours change.
  const double* listed_position;  ///< null: they are fixed
  const double* listed_margin;    ///< m, that an element may move until neighbours are sought anew

  // Results.
  double compression_ratio = 0;  ///< the largest δ_eq/δ that was met
  bool outran = false;           ///< an element has moved farther than its margin
};

/// What central forces do to elements, and what they store, as observers see it.
struct CentralEfforts {
  // Of each element, of whole blocks; all of them null: not asked for.
  double* force;              ///< N, in lanes of vectors
  double* potential;          ///< J, half of that of its pairs
  double* pairs;              ///< half of how many are within range
  double* power;              ///< W, half of what its pairs dissipate; null: nothing does
  double* compression_ratio;  ///< the largest δ_eq/δ of its pairs
  double* slot_force;         ///< of each slot from the first block on, N; null: not asked for
};

/// Columns of conducting elements.
struct HeatFlow {
  const std::uint32_t* first_row;
  const std::int32_t* neighbour;
  const double* temperature;
  double* next_temperature;
  const double* inverse_heat_capacity;
  const double* conductance;
  double time_step;
};

/// Columns of conducting elements whose power is asked for, and not a step.
struct HeatPower {
  const std::uint32_t* first_row;
  const std::int32_t* neighbour;
  const double* temperature;
  double* power;
  const double* conductance;         ///< null: from the conductivities of the elements
  const double* conductivity;        ///< of each element
  const double* conduction_length;   ///< of each pair
  const double* contact_resistance;  ///< of each pair; null: none
};

/// Columns of elements that go straight on and turn on.
struct FreeMotionColumns {
  const double* pose;
  double* next_pose;
  const double* velocity;
  const double* angular_velocity;  ///< null: elements do not turn
  double time_step;
};

/// Velocities, or angular velocities, that are damped.
struct DampedMotion {
  double* velocity;  ///< null: elements have none
  double* before;    ///< a step before; null: no local damping
  const double* inverse_inertia;
  double *viscous, *local;  ///< energy that was taken from each element, J; null: none is
};

/// Elements whose motion is damped, which have moved already in this step.
struct DampedElements {
  DampedMotion translation, rotation;
  const double* inverse_mass;  ///< 0: stands still
  const double* pose;          ///< where elements turn
  double* next_position;  ///< rows: centre, range or nothing, orientation or velocity that is felt
  std::size_t row_length;
  bool velocity_is_felt;
  double time_step;
  double left;   ///< of a velocity after half a step of viscous damping
  double local;  ///< α
};

/// Dashpots of bonds, whose columns are those of BeamMotion.
struct DampedBonds {
  const double* motion;   ///< rows at the time of the pose: v, 1/m, ω, 1/J
  double critical_ratio;  ///< ζ
  double* energy;         ///< J, half of what was taken by the bonds of each element
};

/// Loads on some elements, which have moved already in this step.
struct PushedElements {
  const std::int32_t* element;  ///< which; each once
  const double* load;           ///< of each a row: force, N; nothing; moment, N·m; nothing
  std::size_t count;
  const double* pose;
  double* next_pose;
  double* velocity;
  double* angular_velocity;  ///< null: elements do not turn
  const double* inverse_mass;
  const double* inverse_inertia;
  double kick;  ///< s, by which the velocities move on
  double time_step;
};

/// Energies that went in a step, J, and how many contacts act.
struct ContactSums {
  double friction = 0, damped = 0;
  std::size_t acting = 0;
};

/// Elements as contacts see them: a row of each, v, 1/m, ω, R, one line of memory.
struct MotionRows {
  const double* velocity;
  const double* spin;  ///< null: elements do not turn
  const double *inverse_mass, *radius;
  double* rows;
};

/// Pairs of elements that may touch, in blocks. Columns of pairs are as long as there are pairs,
/// and `lanes` more: these touch nothing, and what they are told is not kept.
struct ContactColumns {
  static constexpr std::size_t pairs_a_block = 512;

  std::size_t pairs;
  const std::int32_t *element_i, *element_j;
  const double* distance;                     ///< at which they touch, m
  const double* stiffness;                    ///< k_n, N/m
  const double* damping;                      ///< c_n, N·s/m
  const double *shift_x, *shift_y, *shift_z;  ///< m, of the image of j; null: nothing is periodic
  const double* pose;
  const double* motion;               ///< MotionRows
  double tangential_stiffness_ratio;  ///< k_t / k_n
  double friction;                    ///< μ
  double time_step;                   ///< s, since the pose before

  double* history;  ///< of each pair a row: n, s, push of the dashpot, nothing
  double* load;  ///< likewise: force on i, its arm, moment of the force for an arm of 1 m, arm on j
  char* acts;    ///< likewise: 1 where it touches
  double* heat;  ///< likewise: what it loses as heat, J; null: nothing
  double heat_of_friction, heat_of_damping;  ///< fractions of what these take
  // Of each block, from where its pairs begin.
  std::uint32_t* picked;  ///< pairs that touch, or did when they were last looked at
  std::size_t* picks;     ///< how many
  ContactSums* sums;      ///< what went in them
};

/// A side of a pair, as an element sees it.
struct ContactSide {
  std::uint32_t pair;
  bool is_first;  ///< the element is i
};

/// What pairs do to their elements: those of the n-th stand from first[n] to first[n + 1].
struct ContactSides {
  const std::int32_t* element;
  const std::uint32_t* first;
  const ContactSide* side;
  const double* load;  ///< as in ContactColumns
  const char* acts;
};

/// One instruction set's kernels. Each treats the blocks [first, last).
struct Kernels {
  const char* instruction_set;
  /// Beam loads on every element, after any plastic flow, then velocity += kick · load / mass,
  /// pose += drift · velocity.
  void (*move_beams)(const BeamMotion&, std::size_t first, std::size_t last);
  /// Loads and energies of bonds; nothing moves.
  void (*find_beam_efforts)(const BeamMotion&, const BeamEfforts&, std::size_t first,
                            std::size_t last);
  /// Central forces on every element, then velocity += kick · force / mass,
  /// place += drift · velocity.
  void (*move_by_central_forces)(CentralMotion&, std::size_t first, std::size_t last);
  /// What every element shows of the cracks about it: laws/crack_face.hpp.
  void (*find_crack_faces)(const CentralMotion&, std::size_t first, std::size_t last);
  /// Forces and potentials of pairs; nothing moves.
  void (*find_central_efforts)(const CentralMotion&, const CentralEfforts&, std::size_t first,
                               std::size_t last);
  /// Pose and velocity of elements on which nothing acts.
  void (*move_freely)(const FreeMotionColumns&, std::size_t first, std::size_t last);
  /// What damping of motion changes of velocities and of the poses that follow: laws/damping.hpp.
  void (*damp)(const DampedElements&, std::size_t first, std::size_t last);
  /// The same of the dashpots of bonds: laws/bond_damping.hpp.
  void (*damp_bonds)(const BeamMotion&, const DampedBonds&, std::size_t first, std::size_t last);
  /// What loads change of velocities and of the poses that follow; of all elements at once.
  void (*push)(const PushedElements&);
  /// Lays out the rows of some elements, in ascending order.
  void (*lay_out_motion)(const MotionRows&, const std::int32_t* element, std::size_t count);
  /// Picks pairs of some blocks.
  void (*pick_contacts)(const ContactColumns&, std::size_t first, std::size_t last);
  /// Loads of those that are picked, and what they remember: laws/linear_contact.hpp.
  void (*find_contact_loads)(const ContactColumns&, std::size_t first, std::size_t last);
  /// Adds up the loads on elements [first, last): on which something acts, and a row for each as in
  /// PushedElements. Returns how many.
  std::size_t (*sum_contact_loads)(const ContactSides&, std::size_t first, std::size_t last,
                                   std::int32_t* element, double* sums);
  /// Which of some positions are near; given to find_neighbours.
  PickNear pick_near;
  /// Explicit Euler step of the temperatures.
  void (*conduct)(const HeatFlow&, std::size_t first, std::size_t last);
  /// Power conducted into each element.
  void (*conducted_power)(const HeatPower&, std::size_t first, std::size_t last);
  /// What packs spheres.
  SoftSphereKernels soft_spheres;
};

/// The kernels that this machine can run, the best first.
std::vector<const Kernels*> usable_kernels();

/// The kernels for this machine's best instruction set, but those of another one that were measured
/// to be faster on such a processor; the environment variable SOLIDEM_INSTRUCTION_SET (baseline,
/// x86_64_v3, x86_64_v4) asks for one set alone.
/// Throws InputError when it names one that is unknown or that this machine lacks.
const Kernels& kernels();

}  // namespace solidem

#endif
