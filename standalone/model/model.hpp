// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_MODEL_MODEL_HPP
#define SOLIDEM_MODEL_MODEL_HPP

#include <optional>
#include <vector>

#include "model/buffer.hpp"
#include "model/columns.hpp"
#include "model/slots.hpp"
#include "model/specimen.hpp"

namespace solidem {

/// The state of a simulation: a specimen, its bonds as slots, and the columns that were asked for.
class Model {
 public:
  /// Takes the specimen; its list of bonds becomes slots and is freed. `conductors`: sorted pairs
  /// that conduct heat, where these are not the bonds.
  explicit Model(Specimen specimen, const std::optional<std::vector<Pair>>& conductors = {});

  const Specimen& specimen() const { return specimen_; }
  const Slots& slots() const { return slots_; }
  /// Bonds may break and form anew.
  Slots& slots() { return slots_; }
  /// Other neighbours in the place of those before; columns of slots are laid out anew, zeroed.
  void replace_slots(Slots slots);
  /// Both sides of the pairs that conduct heat: the slots of the bonds unless others were given.
  const Slots& conductors() const { return conductors_ ? *conductors_ : slots_; }
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

  /// Centres of the elements, m: the first three of a row of doubles each, whichever column holds
  /// them.
  template <class Double>
  struct Places {
    Double* first;
    std::size_t components;
    Double* operator[](std::size_t element) const { return first + components * element; }
  };
  Places<double> places() { return {data(place_column()), components_of(place_column())}; }
  Places<const double> places() const {
    return {data(place_column()), components_of(place_column())};
  }
  /// What a step writes of them.
  Places<double> next_places() { return {next(place_column()), components_of(place_column())}; }
  /// Whether elements move, and the column of their places.
  bool moves() const { return has(solidem::columns::pose) || has(solidem::columns::place); }
  const Column& place_column() const {
    return has(solidem::columns::place) ? solidem::columns::place : solidem::columns::pose;
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

  Specimen specimen_;
  Slots slots_;
  std::optional<Slots> conductors_;
  std::vector<Storage> storage_;
  std::vector<std::int32_t> driven_;
};

}  // namespace solidem

#endif
