// SPDX-License-Identifier: GPL-2.0-or-later
//
// Every column that an effect can ask for. A column that nobody asks for is never allocated.
#ifndef SOLIDEM_MODEL_COLUMNS_HPP
#define SOLIDEM_MODEL_COLUMNS_HPP

#include <cstddef>

namespace solidem {

/// What a column has one entry for: an element; a slot, which is one side of a bond; a conductor,
/// which is one side of a pair that conducts heat (a bond, or a face between two Voronoi cells).
enum class Site { element, slot, conductor };

/// A column of doubles. Columns of lanes are stored as [block of 8][component][8], rows as
/// [element][component].
struct Column {
  enum class Layout { rows, lanes };
  const char* name;
  Site site;
  Layout layout;
  int components;
  int buffers;   ///< 2 when a step reads one and writes the other
  bool dynamic;  ///< changes during a run: belongs into a checkpoint
  const char* unit;
  const char* meaning;

  constexpr std::size_t bytes() const {
    return sizeof(double) * static_cast<std::size_t>(components * buffers);
  }
};

/// A column is known by its address.
namespace columns {

using Layout = Column::Layout;

/// What a neighbour reads of an element, in one cache line.
inline constexpr Column pose{
    "pose", Site::element, Layout::rows, 8,
    2,      true,          "m, 1",       "centre x y z, spare, orientation quaternion w x y z"};
/// The same of an element that has no orientation, in half a line.
inline constexpr Column position{
    "position", Site::element, Layout::rows, 4,
    2,          true,          "m",          "centre x y z, fraction of the range"};
/// The same of one whose neighbours feel how fast it is: all that they read of it, in one line.
inline constexpr Column position_and_velocity{
    "position_and_velocity",
    Site::element,
    Layout::rows,
    8,
    2,
    true,
    "m, m/s",
    "centre x y z, fraction of the range, velocity x y z (imposed ones too, half a time step "
    "behind the centre), spare"};
inline constexpr Column last_pose{"last_pose",
                                  Site::element,
                                  Layout::rows,
                                  8,
                                  1,
                                  true,
                                  "m, 1",
                                  "the pose one step before, from which plastic work is counted"};
inline constexpr Column velocity{
    "velocity", Site::element, Layout::lanes, 3,
    1,          true,          "m/s",         "half a time step behind the pose"};
inline constexpr Column angular_velocity{"angular_velocity",
                                         Site::element,
                                         Layout::lanes,
                                         3,
                                         1,
                                         true,
                                         "rad/s",
                                         "in world axes, half a step behind"};
inline constexpr Column inverse_mass{
    "inverse_mass", Site::element, Layout::lanes, 1, 1, false, "1/kg", "of the represented mass"};
inline constexpr Column inverse_inertia{
    "inverse_inertia",        Site::element, Layout::lanes, 1, 1, false, "1/(kg m^2)",
    "of the represented mass"};
inline constexpr Column rest_direction{"rest_direction",
                                       Site::slot,
                                       Layout::lanes,
                                       3,
                                       1,
                                       false,
                                       "1",
                                       "from the element to its neighbour, in body axes"};
inline constexpr Column rest_length{"rest_length",
                                    Site::slot,
                                    Layout::lanes,
                                    1,
                                    1,
                                    false,
                                    "m",
                                    "distance of the centres when the bond was made"};
inline constexpr Column reference_length{
    "reference_length",
    Site::slot,
    Layout::lanes,
    1,
    1,
    false,
    "m",
    "of the bond at the reference temperature; 0 until heat steps after the bond was made"};
inline constexpr Column reference_rigidity{
    "reference_rigidity",
    Site::slot,
    Layout::lanes,
    4,
    1,
    false,
    "N, N m^2",
    "as bond_rigidity, before temperature acts on it; 0 until heat steps after the bond was made"};
inline constexpr Column bond_radius{"bond_radius",
                                    Site::slot,
                                    Layout::lanes,
                                    1,
                                    1,
                                    false,
                                    "m",
                                    "of the beam, where it matters and differs"};
inline constexpr Column bond_limits{
    "bond_limits",
    Site::slot,
    Layout::lanes,
    3,
    1,
    false,
    "1",
    "of yield, plastic strain and rupture over those of the laws, where materials differ in them"};
inline constexpr Column bond_rigidity{
    "bond_rigidity",
    Site::slot,
    Layout::lanes,
    4,
    1,
    false,
    "N, N m^2",
    "axial, bending, shear and torsion of the beam, where beams differ"};
inline constexpr Column section_normal{
    "section_normal",
    Site::slot,
    Layout::lanes,
    3,
    1,
    true,
    "1",
    "of the beam at the element, away from it, in the element's body axes; moves in plastic flow"};
inline constexpr Column far_section_normal{
    "far_section_normal",
    Site::slot,
    Layout::lanes,
    3,
    1,
    true,
    "1",
    "the same at the neighbour, in the neighbour's body axes"};
inline constexpr Column plastic_extension{
    "plastic_extension", Site::slot, Layout::lanes, 1, 1, true, "m", "of the beam"};
inline constexpr Column plastic_twist{"plastic_twist", Site::slot,   Layout::lanes, 1, 1, true,
                                      "rad",           "of the beam"};
inline constexpr Column plastic_strain{
    "plastic_strain", Site::slot, Layout::lanes, 1, 1, true, "1", "of the beam, equivalent"};
inline constexpr Column flow_rate{
    "flow_rate", Site::slot, Layout::lanes, 1, 1, true, "1/s", "of the plastic strain of the beam"};
inline constexpr Column flow_time{
    "flow_time", Site::slot, Layout::lanes, 1,
    1,           true,       "s",           "when the beam last flowed, at that rate"};
inline constexpr Column limit_strain{
    "limit_strain",
    Site::slot,
    Layout::lanes,
    1,
    1,
    true,
    "1",
    "equivalent, up to which the beam surely neither flows nor breaks; negative where it may have "
    "another shape than at the start"};
inline constexpr Column plastic_work{"plastic_work",
                                     Site::element,
                                     Layout::lanes,
                                     1,
                                     1,
                                     true,
                                     "J",
                                     "half of that of the element's bonds"};
inline constexpr Column plastic_heat{"plastic_heat",
                                     Site::element,
                                     Layout::lanes,
                                     1,
                                     1,
                                     true,
                                     "J",
                                     "of its plastic work, that the element was heated by"};
inline constexpr Column friction_heat{"friction_heat",
                                      Site::element,
                                      Layout::lanes,
                                      1,
                                      1,
                                      true,
                                      "J",
                                      "the element's share of what its contacts lose"};
inline constexpr Column given_friction_heat{"given_friction_heat",
                                            Site::element,
                                            Layout::lanes,
                                            1,
                                            1,
                                            true,
                                            "J",
                                            "of that, that the element was heated by"};
inline constexpr Column image_shift{"image_shift",
                                    Site::slot,
                                    Layout::lanes,
                                    3,
                                    1,
                                    false,
                                    "m",
                                    "added to the neighbour's centre across a periodic face"};
inline constexpr Column dissipated_energy{"dissipated_energy",
                                          Site::element,
                                          Layout::lanes,
                                          1,
                                          1,
                                          true,
                                          "J",
                                          "half of that of the element's pairs"};
inline constexpr Column barycentre{
    "barycentre",
    Site::element,
    Layout::rows,
    4,
    1,
    true,
    "m, 1",
    "of the neighbours, from the element, where it is a crack's face, else 0; their number"};
inline constexpr Column neighbours_at_start{
    "neighbours_at_start",
    Site::element,
    Layout::lanes,
    1,
    1,
    false,
    "1",
    "number of neighbours in range at the start, where free faces are told from cracks"};
inline constexpr Column listed_position{"listed_position",
                                        Site::element,
                                        Layout::lanes,
                                        3,
                                        1,
                                        true,
                                        "m",
                                        "where the element stood when neighbours were sought"};
inline constexpr Column listed_margin{"listed_margin",
                                      Site::element,
                                      Layout::lanes,
                                      1,
                                      1,
                                      true,
                                      "m",
                                      "how far it may move until they are sought anew"};
inline constexpr Column temperature{"temperature", Site::element, Layout::lanes,   1, 2,
                                    true,          "K",           "of the element"};
inline constexpr Column inverse_heat_capacity{
    "inverse_heat_capacity",    Site::element, Layout::lanes, 1, 1, false, "K/J",
    "of the represented volume"};
inline constexpr Column conductance{"conductance", Site::conductor, Layout::lanes, 1, 1,
                                    false,         "W/K",           "of the pair"};
inline constexpr Column conductivity{"conductivity",
                                     Site::element,
                                     Layout::lanes,
                                     1,
                                     1,
                                     false,
                                     "W/(m K)",
                                     "of the element at its temperature, where it depends on it"};
inline constexpr Column conduction_length{
    "conduction_length",
    Site::conductor,
    Layout::lanes,
    1,
    1,
    false,
    "m",
    "transmission area / distance of the pair, where the conductivity depends on temperature"};
inline constexpr Column contact_resistance{
    "contact_resistance",
    Site::conductor,
    Layout::lanes,
    1,
    1,
    false,
    "K/W",
    "of the surface between two materials, beside a conductivity that depends on temperature"};

}  // namespace columns

}  // namespace solidem

#endif
