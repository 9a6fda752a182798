// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_MODEL_MODEL_HPP
#define SOLIDEM_MODEL_MODEL_HPP

#include <cstdint>
#include <optional>
#include <vector>

#include "model/buffer.hpp"
#include "model/columns.hpp"
#include "model/pair_table.hpp"
#include "model/slots.hpp"
#include "model/specimen.hpp"

namespace solidem {

/// The state of a simulation: a specimen, its tables of pairs, and the columns that were asked for.
///
/// The tables: `bonds`, whose slots the motion uses, and `conductors`, which pass heat. Where heat
/// passes by the bonds and these never change, both are one table, which costs nothing; else each
/// has slots, columns and a version of its own.
class Model {
 public:
  /// Takes the specimen; its list of bonds becomes slots and is freed. `conductors`: sorted pairs
  /// that conduct heat, where these are not the bonds or where bonds may change.
  explicit Model(Specimen specimen, const std::optional<std::vector<Pair>>& conductors = {});

  const Specimen& specimen() const { return specimen_; }
  const Slots& slots() const { return bonds_.slots; }
  /// For neighbours that no bond joins, and for what a checkpoint restores; bonds break and form by
  /// `break_bond` and `make_bond`.
  Slots& slots() { return bonds_.slots; }
  /// Other neighbours in the place of those before; columns of slots are laid out anew, zeroed.
  /// Lists as of Slots::list.
  void replace_slots(const std::vector<std::uint32_t>& first,
                     const std::vector<std::int32_t>& neighbours, std::size_t bonds);

  /// Empties both slots of a bond and logs that it broke. `length`: at rest, m. Their columns stay.
  void break_bond(Pair pair, double length);
  /// Puts a bond into the first free slot of each element and logs it. `length`: at rest, m. False,
  /// and nothing is done, when an element has no free slot.
  bool make_bond(Pair pair, double length);
  /// Bonds that broke or were made since this model was made, in that order: whoever keeps pairs
  /// of his own follows them here.
  const std::vector<BondChange>& bond_changes() const { return bond_changes_; }

  /// Both sides of the pairs that conduct heat.
  const Slots& conductors() const { return conductor_table().slots; }
  /// Whether they are the bonds themselves.
  bool shares_conductors() const { return !conductors_; }
  std::uint64_t conductors_version() const { return conductor_table().version; }
  /// Other conductors (sorted pairs) in the place of those before, in a table of their own; their
  /// columns are laid out anew, zeroed.
  void replace_conductors(const std::vector<Pair>& pairs);
  /// Tells that columns of the conductors have other values now.
  void touch_conductors() { ++own_conductors().version; }
  std::size_t elements() const { return specimen_.size(); }

  /// Allocates a column, zeroed; asking again changes nothing.
  void add(const Column& column);
  bool has(const Column& column) const { return find(column) != nullptr; }

  /// What a step reads (and writes, where the column has one buffer). Throws std::logic_error when
  /// nobody asked for the column.
  double* data(const Column& column);
  const double* data(const Column& column) const;
  /// What a step writes of a column of two buffers.
  double* next(const Column& column);
  /// Makes what was written what is read.
  void swap(const Column& column);
  /// The same; what was read before goes to another column of such rows.
  void swap(const Column& column, const Column& before);

  /// Three of a row of doubles of each element.
  template <class Double>
  struct Rows {
    Double* first;
    std::size_t components;
    Double* operator[](std::size_t element) const { return first + components * element; }
  };
  /// Centres of the elements, m: the first three, whichever column holds them.
  Rows<double> positions() { return {data(position_column()), components_of(position_column())}; }
  Rows<const double> positions() const {
    return {data(position_column()), components_of(position_column())};
  }
  /// What a step writes of them.
  Rows<double> next_positions() {
    return {next(position_column()), components_of(position_column())};
  }
  /// Whether elements move, and the column of their places.
  bool moves() const { return has(position_column()); }
  const Column& position_column() const {
    return has(solidem::columns::position)                ? solidem::columns::position
           : has(solidem::columns::position_and_velocity) ? solidem::columns::position_and_velocity
                                                          : solidem::columns::pose;
  }

  /// Whether neighbours feel how fast an element is.
  bool neighbours_feel_velocity() const { return has(solidem::columns::position_and_velocity); }
  /// The velocities that they feel, m/s, if so: imposed ones too, half a time step behind the
  /// centres.
  Rows<double> felt_velocities() { return {data(solidem::columns::position_and_velocity) + 4, 8}; }
  Rows<const double> felt_velocities() const {
    return {data(solidem::columns::position_and_velocity) + 4, 8};
  }
  /// What a step writes of them.
  Rows<double> next_felt_velocities() {
    return {next(solidem::columns::position_and_velocity) + 4, 8};
  }

  /// Notes elements that others than the forces between elements move, so that whoever keeps lists
  /// of neighbours looks at them.
  void note_driven(const std::vector<std::int32_t>& elements) {
    driven_.insert(driven_.end(), elements.begin(), elements.end());
  }
  const std::vector<std::int32_t>& driven() const { return driven_; }

  /// Doubles in one buffer of a column.
  std::size_t size(const Column& column) const;

  /// Position in a column of lanes.
  static constexpr std::size_t at(const Column& column, std::size_t element, int component = 0) {
    return (element / lanes * static_cast<std::size_t>(column.components) +
            static_cast<std::size_t>(component)) *
               lanes +
           element % lanes;
  }
  /// The same for a slot or a conductor.
  static constexpr std::size_t at_slot(const Column& column, std::size_t row, int lane,
                                       int component = 0) {
    return (row * static_cast<std::size_t>(column.components) +
            static_cast<std::size_t>(component)) *
               lanes +
           static_cast<std::size_t>(lane);
  }

  /// Bytes of all that the model holds.
  std::size_t bytes() const;

  /// Columns present, in the order they were asked for.
  std::vector<const Column*> columns() const;

 private:
  static std::size_t components_of(const Column& column) {
    return static_cast<std::size_t>(column.components);
  }
  struct Storage {
    const Column* column;
    Buffer<double> buffer[2];
    int current = 0;
  };
  const Storage* find(const Column& column) const;
  Storage& require(const Column& column);
  const PairTable& conductor_table() const { return conductors_ ? *conductors_ : bonds_; }
  /// Throws std::logic_error where they are the bonds.
  PairTable& own_conductors();
  /// Other slots of a table; its columns are laid out anew, zeroed.
  /// Columns of a table that was laid out anew.
  void lay_out_columns(PairTable& table);

  Specimen specimen_;
  PairTable bonds_;
  std::optional<PairTable> conductors_;
  std::vector<BondChange> bond_changes_;
  std::vector<Storage> storage_;
  std::vector<std::int32_t> driven_;
};

}  // namespace solidem

#endif
